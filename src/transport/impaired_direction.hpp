// One direction of a bad line: says of each packet when its copies arrive. Shared by the simulator and the relay.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "isostep/core/random.hpp"
#include "isostep/session/timeline/frame.hpp"
#include "transport/network_profile.hpp"

namespace isostep::transport {

struct Fate {
  std::uint32_t copies = 0;  // 0: lost, 1, or 2
  Time arrives[2] = {};      // [us] of each copy; 0 for those that are not

  friend bool operator==(const Fate&, const Fate&) = default;
};

/// The fates depend on the conditions, the seed, the stream and the packets so far, and on nothing else. Every packet
/// takes the same six numbers from the generator, so that a condition changed leaves the others' choices as they were.
class ImpairedDirection {
 public:
  /// Directions of one seed differ by their streams.
  ImpairedDirection(const Conditions& conditions, std::uint64_t seed, std::uint64_t stream);

  /// `now` [us] since the direction's time 0, never less than before; `bytes` as they go over the bottleneck.
  Fate decide(Time now, std::size_t bytes);

  const Conditions& conditions() const { return conditions_; }
  /// Sets the conditions from the next packet on; the generator and a burst under way go on.
  void set_conditions(const Conditions& conditions) { conditions_ = conditions; }

 private:
  bool chance(std::uint32_t permille);
  Time delay();
  bool pass_bottleneck(Time now, std::size_t bytes, Time& leaves);

  Conditions conditions_;
  Pcg32 random_;
  std::uint32_t burst_left_ = 0;  // [packets]
  Time bottleneck_free_ = 0;      // [us] when the last byte accepted so far will have left it
};

}  // namespace isostep::transport
