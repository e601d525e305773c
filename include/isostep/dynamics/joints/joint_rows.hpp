// Rows of joints: Jacobians of two bodies, blocks of three, and the small matrices between them.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/fields.hpp"
#include "isostep/dynamics/solver_body.hpp"
#include "isostep/geometry/limits.hpp"
#include "isostep/math/softness.hpp"
#include "isostep/scalar/headroom.hpp"

namespace isostep {

/// One row: its speed is linear . (v_b - v_a) + angular_b . w_b - angular_a . w_a  [m/s].
template <class S> struct JointRow {
  Vec3<S> linear;                // [1]
  Vec3<S> angular_a, angular_b;  // [m]
  Vec3<S> turn_a, turn_b;        // [1/m] kappa angular: angular velocity per impulse, before the mass share

  static ISO_INLINE constexpr JointRow zero() {
    constexpr Vec3<S> kZero = Vec3<S>::zero();
    return {kZero, kZero, kZero, kZero, kZero};
  }
  ISO_FIELDS(linear, angular_a, angular_b, turn_a, turn_b)
};

/// A block of three equalities that are solved together. Unused rows are zero.
template <class S> struct JointBlock {
  bool point;  // rows are the world axes through a point: linear parts are the identity
  bool turns;  // rows have no linear parts: the second block of every joint
  JointRow<S> rows[3];
  Mat3<S> coupling;           // [1] K = J M^-1 J^T per reduced mass
  Mat3<S> inverse;            // [1] of K, and of its Schur complement inside a tree
  Vec3<Velocity<S>> error;    // [m]
  Vec3<Velocity<S>> impulse;  // [m/s] accumulated, of equalities
  Vec3<S> give;               // [1] added to the diagonal: springs yield
  Vec3<Velocity<S>> curve;    // [m/s] what the arms' turning adds to the speed of a point: curve_of()
};

/// Holds the velocities of the two bodies of a joint. Only those of bodies with mass are written back.
template <class S> struct JointMotion { MotionRow<Velocity<S>> a, b; };

/// Returns the speed along a row, within half of the format: a pass with drives on wrong pieces leaves speeds that are
/// far from any right ones.
template <class S> ISO_INLINE Velocity<S> speed_along(const JointRow<S>& row, const JointMotion<S>& m) {
  const Vec3<Velocity<S>> between = saturating_subtract(m.b.linear, m.a.linear);
  return round_with_headroom<Velocity<S>>(dot_sum(row.linear, between) + dot_sum(row.angular_b, m.b.angular) -
                                          dot_sum(row.angular_a, m.a.angular));
}
template <class S> ISO_INLINE Vec3<Velocity<S>> speed_along(const JointBlock<S>& block, const JointMotion<S>& m) {
  if (block.point) {
    using V = Velocity<S>;
    // w x r of b less that of a; the arms stand in the rows: angular of x is (0, r.z, -r.y), of y (-r.z, 0, r.x).
    const Vec3<S> xa = block.rows[0].angular_a, xb = block.rows[0].angular_b;
    const S za = block.rows[1].angular_a.z, zb = block.rows[1].angular_b.z;
    const Vec3<V> wa = m.a.angular, wb = m.b.angular;
    const Vec3<V> turning = {
        round_with_headroom<V>(product(xb.y, wb.y) + product(xb.z, wb.z) - product(xa.y, wa.y) - product(xa.z, wa.z)),
        round_with_headroom<V>(product(zb, wb.z) - product(xb.y, wb.x) - product(za, wa.z) + product(xa.y, wa.x)),
        round_with_headroom<V>(product(za, wa.y) + product(xa.z, wa.x) - product(zb, wb.y) - product(xb.z, wb.x))};
    return with_headroom(with_headroom(saturating_subtract(m.b.linear, m.a.linear)) + turning) + block.curve;
  }
  return {speed_along(block.rows[0], m), speed_along(block.rows[1], m), speed_along(block.rows[2], m)};
}

/// Returns v s at the precision of velocities.
template <class S, class V> ISO_INLINE Vec3<V> scaled(Vec3<S> v, V s) {
  return {round_to<V>(product(v.x, s)), round_to<V>(product(v.y, s)), round_to<V>(product(v.z, s))};
}
template <class S, class V> ISO_INLINE V scaled(S a, V s) { return round_to<V>(product(a, s)); }
/// Rounds a sum to a velocity within the speed limit: the impulse of an overloaded joint must not wrap.
template <class S, class Sum> ISO_INLINE Velocity<S> saturated(Sum sum) {
  return round_within<Velocity<S>>(sum, convert<Velocity<S>>(Limits<S>::speed()));
}
/// [m/s] Returns the largest impulse of a joint: four times the speed limit, an eighth of what Velocity<Q16_16> holds.
/// Chains of stops hold themselves out straight like a beam, whose first joint bears all the others.
template <class S> ISO_INLINE constexpr Velocity<S> most_joint_impulse() {
  return convert<Velocity<S>>(Limits<S>::speed()) * Velocity<S>(4);
}
/// Returns m v as impulses of a joint.
template <class S, class V> ISO_INLINE Vec3<V> impulses(const Mat3<S>& m, Vec3<V> v) {
  const auto held = [](auto sum) ISO_INLINE_LAMBDA { return round_within<V>(sum, most_joint_impulse<S>()); };
  return {held(dot_sum(m.rows[0], v)), held(dot_sum(m.rows[1], v)), held(dot_sum(m.rows[2], v))};
}
/// Returns right - m v, the rest of a right-hand side after impulses. Large impulses on long arms do not wrap.
template <class S, class V> ISO_INLINE Vec3<V> less_moved(Vec3<V> right, const Mat3<S>& m, Vec3<V> v) {
  return {with_headroom(right.x - round_with_headroom<V>(dot_sum(m.rows[0], v))),
          with_headroom(right.y - round_with_headroom<V>(dot_sum(m.rows[1], v))),
          with_headroom(right.z - round_with_headroom<V>(dot_sum(m.rows[2], v)))};
}
/// Returns old + change within the speed limit.
template <class S> ISO_INLINE Vec3<Velocity<S>> saturated_sum(Vec3<Velocity<S>> old, Vec3<Velocity<S>> change) {
  return held_within(old + change, convert<Velocity<S>>(Limits<S>::speed()));
}

template <class S>
ISO_INLINE void push(const JointRow<S>& row, MassShare<S> share, Velocity<S> impulse, JointMotion<S>& m) {
  const Velocity<S> to_a = scaled(share.a, impulse), to_b = scaled(share.b, impulse);
  m.a.linear -= scaled(row.linear, to_a);
  m.a.angular -= scaled(row.turn_a, to_a);
  m.b.linear += scaled(row.linear, to_b);
  m.b.angular += scaled(row.turn_b, to_b);
}
template <class S> ISO_INLINE Mat3<S> scaled_by(const Mat3<S>& m, S s) {
  return {{m.rows[0] * s, m.rows[1] * s, m.rows[2] * s}};
}
template <class S> ISO_INLINE void subtract(Mat3<S>& m, const Mat3<S>& p) {
  for (int i = 0; i < 3; ++i) m.rows[i] -= p.rows[i];
}

/// Returns the sum of rows times impulses, with one rounding a component.
template <class S, class V> ISO_INLINE Vec3<V> combine(Vec3<S> r0, Vec3<S> r1, Vec3<S> r2, Vec3<V> x) {
  return {round_to<V>(product(r0.x, x.x) + product(r1.x, x.y) + product(r2.x, x.z)),
          round_to<V>(product(r0.y, x.x) + product(r1.y, x.y) + product(r2.y, x.z)),
          round_to<V>(product(r0.z, x.x) + product(r1.z, x.y) + product(r2.z, x.z))};
}
template <class S>
ISO_INLINE void push(const JointBlock<S>& block, MassShare<S> share, Vec3<Velocity<S>> impulse, JointMotion<S>& m) {
  const auto& r = block.rows;
  const Vec3<Velocity<S>> to_a = {scaled(share.a, impulse.x), scaled(share.a, impulse.y), scaled(share.a, impulse.z)};
  const Vec3<Velocity<S>> to_b = {scaled(share.b, impulse.x), scaled(share.b, impulse.y), scaled(share.b, impulse.z)};
  m.a.linear -= block.point ? to_a : combine(r[0].linear, r[1].linear, r[2].linear, to_a);
  m.a.angular -= combine(r[0].turn_a, r[1].turn_a, r[2].turn_a, to_a);
  m.b.linear += block.point ? to_b : combine(r[0].linear, r[1].linear, r[2].linear, to_b);
  m.b.angular += combine(r[0].turn_b, r[1].turn_b, r[2].turn_b, to_b);
}

template <class S> ISO_INLINE JointMotion<S> gather(const SolverBodies<S>& bodies, std::uint32_t a, std::uint32_t b) {
  return {bodies.velocity[a], bodies.velocity[b]};
}
template <class S>
ISO_INLINE void scatter(SolverBodies<S>& bodies, std::uint32_t a, std::uint32_t b, const JointMotion<S>& m) {
  if (bodies.moves(a)) bodies.velocity[a] = m.a;
  if (bodies.moves(b)) bodies.velocity[b] = m.b;
}

namespace detail {
/// [m/s] The most speed with which a joint's error is closed.
template <class S> inline constexpr Velocity<S> kJointPushSpeed = Velocity<S>(4);
/// [1] The compliance on K's diagonal. It keeps a block solvable in directions in which its bodies cannot move.
template <class S> inline constexpr S kBlockCompliance = S(0x1p-20) + S(16) * resolution<S>();
/// [1] The least value that a format resolves to ten bits: 2^-6 for Q16.16, 2^-22 for Q32.32, 2^-13 for float.
template <class S> inline constexpr S kLeastCompliance = S(1024) * resolution<S>();
/// [1] The softest entry that a tree may hold: 2^-7 for Q16.16, 2^-23 for Q32.32, 2^-14 for float. Rounding is a
/// sixty-fourth of it: residuals are measured anew in every pass. Random trees of Q16.16 that hold 2^-9 fly apart.
template <class S> inline constexpr S kTreeCompliance = S(512) * resolution<S>();
/// [1] The compliance of the end that closes a loop through the world: a bridge of hinges holds its width twice.
template <class S> inline constexpr S kClosingCompliance = S(1.0 / 64);
/// [1] (angular frequency h)^2 above which tension is taken implicitly: half of what an explicit step can follow.
template <class S> inline constexpr S kTautLimit = S(2);
}  // namespace detail

/// Returns [r]x^T kappa [r]x between two blocks of points at one body: the angular part of their coupling.
template <class S> ISO_INLINE Mat3<S> point_coupling(const Vec3<S> (&angular)[3], const Vec3<S> (&turn)[3]) {
  Mat3<S> k;
  for (int j = 0; j < 3; ++j) {
    const Vec3<S> t = turn[j];
    k.rows[0][j] = round_to<S>(product(angular[0].y, t.y) + product(angular[0].z, t.z));
    k.rows[1][j] = round_to<S>(product(angular[1].x, t.x) + product(angular[1].z, t.z));
    k.rows[2][j] = round_to<S>(product(angular[2].x, t.x) + product(angular[2].y, t.y));
  }
  return k;
}

/// Returns linear . linear + angular . kappa angular for one body's halves of two rows.
template <class S> ISO_INLINE S coupling(Vec3<S> linear_i, Vec3<S> angular_i, Vec3<S> linear_j, Vec3<S> turn_j) {
  return round_to<S>(dot_sum(linear_i, linear_j) + dot_sum(angular_i, turn_j));
}

}  // namespace isostep
