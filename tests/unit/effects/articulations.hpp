// The common part of the tests of articulations: links of bars and points, and energy and momentum reckoned in double
// from what an articulation tells of its links.
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "isostep/articulation/articulation.hpp"
#include "isostep/math/mat3.hpp"

namespace isostep::test {

using ArticulatedScalars = ::testing::Types<float, double, Q32_32>;
using D3 = Vec3<double>;
using D33 = Mat3<double>;

template <class S> S number(double x) { return from_double<S>(x); }
template <class S> Vec3<S> vector(D3 v) { return {number<S>(v.x), number<S>(v.y), number<S>(v.z)}; }
template <class T> D3 doubles(Vec3<T> v) { return {to_double(v.x), to_double(v.y), to_double(v.z)}; }
template <class T> Quat<double> doubles(Quat<T> q) {
  return normalise(Quat<double>{to_double(q.x), to_double(q.y), to_double(q.z), to_double(q.w)});
}
inline double size(D3 v) { return std::sqrt(dot(v, v)); }
template <class S> double by_scalar(double in_float, double in_double, double in_fixed) {
  return std::is_same_v<S, float> ? in_float : std::is_same_v<S, double> ? in_double : in_fixed;
}

/// A bar along local -y from the joint at its origin; radius 0: its mass is in a line.
template <class S>
ArticulationLink<S> bar(std::uint32_t parent, D3 joint, double length, double mass, double radius = 0) {
  ArticulationLink<S> l;
  l.parent = parent;
  l.frame_a.position = vector<S>(joint);
  const double across = mass * (length * length / 12 + radius * radius / 4);
  l.mass = {number<S>(mass), vector<S>({0, -length / 2, 0}), vector<S>({across, mass * radius * radius / 2, across}),
            Quat<Unit<S>>::identity()};
  return l;
}
/// A point at the end of a rod without mass.
template <class S> ArticulationLink<S> bob(std::uint32_t parent, D3 joint, double length, double mass) {
  ArticulationLink<S> l = bar<S>(parent, joint, length, mass);
  l.mass.centre = vector<S>({0, -length, 0});
  l.mass.inertia = Vec3<S>::zero();
  return l;
}

template <class S> Articulation<S> built(const ArticulationDefinition<S>& definition) {
  Articulation<S> a;
  const Result<void> result = a.build(definition);
  if (!result) ADD_FAILURE() << result.error().place.view() << ": " << result.error().message.view();
  return a;
}

/// The motion of all links, about the world's origin.
struct Motion {
  double kinetic = 0, potential = 0;  // [J] of gravity and springs, armatures included
  D3 momentum = {0, 0, 0}, angular = {0, 0, 0}, centre = {0, 0, 0};
  double mass = 0;

  double energy() const { return kinetic + potential; }
  D3 angular_about_centre() const { return angular - cross(centre, momentum); }
};
template <class S> void add_joint(Motion& m, const ArticulationLink<S>& l, const JointCoordinates<S>& c) {
  const double k = to_double(l.stiffness), armature = to_double(l.armature);
  if (l.type == ArticulationJoint::ball) {
    const D3 spin = doubles(c.angular_velocity);
    m.kinetic += armature * dot(spin, spin) / 2;
    m.potential += 4 * k * (1 - std::fabs(to_double(c.rotation.w)));  // torque k 2 sin(angle / 2)
  } else {
    double away = to_double(c.position.x) - to_double(l.rest);
    if (l.type == ArticulationJoint::hinge && !l.limited) away = std::remainder(away, 2 * std::acos(-1.0));
    m.kinetic += armature * to_double(c.velocity.x) * to_double(c.velocity.x) / 2;
    m.potential += k * away * away / 2;
  }
}
template <class S> Motion motion_of(const Articulation<S>& a) {
  Motion m;
  const D3 gravity = doubles(a.definition().settings.gravity);
  for (std::uint32_t i = 0; i < a.links(); ++i) {
    const LinkMass<S>& mass = a.definition().links[i].mass;
    const double kg = to_double(mass.mass);
    const Pose<S> pose = a.link_pose(i);
    const LinkVelocity<S> velocity = a.link_velocity(i);
    const D33 turn = to_matrix(doubles(pose.orientation));
    const D33 axes = turn * to_matrix(doubles(mass.principal));
    const D33 inertia = rotate_diagonal(axes, doubles(mass.inertia));
    const D3 arm = turn * doubles(mass.centre), spin = doubles(velocity.angular);
    const D3 at = doubles(pose.position) + arm, v = doubles(velocity.linear) + cross(spin, arm);
    const D3 own = inertia * spin;
    m.kinetic += kg * dot(v, v) / 2 + dot(own, spin) / 2;
    m.potential -= kg * dot(gravity, at);
    m.momentum += v * kg;
    m.angular += cross(at, v * kg) + own;
    m.centre += at * kg;
    m.mass += kg;
    if (a.definition().links[i].type != ArticulationJoint::free)
      add_joint(m, a.definition().links[i], a.coordinates(i));
  }
  m.centre = m.centre * (1 / m.mass);
  return m;
}

/// A turn by `angle` [rad] about a unit axis.
template <class S> Quat<Unit<S>> turn_about(D3 axis, double angle) {
  using U = Unit<S>;
  const double s = std::sin(angle / 2), c = std::cos(angle / 2);
  return normalise(Quat<U>{number<U>(axis.x * s), number<U>(axis.y * s), number<U>(axis.z * s), number<U>(c)});
}

}  // namespace isostep::test
