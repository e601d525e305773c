// The arena that a match is built from, before any scalar is chosen.
// SPDX-License-Identifier: MIT
#pragma once

#include "match.hpp"
#include "scene.hpp"

namespace isostep::scenes {

/// The arena as a scene; places are indices into its bodies and joints.
struct MatchPlan {
  Scene scene;
  int ring, first_rope, first_puck, mill_joint;  // the ropes' bodies end where the pucks begin
  Number half;                                   // [m] of the floor's inside
};
MatchPlan plan_match(const MatchSettings& settings);
/// Every number at its range's nearer end.
MatchSettings within_range(MatchSettings settings);

}  // namespace isostep::scenes
