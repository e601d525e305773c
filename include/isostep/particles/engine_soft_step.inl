// ParticleEngine: the default solver. Constraints act over sub-steps as damped springs on velocities, then once more
// without push (Catto 2024, Solver2D: Soft Step); the rigid world's method for what does not turn.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/particles/engine_integrate.inl"

namespace isostep {

namespace detail {
/// [rad] a sub-step and [1] of critical: contacts are springs of an eighth of the sub-step rate, as bodies' are.
template <class S> inline constexpr S kParticleContactAngle = S(0.78539816339744831);
template <class S> inline constexpr S kParticleContactDamping = S(10);
/// Links are springs of a quarter of the sub-step rate: of a half, a chain of fifty gains energy for ever. At rest a
/// link is stretched by 0.4 h^2 of the acceleration that it holds back: 0.07 mm for 10 m/s^2 and four sub-steps.
template <class S> inline constexpr S kLinkAngle = S(1.5707963267948966);
template <class S> inline constexpr S kLinkDamping = S(2);
/// [m/s] at most, with which overlaps are pushed apart.
template <class V> inline constexpr V kParticlePushSpeed = V(4);
}  // namespace detail

/// n.(v_b - v_a) [m/s], below 0 while they close
template <class S> ISO_INLINE Velocity<S> ParticleEngine<S>::separating_speed(const ParticleConstraint<S>& row) const {
  const Vec3<V> b = row.b == kNoParticle ? row.surface_velocity : state_.velocity[row.b];
  return saturate_to<V>(dot_sum(row.normal, b) - dot_sum(row.normal, state_.velocity[row.a]));
}

/// The same before anything held them in this sub-step: what passes on halfway through a sweep is not how fast they
/// came.
template <class S> ISO_INLINE Velocity<S> ParticleEngine<S>::unheld_speed(const ParticleConstraint<S>& row) const {
  const Vec3<V> b = row.b == kNoParticle ? row.surface_velocity : scratch_.before[row.b];
  return saturate_to<V>(dot_sum(row.normal, b) - dot_sum(row.normal, scratch_.before[row.a]));
}

/// A change of relative velocity, to each side its share. Equal masses get exactly opposite halves.
template <class S> ISO_INLINE void ParticleEngine<S>::give(ParticleConstraint<S>& row, Vec3<V> j) {
  const V most = passing_speed<S>();
  const Vec3<V> a = saturating_subtract(state_.velocity[row.a], j * row.share_a);
  state_.velocity.set(row.a, held_within(a, most));
  const Vec3<V> other = row.b == kNoParticle ? row.surface_velocity : state_.velocity[row.b];
  const Vec3<V> b = held_within(saturating_add(other, j * row.share_b), most);
  if (row.b != kNoParticle) return state_.velocity.set(row.b, b);
  row.surface_velocity = b;
  row.total = saturating_add(row.total, j);
}

template <class S> void ParticleEngine<S>::warm_start() {
  for (ParticleConstraint<S>& row : rows_) {
    const bool bounces = S(0) < row.restitution && V(0) < row.impulse;
    const V before = bounces ? separating_speed(row) : V(0);
    const Vec3<V> j = row.normal * row.impulse;
    give(row, saturating_add(j, row.friction_impulse));
    if (bounces) note_work(row, before, separating_speed(row));
  }
}

/// Biased: friction before the normal, for what may not overlap has the last word. Relaxed: the other way round.
template <class S> void ParticleEngine<S>::solve(bool biased) {
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    ParticleConstraint<S>& row = rows_[i];
    const Softness<S>& softness = !biased                               ? rigid_softness_
                                  : row.kind == ConstraintKind::contact ? contact_softness_
                                                                        : link_softness_;
    const bool rubs = S(0) < row.friction;
    if (rubs && biased) solve_friction(row);
    solve_normal(row, softness, biased);
    if (rubs && !biased) solve_friction(row);
  }
}

