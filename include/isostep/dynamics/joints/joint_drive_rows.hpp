// Drives as rows of their joint: which row a piece of the law is, how strong its spring, what it asks for.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/joints/joint_couplings.hpp"

namespace isostep::detail {

template <class S> ISO_INLINE JointRow<S> scaled_row(const JointRow<S>& row, Unit<S> s) {
  return {row.linear * s, row.angular_a * s, row.angular_b * s, row.turn_a * s, row.turn_b * s};
}
/// Places the drives' rows: for a fixed speed the row itself, for a spring a weaker one that yields, else none.
template <class S> ISO_INLINE void place_drives(JointConstraint<S>& joint) {
  for (std::uint32_t i = 0; i < joint.drive_count; ++i) {
    const JointDrive<S>& drive = joint.drives[i];
    JointBlock<S>& block = joint.blocks[drive.block];
    const int at = static_cast<int>(drive.place);
    const bool fixed = fixes_speed(drive.piece), yields = springs(drive, drive.piece);
    block.rows[at] = fixed ? drive.row : yields ? scaled_row(drive.row, drive.spring_row.y) : JointRow<S>::zero();
    const S share = convert<S>(drive.spring_row.x);
    block.give[at] = yields ? share * share : S(0);
  }
}

/// Computes the strength of a spring that has its frequency with the effective mass e that it is made for. It stays for
/// the step, but for one at a soft limit.
/// Symbols: a1 = 2 damping + angle, w^2 = angle a1 e, with angle = 2 pi frequency h. Roots are taken apart: for a weak
///          spring their product keeps digits that w^2 loses.
template <class S> ISO_INLINE void weigh_spring(JointDrive<S>& drive, S angle, S rate) {
  const S a1 = S(2) * drive.damping + angle;
  drive.spring_root = sqrt(angle) * sqrt(a1);
  drive.spring_rate = a1 > S(0) ? rate * (angle / a1) : S(0);
  drive.spring = drive.spring_inverse > S(0) ? drive.spring_root / sqrt(drive.spring_inverse) : S(0);
  if (drive.spring < S(8) * resolution<S>()) drive.spring = S(0);
  drive.spring_row = direction_of(S(1), drive.spring, S(0));
}
/// Computes what the spring asks for where it is now.
template <class S> ISO_INLINE void set_spring_push(JointDrive<S>& drive) {
  using V = Velocity<S>;
  const V error = saturating_subtract(spring_way(drive), drive.spring_came);
  drive.spring_speed = saturated<S>(product(drive.spring_rate, error));
  drive.spring_push = drive.spring < S(1) ? saturated<S>(product(drive.spring * drive.spring_rate, error))
                                          : saturated<S>(product(drive.spring, drive.spring_speed));
}

/// [m/s] Returns the most impulse of a motor or servo in a sub-step.
template <class S> ISO_INLINE Velocity<S> most_impulse(const JointDrive<S>& drive, Step<S> h) {
  return convert<Velocity<S>>(min(drive.force * h, drive.most));
}
template <class S>
ISO_INLINE DriveBounds<S> bounds_of(const JointDrive<S>& drive, const JointStep<S>& step, bool relax) {
  return bounds_of(drive, step.rate, step.h, relax ? S(0) : step.softness.bias_rate);
}

/// Sets the piece to try next, given the speed along the row. Returns true if it is another one. Without `may_hold` a
/// drive may only let go of a speed that it holds.
template <class S>
ISO_INLINE bool judge_drive(JointDrive<S>& drive, Velocity<S> speed, const DriveBounds<S>& bounds, Step<S> h,
                            bool may_hold) {
  drive.next = next_piece(drive, speed, bounds, most_impulse(drive, h));
  const bool lets_go = fixes_speed(drive.piece) && !fixes_speed(drive.next);
  if (!may_hold && !lets_go) drive.next = drive.piece;
  return drive.next != drive.piece;
}

/// Returns the right side of a drive's row. `speed` is that of the row as it is in its block.
template <class S>
ISO_INLINE Velocity<S> drive_right_side(const JointDrive<S>& drive, Velocity<S> speed, const DriveBounds<S>& bounds,
                                        Velocity<S> most) {
  using V = Velocity<S>;
  if (fixes_speed(drive.piece)) return saturating_subtract(fixed_speed(drive, drive.piece, bounds), speed);
  if (!springs(drive, drive.piece)) return V(0);
  const S share = convert<S>(drive.spring_row.x);
  const V pushed = drive.impulse - motor_impulse(drive.piece, most);
  return -(speed + scaled(share, drive.spring_push) + saturated<S>(product(share / drive.spring, pushed)));
}

}  // namespace isostep::detail
