// The angles of a six-axis joint: their rows as equalities and as drives.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/joints/slide_rows.hpp"
#include "isostep/dynamics/joints/soft_limit.hpp"
#include "isostep/dynamics/joints/turn_rows.hpp"

namespace isostep::detail {

/// The direction of b's z axis in frame a, and the rate at which it changes.
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
  /// [1] Return the rates, in a: w . rate is the rate of the swing about y, or of the one about x.
  ISO_INLINE Vec3<S> rate_about_y() const { return rate({per, S(0), -(x * per)}, x); }
  ISO_INLINE Vec3<S> rate_about_x() const { return -rate({S(0), per, -(y * per)}, y); }
  /// [rad] Return the swings.
  ISO_INLINE S angle_about_y() const { return S(2) * atan2(x, S(1)); }
  ISO_INLINE S angle_about_x() const { return S(-2) * atan2(y, S(1)); }

 private:
  ISO_INLINE Vec3<S> rate(Vec3<S> gradient, S s) const { return cross(d, gradient) * (S(2) / (S(1) + s * s)); }
};

/// [rad] The limits within which a swing is a tilt.
template <class S> inline constexpr S kMostTilt = S(1.4);
template <class S> ISO_INLINE bool is_limited(const AxisDrive<S>* drive) { return drive != nullptr && drive->limited; }
/// Returns the swing, 0 about x and 1 about y, that is the tilt of b's z axis out of the plane across its limit, or -1.
/// It is locked, or has limits beside a swing that has none. The other swing is then a turn, which goes round: limits
/// of SwingTwist's angle would meet where the z axes point in opposite directions, and stop that turn.
template <class S> ISO_INLINE int tilting_swing(std::uint32_t flags, const AxisDrive<S>* x, const AxisDrive<S>* y) {
  const AxisDrive<S>* const swings[2] = {x, y};
  for (int i = 0; i < 2; ++i) {
    if ((flags & joint_flag::kLockSwingX << i) != 0) return i;
    if (!is_limited(swings[i]) || is_limited(swings[1 - i]) || (flags & joint_flag::kLockSwingX << (1 - i)) != 0)
      continue;
    if (-kMostTilt<S> <= swings[i]->lower && swings[i]->upper <= kMostTilt<S>) return i;
  }
  return -1;
}
/// The direction of b's z axis in frame a, as a tilt and a turn.
/// Symbols: e = a's x axis where the swing about y tilts, -y where that about x does; rho = sin of the angle between d
///          and e. The tilt is asin(d . e), its rate w . (d x e) / rho. p = the axis turned about, x or y: the rate of
///          the turn is w . (p - (p . d) d) / rho^2.
template <class S> struct TiltTurn {
  Vec3<S> tilt_rate, turn_rate;  // [1] in a
  S tilt, turn;                  // [rad]

  static ISO_INLINE TiltTurn of(int tilting, Vec3<S> d) {
    const int k = 1 - tilting;  // the axis turned about, and the component of d that tilts
    const Direction<S> across = direction_of(d[tilting], d.z, S(0));
    const S way = tilting == 1 ? d.x : -d.y, sign = tilting == 1 ? S(1) : S(-1);
    const S rho = max(across.length, S(1.0 / 16));
    Vec3<S> p = Vec3<S>::zero();
    p[k] = S(1);
    TiltTurn t;
    t.tilt = atan2(way, across.length);
    t.turn = atan2(-(sign * d[tilting]), d.z);
    t.tilt_rate = Vec3<S>::zero();
    t.tilt_rate[tilting] = convert<S>(across.y);
    t.tilt_rate.z = -convert<S>(across.x);
    t.turn_rate = (p - d * d[k]) * (S(1) / (rho * rho));
    return t;
  }
};

/// Makes an angular_row() of an axis of any length.
template <class S> ISO_INLINE JointRow<S> turning_row(Vec3<S> axis, S radius) {
  const Vec3<S> angular = axis * radius;
  return {Vec3<S>::zero(), angular, angular, Vec3<S>::zero(), Vec3<S>::zero()};
}

