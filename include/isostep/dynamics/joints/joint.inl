// Bodies of joint.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/joints/ball.hpp"
#include "isostep/dynamics/joints/distance.hpp"
#include "isostep/dynamics/joints/fixed.hpp"
#include "isostep/dynamics/joints/hinge.hpp"

namespace isostep {

namespace detail {

template <class S> ISO_INLINE S trace_bound(const SolverMass<S>& a, const SolverMass<S>& b, MassShare<S> share) {
  const auto entry = [&](int i) { return share.a * a.kappa.rows[i][i] + share.b * b.kappa.rows[i][i]; };
  return max(entry(0), max(entry(1), entry(2)));
}

/// [1/m^2] how easily the pair turns about an axis of frame a.
template <class S>
ISO_INLINE S turning_about(Vec3<S> axis, const SolverMass<S>& a, const SolverMass<S>& b, MassShare<S> share) {
  return share.a * dot(axis, a.kappa * axis) + share.b * dot(axis, b.kappa * axis);
}
template <class S> ISO_INLINE S radius_of(S turning) { return turning > S(0) ? S(1) / sqrt(turning) : S(0); }

/// Lever of an angle about the joint's z axis, and of one across it: thin bodies turn far more easily about one.
template <class S>
ISO_INLINE void set_radii(const JointEnd<S>& end_a, const SolverMass<S>& a, const SolverMass<S>& b,
                          JointConstraint<S>& joint) {
  joint.radius = S(0);
  if (joint.block_count + joint.drive_count < 2) return;  // no row turns alone
  joint.radius = radius_of(trace_bound(a, b, joint.share));
  joint.drives[0].radius = joint.drives[1].radius = joint.radius;
  if (joint.drive_count == 0 || joint.properties.type == JointType::distance) return;
  const Mat3<Unit<S>> frame = to_matrix(end_a.pose.orientation * joint.properties.frame_a.orientation);
  const auto about = [&](int i) { return turning_about(convert<S>(frame.column(i)), a, b, joint.share); };
  joint.drives[0].radius = radius_of(about(2));
  joint.drives[1].radius = radius_of(S(0.5) * about(0) + S(0.5) * about(1));
}

/// Which of the two kinds of row a joint has.
template <class S> ISO_INLINE void count_rows(JointConstraint<S>& joint) {
  const JointProperties<S>& p = joint.properties;
  const bool limit = (p.flags & joint_flag::kLimit) != 0, motor = (p.flags & joint_flag::kMotor) != 0;
  const bool spring = (p.flags & joint_flag::kSpring) != 0, cone = (p.flags & joint_flag::kCone) != 0;
  JointDrive<S>& main = joint.drives[0];
  JointDrive<S>& swing = joint.drives[1];
  main = {};
  swing = {};
  switch (p.type) {
    case JointType::ball:
      joint.block_count = 1;
      joint.drive_count = cone || limit ? 2 : 0;
      main.bounded_below = main.bounded_above = limit;
      swing.bounded_above = cone;
      return;
    case JointType::hinge:
      joint.block_count = 2;
      joint.drive_count = limit || motor || spring ? 1 : 0;
      main.bounded_below = main.bounded_above = limit;
      main.driven = motor;
      main.sprung = spring;
      return;
    case JointType::fixed:
      joint.block_count = 2;
      joint.drive_count = 0;
      return;
    case JointType::distance: {
      const bool bounded = limit || !spring;
      const bool rod = bounded && !(p.lower < p.upper);
      joint.block_count = rod ? 1 : 0;
      joint.drive_count = rod ? 0 : 1;
      main.bounded_below = bounded && p.lower > S(0);
      main.bounded_above = bounded;
      main.sprung = spring;
      return;
    }
  }
}

template <class S> ISO_INLINE void load_impulses(const JointState<S>& state, JointConstraint<S>& joint) {
  joint.blocks[0].impulse = state.point;
  joint.blocks[1].impulse = state.angular;
  JointDrive<S>& main = joint.drives[0];
  main.motor_impulse = state.motor;
  main.spring_impulse = state.spring;
  main.lower_impulse = state.lower;
  main.upper_impulse = state.upper;
  joint.drives[1].upper_impulse = state.swing;
}

template <class S> ISO_INLINE void set_turns(JointRow<S>& row, const Mat3<S>& kappa_a, const Mat3<S>& kappa_b) {
  row.turn_a = kappa_a * row.angular_a;
  row.turn_b = kappa_b * row.angular_b;
}
/// Entry of K between two rows of one joint.
template <class S> ISO_INLINE S self_coupling(const JointRow<S>& i, const JointRow<S>& j, MassShare<S> share) {
  return share.a * coupling(i.linear, i.angular_a, j.linear, j.turn_a) +
         share.b * coupling(i.linear, i.angular_b, j.linear, j.turn_b);
}
template <class S> ISO_INLINE void weigh_block(JointBlock<S>& block, MassShare<S> share) {
  if (block.point) {
    const auto& r = block.rows;
    const Mat3<S> a =
        point_coupling<S>({r[0].angular_a, r[1].angular_a, r[2].angular_a}, {r[0].turn_a, r[1].turn_a, r[2].turn_a});
    const Mat3<S> b =
        point_coupling<S>({r[0].angular_b, r[1].angular_b, r[2].angular_b}, {r[0].turn_b, r[1].turn_b, r[2].turn_b});
    const S one = share.a + share.b;
    const auto mix = [&](S of_a, S of_b) { return round_to<S>(product(share.a, of_a) + product(share.b, of_b)); };
    const S xy = mix(a.rows[0].y, b.rows[0].y), xz = mix(a.rows[0].z, b.rows[0].z), yz = mix(a.rows[1].z, b.rows[1].z);
    block.coupling = {{{one + mix(a.rows[0].x, b.rows[0].x), xy, xz},
                       {xy, one + mix(a.rows[1].y, b.rows[1].y), yz},
                       {xz, yz, one + mix(a.rows[2].z, b.rows[2].z)}}};
    return;
  }
  const auto k = [&](int i, int j) { return self_coupling(block.rows[i], block.rows[j], share); };
  const S xy = k(0, 1), xz = k(0, 2), yz = k(1, 2);
  block.coupling = {{{k(0, 0), xy, xz}, {xy, k(1, 1), yz}, {xz, yz, k(2, 2)}}};
}

template <class S> ISO_INLINE Vec3<Velocity<S>> block_bias(const JointBlock<S>& block, S bias_rate) {
  const Velocity<S> most = kJointPushSpeed<S>;
  const auto bound = [&](Velocity<S> e) { return clamp(scaled(bias_rate, e), -most, most); };
  return {bound(block.error.x), bound(block.error.y), bound(block.error.z)};
}

/// One-sided row at `gap` >= 0 from its bound, `sign` +1 towards larger positions; returns the change of impulse.
template <class S>
ISO_INLINE Velocity<S> bound_change(const JointDrive<S>& drive, S gap, Velocity<S> speed, Velocity<S> old,
                                    const JointStep<S>& step, bool relax) {
  using V = Velocity<S>;
  const Softness<S> soft = relax ? Softness<S>::rigid() : step.softness;
  const V distance = bounded_error(gap, step.h);
  if (gap > S(0)) {  // not there yet: it may close the gap within the sub-step, no more
    const V wanted = old - saturated<S>(product(drive.effective_mass, speed + scaled(step.rate, distance)));
    return max(wanted, V(0)) - old;
  }
  const V bias = max(scaled(soft.bias_rate, distance), -kJointPushSpeed<S>);
  const V change = scaled(soft.mass_scale, saturated<S>(product(drive.effective_mass, speed + bias))) +
                   scaled(soft.impulse_scale, old);
  return max(old - change, V(0)) - old;
}

template <class S>
ISO_INLINE void solve_drive(JointDrive<S>& drive, MassShare<S> share, Velocity<S> motor_limit, const JointStep<S>& step,
                            bool relax, JointMotion<S>& m) {
  using V = Velocity<S>;
  if (drive.sprung) {
    const V speed = speed_along(drive.row, m) + drive.spring_speed;
    const V change = -(scaled(drive.spring.mass_scale, saturated<S>(product(drive.effective_mass, speed))) +
                       scaled(drive.spring.impulse_scale, drive.spring_impulse));
    drive.spring_impulse += change;
    push(drive.row, share, change, m);
  }
  if (drive.driven) {
    const V wanted =
        drive.motor_impulse - saturated<S>(product(drive.effective_mass, speed_along(drive.row, m) - drive.speed));
    const V next = clamp(wanted, -motor_limit, motor_limit);
    push(drive.row, share, next - drive.motor_impulse, m);
    drive.motor_impulse = next;
  }
  if (drive.bounded_below) {
    const V change =
        bound_change(drive, drive.position - drive.lower, speed_along(drive.row, m), drive.lower_impulse, step, relax);
    drive.lower_impulse += change;
    push(drive.row, share, change, m);
  }
  if (drive.bounded_above) {
    const V change =
        bound_change(drive, drive.upper - drive.position, -speed_along(drive.row, m), drive.upper_impulse, step, relax);
    drive.upper_impulse += change;
    push(drive.row, share, -change, m);
  }
}

}  // namespace detail

template <class S>
void prepare_joint(const JointProperties<S>& properties, const JointState<S>& state, const JointEnd<S>& a,
                   const JointEnd<S>& b, const SolverBodies<S>& bodies, JointConstraint<S>& joint) {
  joint.properties = properties;
  joint.row_a = a.row;
  joint.row_b = b.row;
  joint.pose_a = a.pose;
  joint.pose_b = b.pose;
  const SolverMass<S>& mass_a = bodies.mass[a.row];
  const SolverMass<S>& mass_b = bodies.mass[b.row];
  joint.share = mass_share(mass_a.mass, mass_b.mass);
  joint.holds = a.row != b.row && joint.share.a + joint.share.b > S(0);
  detail::count_rows(joint);
  detail::load_impulses(state, joint);
  detail::set_radii(a, mass_a, mass_b, joint);
  joint.motor_force = S(0);
  if (!joint.drives[0].driven) return;
  // torque h / (reduced mass radius) is the impulse, in its unit, that the motor gives in h.
  const S reduced = mass_a.mass > S(0) ? mass_a.mass * joint.share.a : mass_b.mass * joint.share.b;
  joint.motor_force = divide_to<S>(properties.motor_torque, reduced * joint.drives[0].radius);
}

template <class S> void linearise_joint(JointConstraint<S>& joint, const JointStep<S>& step) {
  const detail::JointFrames<S> frames = detail::joint_frames(joint, step.states);
  joint.arm_a = frames.arm_a;
  joint.arm_b = frames.arm_b;
  switch (joint.properties.type) {
    case JointType::ball: detail::linearise_ball(frames, step.h, joint); break;
    case JointType::hinge: detail::linearise_hinge(frames, step.h, joint); break;
    case JointType::fixed: detail::linearise_fixed(frames, step.h, joint); break;
    case JointType::distance: detail::linearise_distance(frames, step.h, joint); break;
  }
  const JointProperties<S>& p = joint.properties;
  const S angle = S(6.283185307179586) * (p.spring_frequency * step.h);
  for (std::uint32_t i = 0; i < joint.drive_count; ++i) {
    JointDrive<S>& drive = joint.drives[i];
    if (!drive.sprung) continue;
    drive.spring = soften(angle, p.spring_damping, step.rate);
    const S most = Limits<S>::speed();
    const auto asked = product(drive.spring.bias_rate, drive.position - drive.target), bound = product(most, S(1));
    drive.spring_speed = convert<Velocity<S>>(bound < asked ? most : asked < -bound ? -most : round_to<S>(asked));
  }
}

template <class S> void weigh_joint(JointConstraint<S>& joint, const Mat3<S>& kappa_a, const Mat3<S>& kappa_b) {
  for (std::uint32_t i = 0; i < joint.block_count; ++i) {
    for (JointRow<S>& row : joint.blocks[i].rows) detail::set_turns(row, kappa_a, kappa_b);
    detail::weigh_block(joint.blocks[i], joint.share);
  }
  for (std::uint32_t i = 0; i < joint.drive_count; ++i) detail::set_turns(joint.drives[i].row, kappa_a, kappa_b);
}

/// What a push along the drive moves once the joint's own point has answered it: a door turns about its hinge, not
/// about its centre. Never less than what truly moves, so repeated passes converge.
template <class S> void weigh_drives(JointConstraint<S>& joint) {
  for (std::uint32_t i = 0; i < joint.drive_count; ++i) {
    JointDrive<S>& drive = joint.drives[i];
    const S own = detail::self_coupling(drive.row, drive.row, joint.share);
    S k = own;
    if (joint.block_count > 0) {
      const JointBlock<S>& block = joint.blocks[0];
      const auto with = [&](int r) { return detail::self_coupling(drive.row, block.rows[r], joint.share); };
      const Vec3<S> c = {with(0), with(1), with(2)};
      k = max(own - dot(c, block.inverse * c), own * S(0x1p-7));
    }
    drive.effective_mass = k > S(0) ? S(1) / k : S(0);
  }
}

template <class S> void apply_impulses(const JointConstraint<S>& joint, SolverBodies<S>& bodies) {
  JointMotion<S> m = gather(bodies, joint.row_a, joint.row_b);
  for (std::uint32_t i = 0; i < joint.block_count; ++i) push(joint.blocks[i], joint.share, joint.blocks[i].impulse, m);
  for (std::uint32_t i = 0; i < joint.drive_count; ++i) {
    const JointDrive<S>& d = joint.drives[i];
    push(d.row, joint.share, d.motor_impulse + d.spring_impulse + d.lower_impulse - d.upper_impulse, m);
  }
  scatter(bodies, joint.row_a, joint.row_b, m);
}

template <class S> void solve_drives(JointConstraint<S>& joint, const JointStep<S>& step, bool relax) {
  JointMotion<S> m = gather(*step.bodies, joint.row_a, joint.row_b);
  const S limit = min(joint.motor_force * step.h, Limits<S>::speed());
  for (std::uint32_t i = 0; i < joint.drive_count; ++i) {
    detail::solve_drive(joint.drives[i], joint.share, convert<Velocity<S>>(limit), step, relax, m);
  }
  scatter(*step.bodies, joint.row_a, joint.row_b, m);
}

template <class S> void store_joint(const JointConstraint<S>& joint, JointState<S>& state) {
  using V = Velocity<S>;
  const Vec3<V> zero = Vec3<V>::zero();
  const JointDrive<S>& main = joint.drives[0];
  state.point = joint.block_count > 0 ? joint.blocks[0].impulse : zero;
  state.angular = joint.block_count > 1 ? joint.blocks[1].impulse : zero;
  state.motor = main.driven ? main.motor_impulse : V(0);
  state.spring = main.sprung ? main.spring_impulse : V(0);
  state.lower = main.bounded_below ? main.lower_impulse : V(0);
  state.upper = main.bounded_above ? main.upper_impulse : V(0);
  state.swing = joint.drives[1].bounded_above ? joint.drives[1].upper_impulse : V(0);
}

template <class S> void warm_start_joints(std::span<JointConstraint<S>> joints, const JointStep<S>& step) {
  for (JointConstraint<S>& joint : joints) {
    if (!joint.holds) continue;
    linearise_joint(joint, step);
    weigh_joint(joint, step.bodies->mass[joint.row_a].kappa, step.bodies->mass[joint.row_b].kappa);
    for (std::uint32_t i = 0; i < joint.block_count; ++i) {
      joint.blocks[i].inverse = invert_symmetric(joint.blocks[i].coupling, detail::kBlockCompliance<S>);
    }
    weigh_drives(joint);
    apply_impulses(joint, *step.bodies);
  }
}

/// Drives, then angles, then the point: what is seen first has the last word.
template <class S> void solve_joint(JointConstraint<S>& joint, const JointStep<S>& step, bool relax) {
  if (!joint.holds) return;
  if (joint.drive_count > 0) solve_drives(joint, step, relax);
  solve_blocks(joint, step, relax);
}

template <class S> void solve_blocks(JointConstraint<S>& joint, const JointStep<S>& step, bool relax) {
  const Softness<S> soft = relax ? Softness<S>::rigid() : step.softness;
  JointMotion<S> m = gather(*step.bodies, joint.row_a, joint.row_b);
  for (std::uint32_t i = joint.block_count; i-- > 0;) {
    JointBlock<S>& block = joint.blocks[i];
    const Vec3<Velocity<S>> wrong = speed_along(block, m) + detail::block_bias(block, soft.bias_rate);
    const Vec3<Velocity<S>> rigid = saturated_times(block.inverse, wrong);
    const auto change = [&](Velocity<S> full, Velocity<S> old) {
      return -(scaled(soft.mass_scale, full) + scaled(soft.impulse_scale, old));
    };
    const Vec3<Velocity<S>> delta = {change(rigid.x, block.impulse.x), change(rigid.y, block.impulse.y),
                                     change(rigid.z, block.impulse.z)};
    block.impulse += delta;
    push(block, joint.share, delta, m);
  }
  scatter(*step.bodies, joint.row_a, joint.row_b, m);
}

template <class S> void solve_joints(std::span<JointConstraint<S>> joints, const JointStep<S>& step, bool relax) {
  for (JointConstraint<S>& joint : joints) solve_joint(joint, step, relax);
}

}  // namespace isostep
