// Conversions between C structs and their C++ twins, member by member, at the offsets of layout.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstring>

#include "layout/structs.hpp"
#include "status.hpp"

namespace isostep::c {

template <class Tag> constexpr std::uint64_t id_bits(Id<Tag> id) {
  return std::uint64_t{id.slot} | std::uint64_t{id.generation} << 32;
}
template <class IdType> constexpr IdType id_of(std::uint64_t bits) {
  return {static_cast<std::uint32_t>(bits), static_cast<std::uint32_t>(bits >> 32)};
}

/// [bytes] The most by which a struct of a later release is longer than this release's.
inline constexpr std::size_t kMostUnknown = 4096;

/// Copies the bits: numbers cross raw, T from the bits of a Raw or the other way round.
template <class To, class From> To same_bits(From from) {
  static_assert(sizeof(To) == sizeof(From) && std::is_trivially_copyable_v<To>);
  To to;
  std::memcpy(static_cast<void*>(&to), &from, sizeof to);
  return to;
}

template <class T> void put_at(std::uint8_t* at, const T& value);

/// Writes the members that lie before `end`.
struct Put {
  std::uint8_t* to;
  std::size_t end;
  Placing placing;

  template <class T> void operator()(const char*, const T& value) {
    if constexpr (kIsOptional<T>) {
      one(value.has_value());
      one(value ? *value : typename T::value_type{});
    } else {
      one(value);
    }
  }
  template <class T> void one(const T& value) {
    const std::size_t at = placing.next<T>();
    if (at + extent_of<T>().size <= end) put_at(to + at, value);
  }
};

/// Writes a value into bytes that are 0.
template <class T> void put_at(std::uint8_t* at, const T& value) {
  if constexpr (std::is_bounded_array_v<T>) {
    constexpr std::size_t kStride = extent_of<std::remove_extent_t<T>>().size;
    for (std::size_t i = 0; i < std::extent_v<T>; ++i) put_at(at + i * kStride, value[i]);
  } else if constexpr (kIsId<T>) {
    put_at(at, id_bits(value));
  } else if constexpr (kIsPointer<T>) {
    std::memcpy(at, &value.at, sizeof value.at);
  } else if constexpr (CStruct<T>) {
    Put put{at, extent_of<T>().size, {}};
    CFields<T>::fields(put, value);
  } else if constexpr (std::is_enum_v<T>) {
    put_at(at, static_cast<std::uint32_t>(value));
  } else if constexpr (std::is_same_v<T, bool>) {
    *at = value ? 1 : 0;
  } else {
    static_assert(std::is_trivially_copyable_v<T>);
    std::memcpy(at, &value, sizeof value);
  }
}

/// A member with a value that it cannot have.
struct Flaw {
  const char* member = nullptr;

  explicit operator bool() const { return member != nullptr; }
};

template <class T> Flaw take_at(const std::uint8_t* at, T& value);

/// Reads the members that lie before `end`; the others stay. `cut` is set where a member lies across it.
struct Take {
  const std::uint8_t* from;
  std::size_t end;
  Placing placing;
  Flaw flaw;
  bool cut = false;

