// The joints of a scene as ODE has them.
// SPDX-License-Identifier: MIT
#pragma once

#include <ode/ode.h>

#include "peer_scene.hpp"

namespace isostep::bench {

/// The places of a joint's ends at the start, world, and the axis along which it turns or slides.
struct OdePlace {
  dBodyID a, b;             // null: the world
  Vec3<double> on_a, on_b;  // [m]
  Vec3<double> axis;        // [1]
};
/// Throws SceneError with the reason where ODE has none.
void add_ode_joint(dWorldID world, const PeerJoint& joint, const OdePlace& at, double hz);
/// Wheels on parallel axes; each place is that of its hinge.
void add_ode_gear(dWorldID world, const PeerGear& gear, const OdePlace& a, const OdePlace& b);

}  // namespace isostep::bench
