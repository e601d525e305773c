// The velocity pass of worst_first.hpp: what a row still has to change of speeds, and the change.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/book/worst_first.hpp"
#include "isostep/dynamics/joints/joint.inl"

namespace isostep {

namespace detail {

/// [m/s] The speed errors that are left alone, apart from rounding. By the book's 0.01 a block creeps down its slope
/// 0.1 m in ten seconds, by this 0.15 mm.
template <class S> ISO_INLINE Velocity<S> motion_tolerance(const Motion<S>& a, const Motion<S>& b) {
  using V = Velocity<S>;
  const V fastest = max(max(max_abs(a.linear), max_abs(a.angular)), max(max_abs(b.linear), max_abs(b.angular)));
  return max(V(0x1p-16), V(16) * (resolution<V>() + round_to<V>(product(resolution<Unit<S>>(), fastest))));
}

}  // namespace detail

/// Adds forces, then all that is fixed while velocities are resolved, then the impulses of the last sub-step.
template <class S, class Queue>
void WorstFirstResolver<S, Queue>::begin_velocities(const StepContext<S>& context, const JointStep<S>& step) {
  SolverBodies<S>& bodies = bodies_.rows();
  bodies_.renew_forces(context);
  if (impacts_.any()) impacts_.bounce(context, bodies_);
  bodies_.integrate_velocities(context, 0, bodies_.count());
  carry(context);
  if (context.mechanisms.any()) {
    context.mechanisms.place(bodies, bodies_.rate());
    context.mechanisms.solve(bodies, 1);
  }
  // A gap wider than a sub-step covers at 64 m/s counts as that: times the rate it fits.
  const V widest = divide_to<V>(S(64), step.rate);
  const auto is_followed = [&](std::uint32_t body) { return any_followed_ && bodies_.is_followed(context, body); };
  for (Point& row : points_) {
    row.total_impulse = saturating_add(row.total_impulse, row.impulse);
    if (is_followed(row.a) || is_followed(row.b)) forget_impulses(row);
    row.least_speed = -scaled(step.rate, clamp(gap(row), V(0), widest));
    warm_start(row);
  }
  for (const std::uint32_t j : held_) {
    JointConstraint<S>& joint = joints_[j];
    linearise_joint(joint, step);
    weigh_joint(joint, bodies.mass[joint.row_a].kappa, bodies.mass[joint.row_b].kappa);
    factor_joint(joint);
    apply_impulses(joint, step);
    hold(joint);
  }
}

/// Carries bodies. The points of a contact lie side by side, in its order.
template <class S, class Queue> void WorstFirstResolver<S, Queue>::carry(const StepContext<S>& context) {
  std::size_t next = 0, first = 0;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    Point& row = points_[i];
    if (row.contact != points_[first].contact) first = i;
    while (next < context.carried.size() && context.carried[next].contact < row.contact) ++next;
    if (next == context.carried.size()) break;
    const Carried<S>& carried = context.carried[next];
    if (carried.contact != row.contact) continue;
    Vec3<V> surface = carried.surface(bodies_.rows());
    if (carried.spins()) {
      const ContactGeometry<S>& g = context.geometry[row.contact];
      const Vec3<S> middle = detail::ContactArms<S>::middle_of(g, context.contacts[row.contact].count).b;
      surface += carried.spun(g.points[i - first].arm_b - middle);
    }
    for (int k = 0; k < 2; ++k) row.friction.surface[k] = round_to<V>(dot_sum(row.friction.rows[k].linear, surface));
  }
}

template <class S, class Queue> void WorstFirstResolver<S, Queue>::warm_start(const Point& row) {
  SolverBodies<S>& bodies = bodies_.rows();
  Motion a = bodies.velocity[row.a], b = bodies.velocity[row.b];
  detail::push(row.normal, row.share, row.impulse, a, b);
  const auto push_across = [&](const TangentPair<S>& pair) {
    for (int k = 0; k < 2; ++k) detail::push(pair.rows[k], row.share, pair.impulse[k], a, b);
  };
  push_across(row.friction);
  if (row.rolling != kNoPair) push_across(rolling_[row.rolling]);
  if (row.spinning != kNoPair) push_across(rolling_[row.spinning]);
  if (bodies.moves(row.a)) bodies.velocity[row.a] = a;
  if (bodies.moves(row.b)) bodies.velocity[row.b] = b;
}

/// Holds impulses of a joint. Joints saturate what they add, but not the sums of a pass of many turns.
template <class S, class Queue> void WorstFirstResolver<S, Queue>::hold(JointConstraint<S>& joint) {
  SolverBodies<S>& bodies = bodies_.rows();
  const V most = convert<V>(Limits<S>::speed());
  for (std::uint32_t i = 0; i < joint.block_count; ++i) {
    joint.blocks[i].impulse = detail::held(joint.blocks[i].impulse, most);
  }
  for (std::uint32_t i = 0; i < joint.drive_count; ++i) {
    joint.drives[i].impulse = clamp(joint.drives[i].impulse, -most, most);
  }
  for (const std::uint32_t body : {joint.row_a, joint.row_b}) {
    if (!bodies.moves(body)) continue;
    Motion& v = bodies.velocity[body];
    v.linear = detail::held(v.linear, detail::passing_velocity<S>());
    v.angular = detail::held(v.angular, detail::passing_angular_speed<S>());
  }
}