/// Returns the axis that two locks leave free, or -1.
ISO_INLINE constexpr int only_free_turn(std::uint32_t flags) {
  const std::uint32_t locks = flags & joint_flag::kLockTurns;
  return locks == joint_flag::kLockSwing                               ? 2
         : locks == (joint_flag::kLockSwingX | joint_flag::kLockTwist) ? 1
         : locks == (joint_flag::kLockSwingY | joint_flag::kLockTwist) ? 0
                                                                       : -1;
}

/// [rad] Returns the position of an angular axis, in (-pi, pi]. `tilting`: see tilting_swing().
template <class S> ISO_INLINE S angle_of(JointAxis axis, std::uint32_t flags, int tilting, const JointFrames<S>& f) {
  const int place = static_cast<int>(axis) - 3;
  const Quat<Unit<S>> q = relative_rotation(f);
  const Unit<S> parts[3] = {q.x, q.y, q.z};
  if (place == 2 || only_free_turn(flags) == place) return S(2) * atan2_to<S>(parts[place], q.w);
  const Vec3<Unit<S>> d = transposed_times(to_matrix(f.a), to_matrix(f.b).column(2));
  if (tilting >= 0) {
    const TiltTurn<S> now = TiltTurn<S>::of(tilting, convert<S>(d));
    return place == tilting ? now.tilt : now.turn;
  }
  const S up = S(1) + convert<S>(d.z);
  return place == 1 ? S(2) * atan2(convert<S>(d.x), up) : S(-2) * atan2(convert<S>(d.y), up);
}
/// [m] or [rad] Returns the position of an axis.
template <class S> ISO_INLINE S position_of(JointAxis axis, std::uint32_t flags, int tilting, const JointFrames<S>& f) {
  if (!is_length(axis)) return angle_of(axis, flags, tilting, f);
  return dot(f.between, to_matrix(f.a).column(static_cast<int>(axis)));
}

template <class S> ISO_INLINE JointDrive<S>* drive_of(JointConstraint<S>& joint, std::uint32_t place) {
  for (std::uint32_t i = 0; i < joint.drive_count; ++i) {
    if (joint.drives[i].block == 1 && joint.drives[i].place == place) return &joint.drives[i];
  }
  return nullptr;
}

/// Returns true if a twist beside a swing is locked, limited or sprung. One with only a motor may have any angle.
template <class S> ISO_INLINE bool holds_twist(JointConstraint<S>& joint) {
  const std::uint32_t flags = joint.properties.flags;
  if ((flags & joint_flag::kLockTurns) == joint_flag::kLockTurns || only_free_turn(flags) >= 0) return false;
  if ((flags & joint_flag::kLockTwist) != 0) return true;
  const JointDrive<S>* const twist = drive_of(joint, 2);
  return twist != nullptr && (twist->asked->limited || S(0) < twist->asked->spring_frequency);
}
/// Adds drives without an AxisDrive for swings that must stop where the twist ends.
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

/// Keeps b's axis of that number together with a's. The turn about it may be driven.
template <class S>
ISO_INLINE void linearise_turn_about(int free, const JointFrames<S>& f, const Mat3<Unit<S>>& a, Step<S> h,
                                     JointConstraint<S>& joint) {
  const int i = (free + 1) % 3, j = (free + 2) % 3;
  const Vec3<Unit<S>> tilt = transposed_times(a, to_matrix(f.b).column(free));
  JointBlock<S>& block = joint.blocks[1];
  block.rows[i] = angular_row<S>(a.column(i), joint.radius);
  block.rows[j] = angular_row<S>(a.column(j), joint.radius);
  block.error[i] = bounded_error(-(joint.radius * tilt[j]), h);
  block.error[j] = bounded_error(joint.radius * part_across(tilt[i], tilt[free]), h);
  JointDrive<S>* const drive = drive_of(joint, static_cast<std::uint32_t>(free));
  if (drive == nullptr) return;
  drive->row = angular_row<S>(a.column(free), drive->radius);
  set_angle(*drive, *drive->asked, angle_of(static_cast<JointAxis>(3 + free), joint.properties.flags, -1, f));
}

/// Locks one swing: b's z axis stays in a plane of a.
/// Symbols: d(z_b . y_a)/dt = (w_b - w_a) . (z_b x y_a), and the same for x.
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

