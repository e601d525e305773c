// ParticleLimits<S>: the range inside which no intermediate of the particle engine overflows, for each scalar.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/particles/particle.hpp"

namespace isostep {

/// All are powers of two, so that they are exact in every format. Particles have no extent to square and do not turn,
/// so they may be four times as fast as bodies of a narrow scalar.
///   position()     [m]     largest coordinate
///   speed()        [m/s]   largest component of a velocity
///   acceleration() [m/s^2] largest component that gravity, drag and commands may give, each
///   least_mass()   [kg]    smallest mass of what is not pinned
///   mass()         [kg]    largest mass
template <class S> struct ParticleLimits;

/// These are of fixed point with W = bits - 1 - F whole bits, so |value| < 2^W:
///   position <= 2^(W-6)      differences, spring extensions and margins fit.
///   speed                    a quarter of what Velocity<S> holds: within a sub-step a component stays below 3/2 of it
///                            and a push below twice it, and the two add up.
///   least_mass               1/m fits InverseMass<S> with a bit to spare: two of them add up, saturating at the very
///                            end, where it is one unit in 2^31.
///   mass <= 2^(W-2)          and 1/m keeps 11 bits.
/// Q16.16: position 512, speed 512, mass 1/64 to 8192. Q32.32: position 1048576, speed 16384, mass 2^-14 to 2^29.
template <class Rep, int F, Overflow P> struct ParticleLimits<Fixed<Rep, F, P>> {
  using S = Fixed<Rep, F, P>;
  static constexpr int kWhole = S::kBits - 1 - F;
  static_assert(kWhole >= 11, "a world needs 11 whole bits: 32 m");
  static_assert(F >= 16, "a world needs 16 fraction bits: 15 um");

  static ISO_INLINE constexpr S position() { return power(least(kWhole - 6, 20)); }
  static ISO_INLINE constexpr S speed() {
    return power(least(least(S::kBits - 3 - Velocity<S>::kFracBits, kWhole - 6), 14));
  }
  static ISO_INLINE constexpr S acceleration() { return power(kWhole - 2); }
  static ISO_INLINE constexpr S least_mass() { return power(-least(S::kBits - 2 - InverseMass<S>::kFracBits, F)); }
  static ISO_INLINE constexpr S mass() { return power(kWhole - 2); }

 private:
  static ISO_INLINE constexpr S power(int exponent) { return S::from_raw(Rep(1) << (F + exponent)); }
  static ISO_INLINE constexpr int least(int a, int b) { return a < b ? a : b; }
};

/// The spacing of numbers bounds the position, as for bodies: 2^-8 m and 2^-23 m.
template <> struct ParticleLimits<float> {
  static ISO_INLINE constexpr float position() { return 0x1p16f; }
  static ISO_INLINE constexpr float speed() { return 0x1p14f; }
  static ISO_INLINE constexpr float acceleration() { return 0x1p100f; }
  static ISO_INLINE constexpr float least_mass() { return 0x1p-40f; }
  static ISO_INLINE constexpr float mass() { return 0x1p40f; }
};
template <> struct ParticleLimits<double> {
  static ISO_INLINE constexpr double position() { return 0x1p30; }
  static ISO_INLINE constexpr double speed() { return 0x1p20; }
  static ISO_INLINE constexpr double acceleration() { return 0x1p200; }
  static ISO_INLINE constexpr double least_mass() { return 0x1p-60; }
  static ISO_INLINE constexpr double mass() { return 0x1p60; }
};

/// [m/s] Slower than this nothing bounces (Millington, p. 358): rest would be a rain of small bounces.
template <class S> inline constexpr Velocity<S> kLeastBounce = Velocity<S>(0.25);

/// [m/s] Returns the error that rounding may leave in a row's speed: 4 units of Velocity<S> (two particles, three axes,
/// the normal), times 4 to spare. Floats round relative to `fastest`, the largest speed that was added.
template <class S> ISO_INLINE constexpr Velocity<S> speed_tolerance(Velocity<S> fastest) {
  using V = Velocity<S>;
  return V(16) * (resolution<V>() + round_to<V>(product(resolution<Unit<S>>(), fastest)));
}

/// [m/s] and [m] The bounds of a component: nothing goes beyond them while a step lasts, whatever forces and impulses
/// ask for.
template <class S> ISO_INLINE constexpr Velocity<S> passing_speed() {
  const Velocity<S> speed = convert<Velocity<S>>(ParticleLimits<S>::speed());
  return speed + speed * Velocity<S>(0.5);
}
template <class S> ISO_INLINE constexpr Velocity<S> passing_distance() {
  const Velocity<S> edge = convert<Velocity<S>>(ParticleLimits<S>::position());
  return edge + edge;
}

}  // namespace isostep
