// Trees of bodies on hinges: what robots and chains of published tests are made of.
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "scenes/scene.hpp"
#include "scenes/shapes.hpp"
#include "scenes/sight.hpp"

namespace isostep::scenes {

inline Point point_of(Vec3<double> v) { return {v.x, v.y, v.z}; }

/// A hinge at a point of the world; `frame` turns z to its axis.
inline SceneJoint hinge_of(int a, int b, Point anchor, Rotation frame = no_rotation()) {
  SceneJoint joint = joint_of(JointType::hinge, a, b, anchor);
  joint.orientation = frame;
  return joint;
}

/// Sets the velocities of all bodies below hinges that turn at so many rad/s, from the first of these joints on; its
/// first body keeps its own. Joints lead from bodies that are known to bodies that are not.
void turn_hinges(Scene& scene, std::size_t first_joint, std::span<const double> rates);

/// Mass and inertia of every body of a scene, for sums over the bodies of a sight.
class Inertias {
 public:
  explicit Inertias(const Scene& scene);
  /// [kg m/s] of all bodies.
  Vec3<double> momentum(const Sight& sight) const;
  /// [kg m^2/s] about the centre of mass of all bodies.
  Vec3<double> angular_momentum(const Sight& sight) const;

 private:
  std::vector<double> masses_;          // [kg] 0 of what does not move
  std::vector<Mat3<double>> inertias_;  // [kg m^2] body frame
};

}  // namespace isostep::scenes