  template <class T> void operator()(const char* name, T& value) {
    if constexpr (kIsOptional<T>) {
      bool has = value.has_value();
      typename T::value_type inner = value ? *value : typename T::value_type{};
      one(name, has);
      one(name, inner);
      if (has) value = inner;
      else value.reset();
    } else {
      one(name, value);
    }
  }
  template <class T> void one(const char* name, T& value) {
    const std::size_t at = placing.next<T>(), after = at + extent_of<T>().size;
    if (at < end && end < after) cut = true;
    if (end < after || flaw) return;
    flaw = take_at(from + at, value);
    if (flaw && flaw.member[0] == '\0') flaw.member = name;
  }
};

/// Reads a value from bytes. Its flaw has an empty text: the caller names the place.
template <class T> Flaw take_at(const std::uint8_t* at, T& value) {
  if constexpr (std::is_bounded_array_v<T>) {
    constexpr std::size_t kStride = extent_of<std::remove_extent_t<T>>().size;
    Flaw flaw;
    for (std::size_t i = 0; i < std::extent_v<T> && !flaw; ++i) flaw = take_at(at + i * kStride, value[i]);
    return flaw;
  } else if constexpr (kIsId<T>) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, at, sizeof bits);
    value = id_of<T>(bits);
  } else if constexpr (kIsPointer<T>) {
    std::memcpy(&value.at, at, sizeof value.at);
  } else if constexpr (CStruct<T>) {
    Take take{at, extent_of<T>().size, {}, {}};
    CFields<T>::fields(take, value);
    return take.flaw;
  } else if constexpr (std::is_enum_v<T>) {
    std::uint32_t number = 0;
    std::memcpy(&number, at, sizeof number);
    if (number >= Enumerators<T>::kCount) return {""};
    value = static_cast<T>(number);
  } else if constexpr (std::is_same_v<T, bool>) {
    if (*at > 1) return {""};
    value = *at == 1;
  } else {
    std::memcpy(static_cast<void*>(&value), at, sizeof value);
  }
  return {};
}

/// Returns true if the size is one of this library's release, an earlier one or a later one.
template <class T> bool is_struct_size(std::size_t size) {
  return size >= kHeadSize && size <= sized_size<T>() + kMostUnknown;
}

/// Checks a caller's struct by its size: that it is one, and that the bytes which this library does not know are 0.
iso_status check_size(const void* from, std::size_t known, const char* call, std::size_t& size);

/// Takes a struct that begins with its size. `value` keeps the members that the caller's version of the struct lacks.
template <class T> iso_status take_sized(const char* call, const void* from, T& value) {
  std::size_t size = 0;
  const iso_status status = check_size(from, sized_size<T>(), call, size);
  if (status != kOk) return status;
  Take take{static_cast<const std::uint8_t*>(from), size, {kHeadSize, 1, 0, kMembersReleased<T>}, {}};
  CFields<T>::fields(take, value);
  if (take.cut) return refuse(ISO_WRONG_SIZE, call, "size", "the end of a member");
  return take.flaw ? refuse(ISO_BAD_ENUM, call, take.flaw.member) : kOk;
}
/// Takes a struct that does not begin with its size.
template <class T> iso_status take_plain(const char* call, const void* from, T& value) {
  if (from == nullptr) return refuse(ISO_NULL, call);
  const Flaw flaw = take_at(static_cast<const std::uint8_t*>(from), value);
  return flaw ? refuse(ISO_BAD_ENUM, call, flaw.member) : kOk;
}

template <class T> void put_plain(void* to, const T& value) {
  std::memset(to, 0, extent_of<T>().size);
  put_at(static_cast<std::uint8_t*>(to), value);
}
/// Fills a struct whose size the caller has set: bytes beyond the members that this library knows become zeros.
template <class T> iso_status put_sized(const char* call, void* to, const T& value) {
  if (to == nullptr) return refuse(ISO_NULL, call, "out");
  std::uint32_t size = 0;
  std::memcpy(&size, to, sizeof size);
  if (!is_struct_size<T>(size)) return refuse(ISO_WRONG_SIZE, call, "out");
  auto* const bytes = static_cast<std::uint8_t*>(to);
  std::memset(bytes + sizeof size, 0, size - sizeof size);
  Put put{bytes, size, {kHeadSize, 1, 0, kMembersReleased<T>}};
  CFields<T>::fields(put, value);
  return kOk;
}
/// Writes, for _init, the defaults into a struct of the caller's that has so many bytes.
template <class T> iso_status init_sized(const char* call, void* to, std::size_t size) {
  if (to == nullptr) return refuse(ISO_NULL, call, "out");
  if (!is_struct_size<T>(size)) return refuse(ISO_WRONG_SIZE, call, "size", "sizeof of the struct");
  const auto given = static_cast<std::uint32_t>(size);
  std::memcpy(to, &given, sizeof given);
  return put_sized(call, to, T{});
}

}  // namespace isostep::c
