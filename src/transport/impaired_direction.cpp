// The fates of packets: bottleneck, loss, bursts, blackout, delay, copies.
// SPDX-License-Identifier: MIT
#include "transport/impaired_direction.hpp"

#include <algorithm>

namespace isostep::transport {
namespace {

/// [us] The longest queue of a router before it drops: about that of home routers without queue management.
constexpr Time kLongestQueue = 200000;  // [us]

/// A number in [0, bound) from one word. It is not exactly even, off by bound / 2^32 at most: an even draw would
/// sometimes take two.
std::uint32_t scaled(std::uint32_t word, std::uint32_t bound) {
  return static_cast<std::uint32_t>(std::uint64_t{word} * bound >> 32);
}

}  // namespace

ImpairedDirection::ImpairedDirection(const Conditions& conditions, std::uint64_t seed, std::uint64_t stream)
    : conditions_(conditions), random_(Pcg32::seeded(seed, stream)) {}

bool ImpairedDirection::chance(std::uint32_t permille) { return scaled(random_.next(), 1000) < permille; }

Time ImpairedDirection::delay() {
  const Time shifted = Time{conditions_.latency} + scaled(random_.next(), 2 * conditions_.jitter + 1);
  return shifted > conditions_.jitter ? shifted - conditions_.jitter : 0;
}

bool ImpairedDirection::pass_bottleneck(Time now, std::size_t bytes, Time& leaves) {
  leaves = now;
  if (conditions_.rate == 0) return true;
  const Time starts = std::max(now, bottleneck_free_);
  if (starts - now > kLongestQueue) return false;
  leaves = bottleneck_free_ = starts + bytes * kSecond / conditions_.rate;
  return true;
}

Fate ImpairedDirection::decide(Time now, std::size_t bytes) {
  const bool by_chance = chance(conditions_.loss);
  const bool begins_burst = chance(conditions_.burst);
  const bool doubled = chance(conditions_.duplication);
  const bool held = chance(conditions_.reordering);
  const Time first = delay(), second = delay();

  if (burst_left_ == 0 && begins_burst) burst_left_ = conditions_.burst_length;
  const bool in_burst = burst_left_ != 0;
  if (in_burst) --burst_left_;
  const bool dark = now >= conditions_.blackout_start && now - conditions_.blackout_start < conditions_.blackout;

  Time leaves = now;
  if (!pass_bottleneck(now, bytes, leaves) || by_chance || in_burst || dark) return {};
  const Time late = held ? conditions_.hold : 0;
  if (!doubled) return {1, {leaves + first + late, 0}};
  return {2, {leaves + first + late, leaves + second}};
}

}  // namespace isostep::transport
