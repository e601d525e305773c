// ParticleEngine: the default solver. Constraints act over sub-steps as damped springs on velocities, then once more
// without push (Catto 2024, Solver2D: Soft Step); the rigid world's method for what does not turn. What pushes overlaps
// of contacts apart is a velocity of its own, which moves particles and is forgotten (split impulses, as in Bullet): in
// a crowd one pass does not take back what another gave, and overlap would turn into motion.
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
template <class S>
ISO_INLINE Velocity<S> ParticleEngine<S>::speed_of(const Axes<V>& velocity, const ParticleConstraint<S>& row) const {
  const Vec3<V> b = row.b == kNoParticle ? row.surface_velocity : velocity[row.b];
  return saturate_to<V>(dot_sum(row.normal, b) - dot_sum(row.normal, velocity[row.a]));
}
template <class S> ISO_INLINE Velocity<S> ParticleEngine<S>::separating_speed(const ParticleConstraint<S>& row) const {
  return speed_of(state_.velocity, row);
}

/// [m/s] that forces at the present places add to the speed at which they close, in a sub-step.
template <class S> ISO_INLINE Velocity<S> ParticleEngine<S>::closing_gain(const ParticleConstraint<S>& row) const {
  const V of_a = saturate_to<V>(product(saturate_to<S>(dot_sum(row.normal, scratch_.acceleration[row.a])), h_));
  const V of_b = row.b == kNoParticle
                     ? saturate_to<V>(dot_sum(row.normal, row.surface_gain))
                     : saturate_to<V>(product(saturate_to<S>(dot_sum(row.normal, scratch_.acceleration[row.b])), h_));
  return saturating_subtract(of_a, of_b);
}
/// The speed of which restitution gives back a share: that of the motion before the sub-step, and what forces do on the
/// way to where they meet, or have done on the way beyond: there the push out of the overlap works against them. No
/// more than either the forces before or those at the meeting would do; `there` is what the latter add.
/// Where there is no arrive(), velocities are those of half a sub-step ago, and so are those that leave: what forces
/// add in that half is due once, what they hold back twice.
template <class S>
ISO_INLINE Velocity<S> ParticleEngine<S>::meeting_speed(const ParticleConstraint<S>& row, V there) const {
  const auto gained = [&](std::uint32_t slot) ISO_INLINE_LAMBDA { return scratch_.before[slot] - scratch_.came[slot]; };
  const Vec3<V> of_b = row.b == kNoParticle ? row.surface_gain : gained(row.b);
  V here = saturate_to<V>(dot_sum(row.normal, gained(row.a)) - dot_sum(row.normal, of_b));
  const V came = saturating_subtract(row.closing, here);
  if (arrives()) here = saturating_add(here, here);
  const V ahead = saturate_to<V>(product(row.separation, rate_));
  const V gain = ahead < V(0) ? max(here, there) : min(here, there);
  if (arrives()) return worked_speed<S>(max(came, V(0)), gain, ahead);
  if (V(0) < gain) return worked_speed<S>(max(saturating_add(came, gain * V(0.5)), V(0)), gain, ahead);
  return max(saturating_add(worked_speed<S>(max(came, V(0)), gain, ahead), gain), V(0));
}
/// Forces are looked at once more where something met that bounces.
template <class S> void ParticleEngine<S>::note_meetings() {
  bool meets = false, bounces = false;
  for (const ParticleConstraint<S>& row : rows_) {
    meets = meets || row.meets != 0;
    bounces = bounces || (row.meets != 0 && S(0) < row.restitution);
  }
  if (!meets) return;
  if (bounces) {
    renew_positions();
    accelerate();
    pull_stiff_springs();
  }
  for (ParticleConstraint<S>& row : rows_) {
    if (row.meets == 0) continue;
    row.meets = 0;
    const bool bounced = V(0) < row.closing && S(0) < row.restitution;
    row.approach = min(row.approach, -(bounced ? meeting_speed(row, closing_gain(row)) : row.closing));
  }
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

/// A touch is not: of its two sides the other is somebody else's to move, so its velocity has to.
template <class S> ISO_INLINE bool ParticleEngine<S>::is_shifted(const ParticleConstraint<S>& row) const {
  return row.kind == ConstraintKind::contact && (row.b != kNoParticle || row.other != kNoParticle);
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
ISO_INLINE void ParticleEngine<S>::solve_normal(ParticleConstraint<S>& row, const Softness<S>& softness, bool biased) {
  const V speed = separating_speed(row);
  const bool rod = row.kind == ConstraintKind::rod;
  V change;
  if (!rod && S(0) < row.separation) {
    // A gap may be closed within the sub-step and no further.
    change = -saturating_add(speed, saturate_to<V>(product(row.separation, rate_)));
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
    row.closing = max(-speed_of(scratch_.before, row), V(0));
  }
  row.impulse = total;
  if (given == V(0)) return;
  give(row, row.normal * given);
  if (S(0) < row.restitution) note_work(row, speed, saturating_add(speed, given));
}

/// Overlap as a velocity that moves and does not last: the way of all contacts of a sub-step is planned in it.
template <class S> ISO_INLINE void ParticleEngine<S>::push_apart(ParticleConstraint<S>& row) {
  const Vec3<V> b = row.b == kNoParticle ? Vec3<V>::zero() : scratch_.shift[row.b];
  const V shift = saturate_to<V>(dot_sum(row.normal, b) - dot_sum(row.normal, scratch_.shift[row.a]));
  const V moving = saturating_add(shift, max(separating_speed(row), V(0)));
  V change;
  if (S(0) < row.separation) {
    change =
        -saturating_add(saturating_add(shift, separating_speed(row)), saturate_to<V>(product(row.separation, rate_)));
  } else {
    // What bears a load gives way under it, as a spring does.
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
  scratch_.shift.set(row.a, held_within(saturating_subtract(scratch_.shift[row.a], j * row.share_a), most));
  if (row.b != kNoParticle) scratch_.shift.set(row.b, held_within(saturating_add(b, j * row.share_b), most));
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
  scratch_.came = state_.velocity;
  integrate();
  scratch_.before = state_.velocity;
  scratch_.shift.assign(state_.material.size(), V(0));
  for (ParticleConstraint<S>& row : rows_) row.shift = V(0);
  warm_start();
  solve(true);
  move_by_constraints();
  for (std::uint32_t i = 0; i < state_.material.size(); ++i) move_on(i, detail::travelled<S>(scratch_.shift[i], h_));
  if (arrives()) arrive();
  solve(false);
  for (ParticleConstraint<S>& row : rows_) row.impulse_seen = max(row.impulse_seen, row.impulse);
  note_meetings();
}

/// Positions follow what constraints did to velocities: `before` is what they were without.
template <class S> void ParticleEngine<S>::move_by_constraints() {
  for (std::uint32_t i = 0; i < state_.material.size(); ++i)
    move_on(i, detail::travelled<S>(saturating_subtract(state_.velocity[i], scratch_.before[i]), h_));
}

}  // namespace isostep
