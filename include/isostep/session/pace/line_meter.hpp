// LineMeter: how one peer's datagrams arrive: how many are lost, by their numbers, and how evenly the others come.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/session/timeline/frame.hpp"

namespace isostep {

/// Measures a line over the last minute, in twelve parts. Copies count once, and a datagram that at most 63 others
/// overtake is not lost. Source: RFC 3550, sec. 6.4.1 and appendix A; the mean over a minute replaces its filter.
class LineMeter {
 public:
  /// Notes a datagram. `number` counts the datagrams that the peer sent us, mod 2^16.
  void arrived(std::uint16_t number, Time now);
  /// Notes a datagram whose time is known. `sent`: the peer's clock [ms] when it was sent, mod 2^16.
  void measured(std::uint16_t sent, Time now);

  /// Returns the lost part [permille] of what was sent.
  std::uint32_t loss(Time now);
  /// Returns the mean difference [us] between the travel times of two datagrams that arrive one after the other.
  std::uint32_t jitter(Time now);

 private:
  static constexpr std::uint64_t kParts = 12;
  static constexpr Time kPart = 60 * kSecond / kParts;  // [us]
  /// A larger gap is forged: it takes ten seconds, and the connection would have ended before.
  static constexpr int kMostLost = 600;
  struct Part {
    std::uint32_t sent = 0, received = 0;  // datagrams
    std::uint32_t pairs = 0;
    Time differences = 0;  // [us] of all pairs
  };
  Part& newest(Time now);

  Part parts_[kParts] = {};
  std::uint64_t newest_ = 0;  // number of the part that time is in
  bool has_number_ = false, has_time_ = false;
  std::uint16_t highest_ = 0;
  std::uint64_t seen_ = 0;  // bit n: highest_ - n has arrived
  std::uint16_t sent_ = 0;  // [ms] of the last one that was measured,
  Time received_at_ = 0;    // [us] and when it arrived
};

}  // namespace isostep
