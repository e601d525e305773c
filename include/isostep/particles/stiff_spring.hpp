// The exact motion of a damped harmonic oscillator over one step, in all three regimes.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/fields.hpp"
#include "isostep/core/instantiate.hpp"
#include "isostep/particles/particle.hpp"

namespace isostep {

/// The coefficients that h seconds give to the distance d between a stiff spring's ends and to its rate v:
/// d' = dd d + dv v h,  v' = vd d + vv v.
template <class S> struct OscillatorStep {
  Unit<S> dd, dv, vv;  // [1]
  S vd;                // [1/s]

  ISO_FIELDS(dd, dv, vv, vd)
};

/// The exact step of d'' = -k w d - c w d', where w [1/kg] is the sum of both ends' 1/m.
/// Symbols: kappa = k w h^2, delta = c w h / 2, theta = sqrt(|kappa - delta^2|), all [1].
///          Below critical damping C = e^-delta cos theta and Q = e^-delta sin(theta) / theta; above it the hyperbolic
///          functions, as sums of falling exponentials, so that nothing grows; near it their series.
///          dd = C + delta Q, dv = Q, vv = C - delta Q, vd = -kappa Q / h.
/// Source:  Millington, ch. 6.3 gives the case below critical damping.
/// Error:   the coefficients are those of the next wider format, rounded. Motions are measured against the exact one in
///          tests/laws/particle_springs_test.cpp.
/// Limits:  delta counts up to 1024: beyond, the ends only creep.
template <class S> OscillatorStep<S> oscillator_step(S stiffness, S damping, InverseMass<S> w, S rate);

/// The step by backward Euler, which is stable beside whatever else moves the ends, and damps. d' = d + v' h:
/// with D = 1 + 2 delta + kappa, vv = dv = 1 / D, dd = 1 - kappa / D, vd = -kappa / (h D).
template <class S> OscillatorStep<S> implicit_oscillator_step(S stiffness, S damping, InverseMass<S> w, S rate);

#define ISO_STIFF_SPRING_OF(extern, S)                                           \
  extern template OscillatorStep<S> oscillator_step<S>(S, S, InverseMass<S>, S); \
  extern template OscillatorStep<S> implicit_oscillator_step<S>(S, S, InverseMass<S>, S);
ISO_EXTERN_FOR_EACH_SCALAR(ISO_STIFF_SPRING_OF)

}  // namespace isostep