template <class S>
ISO_INLINE void ParticleEngine<S>::solve_normal(ParticleConstraint<S>& row, const Softness<S>& softness, bool biased) {
  const V speed = separating_speed(row);
  const bool rod = row.kind == ConstraintKind::rod;
  V change;
  if (!rod && S(0) < row.separation) {
    // A gap may be closed within the sub-step and no further.
    change = -saturating_add(speed, saturate_to<V>(product(row.separation, rate_)));
  } else {
    V wanted = speed;
    if (biased) {
      const V push = saturate_to<V>(product(row.separation, softness.bias_rate));
      const V most = detail::kParticlePushSpeed<V>;
      wanted = saturating_add(speed, rod ? clamp(push, -most, most) : max(push, -most));
    }
    change = saturating_subtract(saturating_subtract(V(0), round_to<V>(product(wanted, softness.mass_scale))),
                                 round_to<V>(product(row.impulse, softness.impulse_scale)));
  }
  const V next = saturating_add(row.impulse, change);
  const V total = rod ? next : max(next, V(0));
  const V given = saturating_subtract(total, row.impulse);
  if (row.impulse == V(0) && V(0) < total) row.approach = min(row.approach, unheld_speed(row));
  row.impulse = total;
  if (given == V(0)) return;
  give(row, row.normal * given);
  if (S(0) < row.restitution) note_work(row, speed, saturating_add(speed, given));
}

/// Coulomb: against the slip, within a cone about the normal.
template <class S> ISO_INLINE void ParticleEngine<S>::solve_friction(ParticleConstraint<S>& row) {
  const Vec3<V> b = row.b == kNoParticle ? row.surface_velocity : state_.velocity[row.b];
  const Vec3<V> v = state_.velocity[row.a];
  const Vec3<V> slip = saturating_subtract(saturating_subtract(b, v), row.normal * separating_speed(row));
  const Vec3<V> old = row.friction_impulse;
  // So that it has a length in the format.
  Vec3<V> next = held_within(saturating_subtract(old, slip), passing_speed<S>());
  const V limit = saturate_to<V>(product(row.impulse, row.friction));
  const Direction<V> way = direction_of(next.x, next.y, next.z);
  if (limit < way.length) next = Vec3<U>{way.x, way.y, way.z} * limit;
  row.friction_impulse = next;
  give(row, saturating_subtract(next, old));
}

/// Twice the work of an impulse, of unit reduced mass, up to what two particles bring that come at each other:
/// 2 sqrt(3) times the speed limit, squared. In Q12.20 that and the square of any speed together are within the sum's
/// 2^23.
template <class S> ISO_INLINE void ParticleEngine<S>::note_work(ParticleConstraint<S>& row, V before, V after) {
  const V fastest = convert<V>(ParticleLimits<S>::speed()) * V(3.5);
  const auto most = product(fastest, fastest);
  row.work = clamp(row.work + (product(after, after) - product(before, before)), -most, most);
}
/// As fast as wanted, or as what the row has taken from the motion pays for: between several, or past a corner, one
/// speed may come back along more than one normal. Within 2^-12, from below; rounding alone costs nothing.
template <class S>
ISO_INLINE Velocity<S> ParticleEngine<S>::most_bounce(const ParticleConstraint<S>& row, V speed, V wanted) const {
  const auto paid = product(speed, speed) - row.work;
  const V least = max(wanted - speed_tolerance<S>(wanted), V(0));
  if (product(least, least) <= paid) return wanted;
  V low = V(0), part = wanted * V(0.5);
  for (int i = 0; i < 12; ++i, part = part * V(0.5)) {
    const V next = low + part;
    if (product(next, next) <= paid) low = next;
  }
  return low;
}

/// What came fast goes back as its restitution says, once, after the step.
template <class S> void ParticleEngine<S>::restitute() {
  for (ParticleConstraint<S>& row : rows_) {
    if (!(S(0) < row.restitution) || !(V(0) < row.impulse_seen) || !(row.approach < -kLeastBounce<S>)) continue;
    const V speed = separating_speed(row);
    const V wanted = most_bounce(row, speed, -round_to<V>(product(row.approach, row.restitution)));
    const V change = max(saturating_subtract(wanted, speed), -row.impulse);
    give(row, row.normal * change);
    // What leaves has nothing to begin the next step with: a blow is not a load.
    row.impulse = V(0);
    row.friction_impulse = Vec3<V>::zero();
  }
}

template <class S> void ParticleEngine<S>::soften_substep() {
  look();
  integrate();
  scratch_.before = state_.velocity;
  warm_start();
  solve(true);
  move_by_constraints();
  solve(false);
  for (ParticleConstraint<S>& row : rows_) row.impulse_seen = max(row.impulse_seen, row.impulse);
}

/// Positions follow what constraints did to velocities: `before` is what they were without.
template <class S> void ParticleEngine<S>::move_by_constraints() {
  for (std::uint32_t i = 0; i < state_.material.size(); ++i) {
    scratch_.displacement.add(i, detail::travelled<S>(state_.velocity[i] - scratch_.before[i], h_));
  }
}

}  // namespace isostep
