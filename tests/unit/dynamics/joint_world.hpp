// Bodies and joints without a world around them: what the tests of joints step.
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "isostep/dynamics/joints/joint_tree.hpp"

namespace isostep {
inline namespace joint_world {

constexpr double kPi = 3.14159265358979323846;

struct D3 {
  double x, y, z;
};
inline D3 operator-(D3 a, D3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline double norm(D3 a) { return std::sqrt(a.x * a.x + a.y * a.y + a.z * a.z); }

/// Bodies and joints, stepped as the soft step does: velocities, joints, positions, joints relaxed.
template <class S> class JointWorld {
 public:
  using V = Velocity<S>;
  bool one_by_one = false;
  bool last_batch_first = false;
  const TreeKernels<S>* kernels = tree_kernels<S>(Simd::best);
  D3 gravity = {0, -10, 0};

  static S number(double x) { return from_double<S>(x); }
  static Vec3<S> vector(D3 a) { return {number(a.x), number(a.y), number(a.z)}; }
  static Vec3<V> velocity(D3 a) { return {from_double<V>(a.x), from_double<V>(a.y), from_double<V>(a.z)}; }

  /// `inertia` [m^2] per mass about x, y, z.
  std::uint32_t add_body(D3 centre, double mass, D3 inertia) {
    BodyState<S> state = {};
    state.slot = static_cast<std::uint32_t>(states.size());
    state.centre = vector(centre);
    state.orientation = Quat<Unit<S>>::identity();
    states.push_back(state);
    masses.push_back(number(mass));
    const auto inverse = [](double i) { return i > 0 ? 1 / i : 0; };
    kappas.push_back(vector({inverse(inertia.x), inverse(inertia.y), inverse(inertia.z)}));
    return state.slot;
  }
  std::uint32_t add_box(D3 centre, double mass, D3 half) {
    const double x = half.x * half.x / 3, y = half.y * half.y / 3, z = half.z * half.z / 3;
    return add_body(centre, mass, {y + z, x + z, x + y});
  }
  /// Joins two bodies at a world point, frames along the world's axes.
  JointProperties<S>& join(JointType type, std::uint32_t a, std::uint32_t b, D3 at) {
    JointProperties<S> p;
    p.type = type;
    p.body_a = a;
    p.body_b = b;
    const Vec3<S> point = vector(at);
    p.frame_a.position = a == kNoBody ? point : point - states[a].centre;
    p.frame_b.position = b == kNoBody ? point : point - states[b].centre;
    joints.push_back(p);
    impulses.push_back({});
    return joints.back();
  }

  void gather() {
    bodies.velocity.assign(states.size() + 1, MotionRow<V>::zero());
    bodies.displacement.assign(states.size() + 1, MotionRow<V>::zero());
    bodies.mass.assign(states.size() + 1, {S(0), Mat3<S>::diagonal(Vec3<S>::zero())});
    for (std::size_t i = 0; i < states.size(); ++i) {
      bodies.velocity[i + 1].linear = states[i].velocity;
      bodies.velocity[i + 1].angular = states[i].angular_velocity;
      bodies.mass[i + 1] = {masses[i], rotate_diagonal(to_matrix(states[i].orientation), kappas[i])};
    }
    constraints.resize(joints.size());
    for (std::size_t j = 0; j < joints.size(); ++j) {
      const auto end = [&](std::uint32_t body) {
        if (body == kNoBody) return JointEnd<S>{0, Pose<S>::identity()};
        return JointEnd<S>{body + 1, {states[body].centre, states[body].orientation}};
      };
      prepare_joint(joints[j], impulses[j], end(joints[j].body_a), end(joints[j].body_b), bodies, constraints[j]);
    }
    trees.plan(constraints, bodies, kernels);
  }
  JointStep<S> substep() {
    const S rate = S(240);
    return {
        states.data(), &bodies, rate, divide_to<Step<S>>(S(1), rate), joint_softness(rate), rapid_angular_speed<S>(60)};
  }
  template <class Act> void for_each_batch(const Act& act) {
    const std::uint32_t count = trees.batch_count();
    for (std::uint32_t i = 0; i < count; ++i) act(last_batch_first ? count - 1 - i : i);
  }
  void warm_start(const JointStep<S>& step) {
    if (one_by_one) return warm_start_joints(std::span<JointConstraint<S>>(constraints), step);
    for_each_batch([&](std::uint32_t batch) { trees.warm_start(batch, constraints, step); });
  }
  void solve(const JointStep<S>& step, bool relax) {
    if (one_by_one) return solve_joints(std::span<JointConstraint<S>>(constraints), step, relax);
    for_each_batch([&](std::uint32_t batch) { trees.solve(batch, step, relax); });
  }
  void step() {
    gather();
    const JointStep<S> sub = substep();
    for (int i = 0; i < 4; ++i) {
      for (std::size_t r = 0; r < states.size(); ++r) {
        if (masses[r] > S(0))
          bodies.velocity[r + 1].linear += velocity({gravity.x / 240, gravity.y / 240, gravity.z / 240});
      }
      warm_start(sub);
      solve(sub, false);
      for (std::size_t r = 0; r < states.size(); ++r) move(states[r], bodies.velocity[r + 1], sub.h);
      solve(sub, true);
    }
    for (std::size_t r = 0; r < states.size(); ++r) {
      states[r].velocity = bodies.velocity[r + 1].linear;
      states[r].angular_velocity = bodies.velocity[r + 1].angular;
    }
    if (!one_by_one) for_each_batch([&](std::uint32_t batch) { trees.store(batch, constraints); });
    for (std::size_t j = 0; j < joints.size(); ++j) store_joint(constraints[j], impulses[j]);
  }
  static void move(BodyState<S>& state, const MotionRow<V>& motion, Step<S> h) {
    const auto length = [&](V v) { return round_to<S>(product(v, h)); };
    const auto angle = [&](V v) { return round_to<Unit<S>>(product(v, h)); };
    state.centre += Vec3<S>{length(motion.linear.x), length(motion.linear.y), length(motion.linear.z)};
    state.orientation =
        integrate(state.orientation, {angle(motion.angular.x), angle(motion.angular.y), angle(motion.angular.z)});
  }

  static D3 wide(Vec3<S> a) { return {to_double(a.x), to_double(a.y), to_double(a.z)}; }
  template <class T> static D3 wide_of(Vec3<T> a) { return {to_double(a.x), to_double(a.y), to_double(a.z)}; }
  D3 centre(std::uint32_t b) const { return wide(states[b].centre); }
  D3 axis(std::uint32_t b, int i) const { return wide_of(to_matrix(states[b].orientation).column(i)); }
  D3 anchor(std::uint32_t body, Vec3<S> local) const {
    if (body == kNoBody) return wide(local);
    return wide(states[body].centre + to_matrix(states[body].orientation) * local);
  }
  D3 between(std::size_t j) const {
    return anchor(joints[j].body_b, joints[j].frame_b.position) - anchor(joints[j].body_a, joints[j].frame_a.position);
  }
  double worst_separation() const {
    double worst = 0;
    for (std::size_t j = 0; j < joints.size(); ++j) worst = std::max(worst, norm(between(j)));
    return worst;
  }
  /// Momentum and angular momentum about the origin.
  std::pair<D3, D3> momentum() const {
    Eigen::Vector3d p = Eigen::Vector3d::Zero(), l = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < states.size(); ++i) {
      const auto to = [](D3 a) { return Eigen::Vector3d(a.x, a.y, a.z); };
      const std::uint32_t b = static_cast<std::uint32_t>(i);
      const double m = to_double(masses[i]);
      Eigen::Matrix3d r;
      for (int c = 0; c < 3; ++c) r.col(c) = to(axis(b, c));
      const D3 k = wide(kappas[i]);
      const Eigen::Matrix3d inertia = r * Eigen::Vector3d(m / k.x, m / k.y, m / k.z).asDiagonal() * r.transpose();
      p += m * to(wide_of(states[i].velocity));
      l += m * to(centre(b)).cross(to(wide_of(states[i].velocity))) + inertia * to(wide_of(states[i].angular_velocity));
    }
    return {{p.x(), p.y(), p.z()}, {l.x(), l.y(), l.z()}};
  }
  double energy() const {
    double e = 0;
    for (std::size_t i = 0; i < states.size(); ++i) {
      const double m = to_double(masses[i]);
      const D3 v = wide_of(states[i].velocity), c = wide(states[i].centre);
      e += m * (v.x * v.x + v.y * v.y + v.z * v.z) / 2 - m * (gravity.x * c.x + gravity.y * c.y + gravity.z * c.z);
      const D3 w = wide_of(transposed_times(to_matrix(states[i].orientation), states[i].angular_velocity)),
               k = wide(kappas[i]);
      e += m * (w.x * w.x / k.x + w.y * w.y / k.y + w.z * w.z / k.z) / 2;
    }
    return e;
  }

  std::vector<BodyState<S>> states;
  std::vector<S> masses;
  std::vector<Vec3<S>> kappas;
  std::vector<JointProperties<S>> joints;
  std::vector<JointState<S>> impulses;
  std::vector<JointConstraint<S>> constraints;
  SolverBodies<S> bodies;
  JointTrees<S> trees;
};

/// `fine` for every scalar but Q16.16, whose lengths are 15 um apart.
template <class S> double tolerance(double fine, double coarse) { return std::is_same_v<S, Q16_16> ? coarse : fine; }

}  // namespace joint_world
}  // namespace isostep
