// Bodies of joint.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/joints/joint_drive_rows.hpp"
#include "isostep/dynamics/joints/joint_kinds.hpp"
#include "isostep/dynamics/joints/joint_prepare.inl"
#include "isostep/dynamics/joints/joint_push.hpp"

namespace isostep {

namespace detail {
template <class S> ISO_INLINE Vec3<Velocity<S>> block_bias(const JointBlock<S>& block, S bias_rate) {
  const Velocity<S> most = kJointPushSpeed<S>;
  const auto bound = [&](Velocity<S> e) { return clamp(scaled(bias_rate, e), -most, most); };
  return {bound(block.error.x), bound(block.error.y), bound(block.error.z)};
}

/// Returns the curvature of an arm. Velocities hold at the start of a sub-step and move bodies through all of it: while
/// an arm turns, its end leaves the tangent by h^2 / 2 w x (w x arm). A joint that closed that afterwards would turn
/// the body back in every sub-step, and a spinning top would sink. The curvature is limited like an error: beyond, a
/// turn is too long for the second order. If an arm turns by more than a sixteenth of a radian in the sub-step, half of
/// what angular_speed_to_follow() allows, neither arm of the joint bends: light links of a loaded rope whip that fast,
/// and the bend would drive them.
template <class S>
ISO_INLINE Vec3<Velocity<S>> curve_of(Vec3<S> arm, Vec3<Velocity<S>> angular_velocity, Step<S> h, Velocity<S> fastest,
                                      bool& bends) {
  using V = Velocity<S>;
  const auto across = [](Vec3<V> w, Vec3<S> r) {
    return Vec3<V>{saturated<S>(product(r.z, w.y) - product(r.y, w.z)),
                   saturated<S>(product(r.x, w.z) - product(r.z, w.x)),
                   saturated<S>(product(r.y, w.x) - product(r.x, w.y))};
  };
  const Vec3<V> turning = across(angular_velocity, arm);
  bends = bends && !(saturated<S>(product(S(0.5) * max_abs(arm), fastest)) < max_abs(turning));
  const S half = S(0.5) * h;
  const V most = kJointPushSpeed<S>;
  const Vec3<V> bent =
      across({scaled(half, angular_velocity.x), scaled(half, angular_velocity.y), scaled(half, angular_velocity.z)},
             convert<S>(turning));
  return held_within(bent, most);
}

/// [1] Returns the part of its way in the last sub-step that a spring does not feel. An undamped spring whose force is
/// taken where it was then, at x - h v + h v', keeps its energy at any frequency, as if its bodies were heavier by
/// angle^2 of themselves. At x + h v', implicit Euler, it loses angle^2 of its energy in every sub-step. Beyond
/// kSpringLag less is taken back: bodies on a fast spring would sag.
template <class S> ISO_INLINE S lag_of(S angle) {
  if (!(kSpringLag<S> < angle)) return S(1);
  const S part = kSpringLag<S> / angle;
  return part * part;
}
template <class S>
ISO_INLINE Velocity<S> lagging_way(const JointDrive<S>& drive, const JointConstraint<S>& joint,
                                   const JointStep<S>& step) {
  const JointMotion<S> motion = {step.bodies->velocity[joint.row_a], step.bodies->velocity[joint.row_b]};
  return scaled(drive.spring_lag, speed_along(drive.row, motion) * step.h);
}
}  // namespace detail

/// Curves both arms or neither. The joint's impulse works by half of the speed between its ends before it and half of
/// that after it. With one arm bent the two did not cancel, which gave bodies 7 % of their energy in ten seconds.
template <class S> void curve_joint(JointConstraint<S>& joint, const JointStep<S>& step) {
  if (!joint.blocks[0].point) return;
  const Vec3<Velocity<S>> a = step.bodies->velocity[joint.row_a].angular;
  const Vec3<Velocity<S>> b = step.bodies->velocity[joint.row_b].angular;
  const Velocity<S> fast = max(max_abs(a), max_abs(b));
  bool bends = step.rapid < fast && fast < step.fastest;
  if (!bends) return;
  const Vec3<Velocity<S>> of_a = detail::curve_of(joint.arm_a, a, step.h, step.fastest, bends);
  const Vec3<Velocity<S>> of_b = detail::curve_of(joint.arm_b, b, step.h, step.fastest, bends);
  if (bends) joint.blocks[0].curve = of_b - of_a;
}

template <class S> void linearise_joint(JointConstraint<S>& joint, const JointStep<S>& step) {
  joint.blocks[0].curve = joint.blocks[1].curve = Vec3<Velocity<S>>::zero();
  const detail::JointFrames<S> frames = detail::joint_frames(joint, step.states);
  joint.arm_a = frames.arm_a;
  joint.arm_b = frames.arm_b;
  for (std::uint32_t i = 0; i < joint.drive_count; ++i) {
    JointDrive<S>& drive = joint.drives[i];
    if (drive.soft) drive.bounded_below = drive.bounded_above = true;
  }
  visit_joint_type(joint.properties.type, [&](auto kind) ISO_INLINE_LAMBDA {
    decltype(kind)::template Of<S>::linearise(frames, step.h, joint);
  });
  for (std::uint32_t i = 0; i < joint.drive_count; ++i) {
    JointDrive<S>& drive = joint.drives[i];
    if (drive.soft) detail::yield_limit(drive);
    drive.piece = detail::valid_piece(drive, drive.piece);
    if (drive.sways) {
      detail::weigh_sway(joint, step, drive);
    } else if (drive.sprung) {
      const S angle = S(6.283185307179586) * (drive.frequency * step.h);
      if (drive.soft || drive.spring_root == S(0)) detail::weigh_spring(drive, angle, step.rate);
      drive.spring_lag = drive.yields ? S(0) : detail::lag_of(angle);
      drive.spring_came = detail::lagging_way(drive, joint, step);
      detail::set_spring_push(drive);
    } else {
      drive.spring = S(0);  // of a soft limit that the last sub-step left, too
    }
  }
}

template <class S> void weigh_joint(JointConstraint<S>& joint, const Mat3<S>& kappa_a, const Mat3<S>& kappa_b) {
  for (std::uint32_t i = 0; i < joint.block_count; ++i) {
    for (JointRow<S>& row : joint.blocks[i].rows) detail::set_turns(row, kappa_a, kappa_b);
  }
  for (std::uint32_t i = 0; i < joint.drive_count; ++i) detail::set_turns(joint.drives[i].row, kappa_a, kappa_b);
}

template <class S> void couple_blocks(JointConstraint<S>& joint) {
  if (joint.drive_count > 0) detail::place_drives(joint);
  for (std::uint32_t i = 0; i < joint.block_count; ++i) detail::weigh_block(joint.blocks[i], joint.share);
}

template <class S> void apply_impulses(JointConstraint<S>& joint, const JointStep<S>& step) {
  detail::JointPush<S> push;
  for (std::uint32_t i = 0; i < joint.block_count; ++i) push.add(joint.blocks[i], joint.blocks[i].impulse);
  for (std::uint32_t i = 0; i < joint.drive_count; ++i) {
    JointDrive<S>& drive = joint.drives[i];
    if (detail::is_constant(drive, drive.piece)) {
      drive.impulse = detail::motor_impulse(drive.piece, detail::most_impulse(drive, step.h));
    }
    push.add(drive.row, drive.impulse);
  }
  push.apply(joint, *step.bodies);
}

template <class S>
Vec3<Velocity<S>> right_side(const JointConstraint<S>& joint, std::uint32_t block, const JointMotion<S>& motion,
                             const JointStep<S>& step, bool relax) {
  using V = Velocity<S>;
  const JointBlock<S>& of = joint.blocks[block];
  const Vec3<V> speed = speed_along(of, motion);
  Vec3<V> right = -speed;
  if (!relax) right -= detail::block_bias(of, step.softness.bias_rate);
  for (std::uint32_t i = 0; i < joint.drive_count; ++i) {
    const JointDrive<S>& drive = joint.drives[i];
    if (drive.block != block) continue;
    const int at = static_cast<int>(drive.place);
    right[at] = detail::drive_right_side(drive, speed[at], detail::bounds_of(drive, step, relax),
                                         detail::most_impulse(drive, step.h));
  }
  return with_headroom(right);
}

template <class S>
void push_joint(JointConstraint<S>& joint, const JointRows<S>& change, Softness<S> soft, SolverBodies<S>& bodies) {
  using V = Velocity<S>;
  const V limit = most_joint_impulse<S>();
  const auto next = [&](V old, V full) {
    return clamp(old + scaled(soft.mass_scale, full) - scaled(soft.impulse_scale, old), -limit, limit);
  };
  detail::JointPush<S> push;
  Vec3<V> asked[2] = {change.point, change.angular};
  for (std::uint32_t i = 0; i < joint.drive_count; ++i) {
    JointDrive<S>& drive = joint.drives[i];
    Vec3<V>& of_drives = asked[drive.block];
    const int at = static_cast<int>(drive.place);
    if (!detail::is_constant(drive, drive.piece)) {
      const bool fixed = detail::fixes_speed(drive.piece);
      const V full = fixed ? of_drives[at] : round_to<V>(product(drive.spring_row.y, of_drives[at]));
      const V impulse = next(drive.impulse, full);
      push.add(drive.row, impulse - drive.impulse);
      drive.impulse = impulse;
    }
    of_drives[at] = V(0);
  }
  for (std::uint32_t i = 0; i < joint.block_count; ++i) {
    Vec3<V>& impulse = joint.blocks[i].impulse;
    const Vec3<V> old = impulse;
    impulse = {next(old.x, asked[i].x), next(old.y, asked[i].y), next(old.z, asked[i].z)};
    push.add(joint.blocks[i], impulse - old);
  }
  push.apply(joint, bodies);
}

template <class S> bool judge_drives(JointConstraint<S>& joint, const JointStep<S>& step, bool relax, bool may_hold) {
  const JointMotion<S> m = gather(*step.bodies, joint.row_a, joint.row_b);
  bool changes = false;
  for (std::uint32_t i = 0; i < joint.drive_count; ++i) {
    JointDrive<S>& drive = joint.drives[i];
    const DriveBounds<S> bounds = detail::bounds_of(drive, step, relax);
    if (drive.sways) changes = detail::judge_sway(joint, drive, may_hold) || changes;
    else changes = detail::judge_drive(drive, speed_along(drive.row, m), bounds, step.h, may_hold) || changes;
  }
  return changes;
}

template <class S> JointStart<S> start_of(const JointConstraint<S>& joint, const SolverBodies<S>& bodies) {
  JointStart<S> start;
  start.motion = gather(bodies, joint.row_a, joint.row_b);
  start.impulses = {joint.blocks[0].impulse, joint.blocks[1].impulse};
  for (std::uint32_t i = 0; i < joint.drive_count; ++i) start.drives[i] = joint.drives[i].impulse;
  return start;
}
template <class S> void restart_joint(JointConstraint<S>& joint, const JointStart<S>& start, SolverBodies<S>& bodies) {
  scatter(bodies, joint.row_a, joint.row_b, start.motion);
  joint.blocks[0].impulse = start.impulses.point;
  joint.blocks[1].impulse = start.impulses.angular;
  for (std::uint32_t i = 0; i < joint.drive_count; ++i) joint.drives[i].impulse = start.drives[i];
}

template <class S> void change_pieces(JointConstraint<S>& joint, const JointStep<S>& step) {
  detail::JointPush<S> push;
  for (std::uint32_t i = 0; i < joint.drive_count; ++i) {
    JointDrive<S>& drive = joint.drives[i];
    drive.piece = drive.next;
    // A drive that let go in an earlier round counts too: the restart has given it back the impulse with which it held.
    if (!detail::is_constant(drive, drive.piece)) continue;
    const Velocity<S> impulse = detail::motor_impulse(drive.piece, detail::most_impulse(drive, step.h));
    push.add(drive.row, impulse - drive.impulse);
    drive.impulse = impulse;
  }
  push.apply(joint, *step.bodies);
}

template <class S> void store_joint(const JointConstraint<S>& joint, JointState<S>& state) {
  using V = Velocity<S>;
  const Vec3<V> zero = Vec3<V>::zero();
  state.point = joint.block_count > 0 ? joint.blocks[0].impulse : zero;
  state.angular = joint.block_count > 1 ? joint.blocks[1].impulse : zero;
  state.pieces = 0;
  for (std::uint32_t i = 0; i < joint.drive_count; ++i) {
    const JointDrive<S>& drive = joint.drives[i];
    (drive.block == 0 ? state.point : state.angular)[static_cast<int>(drive.place)] = drive.impulse;
    state.set_piece(3 * drive.block + drive.place, drive.piece);
  }
}

}  // namespace isostep
