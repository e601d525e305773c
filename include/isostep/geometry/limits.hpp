// Limits<S>: the range inside which no intermediate of the engine overflows, for each scalar.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/scalar/scalar.hpp"

namespace isostep {

/// The published range of a scalar. All are powers of two, so that they are exact in every format.
///   extent()        [m]      largest coordinate of a shape in its body's frame
///   minimum_size()  [m]      smallest radius, half extent or half height; four boxes stand on each other from 1/64 m
///   position()      [m]      largest coordinate of a body
///   speed()         [m/s]    largest length of a velocity
///   angular_speed() [rad/s]  largest length of an angular velocity
///   mass()          [kg]     largest mass
///   mass_ratio()    [1]      largest ratio of two bodies' masses that keeps half of the format's digits
///   leverage()      [1]      largest kappa arm^2 of a joint
///   surface_speed() [m/s]    largest speed of a point of a body against its centre
template <class S> struct Limits;

/// The limits of fixed point with W = bits - 1 - F whole bits, so |value| < 2^W:
///   extent <= 2^((W-1)/2)    a product of two extents, 2^(W-1), fits.
///   speed  <= 2^((W-3)/2)    its square, 2^(W-3), fits with room for an energy's other terms.
///   angular_speed <= 2^((W-3)/2)    two points at arms of sqrt(3) extent move against each other with at most
///                            2 (speed + sqrt(3) angular_speed extent) <= 2 speed + 0.87 2^W, which fits for W >= 11.
///   position <= 2^(W-6)      32 positions add up: differences, doubled coordinates, rays and margins fit.
///   minimum_size >= 2^-((W-3)/2), 2^(10-F)    kappa <= 5 / (2 size^2) <= 5/16 2^W fits; a size has three digits.
///   mass <= 2^(W-2)          the sum of two masses fits.
///   mass_ratio <= 2^(W/2)    its square fits.
///   leverage <= 2^(W/2 + 1)  times an impulse of a few metres a second, and summed over a joint's rows, it fits.
///   surface_speed            a quarter of what Velocity<S> holds: two bodies' points meet and are summed by axis.
/// Beyond 2^20 m, 2^14 m, 2^14 m/s and below 2^-10 m they stop growing: no scene needs more.
/// Q16.16: extent 128, size 1/64, position 512, speed 64, angular speed 64, mass 8192, ratio 128, leverage 256,
///         surface speed 512.
/// Q32.32: extent 16384, size 1/1024, position 1048576, speed 16384, angular speed 16384, mass 2^29, ratio 32768.
template <class Rep, int F, Overflow P> struct Limits<Fixed<Rep, F, P>> {
  using S = Fixed<Rep, F, P>;
  static constexpr int kWhole = S::kBits - 1 - F;
  static_assert(kWhole >= 11, "a world needs 11 whole bits: 32 m");
  static_assert(F >= 16, "a world needs 16 fraction bits: 15 um");

  static ISO_INLINE constexpr S extent() { return power(least((kWhole - 1) / 2, 14)); }
  static ISO_INLINE constexpr S minimum_size() { return power(-least((kWhole - 3) / 2, least(F - 10, 10))); }
  static ISO_INLINE constexpr S position() { return power(least(kWhole - 6, 20)); }
  static ISO_INLINE constexpr S speed() { return power(least((kWhole - 3) / 2, 14)); }
  static ISO_INLINE constexpr S angular_speed() { return power(least((kWhole - 3) / 2, 14)); }
  static ISO_INLINE constexpr S mass() { return power(kWhole - 2); }
  static ISO_INLINE constexpr S mass_ratio() { return power(kWhole / 2); }
  static ISO_INLINE constexpr S leverage() { return power(kWhole / 2 + 1); }
  static ISO_INLINE constexpr S surface_speed() { return power(least(S::kBits - 3 - Velocity<S>::kFracBits, 20)); }

 private:
  static ISO_INLINE constexpr S power(int exponent) { return S::from_raw(Rep(1) << (F + exponent)); }
  static ISO_INLINE constexpr int least(int a, int b) { return a < b ? a : b; }
};

/// Nothing overflows at these sizes (mass position^4 < 2^108); they bound the spacing of numbers: 2^-8 m at the
/// position limit, still less than the overlap a contact rests with. The ratio is half the mantissa.
template <> struct Limits<float> {
  static ISO_INLINE constexpr float extent() { return 0x1p13f; }
  static ISO_INLINE constexpr float minimum_size() { return 0x1p-10f; }
  static ISO_INLINE constexpr float position() { return 0x1p16f; }
  static ISO_INLINE constexpr float speed() { return 0x1p14f; }
  static ISO_INLINE constexpr float angular_speed() { return 0x1p14f; }
  static ISO_INLINE constexpr float mass() { return 0x1p40f; }
  static ISO_INLINE constexpr float mass_ratio() { return 0x1p12f; }
  static ISO_INLINE constexpr float leverage() { return 0x1p30f; }
  static ISO_INLINE constexpr float surface_speed() { return 0x1p30f; }
};
/// The spacing at the position limit is 2^-23 m.
template <> struct Limits<double> {
  static ISO_INLINE constexpr double extent() { return 0x1p20; }
  static ISO_INLINE constexpr double minimum_size() { return 0x1p-10; }
  static ISO_INLINE constexpr double position() { return 0x1p30; }
  static ISO_INLINE constexpr double speed() { return 0x1p20; }
  static ISO_INLINE constexpr double angular_speed() { return 0x1p17; }
  static ISO_INLINE constexpr double mass() { return 0x1p60; }
  static ISO_INLINE constexpr double mass_ratio() { return 0x1p26; }
  static ISO_INLINE constexpr double leverage() { return 0x1p60; }
  static ISO_INLINE constexpr double surface_speed() { return 0x1p60; }
};

}  // namespace isostep
