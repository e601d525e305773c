// ParticleCoupling: each touch gets its share of its body.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/effects/particle_coupling.hpp"
#include "isostep/particles/limits.hpp"
#include "isostep/scalar/math.hpp"

namespace isostep {

namespace detail {
/// The rounds over a body's touches.
inline constexpr int kShareRounds = 6;
/// [m/s] Errors below this are left to the particles.
template <class S> inline constexpr S kGoodSpeed = S(0.001);
/// [1] The share that counts of the touches on a body: see share.
template <class S> inline constexpr S kCrowdShare = S(0.6);
/// [1] The most of gravity with which a touch is told that its body falls.
template <class S> inline constexpr S kMostAhead = S(4);
/// [1] The share of an overlap deeper than kOverlapSlop that a body leaves in a step, at kLeaveSpeed at most, which is
/// slower than what bounces.
template <class S> inline constexpr S kOverlapShare = S(0.125);
template <class S> inline constexpr S kOverlapSlop = S(0.001);
template <class S> inline constexpr S kLeaveSpeed = S(0.25);

template <class S> ISO_INLINE Vec3<S> saturating_product(Vec3<S> v, S factor) {
  return {saturate_to<S>(product(v.x, factor)), saturate_to<S>(product(v.y, factor)),
          saturate_to<S>(product(v.z, factor))};
}
template <class S> ISO_INLINE Vec3<S> saturating_moment(Vec3<S> arm, Vec3<S> v) {
  return {saturate_to<S>(product(arm.y, v.z) - product(arm.z, v.y)),
          saturate_to<S>(product(arm.z, v.x) - product(arm.x, v.z)),
          saturate_to<S>(product(arm.x, v.y) - product(arm.y, v.x))};
}
template <class S> ISO_INLINE Vec3<S> unlocked(Vec3<S> v, std::uint32_t locks, std::uint32_t first) {
  return {(locks & first) != 0 ? S(0) : v.x, (locks & first << 1) != 0 ? S(0) : v.y,
          (locks & first << 2) != 0 ? S(0) : v.z};
}
}  // namespace detail

/// The inverse inertia in principal axes is I^-1 = kappa / m. With impulses over the body's mass, j = J / m [m/s], a
/// touch moves the body by n j and turns it by (kappa c) j, where c = arm x n, and it answers at the touch with a = n.n
/// + c.(kappa c).
template <class S> void ParticleCoupling<S>::weigh(const Met& met, Touching& touching, Vec3<S> surface, S speed) {
  const auto times = [](S a, S b) ISO_INLINE_LAMBDA { return saturate_to<S>(product(a, b)); };
  const auto look_along = [&](Vec3<U> axis, Along& along) ISO_INLINE_LAMBDA {
    along.push = detail::unlocked(convert<S>(axis), met.locks, body_flag::kLockX);
    along.lever = transposed_times(met.principal,
                                   detail::unlocked(cross(touching.arm, axis), met.locks, body_flag::kLockAngularX));
    const Vec3<S> c = along.lever;
    along.turn = {times(met.kappa.x, c.x), times(met.kappa.y, c.y), times(met.kappa.z, c.z)};
    return response(along, along.push, along.lever);
  };
  touching.answer = touching.widest = look_along(touching.touch.normal, touching.along);
  if (S(0) < touching.touch.friction) {
    // The larger answer across the normal is their sum without the lesser, which is no less than 1.
    const Tangents<U> tangents = tangents_of(touching.touch.normal);
    Along across;
    const S t = look_along(tangents.t, across), u = look_along(tangents.u, across);
    touching.widest = max(max(touching.widest, max(t, u)), saturating_add(saturating_add(t, u), S(-1)));
  }
  touching.surface = surface;
  touching.speed = touching.start_speed = speed;
  touching.own = saturate_to<S>(product(touching.inverse_mass, met.mass));
  const S gap = touching.touch.separation;
  const S overlap = -gap - detail::kOverlapSlop<S>;
  touching.least_speed = S(0);
  if (S(0) < gap) {
    // A particle that meets the body within the step as it goes now is stopped in it; others may come as near as they
    // like.
    const S least = -times(gap, S(hz_));
    touching.least_speed = saturating_add(dot(touching.touch.normal, surface), -speed) < least ? S(0) : least;
  } else if (S(0) < overlap) {
    // Particles are pushed out of what they overlap, bodies only by what changes their velocity: the body's part of the
    // way is a speed. What bounces faster than that leaves by itself; with both the bounce would count the push too.
    const S closing = saturating_add(speed, -dot(touching.touch.normal, surface));
    const S leave = min(times(overlap, S(hz_) * detail::kOverlapShare<S>), detail::kLeaveSpeed<S>);
    const U share = divide_to<U>(touching.answer, saturating_add(touching.answer, touching.own));
    touching.least_speed = leave <= times(touching.touch.restitution, closing) ? S(0) : leave * share;
  }
}
/// Returns the speed that a push and a turning lever of another touch give at this one, in mass-scaled units.
template <class S> ISO_INLINE S ParticleCoupling<S>::response(const Along& along, Vec3<S> push, Vec3<S> lever) {
  return saturating_add(saturate_to<S>(dot_sum(along.push, push)), saturate_to<S>(dot_sum(along.turn, lever)));
}

/// Solves one body's touches alone, with particles as free points without springs: first what happens at once, then the
/// body's gravity within the step, against particles that keep their motion, as what bears it is behind them.
template <class S> void ParticleCoupling<S>::foresee(Met& met) {
  Motion motion = {met.velocity, transposed_times(met.principal, met.angular_velocity)};
  solve(met, motion, true);
  for (std::uint32_t i = met.first_touch; i != kNone; i = touching_[i].next) touching_[i].blow = touching_[i].impulse;
  if (!(met.gravity == Vec3<S>::zero())) {
    motion.velocity = saturating_add(motion.velocity, met.gravity * step_);
    solve(met, motion, false);
  }
  met.pressing = 0;
  met.press = {Vec3<S>::zero(), Vec3<S>::zero()};
  for (std::uint32_t i = met.first_touch; i != kNone; i = touching_[i].next) {
    Touching& touching = touching_[i];
    touching.end_speed = speed_along(touching.along, motion);
    if (S(0) < touching.impulse) count(met, touching.along);
  }
}
template <class S> ISO_INLINE void ParticleCoupling<S>::count(Met& met, const Along& along) {
  ++met.pressing;
  met.press.push = saturating_add(met.press.push, along.push);
  met.press.lever = saturating_add(met.press.lever, along.lever);
}
/// Gives all touches an even start, since what bears a body is more than it takes, and the first touch would get all.
/// Then solves by projected Gauss-Seidel.
template <class S> void ParticleCoupling<S>::solve(Met& met, Motion& motion, bool gives) {
  met.pressing = 0;
  met.press = {Vec3<S>::zero(), Vec3<S>::zero()};
  for (std::uint32_t i = met.first_touch; i != kNone; i = touching_[i].next) {
    touching_[i].missing = missing_speed(touching_[i], motion);
    if (S(0) < touching_[i].missing) count(met, touching_[i].along);
  }
  if (met.pressing == 0) return;
  const std::uint32_t together = met.pressing;
  const Press press = met.press;
  for (std::uint32_t i = met.first_touch; i != kNone; i = touching_[i].next) {
    Touching& touching = touching_[i];
    if (!(S(0) < touching.missing)) continue;
    const S answer = max(touching.answer, response(touching.along, press.push, press.lever));
    give(touching, motion, touching.missing, answer, gives);
  }
  if (together == 1 && met.first_touch == met.last_touch) return;
  for (int round = 0; round < detail::kShareRounds; ++round) {
    S most = S(0);
    for (std::uint32_t i = met.first_touch; i != kNone; i = touching_[i].next) {
      Touching& touching = touching_[i];
      most = max(most, give(touching, motion, missing_speed(touching, motion), touching.answer, gives));
    }
    if (most < detail::kGoodSpeed<S>) return;
  }
}
template <class S> ISO_INLINE S ParticleCoupling<S>::speed_along(const Along& along, const Motion& motion) {
  return saturating_add(saturate_to<S>(dot_sum(along.push, motion.velocity)),
                        saturate_to<S>(dot_sum(along.lever, motion.angular_velocity)));
}
template <class S> ISO_INLINE S ParticleCoupling<S>::missing_speed(const Touching& touching, const Motion& motion) {
  const S apart = saturating_add(speed_along(touching.along, motion), -touching.speed);
  return saturating_add(touching.least_speed, -apart);
}
/// Returns the change of the touch's speed [m/s].
template <class S>
ISO_INLINE S ParticleCoupling<S>::give(Touching& touching, Motion& motion, S missing, S answer, bool gives) {
  const S sum = gives ? saturating_add(answer, touching.own) : answer;
  if (!(S(0) < sum)) return S(0);
  const S next = max(saturating_add(touching.impulse, missing / sum), S(0));
  const S more = next - touching.impulse;
  if (more == S(0)) return more;
  touching.impulse = next;
  const Along& along = touching.along;
  motion.velocity = saturating_add(motion.velocity, detail::saturating_product(along.push, more));
  motion.angular_velocity = saturating_add(motion.angular_velocity, detail::saturating_product(along.turn, more));
  if (gives) touching.speed = saturating_add(touching.speed, -saturate_to<S>(product(touching.own, more)));
  return saturate_to<S>(product(abs(more), sum));
}

/// Particles solve each touch for itself, with springs and neighbours that only they know, and the body gets the sum:
/// Jacobi's iteration, once a step. So that the foreseen impulses come out when nothing unforeseen happens, a touch is
/// told the speed at which those would just stop it: u = j (s + own), or j s where the particle stays. What s stands
/// for a, the body's answer, decides what the unforeseen does. Of n touches that press,
///   s >= sum_j a_ij - own     answers at once what meets all touches at one speed,
///   s >= 0.6 n a - own        lets no motion of the body be answered more than 5/3 times, so that errors decay; a here
///                             is the largest in any direction that friction takes, for a touch has one s for all,
///   s >= a                    is the body itself.
/// Of the particle's own mass only half counts: with all of it a crowd as heavy as the body would bounce off it.
template <class S> void ParticleCoupling<S>::share(Met& met) {
  using W = InverseMass<S>;
  const W most = divide_to<W>(S(1), ParticleLimits<S>::least_mass());
  const auto times = [](S a, S b) ISO_INLINE_LAMBDA { return saturate_to<S>(product(a, b)); };
  for (std::uint32_t i = met.first_touch; i != kNone; i = touching_[i].next) {
    Touching& touching = touching_[i];
    ParticleTouch<S>& touch = touching.touch;
    const S together = response(touching.along, met.press.push, met.press.lever);
    const S apart = times(touching.widest, S(max(met.pressing, 1u)) * detail::kCrowdShare<S>);
    const S shared = max(touching.answer, saturating_add(max(together, apart), -touching.own * U(0.5)));
    touch.inverse_mass = divide_to<W>(shared, met.mass);
    if (most < touch.inverse_mass) ++report_.crowded;
    touch.inverse_mass = min(touch.inverse_mass, most);
    const S scaled = saturate_to<S>(product(touch.inverse_mass, met.mass));
    S told = touching.end_speed;
    if (S(0) < touching.impulse) {
      told = saturating_add(touching.start_speed, -times(touching.blow, saturating_add(scaled, touching.own)));
      const S ahead = times(times(touching.impulse - touching.blow, scaled), S(hz_));  // [m/s^2]
      touch.surface_acceleration =
          held_within(gravity_told(met, touch.normal, ahead), ParticleLimits<S>::acceleration());
    }
    const S along = dot(touch.normal, touching.surface);
    const Vec3<S> surface = saturating_add(touching.surface, touch.normal * saturating_add(told, -along));
    touch.surface_velocity = convert<V>(held_within(surface, ParticleLimits<S>::speed()));
  }
}
/// Returns the part of gravity along the surface that goes with the part across it.
template <class S> Vec3<S> ParticleCoupling<S>::gravity_told(const Met& met, Vec3<U> normal, S ahead) {
  const S across = -dot(normal, met.gravity);
  const Vec3<S> along = met.gravity + normal * across;
  const S part = S(0) < across ? clamp(divide_to<S>(ahead, across), S(0), detail::kMostAhead<S>) : S(0);
  return saturating_add(detail::saturating_product(along, part), normal * -ahead);
}

}  // namespace isostep
