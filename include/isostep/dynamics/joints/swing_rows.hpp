// The angles of a six-axis joint: their rows as equalities and as drives.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/joints/slide_rows.hpp"
#include "isostep/dynamics/joints/soft_limit.hpp"
#include "isostep/dynamics/joints/turn_rows.hpp"

namespace isostep::detail {

/// Where b's z axis points, in frame a, and how fast that changes.
/// Symbols: d = z_b in a. s = (d_x, d_y) / (1 + d_z), of length tan(swing / 2). The swing about y is 2 atan(s_x), the
///          one about x is -2 atan(s_y): for a turn about one of the axes they are its angle. Their rates have no
///          trigonometry: d(2 atan(s_x))/dt = w . (d x g) 2 / (1 + s_x^2), g = gradient of s_x, w = w_b - w_a in a.
template <class S> struct SwingTwist {
  Vec3<S> d;
  S per;          // [1] 1 / (1 + d_z)
  S x, y;         // [1] s
  bool is_clear;  // the z axes are less than 120 degrees apart: farther, rates grow beyond what formats hold

  static ISO_INLINE SwingTwist of(const JointFrames<S>& f, const Mat3<Unit<S>>& a) {
    SwingTwist t;
    t.d = convert<S>(transposed_times(a, to_matrix(f.b).column(2)));
    t.is_clear = S(-0.5) < t.d.z;
    t.per = S(1) / (S(1) + max(t.d.z, S(-0.5)));
    t.x = t.d.x * t.per;
    t.y = t.d.y * t.per;
    return t;
  }
  /// [1] in a: w . rate is the rate of the swing about y, or of the one about x.
  ISO_INLINE Vec3<S> rate_about_y() const { return rate({per, S(0), -(x * per)}, x); }
  ISO_INLINE Vec3<S> rate_about_x() const { return -rate({S(0), per, -(y * per)}, y); }
  /// [rad] The swings themselves.
  ISO_INLINE S angle_about_y() const { return S(2) * atan2(x, S(1)); }
  ISO_INLINE S angle_about_x() const { return S(-2) * atan2(y, S(1)); }

 private:
  ISO_INLINE Vec3<S> rate(Vec3<S> gradient, S s) const { return cross(d, gradient) * (S(2) / (S(1) + s * s)); }
};

/// As angular_row(), of an axis that need not be a direction.
template <class S> ISO_INLINE JointRow<S> turning_row(Vec3<S> axis, S radius) {
  const Vec3<S> angular = axis * radius;
  return {Vec3<S>::zero(), angular, angular, Vec3<S>::zero(), Vec3<S>::zero()};
}

/// The axis that two locks leave, or -1.
ISO_INLINE constexpr int only_free_turn(std::uint32_t flags) {
  const std::uint32_t locks = flags & joint_flag::kLockTurns;
  return locks == joint_flag::kLockSwing                               ? 2
         : locks == (joint_flag::kLockSwingX | joint_flag::kLockTwist) ? 1
         : locks == (joint_flag::kLockSwingY | joint_flag::kLockTwist) ? 0
                                                                       : -1;
}

/// [rad] in (-pi, pi], of an axis that is no length.
template <class S> ISO_INLINE S angle_of(JointAxis axis, std::uint32_t flags, const JointFrames<S>& f) {
  const int place = static_cast<int>(axis) - 3;
  const Quat<Unit<S>> q = relative_rotation(f);
  const Unit<S> parts[3] = {q.x, q.y, q.z};
  if (place == 2 || only_free_turn(flags) == place) return S(2) * atan2_to<S>(parts[place], q.w);
  const Vec3<Unit<S>> d = transposed_times(to_matrix(f.a), to_matrix(f.b).column(2));
  const S up = S(1) + convert<S>(d.z);
  return place == 1 ? S(2) * atan2(convert<S>(d.x), up) : S(-2) * atan2(convert<S>(d.y), up);
}
/// [m] or [rad]
template <class S> ISO_INLINE S position_of(JointAxis axis, std::uint32_t flags, const JointFrames<S>& f) {
  if (!is_length(axis)) return angle_of(axis, flags, f);
  return dot(f.between, to_matrix(f.a).column(static_cast<int>(axis)));
}

template <class S> ISO_INLINE JointDrive<S>* drive_of(JointConstraint<S>& joint, std::uint32_t place) {
  for (std::uint32_t i = 0; i < joint.drive_count; ++i) {
    if (joint.drives[i].block == 1 && joint.drives[i].place == place) return &joint.drives[i];
  }
  return nullptr;
}

/// Whether a twist beside a swing is locked, limited or sprung: one that only has a motor may be any.
template <class S> ISO_INLINE bool holds_twist(JointConstraint<S>& joint) {
  const std::uint32_t flags = joint.properties.flags;
  if ((flags & joint_flag::kLockTurns) == joint_flag::kLockTurns || only_free_turn(flags) >= 0) return false;
  if ((flags & joint_flag::kLockTwist) != 0) return true;
  const JointDrive<S>* const twist = drive_of(joint, 2);
  return twist != nullptr && (twist->asked->limited || S(0) < twist->asked->spring_frequency);
}
/// Drives that nothing asks for, of swings that are to stop where the twist ends.
template <class S> ISO_INLINE void add_swings(JointConstraint<S>& joint) {
  if (joint.properties.type != JointType::six_axis || !holds_twist(joint)) return;
  for (const std::uint32_t place : {0u, 1u}) {
    if ((joint.properties.flags & joint_flag::kLockSwingX << place) != 0 || drive_of(joint, place) != nullptr) continue;
    JointDrive<S>& drive = joint.drives[joint.drive_count++];
    drive = {};
    drive.block = 1;
    drive.place = place;
    drive.push_speed = kAnglePushSpeed<S>;
  }
}

/// b's axis of that number coincides with a's, and the turn about it may be driven.
template <class S>
ISO_INLINE void linearise_turn_about(int free, const JointFrames<S>& f, const Mat3<Unit<S>>& a, Step<S> h,
                                     JointConstraint<S>& joint) {
  const int i = (free + 1) % 3, j = (free + 2) % 3;
  const Vec3<Unit<S>> tilt = transposed_times(a, to_matrix(f.b).column(free));
  JointBlock<S>& block = joint.blocks[1];
  block.rows[i] = angular_row<S>(a.column(i), joint.radius);
  block.rows[j] = angular_row<S>(a.column(j), joint.radius);
  block.error[i] = bounded_error(-(joint.radius * tilt[j]), h);
  block.error[j] = bounded_error(joint.radius * tilt[i], h);
  JointDrive<S>* const drive = drive_of(joint, static_cast<std::uint32_t>(free));
  if (drive == nullptr) return;
  drive->row = angular_row<S>(a.column(free), drive->radius);
  set_angle(*drive, *drive->asked, angle_of(static_cast<JointAxis>(3 + free), joint.properties.flags, f));
}

/// One swing is locked: b's z axis stays in a plane of a.
/// Symbols: d(z_b . y_a)/dt = (w_b - w_a) . (z_b x y_a), and the same of x.
template <class S>
ISO_INLINE void lock_swing(const JointFrames<S>& f, const Mat3<Unit<S>>& a, Step<S> h, JointConstraint<S>& joint) {
  const Vec3<Unit<S>> z = to_matrix(f.b).column(2);
  const bool about_x = (joint.properties.flags & joint_flag::kLockSwingX) != 0;
  const int place = about_x ? 0 : 1;
  const Vec3<Unit<S>> across = a.column(1 - place);
  JointBlock<S>& block = joint.blocks[1];
  block.rows[place] = angular_row<S>(about_x ? cross(across, z) : cross(z, across), joint.radius);
  const S off = joint.radius * dot(z, across);
  block.error[place] = bounded_error(about_x ? -off : off, h);
}

template <class S> ISO_INLINE bool is_limited(const JointDrive<S>& drive) {
  return drive.asked != nullptr && drive.asked->limited;
}
/// Whether the limits of both swings are an ellipse.
template <class S> ISO_INLINE bool makes_cone(std::uint32_t flags, const JointDrive<S>* x, const JointDrive<S>* y) {
  return (flags & joint_flag::kCone) != 0 && x != nullptr && y != nullptr && is_limited(*x) && is_limited(*y);
}
/// The drives of both swings, each about its axis.
template <class S>
ISO_INLINE void set_swings(const SwingTwist<S>& swing, const Mat3<Unit<S>>& a, JointDrive<S>* x, JointDrive<S>* y) {
  const auto set = [&](JointDrive<S>* drive, Vec3<S> rate, S angle) ISO_INLINE_LAMBDA {
    if (drive == nullptr) return;
    drive->bounded_below = drive->bounded_above = is_limited(*drive) && swing.is_clear;
    drive->row = turning_row<S>(a * rate, drive->radius);
    if (drive->asked != nullptr) set_angle(*drive, *drive->asked, angle, false);
  };
  set(x, swing.rate_about_x(), swing.angle_about_x());
  set(y, swing.rate_about_y(), swing.angle_about_y());
}

/// [1] of the ellipse, beyond which rows turn with the direction of the swing: nearer its middle no limit is near.
template <class S> inline constexpr S kConeBasis = S(0.5);

/// [rad] What a spring of a swing is off its target, and [rad/s] what a motor of it runs at: without them nothing, for
/// rows that turn with the swing mix both.
template <class S> ISO_INLINE S off_target(const JointDrive<S>* swing, S angle) {
  if (swing == nullptr || swing->asked == nullptr || !(S(0) < swing->asked->spring_frequency)) return S(0);
  return angle - swing->asked->spring_target;
}
template <class S> ISO_INLINE S asked_speed(const JointDrive<S>* swing) {
  return swing != nullptr && swing->asked != nullptr && swing->asked->motor ? swing->asked->motor_speed : S(0);
}

/// The rows of swings along one axis, in a, and across it: `x` is the drive along it if both are there. Nothing limits
/// them.
template <class S>
ISO_INLINE void set_along(const SwingTwist<S>& swing, const Mat3<Unit<S>>& a, Vec3<Unit<S>> axis, JointDrive<S>* x,
                          JointDrive<S>* y) {
  const S off_x = off_target(x, swing.angle_about_x()), off_y = off_target(y, swing.angle_about_y());
  const S speed_x = asked_speed(x), speed_y = asked_speed(y);
  const auto set = [&](JointDrive<S>* drive, Vec3<S> about, S x_part, S y_part) ISO_INLINE_LAMBDA {
    if (drive == nullptr) return;
    const auto part = [&](S of_x, S of_y) ISO_INLINE_LAMBDA { return x_part * of_x + y_part * of_y; };
    drive->row = turning_row<S>(a * about, drive->radius);
    drive->bounded_below = drive->bounded_above = false;
    drive->position = S(0);
    drive->target = -(part(off_x, off_y) * drive->radius);
    drive->speed = round_to<Velocity<S>>(product(part(speed_x, speed_y), drive->radius));
  };
  const Vec3<S> along = convert<S>(axis);
  if (x == nullptr) return set(y, along, along.x, along.y);
  set(x, along, along.x, along.y);
  set(y, cross(swing.d, along), -along.y, along.x);
}
/// Stops such a drive at `most`, where it is at `angle` along its axis. Its spring stays as far from its target.
template <class S> ISO_INLINE void stop_along(JointDrive<S>& drive, S angle, S most) {
  drive.position = angle * drive.radius;
  drive.target = drive.position + drive.target;
  drive.upper = most * drive.radius;
  drive.bounded_above = true;
}

/// Both swings within an ellipse: a row along the swing, on which the limit acts, and one across it.
/// Symbols: e = sqrt((s_x / t_x)^2 + (s_y / t_y)^2), t = tan(half axis / 2). d x gradient of e points along the row's
///          axis n, and (e - 1) / its length is the angle that is left, to first order: 4 % short at 0.2 rad.
template <class S>
ISO_INLINE bool set_cone(const SwingTwist<S>& swing, const Mat3<Unit<S>>& a, JointDrive<S>& x, JointDrive<S>& y) {
  const S sx = swing.x / y.half_tangent, sy = swing.y / x.half_tangent;  // a swing about y moves the axis along x
  const S e = direction_of(sx, sy, S(0)).length;
  if (e < kConeBasis<S> || !swing.is_clear) return false;
  const S gx = sx / (y.half_tangent * e), gy = sy / (x.half_tangent * e);
  const Vec3<S> gradient = Vec3<S>{gx, gy, -(gx * swing.x + gy * swing.y)} * swing.per;
  const Vec3<S> turned = cross(swing.d, gradient);
  const Direction<S> n = direction_of(turned.x, turned.y, turned.z);
  set_along(swing, a, {n.x, n.y, n.z}, &x, &y);
  stop_along(x, (e - S(1)) / n.length, S(0));
  return true;
}

/// Beyond 120 degrees a joint whose twist is held has a stop along its swing, wherever that leads. It does not yield.
template <class S>
ISO_INLINE void end_swing(const SwingTwist<S>& swing, const Mat3<Unit<S>>& a, JointDrive<S>* x, JointDrive<S>* y) {
  const Direction<S> n = direction_of(-swing.d.y, swing.d.x, S(0));
  set_along(swing, a, {n.x, n.y, Unit<S>(0)}, x, y);
  JointDrive<S>& along = x != nullptr ? *x : *y;
  stop_along(along, atan2(n.length, swing.d.z), kTwistEnds<S>);
  if (!along.soft) return;
  along.soft = along.yields = false;
  set_spring(*along.spring_asked, along);
}

template <class S>
ISO_INLINE void linearise_swings(const JointFrames<S>& f, const Mat3<Unit<S>>& a, JointConstraint<S>& joint) {
  JointDrive<S>* const x = drive_of(joint, 0);
  JointDrive<S>* const y = drive_of(joint, 1);
  if (x == nullptr && y == nullptr) return;
  for (JointDrive<S>* const drive : {x, y}) {
    if (drive != nullptr) drive->soft = drive->asked != nullptr && is_soft(*drive->asked);
  }
  const SwingTwist<S> swing = SwingTwist<S>::of(f, a);
  if (!swing.is_clear && holds_twist(joint)) return end_swing(swing, a, x, y);
  const bool cone = makes_cone(joint.properties.flags, x, y);
  if (cone && set_cone(swing, a, *x, *y)) return;
  set_swings(swing, a, x, y);
  if (cone) x->bounded_below = x->bounded_above = y->bounded_below = y->bounded_above = false;
}

template <class S>
ISO_INLINE void linearise_turns(const JointFrames<S>& f, const Mat3<Unit<S>>& a, Step<S> h, JointConstraint<S>& joint) {
  const std::uint32_t flags = joint.properties.flags;
  if ((flags & joint_flag::kLockTurns) == joint_flag::kLockTurns) return weld_block(f, a, h, joint);
  empty_block(joint.blocks[1]);
  if (const int free = only_free_turn(flags); free >= 0) return linearise_turn_about(free, f, a, h, joint);
  if ((flags & joint_flag::kLockSwing) != 0) lock_swing(f, a, h, joint);
  linearise_swings(f, a, joint);
  const Vec3<Unit<S>> za = a.column(2), zb = to_matrix(f.b).column(2);
  if ((flags & joint_flag::kLockTwist) != 0) return lock_twist(f, za, zb, h, joint);
  JointDrive<S>* const drive = drive_of(joint, 2);
  if (drive != nullptr) set_twist(f, za, zb, drive->asked->limited, *drive->asked, *drive);
}

}  // namespace isostep::detail
