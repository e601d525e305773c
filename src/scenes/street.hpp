// Street: four cars and four walkers in the town, each of four players with one of both: what a session test plays.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "isostep/core/fields.hpp"
#include "isostep/session/timeline/frame.hpp"
#include "isostep/world/world.hpp"
#include "scene.hpp"

namespace isostep::scenes {

inline constexpr int kStreetPlayers = 4;

/// The input of a player in a frame; any bytes are one.
struct StreetInput {
  std::int8_t throttle = 0, steer = 0;  // [1/128]
  std::int8_t walk_x = 0, walk_z = 0;   // [1/32 m/s]
  std::uint8_t buttons = 0;             // 1: jump, 2: brake

  friend bool operator==(const StreetInput&, const StreetInput&) = default;
  ISO_FIELDS(throttle, steer, walk_x, walk_z, buttons)
};
/// The input that a player might give: another choice every second. A pure function.
StreetInput street_bot(int player, Frame frame);

/// Crates, a lift, two doors on hinges and a wagon besides.
Scene street();
/// Gives the players' inputs to their cars and walkers; before the step.
template <class S> void play_street(World<S>& world, std::span<const StreetInput> inputs);
/// All four as bots, by the world's tick.
template <class S> void play_street(World<S>& world);

#define ISO_EXTERN(S)                                                           \
  extern template void play_street<S>(World<S>&, std::span<const StreetInput>); \
  extern template void play_street<S>(World<S>&);
ISO_FOR_EACH_SCALAR(ISO_EXTERN)
#undef ISO_EXTERN

}  // namespace isostep::scenes
