// The position pass of worst_first.hpp: projection of overlaps, by moving and by turning, and of joints' errors.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/book/worst_first.hpp"
#include "isostep/dynamics/joints/joint.inl"
#include "isostep/dynamics/solvers/body_rows.inl"

namespace isostep {

namespace detail {

/// [m] The overlap that stays, so that resting bodies keep touching.
template <class S> inline constexpr Velocity<S> kRestingOverlap = Velocity<S>(0x1p-11);
/// [1] The part of an overlap that a sub-step removes. All of it at once makes stacks jump (relaxation, pp.
/// 324-325).
template <class S> inline constexpr S kRelaxation = S(0.25);
/// [1] The part of what a contact lacks that a resolution of `relaxed` removes: two contacts that press on one body
/// count equally.
template <class S> inline constexpr S kRelaxedPart = S(0.5);
/// The number of turns of `relaxed`: halvings of the most that a sub-step removes, 3 m/s for 1/200 s, down to the
/// tolerance.
inline constexpr std::uint32_t kRelaxedTurns = 8;
/// [m/s] A contact that has less than that left to bear gives way: half of what motion_tolerance() leaves.
template <class S> inline constexpr Velocity<S> kLeftToBear = Velocity<S>(0x1p-15);
/// [m] Position errors below this are left alone.
template <class S> inline constexpr Velocity<S> kProjectionTolerance = Velocity<S>(0x1p-14);
/// [rad] The most that a projection turns a body: the rest moves it instead (pp. 328-330).
template <class S> inline constexpr Velocity<S> kMostProjectedTurn = Velocity<S>(0.2);

/// [m] Returns how far a drive's position is beyond its limits; 0 within them.
template <class S> ISO_INLINE Velocity<S> shortfall(const JointDrive<S>& drive, Step<S> h) {
  if (drive.bounded_below && drive.position < drive.lower) return bounded_error(drive.lower - drive.position, h);
  if (drive.bounded_above && drive.upper < drive.position) return bounded_error(drive.upper - drive.position, h);
  return Velocity<S>(0);
}

}  // namespace detail

/// Returns the gap, from the two displacements each time, so that it does not gather the roundings of every move.
template <class S, class Queue> Velocity<S> WorstFirstResolver<S, Queue>::gap(const Point& row) const {
  const SolverBodies<S>& bodies = bodies_.rows();
  return saturating_add(row.separation,
                        detail::along(row.normal, bodies.displacement[row.a], bodies.displacement[row.b]));
}

/// Returns true if a contact bears all that it may and so gives way: the body sinks in.
template <class S, class Queue> bool WorstFirstResolver<S, Queue>::gives_way(const Point& row) const {
  return row.most < highest<V>() && !(saturating_add(row.impulse, detail::kLeftToBear<S>) < most_of(row));
}

template <class S, class Queue> void WorstFirstResolver<S, Queue>::begin_positions(const JointStep<S>& step) {
  const V fastest = detail::kPushSpeed<S> * step.h;
  for (Point& row : points_) {
    const V over = min(saturating_add(gap(row), detail::kRestingOverlap<S>), V(0));
    const V taken = min(saturate_to<V>(product(detail::kRelaxation<S>, -over)), fastest);
    row.least_gap = saturating_add(over, taken) - detail::kRestingOverlap<S>;
    if (gives_way(row)) row.least_gap = -highest<V>();
  }
}

template <class S, class Queue> Velocity<S> WorstFirstResolver<S, Queue>::overlap_urgency(const Point& row) const {
  const V missing = saturating_subtract(row.least_gap, gap(row));
  return detail::kProjectionTolerance<S> < missing ? missing : V(0);
}

template <class S, class Queue>
Velocity<S> WorstFirstResolver<S, Queue>::error_urgency(JointConstraint<S>& joint, const JointStep<S>& step) const {
  linearise_joint(joint, step);
  V most = V(0);
  for (std::uint32_t i = 0; i < joint.block_count; ++i) most = max(most, max_abs(joint.blocks[i].error));
  for (std::uint32_t i = 0; i < joint.drive_count; ++i) {
    most = max(most, abs(detail::shortfall(joint.drives[i], step.h)));
  }
  return detail::kProjectionTolerance<S> < most ? most : V(0);
}

template <class S, class Queue>
void WorstFirstResolver<S, Queue>::end_overlap(const StepContext<S>& context, const Point& row) {
  const V missing = saturating_subtract(row.least_gap, gap(row));
  switch (context.projection) {
    case Projection::nonlinear: return project(context, row, missing);
    case Projection::linear:
    case Projection::velocity_based: return shift(context, row, missing);
    case Projection::relaxed: return project(context, row, saturate_to<V>(product(detail::kRelaxedPart<S>, missing)));
  }
}

/// Shifts bodies along the normal alone, by inverse mass (p. 322).
template <class S, class Queue>
void WorstFirstResolver<S, Queue>::shift(const StepContext<S>& context, const Point& row, V missing) {
  const auto part = [&](S share, V way) {
    Motion m = Motion::zero();
    m.linear = detail::pushed(Vec3<V>::zero(), row.normal.linear, saturate_to<V>(product(share, way)), highest<V>());
    return m;
  };
  move(context, row.a, part(row.share.a, -missing));
  move(context, row.b, part(row.share.b, missing));
}

/// Moves and turns bodies by inverse mass and inertia (pp. 323-328). Fast turning bodies are only moved: otherwise
/// their angular velocity would stay while their axes turn, and energy would change.
template <class S, class Queue>
void WorstFirstResolver<S, Queue>::project(const StepContext<S>& context, const Point& row, V missing) {
  const V amount = saturate_to<V>(product(row.mass, missing));
  const auto part = [&](std::uint32_t body, S share, Vec3<S> angular, Vec3<S> turn, V way) {
    Motion m = Motion::zero();
    V linear = saturate_to<V>(product(share, way));
    const Vec3<V> rotation = detail::pushed(Vec3<V>::zero(), turn, way, highest<V>());
    const V turned = max_abs(rotation),
            most = bodies_.is_followed(context, body) ? V(0) : detail::kMostProjectedTurn<S>;
    m.angular = rotation;
    if (most < turned) {
      const V keep = divide_to<V>(most, turned);
      m.angular = {rotation.x * keep, rotation.y * keep, rotation.z * keep};
      linear = saturating_add(linear, saturate_to<V>(dot_sum(angular, rotation - m.angular)));
    }
    m.linear = detail::pushed(Vec3<V>::zero(), row.normal.linear, linear, highest<V>());
    return m;
  };
  move(context, row.a, part(row.a, row.share.a, row.normal.angular_a, row.normal.turn_a, -amount));
  move(context, row.b, part(row.b, row.share.b, row.normal.angular_b, row.normal.turn_b, amount));
}

/// Projects positions as solve_joint() solves velocities. A limit that is passed is a row; a drive within its limits is
/// none.
template <class S, class Queue>
void WorstFirstResolver<S, Queue>::project(const StepContext<S>& context, const JointConstraint<S>& joint,
                                           const JointStep<S>& step) {
  const SolverBodies<S>& bodies = *step.bodies;
  const V fastest = detail::kJointPushSpeed<S> * step.h;
  const auto missing = [&](std::uint32_t block) {
    const auto part = [&](V error) { return -clamp(error, -fastest, fastest); };
    const Vec3<V> error = joint.blocks[block].error;
    return Vec3<V>{part(error.x), part(error.y), part(error.z)};
  };
  JointRows<S> right = {missing(0), joint.block_count > 1 ? missing(1) : Vec3<V>::zero()};
  JointConstraint<S> held = joint;
  for (std::uint32_t i = 0; i < joint.drive_count; ++i) {
    JointDrive<S>& drive = held.drives[i];
    const V lacks = detail::shortfall(drive, step.h);
    drive.sprung = drive.servo = false;
    drive.spring = S(0);
    drive.piece = lacks == V(0) ? DrivePiece::free : DrivePiece::lower;
    (drive.block == 1 ? right.angular : right.point)[static_cast<int>(drive.place)] = lacks;
  }
  weigh_joint(held, bodies.mass[joint.row_a].kappa, bodies.mass[joint.row_b].kappa);
  factor_joint(held);
  const JointRows<S> change = substitute_joint(held, right);
  JointMotion<S> m = {Motion::zero(), Motion::zero()};
  if (held.block_count > 1) isostep::push(held.blocks[1], joint.share, change.angular, m);
  isostep::push(held.blocks[0], joint.share, change.point, m);
  move(context, joint.row_a, m.a);
  move(context, joint.row_b, m.b);
}

/// Moves a body. Its centre follows the displacement, not each move: for coarse S small moves add up before rounding.
template <class S, class Queue>
void WorstFirstResolver<S, Queue>::move(const StepContext<S>& context, std::uint32_t body, const Motion& asked) {
  SolverBodies<S>& bodies = bodies_.rows();
  if (!bodies.moves(body)) return;
  Motion way = asked;
  detail::hold_locks(context.properties[body - 1].flags, way);
  BodyState<S>& state = context.states[body - 1];
  Motion& displacement = bodies.displacement[body];
  const Vec3<S> before = convert<S>(displacement.linear);
  displacement.linear += way.linear;
  displacement.angular += way.angular;
  state.centre += convert<S>(displacement.linear) - before;
  const V most = detail::kMostProjectedTurn<S>;
  const auto turn = [&](V w) { return round_to<Unit<S>>(product(clamp(w, -most, most), Unit<S>(1))); };
  state.orientation =
      integrate(state.orientation, Vec3<Unit<S>>{turn(way.angular.x), turn(way.angular.y), turn(way.angular.z)});
}

}  // namespace isostep
