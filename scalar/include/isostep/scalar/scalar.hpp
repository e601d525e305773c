// The concept Scalar and the types that every scalar brings: the one place where float and fixed point are told apart.
// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "isostep/scalar/fixed.hpp"

namespace isostep {

/// The requirements of the engine on a number type S:
///   Unit     directions, quaternions, rotation matrices: values in [-2, 2), as fine as the width allows
///   Velocity speeds, impulses per mass, displacements within a step: where S is narrow, finer than S at less range
///   Step     a time step or another fraction below one [s]
///   Raw      the integer with S's bits, for hashing, files and exact text
///   kId      names the format in files: kind << 16 | bits << 8 | fraction (or mantissa) bits
/// For float and double all of them, and every sum, are S itself.
template <class S> struct ScalarTraits;

template <> struct ScalarTraits<float> {
  using Unit = float;
  using Velocity = float;
  using Step = float;
  using Raw = std::uint32_t;
  static constexpr const char* kName = "float";
  static constexpr std::uint32_t kId = 1u << 16 | 32u << 8 | 24u;
  static constexpr bool kExact = false;
};
template <> struct ScalarTraits<double> {
  using Unit = double;
  using Velocity = double;
  using Step = double;
  using Raw = std::uint64_t;
  static constexpr const char* kName = "double";
  static constexpr std::uint32_t kId = 1u << 16 | 64u << 8 | 53u;
  static constexpr bool kExact = false;
};

namespace detail {
template <int Whole, int Frac> struct FixedName {  // "q32.32", for whole and fraction bits of one or two digits
  char text[8] = {};
  constexpr FixedName() {
    int at = 0;
    auto put = [&](int n) {
      if (n >= 10) text[at++] = static_cast<char>('0' + n / 10);
      text[at++] = static_cast<char>('0' + n % 10);
    };
    text[at++] = 'q';
    put(Whole);
    text[at++] = '.';
    put(Frac);
  }
};
template <int Whole, int Frac> inline constexpr FixedName<Whole, Frac> kFixedName{};
}  // namespace detail

template <class Rep, int F, Overflow P> struct ScalarTraits<Fixed<Rep, F, P>> {
  static constexpr int kBits = Fixed<Rep, F, P>::kBits;
  using Unit = Fixed<Rep, kBits - 2, P>;
  using Velocity = Fixed<Rep, (kBits == 32 && F < 20) ? 20 : F, P>;  // Q12.20: 2048 m/s, 1 um/s
  using Step = Fixed<Rep, kBits - 1, P>;
  using Raw = std::conditional_t<sizeof(Rep) == 4, std::uint32_t, std::uint64_t>;
  static constexpr const char* kName = detail::kFixedName<kBits - F, F>.text;
  static constexpr std::uint32_t kId = 2u << 16 | unsigned(kBits) << 8 | unsigned(F);
  static constexpr bool kExact = true;
};

template <class S> using Unit = typename ScalarTraits<S>::Unit;
template <class S> using Velocity = typename ScalarTraits<S>::Velocity;
template <class S> using Step = typename ScalarTraits<S>::Step;
template <class S> using RawBits = typename ScalarTraits<S>::Raw;

template <class S> inline constexpr bool kIsFixed = ScalarTraits<S>::kExact;

// float and double, as fixed point sees them: sums and roundings are the number itself.
template <std::floating_point S> ISO_INLINE constexpr S product(S a, S b) { return a * b; }
template <class Out, std::floating_point S> ISO_INLINE constexpr Out round_to(S sum) { return sum; }
template <class Sum, std::floating_point S> ISO_INLINE constexpr Sum widen(S a) { return a; }
template <class Out, std::floating_point S> ISO_INLINE constexpr Out divide_to(S a, S b) { return a / b; }

/// The exact sum of products of two S.
template <class S> using Sum = decltype(product(S{}, S{}));
/// The exact sum of products of a length and a direction.
template <class A, class B> using SumOf = decltype(product(A{}, B{}));

template <class S>
concept Scalar = requires(S a, Unit<S> u, Step<S> h) {
  { a + a } -> std::same_as<S>;
  { a - a } -> std::same_as<S>;
  { -a } -> std::same_as<S>;
  { a* a } -> std::same_as<S>;
  { a / a } -> std::same_as<S>;
  { a* u } -> std::same_as<S>;
  { a* h } -> std::same_as<S>;
  { a < a } -> std::same_as<bool>;
  { round_to<S>(product(a, a)) } -> std::same_as<S>;
  S(1);
};

namespace detail {
/// A comparison that the compiler cannot see behind. clang before 17 turns `x < 0 ? 0 : x` into IEEE 754's maximum, for
/// which +0 is above -0, where the target has one (64-bit Arm, WebAssembly) and one side is known to be no NaN. The
/// maximum of x86 decides as the comparison does.
template <class S> ISO_INLINE constexpr bool decided(bool less) {
#if defined(__clang__) && !defined(__x86_64__) && !defined(__i386__)
  if constexpr (std::floating_point<S>) {
    if (!std::is_constant_evaluated()) __asm__("" : "+r"(less));
  }
#endif
  return less;
}
}  // namespace detail

// One result on every machine: min and max by comparison (never fmin), abs by negation. Of equals the first, so that
// max(-0.0, 0.0) is -0.0.
template <class S> ISO_INLINE constexpr S min(S a, S b) { return detail::decided<S>(b < a) ? b : a; }
template <class S> ISO_INLINE constexpr S max(S a, S b) { return detail::decided<S>(a < b) ? b : a; }
template <class S> ISO_INLINE constexpr S clamp(S x, S low, S high) { return min(max(x, low), high); }
template <class S> ISO_INLINE constexpr S abs(S a) { return a < S(0) ? -a : a; }
/// Gives the bits of the generic one (-0.0 and NaN keep their signs), as a maximum that compiles to no branch.
template <std::floating_point S> ISO_INLINE constexpr S abs(S a) { return a < -a ? -a : a; }

/// Converts a to the format of Out: exact if Out is finer and has room, else rounded to nearest.
template <class Out, class S> ISO_INLINE constexpr Out convert(S a) {
  if constexpr (std::same_as<Out, S>) {
    return a;
  } else {
    return round_to<Out>(product(a, Fixed<typename S::Raw, 1, S::kPolicy>::from_raw(2)));
  }
}

/// Converts an exact sum by round_to, but what lies beyond the format becomes its end; float and double go to infinity.
template <class Out, class Total> ISO_INLINE constexpr Out saturate_to(Total sum) {
  if constexpr (kIsFixed<Out>) {
    const Total most = widen<Total>(Out::highest());
    return most < sum ? Out::highest() : sum < -most ? -Out::highest() : round_to<Out>(sum);
  } else {
    return sum;
  }
}
/// Returns a + b, held at the ends of a fixed-point format instead of wrapping.
template <class S> ISO_INLINE constexpr S saturating_add(S a, S b) {
  if constexpr (kIsFixed<S>) {
    using Unsigned = RawBits<S>;
    const auto sum = static_cast<typename S::Raw>(static_cast<Unsigned>(a.raw()) + static_cast<Unsigned>(b.raw()));
    if (((a.raw() ^ sum) & (b.raw() ^ sum)) >= 0) return S::from_raw(sum);
    return a.raw() < 0 ? S::lowest() : S::highest();
  } else {
    return a + b;
  }
}
/// Returns a - b in the same way, for any b: the lowest number has no negative.
template <class S> ISO_INLINE constexpr S saturating_subtract(S a, S b) {
  if constexpr (kIsFixed<S>) {
    using Unsigned = RawBits<S>;
    const auto rest = static_cast<typename S::Raw>(static_cast<Unsigned>(a.raw()) - static_cast<Unsigned>(b.raw()));
    if (((a.raw() ^ b.raw()) & (a.raw() ^ rest)) >= 0) return S::from_raw(rest);
    return a.raw() < 0 ? S::lowest() : S::highest();
  } else {
    return a - b;
  }
}

/// Returns the bits of a, for hashes, files and exact comparison.
template <class S> ISO_INLINE constexpr RawBits<S> to_bits(S a) {
  if constexpr (kIsFixed<S>) return static_cast<RawBits<S>>(a.raw());
  if constexpr (!kIsFixed<S>) return __builtin_bit_cast(RawBits<S>, a);
}
template <class S> ISO_INLINE constexpr S from_bits(RawBits<S> bits) {
  if constexpr (kIsFixed<S>) return S::from_raw(static_cast<typename S::Raw>(bits));
  if constexpr (!kIsFixed<S>) return __builtin_bit_cast(S, bits);  // std::bit_cast would be a weak symbol at -O0
}

/// Returns true if a is neither NaN nor infinite; fixed point always is. By bits, so no compiler option changes it.
template <class S> ISO_INLINE constexpr bool is_finite(S a) {
  if constexpr (std::same_as<S, float>) return (to_bits(a) & 0x7f800000u) != 0x7f800000u;
  if constexpr (std::same_as<S, double>) return (to_bits(a) & 0x7ff0000000000000u) != 0x7ff0000000000000u;
  return true;
}

namespace detail {
/// Returns 2^exponent, for constants: as code, it made reading a frame's poses in Q32.32 forty times slower.
ISO_INLINE constexpr double power_of_two(int exponent) {
  double power = 1;
  for (int i = 0; i < exponent; ++i) power *= 2;
  for (int i = 0; i > exponent; --i) power *= 0.5;
  return power;
}
}  // namespace detail

/// Converts for people, files of measurements and pictures. Never feed the result back into a simulation.
template <class S> ISO_INLINE constexpr double to_double(S a) {
  if constexpr (kIsFixed<S>) {
    constexpr double unit = detail::power_of_two(-S::kFracBits);
    return static_cast<double>(a.raw()) * unit;
  } else {
    return static_cast<double>(a);
  }
}
/// Returns the S nearest to a run-time double, ties away from zero; outside the range the nearest end, 0 for a NaN. It
/// is for tools and tests: two machines that computed different doubles get different simulations.
template <class S> ISO_INLINE constexpr S from_double(double value) {
  if constexpr (kIsFixed<S>) {
    constexpr double units = detail::power_of_two(S::kFracBits), limit = S::kBits == 32 ? 0x1p31 : 0x1p63;
    const double scaled = value * units;
    if (!(scaled == scaled)) return S::from_raw(0);
    if (scaled >= limit - 0.5) return S::highest();
    if (scaled <= -limit) return S::lowest();
    const double size = scaled < 0 ? -scaled : scaled;
    auto whole = static_cast<std::int64_t>(size);
    if (size - static_cast<double>(whole) >= 0.5) ++whole;
    return S::from_raw(static_cast<typename S::Raw>(scaled < 0 ? -whole : whole));
  } else {
    return static_cast<S>(value);
  }
}

/// The largest number of the format.
template <class S> ISO_INLINE constexpr S highest() {
  if constexpr (kIsFixed<S>) return S::highest();
  if constexpr (std::same_as<S, float>) return 0x1.fffffep127f;
  if constexpr (std::same_as<S, double>) return 0x1.fffffffffffffp1023;
}

/// The smallest positive step of the format: one raw unit, or the machine epsilon.
template <class S> ISO_INLINE constexpr S resolution() {
  if constexpr (kIsFixed<S>) return S::from_raw(1);
  if constexpr (!kIsFixed<S>) {
    constexpr S kEpsilon = std::numeric_limits<S>::epsilon();
    return kEpsilon;
  }
}

/// Returns the greatest distance of neighbouring numbers of this size; sizes below one count as one.
template <class S> ISO_INLINE constexpr S spacing_at(S size) {
  if constexpr (kIsFixed<S>) return resolution<S>();
  if constexpr (!kIsFixed<S>) return resolution<S>() * max(size, S(1));
}
/// Returns the error that one rounding of a number of this size may leave, also for sizes below one.
template <class S> ISO_INLINE constexpr S rounding_at(S size) {
  if constexpr (kIsFixed<S>) return resolution<S>();
  if constexpr (!kIsFixed<S>) return resolution<S>() * size;
}

}  // namespace isostep