template <class S> ISO_INLINE bool is_limited(const JointDrive<S>& drive) { return is_limited(drive.asked); }
template <class S> ISO_INLINE const AxisDrive<S>* asked_of(const JointDrive<S>* drive) {
  return drive == nullptr ? nullptr : drive->asked;
}
/// Returns true if the limits of both swings form an ellipse.
template <class S> ISO_INLINE bool makes_cone(std::uint32_t flags, const JointDrive<S>* x, const JointDrive<S>* y) {
  return (flags & joint_flag::kCone) != 0 && x != nullptr && y != nullptr && is_limited(*x) && is_limited(*y);
}
/// Sets the drives of both swings, each about its axis.
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

/// [1] The part of the ellipse beyond which rows turn with the swing's direction. Nearer its middle no limit is near.
template <class S> inline constexpr S kConeBasis = S(0.5);

/// [rad] Returns the angle of a swing's spring off its target, and [rad/s] the speed of its motor; 0 without them,
/// since rows that turn with the swing mix both.
template <class S> ISO_INLINE S off_target(const JointDrive<S>* swing, S angle) {
  if (swing == nullptr || swing->asked == nullptr || !(S(0) < swing->asked->spring_frequency)) return S(0);
  return angle - swing->asked->spring_target;
}
template <class S> ISO_INLINE S asked_speed(const JointDrive<S>* swing) {
  return swing != nullptr && swing->asked != nullptr && swing->asked->motor ? swing->asked->motor_speed : S(0);
}

/// Sets the rows of swings along one axis, in a, and across it. `x` is the drive along it if both exist. Sets no
/// limits.
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
/// Stops such a drive at `most`, with its position at `angle` along its axis. Its spring stays as far from its target.
template <class S> ISO_INLINE void stop_along(JointDrive<S>& drive, S angle, S most) {
  drive.position = angle * drive.radius;
  drive.target = drive.position + drive.target;
  drive.upper = most * drive.radius;
  drive.bounded_above = true;
}

/// Stops such a drive where a held twist ends. The stop does not yield.
template <class S> ISO_INLINE void stop_hard(JointDrive<S>& drive, S angle) {
  stop_along(drive, angle, kTwistEnds<S>);
  if (!drive.soft) return;
  drive.soft = drive.yields = false;
  set_spring(*drive.spring_asked, drive);
}

/// Keeps both swings within an ellipse: a row along the swing, on which the limit acts, and one across it.
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

/// Stops a joint with a held twist along its swing, beyond 120 degrees in any direction. The stop does not yield.
template <class S>
ISO_INLINE void end_swing(const SwingTwist<S>& swing, const Mat3<Unit<S>>& a, JointDrive<S>* x, JointDrive<S>* y) {
  const Direction<S> n = direction_of(-swing.d.y, swing.d.x, S(0));
  set_along(swing, a, {n.x, n.y, Unit<S>(0)}, x, y);
  stop_hard(x != nullptr ? *x : *y, atan2(n.length, swing.d.z));
}

