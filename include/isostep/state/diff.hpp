// The first field at which two states differ, by name: "bodies[17].velocity.x".
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "isostep/core/short_text.hpp"
#include "isostep/state/pack.hpp"
#include "isostep/state/value_text.hpp"

namespace isostep {

struct Difference {
  ShortText<160> path;
  ShortText<80> a, b;            // decimal
  ShortText<24> bits_a, bits_b;  // hexadecimal
  std::uint64_t steps;           // representable values from a to b
  const char* unit;              // of `steps`: "ulp", "lsb", or "" for integers
};

/// "bodies[17].velocity.x: 1.5 | 1.25 (0x3fc00000 | 0x3fa00000), 2097152 ulp apart"
std::string describe(const Difference& difference);

/// A name, or an index, and what it is a part of; a chain on the stack, made into text only for a difference.
struct PathPart {
  const PathPart* outer;  // null at the root
  const char* name;       // null for an index
  std::size_t index;
};

/// "bodies[17].velocity.x"
std::string path_text(const PathPart& path);

/// Counts every difference, keeps the first few.
class DiffReport {
 public:
  explicit DiffReport(std::size_t keep = 1);
  ~DiffReport();
  DiffReport(const DiffReport&) = delete;
  DiffReport& operator=(const DiffReport&) = delete;

  bool any() const;
  std::uint64_t count() const;
  const std::vector<Difference>& kept() const;

  /// Called when the bits of a field differ.
  void add(const PathPart& path, FieldFormat format, std::uint64_t a, std::uint64_t b);

 private:
  std::size_t keep_;
  std::uint64_t count_;
  std::vector<Difference> kept_;
};

namespace detail {
template <class T>
ISO_INLINE void diff_packed(const PathPart& path, const std::uint8_t*& a, const std::uint8_t*& b, const T& type,
                            DiffReport& report);

struct DiffVisitor {
  const PathPart* outer;
  const std::uint8_t** a;
  const std::uint8_t** b;
  DiffReport* report;
  template <class T> ISO_INLINE void operator()(const char* name, const T& member) const {
    diff_packed(PathPart{outer, name, 0}, *a, *b, member, *report);
  }
};

/// Walks T's structure along the canonical bytes of both values; `type` gives the structure, its values do not matter.
template <class T>
ISO_INLINE void diff_packed(const PathPart& path, const std::uint8_t*& a, const std::uint8_t*& b, const T& type,
                            DiffReport& report) {
  if constexpr (std::is_bounded_array_v<T>) {
    for (std::size_t i = 0; i < std::extent_v<T>; ++i) diff_packed(PathPart{&path, nullptr, i}, a, b, type[i], report);
  } else if constexpr (HasFields<T>) {
    T::fields(DiffVisitor{&path, &a, &b, &report}, type);
  } else {
    const std::uint64_t bits_a = load_le<FieldBits<T>>(a);
    const std::uint64_t bits_b = load_le<FieldBits<T>>(b);
    if (bits_a != bits_b) report.add(path, kFieldFormat<T>, bits_a, bits_b);
    a += sizeof(T);
    b += sizeof(T);
  }
}
}  // namespace detail

/// By bits: -0 differs from +0, and a NaN equals itself.
template <class T> ISO_INLINE void diff_value(const PathPart& path, const T& a, const T& b, DiffReport& report) {
  std::uint8_t bytes_a[kPackedSize<T> + 1];
  std::uint8_t bytes_b[kPackedSize<T> + 1];
  pack(bytes_a, a);
  pack(bytes_b, b);
  if (std::memcmp(bytes_a, bytes_b, kPackedSize<T>) == 0) return;
  const std::uint8_t* at_a = bytes_a;
  const std::uint8_t* at_b = bytes_b;
  detail::diff_packed(path, at_a, at_b, a, report);
}
template <class T> ISO_INLINE void diff_value(const char* name, const T& a, const T& b, DiffReport& report) {
  diff_value(PathPart{nullptr, name, 0}, a, b, report);
}

/// Lengths first, as "name.count", then record by record as far as both go.
template <class T>
ISO_INLINE void diff_records(const char* name, const T* a, std::size_t count_a, const T* b, std::size_t count_b,
                             DiffReport& report) {
  const PathPart root{nullptr, name, 0};
  if (count_a != count_b) {
    report.add(PathPart{&root, "count", 0}, kFieldFormat<std::uint64_t>, count_a, count_b);
  }
  const std::size_t common = count_a < count_b ? count_a : count_b;
  for (std::size_t i = 0; i < common; ++i) diff_value(PathPart{&root, nullptr, i}, a[i], b[i], report);
}

}  // namespace isostep
