// The layout of a C struct's members: computed from the `fields` of its C++ twin, the same on every target.
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <type_traits>

#include "isostep/core/fields.hpp"
#include "isostep/core/id.hpp"

namespace isostep::c {

/// The members of a C++ struct in C's order: its own `fields`, or a specialisation's (twins.hpp).
template <class T> struct CFields;
template <HasFields T> struct CFields<T> {
  template <class Visitor, class Self> static ISO_INLINE constexpr void fields(Visitor&& visit, Self&& self) {
    T::fields(visit, self);
  }
};
template <class T>
concept CStruct = requires(T& value) {
  CFields<T>::fields(isostep::detail::AnyVisitor{}, value);
};

/// A pointer as a member: eight bytes on every target.
template <class T> struct Pointer { const T* at; };

template <class T> inline constexpr bool kIsId = false;
template <class Tag> inline constexpr bool kIsId<Id<Tag>> = true;
template <class T> inline constexpr bool kIsPointer = false;
template <class T> inline constexpr bool kIsPointer<Pointer<T>> = true;
template <class T> inline constexpr bool kIsOptional = false;
template <class T> inline constexpr bool kIsOptional<std::optional<T>> = true;

/// [bytes] The head of a struct that goes by pointer: its size as the caller knows it, and a reserved word.
inline constexpr std::size_t kHeadSize = 8;
/// The number of members that a struct that goes by pointer had in the last release, if it has grown since; else 0.
/// Later members begin where the struct ended then, so callers of that release pass none of them.
template <class T> inline constexpr int kMembersReleased = 0;

struct Extent {
  std::size_t size, align;
};
constexpr std::size_t round_up(std::size_t n, std::size_t to) { return (n + to - 1) / to * to; }

template <class T> constexpr Extent extent_of();
template <> constexpr Extent extent_of<bool>() { return {1, 1}; }  // which is asked for before the others are defined

/// Places one member behind another, each at a multiple of its own alignment.
struct Placing {
  std::size_t end = 0;
  std::size_t align = 1;
  int count = 0;
  int released = 0;  // kMembersReleased

  /// The offset of the next member.
  template <class T> constexpr std::size_t next() {
    constexpr Extent extent = extent_of<T>();
    if (released != 0 && count == released) end = round_up(end, 8);
    ++count;
    const std::size_t at = round_up(end, extent.align);
    end = at + extent.size;
    if (align < extent.align) align = extent.align;
    return at;
  }
};

struct ExtentVisitor {
  Placing* placing;
  template <class T> constexpr void operator()(const char*, const T&) const {
    if constexpr (kIsOptional<T>) {
      placing->next<bool>();
      placing->next<typename T::value_type>();
    } else {
      placing->next<T>();
    }
  }
};

/// The extent of a member. Enumerations have four bytes, truth values one, ids and pointers eight.
template <class T> constexpr Extent extent_of() {
  if constexpr (std::is_bounded_array_v<T>) {
    constexpr Extent one = extent_of<std::remove_extent_t<T>>();
    return {one.size * std::extent_v<T>, one.align};
  } else if constexpr (kIsId<T> || kIsPointer<T>) {
    return {8, 8};
  } else if constexpr (CStruct<T>) {
    Placing placing;
    const T value{};
    CFields<T>::fields(ExtentVisitor{&placing}, value);
    return {round_up(placing.end, placing.align), placing.align};
  } else if constexpr (std::is_enum_v<T>) {
    return {4, 4};
  } else {
    return {sizeof(T), sizeof(T)};
  }
}

/// [bytes] The size of a struct that goes by pointer: a multiple of eight, the head included.
template <class T> constexpr std::size_t sized_size() {
  Placing placing{kHeadSize};
  placing.released = kMembersReleased<T>;
  const T value{};
  CFields<T>::fields(ExtentVisitor{&placing}, value);
  return round_up(placing.end, 8);
}

/// Counts members in C's form: an optional one is two.
struct CountVisitor {
  std::size_t* count;
  template <class T> constexpr void operator()(const char*, const T&) const { *count += kIsOptional<T> ? 2 : 1; }
};
template <class T> constexpr std::size_t member_count() {
  std::size_t count = 0;
  const T value{};
  CFields<T>::fields(CountVisitor{&count}, value);
  return count;
}

/// The offsets of all members, to compare with a C compiler's of the header.
template <class T> struct OffsetsVisitor {
  Placing* placing;
  std::array<std::size_t, member_count<T>()>* offsets;
  template <class M> constexpr void operator()(const char*, const M&) const {
    if constexpr (kIsOptional<M>) {
      one<bool>();
      one<typename M::value_type>();
    } else {
      one<M>();
    }
  }
  template <class M> constexpr void one() const {
    const auto i = static_cast<std::size_t>(placing->count);
    (*offsets)[i] = placing->next<M>();
  }
};
template <class T, bool kSized> constexpr std::array<std::size_t, member_count<T>()> offsets_of() {
  std::array<std::size_t, member_count<T>()> offsets{};
  Placing placing{kSized ? kHeadSize : 0};
  if constexpr (kSized) placing.released = kMembersReleased<T>;
  const T value{};
  CFields<T>::fields(OffsetsVisitor<T>{&placing, &offsets}, value);
  return offsets;
}

}  // namespace isostep::c
