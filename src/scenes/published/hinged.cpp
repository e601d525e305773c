// Velocities of trees of hinges, and their momentum.
// SPDX-License-Identifier: MIT
#include "hinged.hpp"

#include "scenes/trials/scene_numbers.hpp"

namespace isostep::scenes {

void turn_hinges(Scene& scene, std::size_t first_joint, std::span<const double> rates) {
  for (std::size_t i = 0; i < rates.size(); ++i) {
    const SceneJoint& joint = scene.joints[first_joint + i];
    const SceneBody& a = scene.bodies[static_cast<std::size_t>(joint.a)];
    SceneBody& b = scene.bodies[static_cast<std::size_t>(joint.b)];
    const Vec3<double> axis = to_matrix(value(joint.orientation)).column(2), at = value(joint.anchor);
    const Vec3<double> before = value(a.angular_velocity), spin = before + axis * rates[i];
    const Vec3<double> of_joint = value(a.velocity) + cross(before, at - value(a.position));
    b.angular_velocity = vector_of(point_of(spin));
    b.velocity = vector_of(point_of(of_joint + cross(spin, value(b.position) - at)));
  }
}

Inertias::Inertias(const Scene& scene) {
  for (const SceneBody& body : scene.bodies) {
    const bool moves = body.type == BodyType::dynamic;
    const Vec3<double> own = value(body.inertia);
    masses_.push_back(moves ? mass_of(body) : 0);
    inertias_.push_back(dot(own, own) > 0 || !moves ? Mat3<double>::diagonal(own) : inertia_of(body));
  }
}

Vec3<double> Inertias::momentum(const Sight& sight) const {
  Vec3<double> sum = {0, 0, 0};
  for (std::size_t i = 0; i < masses_.size(); ++i) sum += masses_[i] * sight.bodies[i].velocity;
  return sum;
}

Vec3<double> Inertias::angular_momentum(const Sight& sight) const {
  Vec3<double> centre = {0, 0, 0}, sum = {0, 0, 0};
  double mass = 0;
  for (std::size_t i = 0; i < masses_.size(); ++i) {
    centre += masses_[i] * sight.bodies[i].centre;
    mass += masses_[i];
  }
  centre = centre * (1 / mass);
  for (std::size_t i = 0; i < masses_.size(); ++i) {
    const BodySight& body = sight.bodies[i];
    const Mat3<double> axes = to_matrix(normalise(body.orientation));
    sum += masses_[i] * cross(body.centre - centre, body.velocity);
    sum += axes * (inertias_[i] * transposed_times(axes, body.angular_velocity));
  }
  return sum;
}

}  // namespace isostep::scenes
