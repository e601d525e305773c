// A ragdoll, for scenes that have one.
// SPDX-License-Identifier: MIT
#pragma once

#include "shapes.hpp"

namespace isostep::scenes {

/// kRagdollParts bodies, `origin` [m] in the pelvis, upright, then tilted about x [rad]. `limited`: with the limits of
/// a body's joints.
void add_ragdoll(Scene& scene, Point origin, double tilt, bool limited);

}  // namespace isostep::scenes
