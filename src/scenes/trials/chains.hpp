// Chains that other trials hang up elsewhere.
// SPDX-License-Identifier: MIT
#pragma once

#include "scenes/scene.hpp"

namespace isostep::scenes {

inline constexpr double kLink = 0.5;  // [m] from joint to joint
inline constexpr char kStretch[] = "peak separation of a joint, of a link's length";

/// Links of 1 kg straight along +x from a fixed point 30 m up, at rest, and a ball at their end; ball joints, no
/// collision, 16 sub-steps.
Scene ball_chain(int links, double ball_mass);

}  // namespace isostep::scenes