/// Forgets impulses of a row, as they refer to former axes.
template <class S, class Queue> void WorstFirstResolver<S, Queue>::forget_impulses(Point& row) {
  row.impulse = row.friction.impulse[0] = row.friction.impulse[1] = V(0);
  for (const std::uint32_t i : {row.rolling, row.spinning}) {
    if (i != kNoPair) rolling_[i].impulse[0] = rolling_[i].impulse[1] = V(0);
  }
}

/// [m/s] Returns the impulse that the point at a place of points_ may bear: the contact's limit less those of its other
/// points.
template <class S, class Queue>
Velocity<S> WorstFirstResolver<S, Queue>::most_beside(std::size_t index, const Point& row) const {
  if (row.most == highest<V>()) return row.most;
  V left = row.most;
  const auto is_beside = [&](std::size_t i) { return i < points_.size() && points_[i].contact == row.contact; };
  for (std::size_t i = index; i > 0 && is_beside(i - 1); --i) left = saturating_subtract(left, points_[i - 1].impulse);
  for (std::size_t i = index + 1; is_beside(i); ++i) left = saturating_subtract(left, points_[i].impulse);
  return max(left, V(0));
}

template <class S, class Queue> Velocity<S> WorstFirstResolver<S, Queue>::motion_urgency(const Point& row) const {
  const SolverBodies<S>& bodies = bodies_.rows();
  const Motion& a = bodies.velocity[row.a];
  const Motion& b = bodies.velocity[row.b];
  const V speed = detail::along(row.normal, a, b);
  V most = min(saturating_subtract(row.least_speed, speed), saturating_subtract(most_of(row), row.impulse));
  const bool pushes = V(0) < row.impulse;
  if (pushes) most = max(most, min(saturating_subtract(speed, row.least_speed), row.impulse));
  const auto look_across = [&](const TangentPair<S>& pair, S slope) ISO_INLINE_LAMBDA {
    if (!pushes && pair.impulse[0] == V(0) && pair.impulse[1] == V(0)) return;
    const V limit = saturate_to<V>(product(slope, row.impulse));
    const auto change = detail::resting_change(pair, limit, a, b);
    most = max(most, max(abs(change.x), abs(change.y)));
  };
  if (S(0) < row.mu) look_across(row.friction, row.mu);
  if (row.rolling != kNoPair) look_across(rolling_[row.rolling], row.lever);
  if (row.spinning != kNoPair) look_across(rolling_[row.spinning], row.spin_lever);
  return detail::motion_tolerance<S>(a, b) < most ? most : V(0);
}

template <class S, class Queue>
Velocity<S> WorstFirstResolver<S, Queue>::motion_urgency(const JointConstraint<S>& joint,
                                                         const JointStep<S>& step) const {
  const JointMotion<S> m = isostep::gather(*step.bodies, joint.row_a, joint.row_b);
  V most = V(0);
  for (std::uint32_t i = 0; i < joint.block_count; ++i) {
    Vec3<V> speed = speed_along(joint.blocks[i], m);
    for (std::uint32_t d = 0; d < joint.drive_count; ++d) {
      if (joint.drives[d].block == i) speed[static_cast<int>(joint.drives[d].place)] = V(0);
    }
    most = max(most, max_abs(speed));
  }
  for (std::uint32_t i = 0; i < joint.drive_count; ++i) {
    const JointDrive<S>& drive = joint.drives[i];
    const DriveBounds<S> bounds = detail::bounds_of(drive, step, true);
    most = max(most,
               detail::drive_residual(drive, speed_along(drive.row, m), bounds, detail::most_impulse(drive, step.h)));
  }
  return detail::motion_tolerance<S>(m.a, m.b) < most ? most : V(0);
}

/// Resolves the normal, then friction, rolling and spinning within the cone that this opens (pp. 359-361).
template <class S, class Queue> void WorstFirstResolver<S, Queue>::resolve_motion(Point& row) {
  SolverBodies<S>& bodies = bodies_.rows();
  Motion a = bodies.velocity[row.a], b = bodies.velocity[row.b];
  resolve_normal(row, a, b);
  const auto stop = [&](TangentPair<S>& pair, S slope) {
    const auto change = detail::resting_change(pair, saturate_to<V>(product(slope, row.impulse)), a, b);
    const V changes[2] = {change.x, change.y};
    for (int k = 0; k < 2; ++k) {
      detail::push(pair.rows[k], row.share, changes[k], a, b);
      pair.impulse[k] = pair.impulse[k] + changes[k];
    }
  };
  if (S(0) < row.mu) stop(row.friction, row.mu);
  if (row.rolling != kNoPair) stop(rolling_[row.rolling], row.lever);
  if (row.spinning != kNoPair) stop(rolling_[row.spinning], row.spin_lever);
  if (bodies.moves(row.a)) bodies.velocity[row.a] = a;
  if (bodies.moves(row.b)) bodies.velocity[row.b] = b;
}

template <class S, class Queue>
void WorstFirstResolver<S, Queue>::resolve_motion(JointConstraint<S>& joint, const JointStep<S>& step) {
  solve_joint(joint, step, true);
  hold(joint);
}

/// Resolves the normal. An impulse that is too large is reduced, down to none.
template <class S, class Queue> void WorstFirstResolver<S, Queue>::resolve_normal(Point& row, Motion& a, Motion& b) {
  const V speed = detail::along(row.normal, a, b);
  const V change = saturate_to<V>(product(row.mass, saturating_subtract(row.least_speed, speed)));
  const V next = max(min(saturating_add(row.impulse, change), most_of(row)), V(0));
  detail::push(row.normal, row.share, next - row.impulse, a, b);
  row.impulse = next;
}

}  // namespace isostep
