// A world as an outsider sees it: bodies in double, the same of our engine and of a peer, for measures and judges.
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "isostep/math/quat.hpp"
#include "isostep/math/vec3.hpp"
#include "measure.hpp"

namespace isostep::scenes {

struct BodySight {
  Vec3<double> centre = {0, 0, 0};            // [m] centre of mass, world
  Quat<double> orientation = {0, 0, 0, 1};    // body frame to world
  Vec3<double> velocity = {0, 0, 0};          // [m/s]
  Vec3<double> angular_velocity = {0, 0, 0};  // [rad/s] world
  bool dynamic = false;
  bool awake = false;
};

struct Sight {
  double time = 0;                // [s] simulated
  std::vector<BodySight> bodies;  // in the scene's order; what a script makes follows
  double joint_error = 0;         // [m] largest separation of anchors
  Energy energy;
  int faults = 0;  // steps so far that had to mend something, or whose numbers are no numbers
};

/// `faults`: as counted so far.
template <class S> Sight sight_of(const World<S>& world, int faults);

#define ISO_EXTERN(S) extern template Sight sight_of<S>(const World<S>&, int);
ISO_FOR_EACH_SCALAR(ISO_EXTERN)
#undef ISO_EXTERN

}  // namespace isostep::scenes
