// Numbers that the scene `mixed` and its script share, and the compounds in it.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "shapes.hpp"

namespace isostep::scenes {

/// Frames in which the script acts; in between the pile may fall asleep.
inline bool is_lively(std::uint64_t frame) { return frame % 200 < 100; }

/// Two spheres on a capsule.
SceneBody dumbbell(Point at);
/// Two boxes, one of them turned: its centre of mass and principal axes are not the frame's.
SceneBody bracket(Point at);
/// A single or compound body somewhere above the pile.
SceneBody mixed_body(Draws& draws);

}  // namespace isostep::scenes
