// ReplayWindow: the packets of a connection that have come: each counts once, and one too old to tell counts not at
// all.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace isostep::transport {

/// A sliding window over the senders' numbers, in the blocks of a ring, so that it moves without a shift.
/// Source: RFC 4303 sec. 3.4.3 and RFC 6347 sec. 4.1.2.6 (the window), RFC 6479 (the ring).
class ReplayWindow {
 public:
  /// [packets] The length of the window behind the newest; at 60 a second lines may be 17 s late.
  static constexpr std::uint32_t kSize = 1024;

  /// The packet has not come yet. It is asked before the packet is opened, which costs more.
  bool is_fresh(std::uint64_t number) const {
    if (number >= end_) return true;
    return end_ - number <= kSize && (block_of(number) >> number % kBits & 1) == 0;
  }
  /// Marks a fresh number, once it is known to be the sender's.
  void mark(std::uint64_t number) {
    if (number >= end_) {
      const std::uint64_t newest = number / kBits;
      std::uint64_t block = (end_ + kBits - 1) / kBits;  // the first that holds none of those that have come
      if (newest >= block + kBlocks) block = newest - kBlocks + 1;
      for (; block <= newest; ++block) blocks_[block % kBlocks] = 0;
      end_ = number + 1;
    }
    blocks_[number / kBits % kBlocks] |= std::uint64_t{1} << number % kBits;
  }

  /// One past the newest.
  std::uint64_t end() const { return end_; }

 private:
  static constexpr std::uint32_t kBits = 64;
  /// One more than the window has, for its ends share one.
  static constexpr std::uint32_t kBlocks = kSize / kBits + 1;

  std::uint64_t block_of(std::uint64_t number) const { return blocks_[number / kBits % kBlocks]; }

  std::uint64_t blocks_[kBlocks] = {};
  std::uint64_t end_ = 0;
};

}  // namespace isostep::transport
