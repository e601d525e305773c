// Bitset: a set of small integers over 64-bit words that grows to the largest member and lists them in ascending order.
// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

#include "isostep/scalar/platform.hpp"

namespace isostep {

/// Words are kept when bits are cleared, so a set that has seen its largest member allocates no more.
class Bitset {
 public:
  static constexpr std::uint32_t kNone = 0xffffffffu;

  ISO_INLINE bool test(std::uint32_t i) const {
    const std::uint32_t word = i >> 6;
    return word < words_.size() && (words_[word] >> (i & 63u) & 1u) != 0;
  }
  ISO_INLINE void set(std::uint32_t i) {
    grow(i);
    words_[i >> 6] |= bit(i);
  }
  ISO_INLINE void reset(std::uint32_t i) {
    if ((i >> 6) < words_.size()) words_[i >> 6] &= ~bit(i);
  }
  /// Adds i. Returns true if it was not a member before.
  ISO_INLINE bool insert(std::uint32_t i) {
    grow(i);
    const bool fresh = (words_[i >> 6] & bit(i)) == 0;
    words_[i >> 6] |= bit(i);
    return fresh;
  }
  ISO_INLINE void clear() {
    for (std::uint64_t& word : words_) word = 0;
  }
  /// Returns the smallest member not below `from`, or kNone.
  ISO_INLINE std::uint32_t find_next(std::uint32_t from) const {
    const std::uint32_t words = static_cast<std::uint32_t>(words_.size());
    std::uint32_t word = from >> 6;
    if (word >= words) return kNone;
    std::uint64_t left = words_[word] >> (from & 63u) << (from & 63u);
    while (left == 0) {
      if (++word == words) return kNone;
      left = words_[word];
    }
    return word << 6 | static_cast<std::uint32_t>(std::countr_zero(left));
  }
  ISO_INLINE std::uint32_t count() const {
    std::uint32_t total = 0;
    for (const std::uint64_t word : words_) total += static_cast<std::uint32_t>(std::popcount(word));
    return total;
  }
  ISO_INLINE bool any() const {
    for (const std::uint64_t word : words_) {
      if (word != 0) return true;
    }
    return false;
  }

 private:
  static ISO_INLINE constexpr std::uint64_t bit(std::uint32_t i) { return std::uint64_t{1} << (i & 63u); }
  ISO_INLINE void grow(std::uint32_t i) {
    if ((i >> 6) >= words_.size()) words_.resize((i >> 6) + 1u, 0);
  }

  std::vector<std::uint64_t> words_;
};

}  // namespace isostep
