// ParticleSoftStep: a sub-step, its rows, and restitution.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/particles/solvers/soft_step.hpp"
#include "isostep/particles/step/row_motion.hpp"

namespace isostep {

namespace detail {
/// [rad] a sub-step and [1] of critical: contacts are springs of an eighth of the sub-step rate, as bodies' are.
template <class S> inline constexpr S kParticleContactAngle = S(0.78539816339744831);
template <class S> inline constexpr S kParticleContactDamping = S(10);
/// Links are springs of a quarter of the sub-step rate: of a half, a chain of fifty gains energy for ever. At rest a
/// link is stretched by 0.4 h^2 of the acceleration that it holds back: 0.07 mm for 10 m/s^2 and four sub-steps.
template <class S> inline constexpr S kLinkAngle = S(1.5707963267948966);
template <class S> inline constexpr S kLinkDamping = S(2);
/// [m/s] The greatest speed with which overlaps are pushed apart.
template <class V> inline constexpr V kParticlePushSpeed = V(4);
}  // namespace detail

template <class S>
ParticleSoftStep<S>::ParticleSoftStep(ParticleState<S>& state, ParticleStep<S>& step, ParticleRows<S>& rows,
                                      ParticleIntegration<S>& integration)
    : state_(state), step_(step), rows_(rows), integration_(integration) {}

template <class S> void ParticleSoftStep<S>::begin_step() {
  contact_softness_ = soften(detail::kParticleContactAngle<S>, detail::kParticleContactDamping<S>, step_.rate);
  link_softness_ = soften(detail::kLinkAngle<S>, detail::kLinkDamping<S>, step_.rate);
}

template <class S> void ParticleSoftStep<S>::solve_substep() {
  const bool constrained = !rows_.empty();
  rows_.look();
  came_ = state_.velocity;
  integration_.integrate(constrained);
  before_ = state_.velocity;
  shift_.assign(state_.material.size(), V(0));
  for (Row& row : rows_.all()) row.shift = V(0);
  warm_start();
  solve(true);
  step_.follow_constraints(state_.velocity, before_);
  for (std::uint32_t i = 0; i < state_.material.size(); ++i) step_.move_on(i, detail::travelled<S>(shift_[i], step_.h));
  if (integration_.arrives()) integration_.arrive(constrained);
  solve(false);
  for (Row& row : rows_.all()) row.impulse_seen = max(row.impulse_seen, row.impulse);
  note_meetings();
}

template <class S> void ParticleSoftStep<S>::warm_start() {
  for (Row& row : rows_.all()) {
    const bool bounces = S(0) < row.restitution && V(0) < row.impulse;
    const V before = bounces ? detail::separating_speed(row, state_.velocity) : V(0);
    const Vec3<V> j = row.normal * row.impulse;
    detail::give(row, state_.velocity, saturating_add(j, row.friction_impulse));
    if (bounces) note_work(row, before, detail::separating_speed(row, state_.velocity));
  }
}

/// A biased pass solves friction before the normal, since non-penetration has the last word. A relaxed pass solves the
/// normal first.
template <class S> void ParticleSoftStep<S>::solve(bool biased) {
  for (Row& row : rows_.all()) {
    const Softness<S>& softness = !biased || is_shifted(row)            ? rigid_softness_
                                  : row.kind == ConstraintKind::contact ? contact_softness_
                                                                        : link_softness_;
    const bool rubs = S(0) < row.friction;
    if (rubs && biased) solve_friction(row);
    solve_normal(row, softness, biased);
    if (rubs && !biased) solve_friction(row);
    if (biased && is_shifted(row)) push_apart(row);
  }
}

template <class S>
ISO_INLINE void ParticleSoftStep<S>::solve_normal(Row& row, const Softness<S>& softness, bool biased) {
  const V speed = detail::separating_speed(row, state_.velocity);
  const bool rod = row.kind == ConstraintKind::rod;
  V change;
  if (!rod && S(0) < row.separation) {
    // A gap may be closed within the sub-step and no further.
    change = -saturating_add(speed, saturate_to<V>(product(row.separation, step_.rate)));
  } else {
    V wanted = speed;
    if (biased && !is_shifted(row)) {
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
  if (row.impulse == V(0) && V(0) < total) {
    row.meets = 1;
    row.closing = max(-detail::separating_speed(row, before_), V(0));
  }
  row.impulse = total;
  if (given == V(0)) return;
  detail::give(row, state_.velocity, row.normal * given);
  if (S(0) < row.restitution) note_work(row, speed, saturating_add(speed, given));
}

/// Pushes particles apart by a velocity that moves them and is then forgotten. All contacts of a sub-step share it.
template <class S> ISO_INLINE void ParticleSoftStep<S>::push_apart(Row& row) {
  const Vec3<V> b = row.b == kNoParticle ? Vec3<V>::zero() : shift_[row.b];
  const V shift = saturate_to<V>(dot_sum(row.normal, b) - dot_sum(row.normal, shift_[row.a]));
  const V moving = saturating_add(shift, max(detail::separating_speed(row, state_.velocity), V(0)));
  V change;
  if (S(0) < row.separation) {
    change = -saturating_add(saturating_add(shift, detail::separating_speed(row, state_.velocity)),
                             saturate_to<V>(product(row.separation, step_.rate)));
  } else {
    // A contact under load gives way, as a spring does.
    const V push = saturate_to<V>(product(row.separation, contact_softness_.bias_rate));
    const V wanted = saturating_add(moving, max(push, -detail::kParticlePushSpeed<V>));
    change = -saturating_add(round_to<V>(product(wanted, contact_softness_.mass_scale)),
                             round_to<V>(product(row.impulse, contact_softness_.impulse_scale)));
  }
  const V total = max(saturating_add(row.shift, change), V(0));
  const V given = saturating_subtract(total, row.shift);
  row.shift = total;
  if (given == V(0)) return;
  const Vec3<V> j = row.normal * given;
  const V most = passing_speed<S>();
  shift_.set(row.a, held_within(saturating_subtract(shift_[row.a], j * row.share_a), most));
  if (row.b != kNoParticle) shift_.set(row.b, held_within(saturating_add(b, j * row.share_b), most));
}

/// Applies Coulomb friction against the slip, within a cone about the normal.
template <class S> ISO_INLINE void ParticleSoftStep<S>::solve_friction(Row& row) {
  const Vec3<V> b = row.b == kNoParticle ? row.surface_velocity : state_.velocity[row.b];
  const Vec3<V> v = state_.velocity[row.a];
  const Vec3<V> slip =
      saturating_subtract(saturating_subtract(b, v), row.normal * detail::separating_speed(row, state_.velocity));
  const Vec3<V> old = row.friction_impulse;
  // It is held, so that it has a length in the format.
  Vec3<V> next = held_within(saturating_subtract(old, slip), passing_speed<S>());
  const V limit = saturate_to<V>(product(row.impulse, row.friction));
  const Heading<V> way = heading_of(next);
  if (limit < way.length) next = way.direction * limit;
  row.friction_impulse = next;
  detail::give(row, state_.velocity, saturating_subtract(next, old));
}

/// Twice the work of an impulse, of unit reduced mass, up to what two particles bring that come at each other:
/// 2 sqrt(3) times the speed limit, squared. In Q12.20 that and the square of any speed together are within the sum's
/// 2^23.
template <class S> ISO_INLINE void ParticleSoftStep<S>::note_work(Row& row, V before, V after) {
  const V fastest = convert<V>(ParticleLimits<S>::speed()) * V(3.5);
  const auto most = product(fastest, fastest);
  row.work = clamp(row.work + (product(after, after) - product(before, before)), -most, most);
}
/// The wanted speed, or the greatest for which what the row has taken from the motion pays: between several, or past a
/// corner, one speed may come back along more than one normal. It is within 2^-12, from below; rounding alone costs
/// nothing.
template <class S> ISO_INLINE Velocity<S> ParticleSoftStep<S>::most_bounce(const Row& row, V speed, V wanted) const {
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

// ---- restitution

/// The speed of which restitution gives back a share: that of the motion before the sub-step, and what forces do on the
/// way to where they meet, or have done on the way beyond: there the push out of the overlap works against them. No
/// more than either the forces before or those at the meeting would do; `there` is what the latter add.
/// Where there is no arrive(), velocities are those of half a sub-step ago, and so are those that leave: what forces
/// add in that half is due once, what they hold back twice.
template <class S> ISO_INLINE Velocity<S> ParticleSoftStep<S>::meeting_speed(const Row& row, V there) const {
  const auto gained = [&](std::uint32_t slot) ISO_INLINE_LAMBDA { return before_[slot] - came_[slot]; };
  const Vec3<V> of_b = row.b == kNoParticle ? row.surface_gain : gained(row.b);
  V here = saturate_to<V>(dot_sum(row.normal, gained(row.a)) - dot_sum(row.normal, of_b));
  const V came = saturating_subtract(row.closing, here);
  if (integration_.arrives()) here = saturating_add(here, here);
  const V ahead = saturate_to<V>(product(row.separation, step_.rate));
  const V gain = ahead < V(0) ? max(here, there) : min(here, there);
  if (integration_.arrives()) return worked_speed<S>(max(came, V(0)), gain, ahead);
  if (V(0) < gain) return worked_speed<S>(max(saturating_add(came, gain * V(0.5)), V(0)), gain, ahead);
  return max(saturating_add(worked_speed<S>(max(came, V(0)), gain, ahead), gain), V(0));
}
/// Notes the rows that met. Computes forces once more if something met that bounces.
template <class S> void ParticleSoftStep<S>::note_meetings() {
  bool meets = false, bounces = false;
  for (const Row& row : rows_.all()) {
    meets = meets || row.meets != 0;
    bounces = bounces || (row.meets != 0 && S(0) < row.restitution);
  }
  if (!meets) return;
  if (bounces) integration_.accelerate_all();
  for (Row& row : rows_.all()) {
    if (row.meets == 0) continue;
    row.meets = 0;
    const bool bounced = V(0) < row.closing && S(0) < row.restitution;
    row.approach =
        min(row.approach,
            -(bounced ? meeting_speed(row, detail::closing_gain(row, step_.acceleration, step_.h)) : row.closing));
  }
}

template <class S> void ParticleSoftStep<S>::apply_restitution() {
  for (Row& row : rows_.all()) {
    if (!(S(0) < row.restitution) || !(V(0) < row.impulse_seen) || !(row.approach < -kLeastBounce<S>)) continue;
    const V speed = detail::separating_speed(row, state_.velocity);
    const V wanted = most_bounce(row, speed, -round_to<V>(product(row.approach, row.restitution)));
    const V change = max(saturating_subtract(wanted, speed), -row.impulse);
    detail::give(row, state_.velocity, row.normal * change);
    // A particle that leaves has nothing to begin the next step with: a blow is not a load.
    row.impulse = V(0);
    row.friction_impulse = Vec3<V>::zero();
  }
}

}  // namespace isostep
