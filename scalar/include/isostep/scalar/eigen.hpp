// Eigen over our scalars: fixed point and Exact as matrix entries. Conversions of vectors: isostep/math/eigen.hpp.
// SPDX-License-Identifier: MIT
#pragma once

// Eigen has no packets for these scalars, so its results are those of its plain loops whatever EIGEN_DONT_VECTORIZE,
// -mavx or -mfma say. Over raw float and double they are not: packets sum in another order and fuse by intrinsics.
// Fixed wraps where Eigen expects infinity. Measured sound with room to spare in the format: everything in the list of
// tests/unit/scalar/eigen_test.cpp. 3 x 3 inverse and determinant need the cube of the entries' range.
// Where results are to agree between machines, Eigen gets Exact<float>, Exact<double> or Fixed, never float or double.

#include <Eigen/Core>
#include <concepts>
#include <cstdlib>
#include <iosfwd>
#include <limits>

#include "isostep/scalar/exact.hpp"
#include "isostep/scalar/fixed.hpp"
#include "isostep/scalar/literal.hpp"
#include "isostep/scalar/math.hpp"
#include "isostep/scalar/text.hpp"

namespace isostep {

namespace detail {
template <class T> inline constexpr bool kIsFixedType = false;
template <class Rep, int F, Overflow P> inline constexpr bool kIsFixedType<Fixed<Rep, F, P>> = true;
template <class T> inline constexpr bool kIsExactType = false;
template <class T> inline constexpr bool kIsExactType<Exact<T>> = true;
}  // namespace detail

template <class D>
concept FixedExpression = detail::kIsFixedType<typename D::Scalar>;

// m * 0.5 in source code: the constant is rounded to the scalar, as a literal is. A double known only at run time
// does not compile, see promote_scalar_arg below.
template <class D>
requires FixedExpression<D> ISO_INLINE auto operator*(const Eigen::DenseBase<D>& m, Literal constant) {
  return m.derived() * from_literal<typename D::Scalar>(constant);
}
template <class D>
requires FixedExpression<D> ISO_INLINE auto operator*(Literal constant, const Eigen::DenseBase<D>& m) {
  return from_literal<typename D::Scalar>(constant) * m.derived();
}
template <class D>
requires FixedExpression<D> ISO_INLINE auto operator/(const Eigen::DenseBase<D>& m, Literal constant) {
  return m.derived() / from_literal<typename D::Scalar>(constant);
}

// Eigen writes 2 * epsilon(): a whole multiple, exact while it fits.
template <std::integral I, class Rep, int F, Overflow P>
ISO_INLINE constexpr Fixed<Rep, F, P> operator*(I n, Fixed<Rep, F, P> a) {
  using S = Fixed<Rep, F, P>;
  return S::from_raw(S::narrow(Wide<Rep>(a.raw()) * Wide<Rep>(static_cast<std::int64_t>(n))));
}
template <std::integral I, class Rep, int F, Overflow P>
ISO_INLINE constexpr Fixed<Rep, F, P> operator*(Fixed<Rep, F, P> a, I n) {
  return n * a;
}

// Eigen finds these by argument-dependent lookup beside the functions of scalar.hpp, math.hpp and exact.hpp. It looks
// for min and max in std too, where they are as good a match as those of scalar.hpp; these are better ones.
template <class Rep, int F, Overflow P>
ISO_INLINE constexpr Fixed<Rep, F, P> min(Fixed<Rep, F, P> a, Fixed<Rep, F, P> b) {
  return b < a ? b : a;
}
template <class Rep, int F, Overflow P>
ISO_INLINE constexpr Fixed<Rep, F, P> max(Fixed<Rep, F, P> a, Fixed<Rep, F, P> b) {
  return a < b ? b : a;
}
template <class Rep, int F, Overflow P> ISO_INLINE constexpr Fixed<Rep, F, P> abs2(Fixed<Rep, F, P> a) { return a * a; }
template <class T> ISO_INLINE constexpr Exact<T> abs2(Exact<T> a) { return a * a; }
template <class Rep, int F, Overflow P> ISO_INLINE constexpr bool isfinite(Fixed<Rep, F, P>) { return true; }
template <class Rep, int F, Overflow P> ISO_INLINE constexpr bool isinf(Fixed<Rep, F, P>) { return false; }
template <class Rep, int F, Overflow P> ISO_INLINE constexpr bool isnan(Fixed<Rep, F, P>) { return false; }
template <class T> ISO_INLINE constexpr bool isfinite(Exact<T> a) { return is_finite(a); }
template <class T> ISO_INLINE constexpr bool isnan(Exact<T> a) { return !(a == a); }
template <class T> ISO_INLINE constexpr bool isinf(Exact<T> a) { return !is_finite(a) && a == a; }

template <class T> ISO_INLINE std::ostream& operator<<(std::ostream& out, Exact<T> value) {
  detail::write_text(out, to_text(value.value()));
  return out;
}

}  // namespace isostep

