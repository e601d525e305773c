// The preparation of a joint, once a step: its rows, their levers, last impulses. Part of joint.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/joints/joint_kinds.hpp"
#include "isostep/dynamics/joints/soft_limit.hpp"
#include "isostep/dynamics/joints/spring_mass.hpp"

namespace isostep {

namespace detail {

template <class S> ISO_INLINE S trace_bound(const SolverMass<S>& a, const SolverMass<S>& b, MassShare<S> share) {
  const auto entry = [&](int i) { return share.a * a.kappa.rows[i][i] + share.b * b.kappa.rows[i][i]; };
  return max(entry(0), max(entry(1), entry(2)));
}

/// [1/m^2] Returns the pair's inverse inertia about an axis of frame a, times its reduced mass.
template <class S>
ISO_INLINE S turning_about(Vec3<S> axis, const SolverMass<S>& a, const SolverMass<S>& b, MassShare<S> share) {
  return share.a * dot(axis, a.kappa * axis) + share.b * dot(axis, b.kappa * axis);
}
template <class S> ISO_INLINE S radius_of(S turning) { return turning > S(0) ? S(1) / sqrt(turning) : S(0); }

/// Sets the levers of angles about the joint's z axis and across it: thin bodies turn far more easily about one. A
/// lever is the mean of the body's own radius of inertia, at which a row alone is one, and the one about the joint, at
/// which it is one once the point holds. So on long arms both entries and impulses stay within the format.
template <class S>
ISO_INLINE void set_radii(const JointEnd<S>& end_a, const SolverMass<S>& a, const SolverMass<S>& b,
                          JointConstraint<S>& joint) {
  joint.radius = S(0);
  if (joint.block_count + joint.drive_count < 2) return;  // no row turns alone
  joint.radius = radius_of(trace_bound(a, b, joint.share));
  bool turns = false;
  for (std::uint32_t i = 0; i < joint.drive_count; ++i) {
    joint.drives[i].radius = joint.radius;
    turns = turns || joint.drives[i].block == 1;
  }
  if (!turns) return;
  const Mat3<Unit<S>> frame = to_matrix(end_a.pose.orientation * joint.properties.frame_a.orientation);
  const auto about = [&](int i) { return turning_about(convert<S>(frame.column(i)), a, b, joint.share); };
  const S arm = joint.share.a * length(joint.properties.frame_a.position) +
                joint.share.b * length(joint.properties.frame_b.position);
  const auto mean = [&](S own) { return sqrt(own) * sqrt(direction_of(own, arm, S(0)).length); };
  const S of_twist = mean(radius_of(about(2))), of_swing = mean(radius_of(S(0.5) * about(0) + S(0.5) * about(1)));
  for (std::uint32_t i = 0; i < joint.drive_count; ++i) {
    JointDrive<S>& drive = joint.drives[i];
    if (drive.block == 1) drive.radius = drive.place == 2 ? of_twist : of_swing;
  }
}

/// Counts a joint's blocks and drives, and places the drives. An angle is in the last row unless its kind overrides it.
template <class S> ISO_INLINE void count_rows(JointConstraint<S>& joint) {
  JointDrive<S>& main = joint.drives[0];
  JointDrive<S>& swing = joint.drives[1];
  main = {};
  swing = {};
  main.block = swing.block = 1;
  main.place = 2;
  main.push_speed = swing.push_speed = kAnglePushSpeed<S>;
  visit_joint_type(joint.properties.type,
                   [&](auto kind) ISO_INLINE_LAMBDA { decltype(kind)::template Of<S>::count_rows(joint); });
  main.frequency = joint.properties.spring_frequency;
  main.damping = joint.properties.spring_damping;
}
/// The widest half axis of an ellipse [rad], 120 degrees, and the least [1]: tan of half of 3 degrees. A narrower
/// ellipse counts as a line in coarse formats.
template <class S> inline constexpr S kWidestSwing = S(2.0943951023931953);
template <class S> inline constexpr S kLeastHalfTangent = S(0.026186);
template <class S> ISO_INLINE void add_drive(const AxisDrive<S>& asked, JointConstraint<S>& joint) {
  JointDrive<S>& drive = joint.drives[joint.drive_count++];
  const std::uint32_t row = static_cast<std::uint32_t>(asked.axis);
  drive = {};
  drive.asked = drive.spring_asked = &asked;
  drive.block = row / 3;
  drive.place = row % 3;
  drive.push_speed = is_length(asked.axis) ? kJointPushSpeed<S> : kAnglePushSpeed<S>;
  drive.bounded_below = drive.bounded_above = asked.limited;
  drive.driven = asked.motor;
  drive.soft = is_soft(asked);
  set_spring(asked, drive);
  if (is_length(asked.axis) || asked.axis == JointAxis::twist) return;
  const SinCos<S> half = sin_cos(min(asked.upper, kWidestSwing<S>) * S(0.5));
  drive.half_tangent = max(half.sin / half.cos, kLeastHalfTangent<S>);
}

/// Loads the last impulses. After a change of the joint's settings, a row that was an equality and is a drive now
/// starts from zero, and so does one that was a drive and is none now.
template <class S> ISO_INLINE void load_impulses(const JointState<S>& state, JointConstraint<S>& joint) {
  joint.blocks[0].impulse = state.point;
  joint.blocks[1].impulse = state.angular;
  for (std::uint32_t row = 0; row < kJointRows; ++row) {
    if (state.has_drive(row)) joint.blocks[row / 3].impulse[static_cast<int>(row % 3)] = Velocity<S>(0);
  }
  for (std::uint32_t i = 0; i < joint.drive_count; ++i) {
    JointDrive<S>& drive = joint.drives[i];
    const std::uint32_t row = 3 * drive.block + drive.place;
    const int place = static_cast<int>(drive.place);
    const bool was = state.has_drive(row);
    joint.blocks[drive.block].impulse[place] = Velocity<S>(0);
    drive.impulse = was ? (drive.block == 0 ? state.point : state.angular)[place] : Velocity<S>(0);
    drive.piece = valid_piece(drive, was ? state.piece(row) : DrivePiece::free);
  }
}

/// [N] or [N m] Returns the most that a drive's motor or servo gives.
template <class S> ISO_INLINE S force_of(const JointDrive<S>& drive, const JointProperties<S>& p) {
  return drive.asked == nullptr ? p.max_force : drive.asked->max_force;
}
/// [kg] Returns the reduced mass to which impulses of the joint refer.
template <class S>
ISO_INLINE S impulse_mass(const SolverMass<S>& a, const SolverMass<S>& b, const JointConstraint<S>& joint) {
  return a.mass > S(0) ? a.mass * joint.share.a : b.mass * joint.share.b;
}
/// Sets the most impulse of a motor in h: force h / reduced mass. The lever of a torque is the radius.
template <class S>
ISO_INLINE void set_force(const SolverMass<S>& a, const SolverMass<S>& b, const JointConstraint<S>& joint,
                          JointDrive<S>& drive) {
  const JointProperties<S>& p = joint.properties;
  const S reduced = impulse_mass(a, b, joint), force = force_of(drive, p);
  if (drive.block == 0) {
    drive.force = divide_to<S>(force, reduced);
    drive.most = Limits<S>::speed();
    return;
  }
  const S radius = drive.radius;
  if (!(radius > S(0))) return;  // nothing turns
  drive.force = divide_to<S>(force, reduced * radius);
  // The drive alone, without what the point holds, turns a body no faster than its points may move.
  const S reach = max(S(1), max(max_abs(p.frame_a.position), max_abs(p.frame_b.position)));
  const S turning = max(trace_bound(a, b, joint.share) * radius, S(1));
  drive.most = min(Limits<S>::speed(), Limits<S>::surface_speed() / reach / turning);
}

/// [1] The least inverse of a spring: its mass counts as at most a million times the mass between its bodies, of which
/// Q16.16 resolves 16384.
template <class S> inline constexpr S kLeastSpringInverse = max(S(0x1p-20), S(4) * resolution<S>());
/// Sets the inverse mass of a spring with a named mass: along a row of unit length, or at the radius of a turn.
template <class S>
ISO_INLINE void set_spring_mass(const SolverMass<S>& a, const SolverMass<S>& b, const JointConstraint<S>& joint,
                                JointDrive<S>& drive) {
  drive.spring_inverse = S(0);
  if (drive.asked == nullptr || !(S(0) < drive.asked->spring_mass)) return;
  const S radius = drive.block == 0 ? S(1) : drive.radius;
  const S at_radius = saturate_to<S>(product(impulse_mass(a, b, joint), radius));
  const S inverse = saturate_to<S>(product(divide_to<S>(at_radius, drive.asked->spring_mass), radius));
  drive.spring_inverse = max(inverse, kLeastSpringInverse<S>);
}

/// Gives both swings of a cone the stiffer spring of the two: their rows turn with the swing, and a stiffness that
/// changed with them would give energy. A swing without a spring has no way to its target: off_target().
template <class S> ISO_INLINE void even_cone(JointConstraint<S>& joint) {
  if (joint.properties.type != JointType::six_axis) return;
  JointDrive<S>* const x = drive_of(joint, 0);
  JointDrive<S>* const y = drive_of(joint, 1);
  if (!makes_cone(joint.properties.flags, x, y) || !(x->sprung || y->sprung)) return;
  const bool of_x =
      !y->sprung || (x->sprung && y->frequency * sqrt(x->spring_inverse) <= x->frequency * sqrt(y->spring_inverse));
  const JointDrive<S>& stiff = of_x ? *x : *y;
  JointDrive<S>& other = of_x ? *y : *x;
  other.spring_asked = stiff.asked;
  set_spring(*stiff.asked, other);
  other.spring_inverse = stiff.spring_inverse;
  if (!other.servo) return;
  other.force = stiff.force;
  other.most = stiff.most;
}

/// Returns the reach within which a body that turns about a far joint still fits the format: see Limits<S>::leverage().
template <class S> ISO_INLINE S reach_of(const JointConstraint<S>& joint, const SolverMass<S>& a) {
  const S kappa = max(a.kappa.rows[0].x, max(a.kappa.rows[1].y, a.kappa.rows[2].z));
  const S most = S(2) * Limits<S>::position();
  if (!(kappa > S(0))) return most;
  const S whole = sqrt(Limits<S>::leverage()) / sqrt(kappa);
  return clamp(whole - length(joint.properties.frame_a.position), S(0), most);
}

}  // namespace detail

template <class S>
void prepare_joint(const JointProperties<S>& properties, const JointState<S>& state, const JointEnd<S>& a,
                   const JointEnd<S>& b, const SolverBodies<S>& bodies, JointConstraint<S>& joint,
                   std::span<const JointAxisDrive<S>> axes) {
  joint.properties = properties;
  joint.row_a = a.row;
  joint.row_b = b.row;
  joint.pose_a = a.pose;
  joint.pose_b = b.pose;
  const SolverMass<S>& mass_a = bodies.mass[a.row];
  const SolverMass<S>& mass_b = bodies.mass[b.row];
  joint.share = mass_share(mass_a.mass, mass_b.mass);
  joint.holds = a.row != b.row && joint.share.a + joint.share.b > S(0);
  joint.blocks[0].give = joint.blocks[1].give = Vec3<S>::zero();
  joint.blocks[0].turns = false;
  joint.blocks[1].turns = true;
  detail::count_rows(joint);
  for (const JointAxisDrive<S>& axis : axes) detail::add_drive(*axis.drive, joint);
  detail::add_swings(joint);
  detail::set_radii(a, mass_a, mass_b, joint);
  joint.reach = detail::reach_of(joint, mass_a);
  for (std::uint32_t i = 0; i < joint.drive_count; ++i) {
    JointDrive<S>& drive = joint.drives[i];
    drive.force = drive.most = S(0);
    if (joint.holds && (drive.driven || drive.servo)) detail::set_force(mass_a, mass_b, joint, drive);
    if (joint.holds) detail::set_spring_mass(mass_a, mass_b, joint, drive);
  }
  if (joint.holds) detail::feel_springs(mass_a, mass_b, joint);
  detail::even_cone(joint);
  detail::load_impulses(state, joint);
}

}  // namespace isostep