/// The row of the swing about x or y near a limit beyond 120 degrees, and the angle left until it.
/// Symbols: the limit L of SwingTwist's angle is a plane that cuts the sphere of d: d . n = sin(L / 2), with n =
///          (cos(L / 2), -sin(L / 2)) along e and z. So it holds as asin(d . n), whose rate is w . (d x n) / |d x n|:
///          however near the z axes come to opposite directions, a row is as long as elsewhere.
template <class S> struct SwingLimit {
  Vec3<S> rate;  // [1] in a
  S left;        // [rad] until the limit, negative beyond

  static ISO_INLINE SwingLimit of(const SwingTwist<S>& swing, std::uint32_t place, S limit, bool above) {
    const S half = limit * S(0.5);
    const auto of_half = sin_cos(half);
    const S sine = of_half.sin, cosine = of_half.cos;
    Vec3<S> n = {S(0), S(0), -sine};
    if (place == 1) n.x = cosine;
    else n.y = -cosine;
    const Vec3<S> turned = cross(swing.d, n);
    const Direction<S> along = direction_of(turned.x, turned.y, turned.z);
    const S beyond = atan2(dot(swing.d, n), along.length) - half;
    return {convert<S>(Vec3<Unit<S>>{along.x, along.y, along.z}), above ? -beyond : beyond};
  }
};
/// Sets the nearer limit of a swing beyond 120 degrees. Returns the angle left until it [rad].
template <class S> ISO_INLINE S set_limit(const SwingTwist<S>& swing, const Mat3<Unit<S>>& a, JointDrive<S>& drive) {
  const SwingLimit<S> low = SwingLimit<S>::of(swing, drive.place, drive.asked->lower, false);
  const SwingLimit<S> high = SwingLimit<S>::of(swing, drive.place, drive.asked->upper, true);
  const bool above = high.left < low.left;
  set_angle(drive, *drive.asked, drive.place == 1 ? swing.angle_about_y() : swing.angle_about_x(), false);
  drive.row = turning_row<S>(a * (above ? high.rate : low.rate), drive.radius);
  drive.bounded_above = above;
  drive.bounded_below = !above;
  drive.upper = drive.position + high.left * drive.radius;
  drive.lower = drive.position - low.left * drive.radius;
  return above ? high.left : low.left;
}
/// Sets swings beyond 120 degrees without a cone, at least one of them with limits. The stop of end_swing() acts on the
/// row that needs it most.
template <class S>
ISO_INLINE void limit_swings(const SwingTwist<S>& swing, const Mat3<Unit<S>>& a, bool ends, JointDrive<S>* x,
                             JointDrive<S>* y) {
  set_swings(swing, a, x, y);
  const S distant = S(4);  // [rad] more than any limit leaves
  S left_x = distant, left_y = distant;
  if (x != nullptr && is_limited(*x)) left_x = set_limit(swing, a, *x);
  if (y != nullptr && is_limited(*y)) left_y = set_limit(swing, a, *y);
  if (!ends) return;
  const Direction<S> n = direction_of(-swing.d.y, swing.d.x, S(0));
  const S angle = atan2(n.length, swing.d.z);
  if (!(kTwistEnds<S> - angle < max(left_x, left_y))) return;
  const bool on_x = left_y <= left_x;
  set_along(swing, a, {n.x, n.y, Unit<S>(0)}, on_x ? x : nullptr, on_x ? nullptr : y);
  stop_hard(on_x ? *x : *y, angle);
}

/// Sets the swing that tilts and the one that turns: see tilting_swing(). `ends`: the twist is held.
template <class S>
ISO_INLINE void set_tilt_and_turn(const TiltTurn<S>& now, int tilting, bool ends, const Mat3<Unit<S>>& a,
                                  JointConstraint<S>& joint) {
  JointDrive<S>* const tilt = drive_of(joint, static_cast<std::uint32_t>(tilting));
  JointDrive<S>* const turn = drive_of(joint, static_cast<std::uint32_t>(1 - tilting));
  const auto set = [&](JointDrive<S>* drive, Vec3<S> rate, S angle, bool goes_round) ISO_INLINE_LAMBDA {
    if (drive == nullptr) return;
    drive->row = turning_row<S>(a * rate, drive->radius);
    drive->bounded_below = drive->bounded_above = is_limited(*drive);
    drive->position = angle * drive->radius;
    if (drive->asked != nullptr) set_angle(*drive, *drive->asked, angle, goes_round);
  };
  set(tilt, now.tilt_rate, now.tilt, false);
  set(turn, now.turn_rate, now.turn, !ends);
  if (!ends || turn == nullptr) return;
  const S most = kTwistEnds<S> * turn->radius;
  if (turn->soft && most < abs(turn->position)) stop_hard(*turn, abs(now.turn));
  turn->upper = is_limited(*turn) ? min(turn->upper, most) : most;
  turn->lower = is_limited(*turn) ? max(turn->lower, -most) : -most;
  turn->bounded_below = turn->bounded_above = true;
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
  const bool cone = makes_cone(joint.properties.flags, x, y), ends = holds_twist(joint);
  const int tilting = tilting_swing(joint.properties.flags, asked_of(x), asked_of(y));
  if (tilting >= 0) return set_tilt_and_turn(TiltTurn<S>::of(tilting, swing.d), tilting, ends, a, joint);
  const bool limited = is_limited(asked_of(x)) || is_limited(asked_of(y));
  if (!swing.is_clear && limited && !cone) return limit_swings(swing, a, ends, x, y);
  if (!swing.is_clear && ends) return end_swing(swing, a, x, y);
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
