// Bodies of contact_prepare.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/solvers/contact_prepare.hpp"

namespace isostep {

template <class S> MixedMaterial<S> mix(const Material<S>& a, const Material<S>& b) {
  const S friction = a.friction == b.friction ? a.friction : sqrt(a.friction * b.friction);
  return {friction, max(a.restitution, b.restitution), max(a.rolling_resistance, b.rolling_resistance),
          b.surface_velocity - a.surface_velocity};
}

namespace detail {

/// How a row of Jacobian (linear part `share` apart) meets the two bodies.
template <class S> struct RowMaker {
  const SolverMass<S>& mass_a;
  const SolverMass<S>& mass_b;
  MassShare<S> share;

  /// Angular parts of a row whose speed is jacobian_b . spin_b - jacobian_a . spin_a; returns 1 / (linear + angular).
  ISO_INLINE void angular(Vec3<S> jacobian_a, Vec3<S> jacobian_b, S linear, AngularRow<S, 1>& row) const {
    const Vec3<S> spin_a = (mass_a.kappa * jacobian_a) * share.a;
    const Vec3<S> spin_b = (mass_b.kappa * jacobian_b) * share.b;
    const S k = linear + round_to<S>(dot_sum(jacobian_a, spin_a) + dot_sum(jacobian_b, spin_b));
    for (int i = 0; i < 3; ++i) {
      row.jacobian_a[i][0] = jacobian_a[i];
      row.jacobian_b[i][0] = jacobian_b[i];
      row.spin_a[i][0] = spin_a[i];
      row.spin_b[i][0] = spin_b[i];
    }
    // Rows that push have k >= 1. A turning row with less than an eighth has hardly a lever: it resists nothing.
    row.effective_mass[0] = k > S(0.125) ? S(1) / k : S(0);
    row.impulse[0] = Velocity<S>(0);
  }
  ISO_INLINE void pushing(Vec3<S> direction, Vec3<S> arm_a, Vec3<S> arm_b, AngularRow<S, 1>& row) const {
    angular(cross(arm_a, direction), cross(arm_b, direction), share.a + share.b, row);
  }
};

/// v_b - v_a at the ends of two arms [m/s].
template <class S>
ISO_INLINE Vec3<Velocity<S>> relative_velocity(const MotionRow<Velocity<S>>& a, Vec3<S> arm_a,
                                               const MotionRow<Velocity<S>>& b, Vec3<S> arm_b) {
  using V = Velocity<S>;
  const auto part = [&](int i, int j) {
    return round_to<V>(product(b.angular[i], arm_b[j]) - product(b.angular[j], arm_b[i]) -
                       product(a.angular[i], arm_a[j]) + product(a.angular[j], arm_a[i]));
  };
  return b.linear - a.linear + Vec3<V>{part(1, 2), part(2, 0), part(0, 1)};
}

/// A vector less its part along the normal.
template <class V, class U> ISO_INLINE Vec3<V> flatten(Vec3<V> x, Vec3<U> n) {
  const V along = round_to<V>(dot_sum(x, n));
  return {x.x - round_to<V>(product(along, n.x)), x.y - round_to<V>(product(along, n.y)),
          x.z - round_to<V>(product(along, n.z))};
}
/// Two tangents, the first along a flat vector.
template <class V, class U> ISO_INLINE Tangents<U> basis_along(Vec3<V> lead, Vec3<U> n) {
  const Direction<V> t = direction_of(lead.x, lead.y, lead.z);
  const Vec3<U> first = {t.x, t.y, t.z};
  return {first, cross(n, first)};
}

/// The friction basis. Sliding: along the slip, for that is what friction opposes. Else along the friction that the
/// contact bears already; where there is neither, any. The kernel's cone is exact along the basis.
template <class S>
ISO_INLINE Tangents<Unit<S>> friction_basis(Vec3<Unit<S>> n, Vec3<Velocity<S>> borne, Velocity<S> limit,
                                            Vec3<Velocity<S>> slip) {
  using V = Velocity<S>;
  const Vec3<V> slide = flatten(slip, n);
  if (max_abs(slide) > V(0.05)) return basis_along(slide, n);  // [m/s] slower is the trembling of what sticks
  const Vec3<V> force = flatten(borne, n);
  return V(8) * max_abs(force) > limit ? basis_along(force, n) : tangents_of(n);  // below an eighth: noise
}

/// Mean arm of the contact's points.
template <class S> ISO_INLINE Vec3<S> mean_arm(const ContactGeometry<S>& g, std::uint32_t count, bool of_b) {
  constexpr S kShares[kMaxContactPoints] = {S(1), S(0.5), S(1.0 / 3), S(0.25)};
  Vec3<S> sum = Vec3<S>::zero();
  for (std::uint32_t i = 0; i < count; ++i) sum += of_b ? g.points[i].arm_b : g.points[i].arm_a;
  return sum * kShares[count - 1];
}

}  // namespace detail

template <class S>
void prepare_contact(const Contact<S>& contact, const ContactGeometry<S>& g, const SolverBodies<S>& bodies,
                     ContactBlock<S, 1, kMaxContactPoints>& block) {
  using V = Velocity<S>;
  const MotionRow<V>& motion_a = bodies.velocity[g.row_a];
  const MotionRow<V>& motion_b = bodies.velocity[g.row_b];
  const SolverMass<S>& mass_a = bodies.mass[g.row_a];
  const SolverMass<S>& mass_b = bodies.mass[g.row_b];
  const detail::RowMaker<S> make = {mass_a, mass_b, mass_share(mass_a.mass, mass_b.mass)};
  const Vec3<S> n = convert<S>(g.normal);
  for (int i = 0; i < 3; ++i) block.normal[i][0] = n[i];
  block.share_a[0] = make.share.a;
  block.share_b[0] = make.share.b;
  block.friction[0] = g.material.friction;
  block.restitution[0] = g.material.restitution;

  V total = V(0);
  for (std::uint32_t p = 0; p < contact.count; ++p) {
    NormalRow<S, 1>& normal = block.normals[p];
    const auto& point = g.points[p];
    make.pushing(n, point.arm_a, point.arm_b, normal.row);
    normal.row.impulse[0] = contact.normal_impulse[p];
    normal.separation[0] = convert<V>(point.separation);
    normal.approach[0] =
        round_to<V>(dot_sum(detail::relative_velocity<S>(motion_a, point.arm_a, motion_b, point.arm_b), g.normal));
    normal.total_impulse[0] = -contact.normal_impulse[p];  // the first warm start is the last step's
    total += contact.normal_impulse[p];
  }

  const Vec3<S> arm_a = detail::mean_arm(g, contact.count, false);
  const Vec3<S> arm_b = detail::mean_arm(g, contact.count, true);
  const Vec3<V> slip =
      detail::relative_velocity<S>(motion_a, arm_a, motion_b, arm_b) + convert<V>(g.material.surface_velocity);
  const V limit = round_to<V>(product(g.material.friction, total));
  const Tangents<Unit<S>> basis = detail::friction_basis<S>(g.normal, contact.friction_impulse, limit, slip);
  const Vec3<Unit<S>> directions[2] = {basis.t, basis.u};
  for (int k = 0; k < 2; ++k) {
    FrictionRow<S, 1>& tangent = block.tangents[k];
    const Vec3<S> t = convert<S>(directions[k]);
    make.pushing(t, arm_a, arm_b, tangent.row);
    for (int i = 0; i < 3; ++i) tangent.direction[i][0] = t[i];
    tangent.row.impulse[0] = round_to<V>(dot_sum(contact.friction_impulse, directions[k]));
    tangent.surface[0] = round_to<V>(dot_sum(convert<V>(g.material.surface_velocity), directions[k]));
  }

  S radius = S(0);
  if (contact.count > 1) {
    // A square patch under even pressure resists twisting as if all friction acted at 0.541 of its half diagonal.
    constexpr S kShares[kMaxContactPoints] = {S(1), S(0.5), S(1.0 / 3), S(0.25)};
    auto sum = SumOf<S, S>{};
    for (std::uint32_t p = 0; p < contact.count; ++p) {
      const Vec3<S> half = (g.points[p].arm_b - arm_b) * S(0.5);  // so that the largest patch's square fits
      sum = sum + dot_sum(half * kShares[contact.count - 1], half);
    }
    radius = S(2 * 0.541) * sqrt(round_to<S>(sum));
  }
  make.angular(n * radius, n * radius, S(0), block.twist);
  block.twist.impulse[0] = contact.count > 1 ? contact.twist_impulse : V(0);
}

template <class S>
void prepare_rolling(const ContactGeometry<S>& g, const SolverBodies<S>& bodies,
                     const ContactBlock<S, 1, kMaxContactPoints>& block, RollingRows<S, 1>& rolling) {
  const detail::RowMaker<S> make = {bodies.mass[g.row_a], bodies.mass[g.row_b], {block.share_a[0], block.share_b[0]}};
  // The rows' radius is the distance from the contact to the centre that rolls: it keeps the coefficients near one.
  const S radius_a = bodies.moves(g.row_a) ? abs(dot(g.points[0].arm_a, g.normal)) : S(0);
  const S radius_b = bodies.moves(g.row_b) ? abs(dot(g.points[0].arm_b, g.normal)) : S(0);
  const S radius = max(radius_a, radius_b);
  // Along the rolling itself, so that the two rows' separate limits resist it as one.
  using V = Velocity<S>;
  const Vec3<V> spin = detail::flatten(bodies.velocity[g.row_b].angular - bodies.velocity[g.row_a].angular, g.normal);
  const bool rolls = max_abs(spin) > V(0.01);  // [rad/s] slower is rest
  const Tangents<Unit<S>> basis = rolls ? detail::basis_along(spin, g.normal) : tangents_of(g.normal);
  const Vec3<Unit<S>> axes[2] = {basis.t, basis.u};
  for (int k = 0; k < 2; ++k) {
    const Vec3<S> jacobian = convert<S>(axes[k]) * radius;
    make.angular(jacobian, jacobian, S(0), rolling.rows[k]);
  }
  // Beyond the radius itself a body does not roll at all; four times it is no different and fits.
  rolling.lever[0] = radius > S(0) ? min(g.material.rolling_resistance / radius, S(4)) : S(0);
}

}  // namespace isostep
