// Effects: what acts on bodies and is no body - water, explosions, zones, surfaces, thrusters - as a page has it.
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace isostep::tool::page {

/// A force record. One that a command changes is another effect from that frame on, save for what a Push tells.
struct Effect {
  const char* kind;                                                  // of kEffects in effects.js
  std::vector<std::pair<const char*, std::vector<double>>> numbers;  // by name; m, s, N
  std::int32_t actor = -1;                                           // whose body it acts on; -1: of the world
  std::uint32_t first = 0, last = 0;                                 // frames of the recording in which it is there
};

/// The push of an effect on its body at a frame.
struct Push {
  std::uint32_t effect;
  std::array<float, 3> force;  // [N] world axes, at the effect's point
  float control;               // [1] of a surface
};

}  // namespace isostep::tool::page