/// Limits as of an integer type, except `min`: Eigen's algorithms use it as "too small to divide by", so it is the
/// smallest positive number, one raw unit. The lowest number is in `lowest`. There is no infinity; the highest number
/// stands for it.
template <class Rep, int F, isostep::Overflow P> class std::numeric_limits<isostep::Fixed<Rep, F, P>> {
  using Number = isostep::Fixed<Rep, F, P>;

 public:
  static constexpr bool is_specialized = true;
  static constexpr bool is_signed = true;
  static constexpr bool is_integer = false;
  static constexpr bool is_exact = true;
  static constexpr bool is_bounded = true;
  static constexpr bool is_modulo = P == isostep::Overflow::wrap;
  static constexpr bool has_infinity = false;
  static constexpr bool has_quiet_NaN = false;
  static constexpr bool has_signaling_NaN = false;
  static constexpr bool is_iec559 = false;
  static constexpr bool traps = P == isostep::Overflow::trap;
  static constexpr bool tinyness_before = false;
  static constexpr std::float_round_style round_style = std::round_to_nearest;
  static constexpr int radix = 2;
  static constexpr int digits = Number::kBits - 1;
  static constexpr int digits10 = digits * 301 / 1000;
  static constexpr int max_digits10 = digits10 + 2;
  static constexpr int min_exponent = 1 - F;
  static constexpr int max_exponent = Number::kBits - 1 - F;
  static constexpr int min_exponent10 = min_exponent * 301 / 1000;
  static constexpr int max_exponent10 = max_exponent * 301 / 1000;
  static constexpr Number min() noexcept { return Number::from_raw(1); }
  static constexpr Number max() noexcept { return Number::highest(); }
  static constexpr Number lowest() noexcept { return Number::lowest(); }
  static constexpr Number epsilon() noexcept { return Number::from_raw(1); }
  static constexpr Number round_error() noexcept { return Number::from_raw(F > 0 ? Rep{1} << (F - 1) : 0); }
  static constexpr Number denorm_min() noexcept { return Number::from_raw(1); }
  static constexpr Number infinity() noexcept { return Number::highest(); }
  static constexpr Number quiet_NaN() noexcept { return Number::from_raw(0); }
  static constexpr Number signaling_NaN() noexcept { return Number::from_raw(0); }
};

namespace Eigen {

template <class Rep, int F, isostep::Overflow P>
struct NumTraits<isostep::Fixed<Rep, F, P>> : GenericNumTraits<isostep::Fixed<Rep, F, P>> {
  enum { RequireInitialization = 0, ReadCost = 1, AddCost = 1, MulCost = sizeof(Rep) == 4 ? 2 : 4 };
  /// The rounding noise that Eigen's algorithms expect: an entry of a decomposition is a few products, each rounded to
  /// half a raw unit.
  static constexpr isostep::Fixed<Rep, F, P> epsilon() { return isostep::Fixed<Rep, F, P>::from_raw(8); }
  /// Its square is still a raw unit, which is what isApprox compares with.
  static constexpr isostep::Fixed<Rep, F, P> dummy_precision() {
    return isostep::Fixed<Rep, F, P>::from_raw(Rep{1} << (F - F / 2));
  }
  static constexpr isostep::Fixed<Rep, F, P> lowest() { return isostep::Fixed<Rep, F, P>::lowest(); }
};

template <class T> struct NumTraits<isostep::Exact<T>> : GenericNumTraits<isostep::Exact<T>> {
  enum { RequireInitialization = 0, ReadCost = 1, AddCost = 1, MulCost = 1 };
  static constexpr isostep::Exact<T> dummy_precision() { return NumTraits<T>::dummy_precision(); }
};

namespace internal {

/// Eigen's operators take no floating-point number beside fixed point: it would become a Fixed at run time.
template <class Rep, int F, isostep::Overflow P> struct promote_scalar_arg<isostep::Fixed<Rep, F, P>, float, false> {};
template <class Rep, int F, isostep::Overflow P> struct promote_scalar_arg<isostep::Fixed<Rep, F, P>, double, false> {};

/// m.cast<double>() and m.cast<Exact<double>>() convert as to_double does, for people and tests.
template <class Rep, int F, isostep::Overflow P, class To>
requires(std::floating_point<To> || isostep::detail::kIsExactType<To>) struct cast_impl<isostep::Fixed<Rep, F, P>, To> {
  static ISO_INLINE To run(isostep::Fixed<Rep, F, P> x) { return static_cast<To>(isostep::to_double(x)); }
};
/// Converts to another format of the same width, rounded to nearest.
template <class Rep, int F, int G, isostep::Overflow P>
struct cast_impl<isostep::Fixed<Rep, F, P>, isostep::Fixed<Rep, G, P>> {
  static ISO_INLINE isostep::Fixed<Rep, G, P> run(isostep::Fixed<Rep, F, P> x) {
    return isostep::convert<isostep::Fixed<Rep, G, P>>(x);
  }
};

/// Random() is in [-1, 1]. Eigen's own would scale by RAND_MAX, which few formats hold.
template <class Rep, int F, isostep::Overflow P> struct random_default_impl<isostep::Fixed<Rep, F, P>, false, false> {
  using Number = isostep::Fixed<Rep, F, P>;
  static ISO_INLINE Number run() {
    std::uint64_t word = 0;
    for (int i = 0; i < 5; ++i) word = word << 15 ^ static_cast<std::uint64_t>(std::rand());
    const auto size = static_cast<Rep>(word >> 1 >> (63 - F));
    return Number::from_raw((word & 1u) != 0 ? -size : size);
  }
  static ISO_INLINE Number run(const Number& low, const Number& high) {
    const Number unit = (run() + Number(1)) / Number(2);
    return low + (high - low) * unit;
  }
};

}  // namespace internal
}  // namespace Eigen

#include "isostep/scalar/eigen_fixed.hpp"
