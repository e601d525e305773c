// The first field at which two states differ, by name: "bodies[17].velocity.x".
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "isostep/core/short_text.hpp"
#include "isostep/state/field_table.hpp"

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

/// Counts all differences and keeps the first few.
class DiffReport {
 public:
  explicit DiffReport(std::size_t keep = 1);
  ~DiffReport();
  DiffReport(const DiffReport&) = delete;
  DiffReport& operator=(const DiffReport&) = delete;

  bool any() const;
  std::uint64_t count() const;
  const std::vector<Difference>& kept() const;

  /// Adds a field whose bits differ.
  void add(const PathPart& path, FieldFormat format, std::uint64_t a, std::uint64_t b);

 private:
  std::size_t keep_;
  std::uint64_t count_;
  std::vector<Difference> kept_;
};

/// Compares two values of this type by the canonical bytes of each.
void diff_bytes(const PathPart& path, const FieldType& type, const std::uint8_t* a, const std::uint8_t* b,
                DiffReport& report);

/// Compares by bits: -0 differs from +0, and a NaN equals itself.
template <class T> ISO_INLINE void diff_value(const PathPart& path, const T& a, const T& b, DiffReport& report) {
  std::uint8_t bytes_a[kPackedSize<T> + 1];
  std::uint8_t bytes_b[kPackedSize<T> + 1];
  pack(bytes_a, a);
  pack(bytes_b, b);
  diff_bytes(path, kFieldType<T>, bytes_a, bytes_b, report);
}
template <class T> ISO_INLINE void diff_value(const char* name, const T& a, const T& b, DiffReport& report) {
  diff_value(PathPart{nullptr, name, 0}, a, b, report);
}

/// Compares the lengths, as "name.count", then the records as far as both go.
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
