// Stable sorts of records by a 64-bit key: one result on every machine and standard library, no allocation.
// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstdint>

#include "isostep/scalar/platform.hpp"

namespace isostep {

/// Insertion beats counting below this many records: a counting pass costs its table, whatever their number.
inline constexpr std::uint32_t kInsertionSortLimit = 32;

/// Sorts ascending by key(record); equal keys keep their order. It is for few records, or many that are nearly sorted.
/// `key` is a function object; write it as a struct with an ISO_INLINE call operator, as a lambda leaves a weak symbol.
template <class Record, class Key>
ISO_INLINE constexpr void insertion_sort(Record* records, std::uint32_t count, const Key& key) {
  for (std::uint32_t i = 1; i < count; ++i) {
    const Record moving = records[i];
    const std::uint64_t moving_key = key(moving);
    std::uint32_t hole = i;
    while (hole > 0 && moving_key < key(records[hole - 1u])) {
      records[hole] = records[hole - 1u];
      --hole;
    }
    records[hole] = moving;
  }
}

namespace detail {
/// One stable counting pass from `from` to `to` by the `kDigitBits` key bits above `shift`.
template <int kDigitBits, class Record, class Key>
ISO_INLINE constexpr void counting_pass(const Record* from, Record* to, std::uint32_t count, int shift,
                                        const Key& key) {
  constexpr std::uint32_t kMask = (1u << kDigitBits) - 1u;
  std::uint32_t starts[kMask + 1u] = {};
  for (std::uint32_t i = 0; i < count; ++i) ++starts[static_cast<std::uint32_t>(key(from[i]) >> shift) & kMask];
  std::uint32_t total = 0;
  for (std::uint32_t& start : starts) {
    const std::uint32_t here = start;
    start = total;
    total += here;
  }
  for (std::uint32_t i = 0; i < count; ++i) {
    to[starts[static_cast<std::uint32_t>(key(from[i]) >> shift) & kMask]++] = from[i];
  }
}
}  // namespace detail

/// Sorts ascending by key(record); equal keys keep their order. `scratch` holds `count` records and must not overlap. A
/// radix sort from the lowest bits: a digit starts at the lowest bit, not yet sorted, in which the keys differ, so bits
/// that all keys share cost nothing: pairs of slots below 2048 take two passes of 11 bits.
template <class Record, class Key>
ISO_INLINE constexpr void stable_sort(Record* records, Record* scratch, std::uint32_t count, const Key& key) {
  if (count <= kInsertionSortLimit) {
    insertion_sort(records, count, key);
    return;
  }
  const std::uint64_t first = key(records[0]);
  std::uint64_t differing = 0;
  bool sorted = true;
  std::uint64_t previous = first;
  for (std::uint32_t i = 1; i < count; ++i) {
    const std::uint64_t current = key(records[i]);
    differing |= current ^ first;
    sorted = sorted && previous <= current;
    previous = current;
  }
  if (sorted) return;
  const bool many = count > 1024;  // a table of 2048 counts is then smaller than the data
  Record* from = records;
  Record* to = scratch;
  while (differing != 0) {
    const int shift = std::countr_zero(differing);
    const int digit = many ? 11 : 8;
    if (many) detail::counting_pass<11>(from, to, count, shift, key);
    if (!many) detail::counting_pass<8>(from, to, count, shift, key);
    differing = shift + digit >= 64 ? 0 : differing >> (shift + digit) << (shift + digit);
    Record* const swapped = from;
    from = to;
    to = swapped;
  }
  if (from != records) {
    for (std::uint32_t i = 0; i < count; ++i) records[i] = from[i];
  }
}

/// The key of a record that is its own key.
struct OwnKey {
  ISO_INLINE constexpr std::uint64_t operator()(std::uint64_t record) const { return record; }
};

}  // namespace isostep
