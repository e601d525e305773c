// Rows that are pushed one or two at a time: impulses along them, and what brings a pair of them to rest.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/core/fields.hpp"
#include "isostep/dynamics/contact.hpp"
#include "isostep/dynamics/friction_ellipse.hpp"
#include "isostep/dynamics/joints/joint_rows.hpp"
#include "isostep/dynamics/solver_body.hpp"
#include "isostep/dynamics/solvers/step_context.hpp"

namespace isostep {

/// Two rows that are solved at once: friction, rolling resistance, or one row about the normal. Turns hold mass shares.
template <class S> struct TangentPair {
  JointRow<S> rows[2];
  S xx, xy, yy;                // [1] inverse of their coupling: what brings both to rest
  S sliding;                   // [1] inverse of a bound of its largest eigenvalue
  Unit<S> ratio = Unit<S>(1);  // [1] of the limits of the two: below one the disc is an ellipse
  Velocity<S> surface[2];      // [m/s] speed of b's surface against a's along the rows
  Velocity<S> impulse[2];      // [m/s] accumulated

  ISO_FIELDS(rows, xx, xy, yy, sliding, ratio, surface, impulse)
};

namespace detail {

template <class S> using Motion = MotionRow<Velocity<S>>;

/// Bounds of velocities within a pass: eight times the published ones, such that sums of two fit the format.
template <class S> ISO_INLINE constexpr Velocity<S> passing_velocity() {
  return convert<Velocity<S>>(Limits<S>::speed()) * Velocity<S>(8);
}
template <class S> ISO_INLINE constexpr Velocity<S> passing_angular_speed() {
  return convert<Velocity<S>>(Limits<S>::angular_speed()) * Velocity<S>(8);
}

template <class V> ISO_INLINE constexpr Vec3<V> held(Vec3<V> v, V most) {
  return {clamp(v.x, -most, most), clamp(v.y, -most, most), clamp(v.z, -most, most)};
}

/// Returns the speed or displacement of b against a along a row, saturated to the format.
template <class S> ISO_INLINE Velocity<S> along(const JointRow<S>& row, const Motion<S>& a, const Motion<S>& b) {
  return saturate_to<Velocity<S>>(dot_sum(row.linear, b.linear - a.linear) + dot_sum(row.angular_b, b.angular) -
                                  dot_sum(row.angular_a, a.angular));
}

/// Returns a velocity plus `change` times v, held within +-most.
template <class S>
ISO_INLINE Vec3<Velocity<S>> pushed(Vec3<Velocity<S>> old, Vec3<S> v, Velocity<S> change, Velocity<S> most) {
  using V = Velocity<S>;
  const auto sum = [&](V x, S k) ISO_INLINE_LAMBDA {
    return clamp(saturating_add(x, saturate_to<V>(product(k, change))), -most, most);
  };
  return {sum(old.x, v.x), sum(old.y, v.y), sum(old.z, v.z)};
}
/// Applies an impulse along a row.
template <class S>
ISO_INLINE void push(const JointRow<S>& row, MassShare<S> share, Velocity<S> impulse, Motion<S>& a, Motion<S>& b) {
  using V = Velocity<S>;
  const V most = passing_velocity<S>(), most_angular_speed = passing_angular_speed<S>();
  if (share.a > S(0)) {
    a.linear = pushed(a.linear, row.linear, -saturate_to<V>(product(share.a, impulse)), most);
    a.angular = pushed(a.angular, row.turn_a, -impulse, most_angular_speed);
  }
  if (share.b > S(0)) {
    b.linear = pushed(b.linear, row.linear, saturate_to<V>(product(share.b, impulse)), most);
    b.angular = pushed(b.angular, row.turn_b, impulse, most_angular_speed);
  }
}

/// Returns a row of two bodies' angular velocities, whose turns include the shares.
template <class S>
ISO_INLINE JointRow<S> weighed_row(Vec3<S> linear, Vec3<S> angular_a, Vec3<S> angular_b, const SolverMass<S>& a,
                                   const SolverMass<S>& b, MassShare<S> share) {
  return {linear, angular_a, angular_b, (a.kappa * angular_a) * share.a, (b.kappa * angular_b) * share.b};
}
/// Returns the change of speed along row i by an impulse along row j. `linear` is the part of the linear rows.
template <class S> ISO_INLINE S coupling_of(const JointRow<S>& i, const JointRow<S>& j, S linear) {
  return linear + round_to<S>(dot_sum(i.angular_a, j.turn_a) + dot_sum(i.angular_b, j.turn_b));
}
/// Returns a row's effective mass. Rows that push have a coupling of at least one. A turning row with less than an
/// eighth has hardly a lever: it resists nothing.
template <class S> ISO_INLINE S mass_of(S coupling) {
  return S(0.125) < coupling ? divide_to<S>(S(1), coupling) : S(0);
}
/// Inverts a pair's coupling by LDL^T, as invert_symmetric() does: a determinant need not fit.
template <class S> ISO_INLINE void invert_pair(TangentPair<S>& pair, S linear) {
  const S k0 = coupling_of(pair.rows[0], pair.rows[0], linear), k1 = coupling_of(pair.rows[1], pair.rows[1], linear);
  const S c = coupling_of(pair.rows[0], pair.rows[1], S(0));
  const S i0 = mass_of(k0);
  const S l = c * i0;
  pair.yy = mass_of(k1 - l * c);
  pair.xy = -(l * pair.yy);
  pair.xx = i0 - l * pair.xy;
  pair.sliding = mass_of(max(k0, k1) + abs(c));
}

template <class V> struct PairChange { V x, y; };

/// Returns the change that brings a pair to rest. If that would leave a disc of radius `limit`, returns the one towards
/// the point of its rim that opposes the slip; of an ellipse, towards the one that takes most power from it. There the
/// step must be equal along both rows: the inverse coupling leads elsewhere, as a point off the centre is lighter
/// across than along its arm.
template <class S>
ISO_INLINE PairChange<Velocity<S>> resting_change(const TangentPair<S>& pair, Velocity<S> limit, const Motion<S>& a,
                                                  const Motion<S>& b) {
  using V = Velocity<S>;
  const V u = saturating_add(along(pair.rows[0], a, b), pair.surface[0]);
  const V v = saturating_add(along(pair.rows[1], a, b), pair.surface[1]);
  const V old_x = pair.impulse[0], old_y = pair.impulse[1];
  const V most = passing_velocity<S>();  // so that the lengths below fit
  const auto less = [&](V old, auto change) ISO_INLINE_LAMBDA {
    return clamp(saturating_subtract(old, saturate_to<V>(change)), -most, most);
  };
  const V x = less(old_x, product(pair.xx, u) + product(pair.xy, v));
  const V y = less(old_y, product(pair.xy, u) + product(pair.yy, v));
  V to_x = less(old_x, product(pair.sliding, u)), to_y = less(old_y, product(pair.sliding, v));
  if (pair.ratio < Unit<S>(1)) {
    V rest_x = x, rest_y = y;
    if (!hold_impulse_in_ellipse<S>(pair.ratio, limit, rest_x, rest_y)) return {x - old_x, y - old_y};
    hold_impulse_in_ellipse<S>(pair.ratio, limit, to_x, to_y);
    return {to_x - old_x, to_y - old_y};
  }
  if (!(limit < abs(x) + abs(y))) return {x - old_x, y - old_y};
  if (!(limit < direction_of(x, y, V(0)).length)) return {x - old_x, y - old_y};
  const Direction<V> way = direction_of(to_x, to_y, V(0));
  if (!(limit < way.length)) return {to_x - old_x, to_y - old_y};
  return {way.x * limit - old_x, way.y * limit - old_y};
}

}  // namespace detail
}  // namespace isostep
