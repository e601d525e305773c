// composite(world, user): a world and the game's own state as one thing to save, load, hash and write down.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <type_traits>

#include "isostep/state/concepts.hpp"
#include "isostep/state/hash.hpp"

namespace isostep {

/// State that is just a struct with `fields`: its snapshot is a copy.
template <class T>
concept PlainState = HasFields<T> && std::is_trivially_copyable_v<T> && !Rollbackable<T>;

namespace detail {
template <class T>
concept CompositePart = Rollbackable<std::remove_const_t<T>> || PlainState<std::remove_const_t<T>>;

template <class T> struct SnapshotOf { using Type = T; };
template <class T> struct SnapshotOf<const T> : SnapshotOf<T> {};
template <Rollbackable T> struct SnapshotOf<T> { using Type = typename T::Snapshot; };

template <class T> ISO_INLINE void save_part(const T& part, typename SnapshotOf<T>::Type& to) {
  if constexpr (PlainState<std::remove_const_t<T>>) {
    to = part;
  } else {
    part.save(to);
  }
}
/// False where the part says that it was refused.
template <class T> ISO_INLINE bool load_part(T& part, const typename SnapshotOf<T>::Type& from) {
  if constexpr (PlainState<T>) {
    part = from;
  } else if constexpr (std::is_same_v<decltype(part.load(from)), bool>) {
    return part.load(from);
  } else {
    part.load(from);
  }
  return true;
}
template <class T> ISO_INLINE std::uint64_t hash_part(const T& part) {
  if constexpr (PlainState<std::remove_const_t<T>>) {
    return hash_records_by_fields(&part, 1);
  } else {
    return part.hash();
  }
}
template <class T> ISO_INLINE void write_part(const T& part, Writer& writer) {
  if constexpr (PlainState<std::remove_const_t<T>>) {
    writer.write(part);
  } else {
    part.write_portable(writer);
  }
}
template <class T> ISO_INLINE Result<void> read_part(T& part, Reader& reader) {
  if constexpr (PlainState<T>) {
    T value{};
    if (reader.read(value)) part = value;
    return reader.result("user state");
  } else {
    return part.read_portable(reader);
  }
}
}  // namespace detail

/// What a composite of these parts is saved into. The same for parts that are const.
template <class World, class User> struct CompositeSnapshot {
  typename detail::SnapshotOf<World>::Type world;
  typename detail::SnapshotOf<User>::Type user;
};

/// Holds references: lives no longer than its parts. Of const parts, as in a game's `save() const`, it is saved, hashed
/// and written; a game's `load` makes another one of parts that may change.
template <detail::CompositePart World, detail::CompositePart User> class Composite {
 public:
  using Snapshot = CompositeSnapshot<std::remove_const_t<World>, std::remove_const_t<User>>;

  ISO_INLINE Composite(World& world, User& user) : world_(&world), user_(&user) {}

  ISO_INLINE void save(Snapshot& to) const {
    detail::save_part(*world_, to.world);
    detail::save_part(*user_, to.user);
  }
  /// False, and the user's part is as it was, where the world refuses.
  ISO_INLINE bool load(const Snapshot& from) {
    return detail::load_part(*world_, from.world) && detail::load_part(*user_, from.user);
  }
  ISO_INLINE std::uint64_t hash() const {
    HashCombiner root;
    root.add(detail::hash_part(*world_));
    root.add(detail::hash_part(*user_));
    return root.value();
  }

  ISO_INLINE void write_portable(Writer& writer) const {
    detail::write_part(*world_, writer);
    detail::write_part(*user_, writer);
  }
  /// Both parts or neither.
  ISO_INLINE Result<void> read_portable(Reader& reader) {
    typename detail::SnapshotOf<World>::Type before;
    detail::save_part(*world_, before);
    if (Result<void> read = detail::read_part(*world_, reader); !read) return read;
    Result<void> read = detail::read_part(*user_, reader);
    if (!read) detail::load_part(*world_, before);
    return read;
  }

 private:
  World* world_;
  User* user_;
};

template <class World, class User> ISO_INLINE Composite<World, User> composite(World& world, User& user) {
  return Composite<World, User>(world, user);
}

}  // namespace isostep
