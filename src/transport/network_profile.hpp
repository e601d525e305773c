// The quality of a network: named profiles and a text form, in whole numbers, so that a seed is one schedule
// everywhere.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "isostep/core/result.hpp"
#include "isostep/core/short_text.hpp"
#include "isostep/session/timeline/frame.hpp"

namespace isostep::transport {

enum class Direction : std::uint8_t { up, down };  // client to host, host to client
inline constexpr Direction kDirections[] = {Direction::up, Direction::down};

/// The conditions of the packets of one direction; without any member set nothing befalls them.
struct Conditions {
  std::uint32_t latency = 0;       // [us] one way
  std::uint32_t jitter = 0;        // [us] a delay is anything from latency - jitter to latency + jitter, at least 0
  std::uint32_t loss = 0;          // [permille] each packet for itself
  std::uint32_t burst = 0;         // [permille] of the packets outside bursts begin one
  std::uint32_t burst_length = 0;  // [packets] lost in a row, the first included
  std::uint32_t duplication = 0;   // [permille] come twice, with a delay of their own each
  std::uint32_t reordering = 0;    // [permille] come `hold` later than they would
  std::uint32_t hold = 0;          // [us]
  std::uint32_t rate = 0;          // [bytes/s] of a bottleneck before everything else; 0: none
  Time blackout_start = 0;         // [us] since the direction's time 0
  Time blackout = 0;               // [us] from then on every packet is lost for this time

  friend bool operator==(const Conditions&, const Conditions&) = default;
};

/// Larger members are refused when parsed.
inline constexpr std::uint32_t kLongestDelay = 60 * 1000000;   // [us]
inline constexpr std::uint32_t kLongestBurst = 1000;           // [packets]
inline constexpr std::uint32_t kLongestBlackout = 3600000000;  // [us] so for its start

struct NetworkProfile {
  ShortText<16> name;
  Conditions up, down;

  const Conditions& of(Direction direction) const { return direction == Direction::up ? up : down; }
};

/// The closed list: loopback lan wifi mobile severe burst duplicate reorder asymmetric constant blackout blackout-up
/// blackout-down.
std::span<const NetworkProfile> named_profiles();

/// A name, or items "key=value" between commas, or a name and items that change it: "wifi", "latency=100,jitter=30,
/// loss=5", "lan,down.loss=2.5". Keys: latency jitter hold blackout-start blackout [ms, three decimals], loss burst
/// duplication reordering [%, one decimal], burst-length [packets], rate [kB/s]. "up." or "down." before a key: that
/// direction only.
Result<NetworkProfile> parse_profile(std::string_view text);

}  // namespace isostep::transport
