// composite(world, user): a world and the game's own state as one thing to save, load, hash and write down.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <type_traits>

#include "isostep/state/concepts.hpp"
#include "isostep/state/hash.hpp"

namespace isostep {

/// State that is a plain struct with `fields`: its snapshot is a copy.
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
/// Loads a part. Returns false if the part refuses.
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

/// The snapshots of a composite's parts.
template <class World, class User> struct CompositeSnapshot {
  typename detail::SnapshotOf<World>::Type world;
  typename detail::SnapshotOf<User>::Type user;
};

/// A world and the game's own state. A game derives from Composite<World, State>, which holds both by value, and adds
/// `step`. Whatever it remembers from frame to frame is a field of `user`: members beside it are neither saved nor
/// hashed, and a sync test finds them. Composite<World&, State&> refers to parts that live elsewhere.
template <class WorldPart, class UserPart>
requires detail::CompositePart<std::remove_reference_t<WorldPart>> &&
    detail::CompositePart<std::remove_reference_t<UserPart>>
struct Composite {
  WorldPart world{};
  UserPart user{};

  using Snapshot = CompositeSnapshot<std::remove_cvref_t<WorldPart>, std::remove_cvref_t<UserPart>>;

  ISO_INLINE void save(Snapshot& to) const {
    detail::save_part(world, to.world);
    detail::save_part(user, to.user);
  }
  /// Loads both parts. If the world refuses, it returns false and leaves the user's part as it was.
  ISO_INLINE bool load(const Snapshot& from) {
    return detail::load_part(world, from.world) && detail::load_part(user, from.user);
  }
  ISO_INLINE std::uint64_t hash() const {
    HashCombiner combiner;
    combiner.add(detail::hash_part(world));
    combiner.add(detail::hash_part(user));
    return combiner.value();
  }

  ISO_INLINE void write_portable(Writer& writer) const {
    detail::write_part(world, writer);
    detail::write_part(user, writer);
  }
  /// Reads both parts or neither.
  ISO_INLINE Result<void> read_portable(Reader& reader) {
    typename detail::SnapshotOf<std::remove_cvref_t<WorldPart>>::Type before;
    detail::save_part(world, before);
    if (Result<void> read = detail::read_part(world, reader); !read) return read;
    Result<void> read = detail::read_part(user, reader);
    if (!read) detail::load_part(world, before);
    return read;
  }
};

/// Returns a composite that refers to these parts, which must outlive it.
template <class World, class User> ISO_INLINE Composite<World&, User&> composite(World& world, User& user) {
  return {world, user};
}

}  // namespace isostep
