// Bodies of stiff_spring.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/particles/stiff_spring.hpp"
#include "isostep/scalar/finer.hpp"
#include "isostep/scalar/math.hpp"

namespace isostep {

namespace detail {
/// sin(theta) / theta and cos(theta) for theta^2 = q, |q| <= 1/64; hyperbolic for q < 0. What is left out is below
/// 2^-60.
template <class S> struct NearZero { S sinc, cos; };
template <class S> ISO_INLINE NearZero<S> near_zero(S q) {
  const S one = S(1);
  S sinc = one - q * S(1.0 / 110);
  sinc = one - q * sinc * S(1.0 / 72);
  sinc = one - q * sinc * S(1.0 / 42);
  sinc = one - q * sinc * S(1.0 / 20);
  sinc = one - q * sinc * S(1.0 / 6);
  S cos = one - q * S(1.0 / 90);
  cos = one - q * cos * S(1.0 / 56);
  cos = one - q * cos * S(1.0 / 30);
  cos = one - q * cos * S(1.0 / 12);
  cos = one - q * cos * S(0.5);
  return {sinc, cos};
}

/// The exact step in a scalar that is fine enough; vd comes times h.
template <class S> ISO_INLINE OscillatorStep<S> oscillator_of(S kappa, S delta) {
  using U = Unit<S>;
  const S q = kappa - delta * delta;
  if (S(-0.015625) < q && q < S(0.015625)) {
    const U fall = exp_to<U>(-delta);
    const NearZero<S> nearby = near_zero(q);
    const S c = nearby.cos * fall, s = nearby.sinc * fall;
    return {convert<U>(c + delta * s), convert<U>(s), convert<U>(c - delta * s), -(kappa * s)};
  }
  if (S(0) < q) {
    const S theta = sqrt(q);
    const U fall = exp_to<U>(-delta);
    const SinCos<U> turn = sin_cos_to<U>(theta);
    const U c = turn.cos * fall, s = turn.sin * fall;
    const U slowing = convert<U>((delta / theta) * s);
    return {c + slowing, divide_to<U>(convert<S>(s), theta), c - slowing, -((kappa / theta) * s)};
  }
  const S theta = sqrt(-q);
  const U slow = exp_to<U>(-(kappa / (delta + theta))), fast = exp_to<U>(-(delta + theta));
  const U half = U(0.5);
  const U c = slow * half + fast * half, s = slow * half - fast * half;
  const U slowing = convert<U>((delta / theta) * s);
  return {c + slowing, divide_to<U>(convert<S>(s), theta), c - slowing, -((kappa / theta) * s)};
}
/// kappa and delta, where they are fine enough.
template <class F> struct Oscillator { F kappa, delta; };
template <class S> ISO_INLINE Oscillator<Finer<S>> oscillator(S stiffness, S damping, InverseMass<S> w, S rate) {
  using F = Finer<S>;
  const F mass_inverse = finer<F>(w), fine_rate = finer<F>(rate);
  return {saturate_to<F>(product(finer<F>(stiffness), mass_inverse)) / fine_rate / fine_rate,
          saturate_to<F>(product(finer<F>(damping), mass_inverse)) / (fine_rate + fine_rate)};
}
/// Rounds a step to the scalar; vd comes times h.
template <class S, class F> ISO_INLINE OscillatorStep<S> coarse_step(const OscillatorStep<F>& step, S rate) {
  const F vd = saturate_to<F>(product(step.vd, finer<F>(rate)));
  return {coarser<Unit<S>>(step.dd), coarser<Unit<S>>(step.dv), coarser<Unit<S>>(step.vv), coarser<S>(vd)};
}
}  // namespace detail

template <class S> OscillatorStep<S> oscillator_step(S stiffness, S damping, InverseMass<S> w, S rate) {
  const detail::Oscillator<Finer<S>> o = detail::oscillator(stiffness, damping, w, rate);
  return detail::coarse_step<S>(detail::oscillator_of(o.kappa, min(o.delta, Finer<S>(1024))), rate);
}

template <class S> OscillatorStep<S> implicit_oscillator_step(S stiffness, S damping, InverseMass<S> w, S rate) {
  using F = Finer<S>;
  const detail::Oscillator<F> o = detail::oscillator(stiffness, damping, w, rate);
  const F slow = saturating_add(F(1), saturating_add(o.delta, o.delta)), all = saturating_add(slow, o.kappa);
  const Unit<F> rest = divide_to<Unit<F>>(F(1), all);
  return detail::coarse_step<S>(OscillatorStep<F>{divide_to<Unit<F>>(slow, all), rest, rest, -(o.kappa / all)}, rate);
}

}  // namespace isostep
