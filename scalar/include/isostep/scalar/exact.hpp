// Exact<float>, Exact<double>: IEEE numbers whose operations no compiler option fuses, for code that is not ours.
// SPDX-License-Identifier: MIT
#pragma once

#include <compare>
#include <concepts>
#include <limits>

#include "isostep/scalar/math.hpp"

#if defined(__GNUC__)
#define ISO_MAY_ALIAS __attribute__((may_alias))
#else
#define ISO_MAY_ALIAS
#endif

namespace isostep {

namespace detail {
/// Returns x, but hides that from the compiler, so a product is rounded before it is added. It costs no instruction
/// where there is a constraint for the register file; wasm has no scalar fma to form.
template <std::floating_point T> ISO_INLINE constexpr T opaque(T x) {
  if (__builtin_is_constant_evaluated()) return x;
#if defined(__GNUC__) && (defined(__x86_64__) || defined(__SSE2__))
  __asm__("" : "+x"(x));
#elif defined(__GNUC__) && (defined(__aarch64__) || defined(__arm64ec__))
  __asm__("" : "+w"(x));
#elif defined(__GNUC__) && (defined(__riscv_flen) || defined(__s390x__))
  __asm__("" : "+f"(x));
#elif defined(__GNUC__) && defined(__powerpc64__)
  __asm__("" : "+d"(x));
#elif !defined(__wasm__)
  volatile T kept = x;
  x = kept;
#endif
  return x;
}
}  // namespace detail

/// Each operator is one IEEE operation, rounded by itself, whatever -mfma, -ffp-contract=fast or the vectoriser would
/// do. Laid out as a bare T and allowed to alias it, so an array of T can be mapped as one of Exact<T>.
template <std::floating_point T> class ISO_MAY_ALIAS Exact {
 public:
  Exact() = default;
  /// Converts whole numbers and T implicitly, so that 2 * x and x * 0.5f are what they look like; for Exact<float> a
  /// double is rounded once, as `float y = 0.1;` would.
  template <class N>
  requires(std::integral<N> || std::floating_point<N>) ISO_INLINE constexpr Exact(N value)
      : value_(static_cast<T>(value)) {}

  ISO_INLINE constexpr T value() const { return value_; }
  template <class N>
  requires(std::integral<N> || std::floating_point<N>) ISO_INLINE constexpr explicit operator N() const {
    return static_cast<N>(value_);
  }

  friend ISO_INLINE constexpr Exact operator+(Exact a, Exact b) { return Exact(a.value_ + b.value_); }
  friend ISO_INLINE constexpr Exact operator-(Exact a, Exact b) { return Exact(a.value_ - b.value_); }
  friend ISO_INLINE constexpr Exact operator*(Exact a, Exact b) { return Exact(detail::opaque(a.value_ * b.value_)); }
  friend ISO_INLINE constexpr Exact operator/(Exact a, Exact b) { return Exact(a.value_ / b.value_); }
  friend ISO_INLINE constexpr Exact operator-(Exact a) { return Exact(-a.value_); }
  friend ISO_INLINE constexpr Exact operator+(Exact a) { return a; }
  ISO_INLINE constexpr Exact& operator+=(Exact b) { return *this = *this + b; }
  ISO_INLINE constexpr Exact& operator-=(Exact b) { return *this = *this - b; }
  ISO_INLINE constexpr Exact& operator*=(Exact b) { return *this = *this * b; }
  ISO_INLINE constexpr Exact& operator/=(Exact b) { return *this = *this / b; }

  friend ISO_INLINE constexpr bool operator==(Exact a, Exact b) { return a.value_ == b.value_; }
  friend ISO_INLINE constexpr std::partial_ordering operator<=>(Exact a, Exact b) { return a.value_ <=> b.value_; }

 private:
  T value_;
};

template <class T> ISO_INLINE constexpr Exact<T> abs(Exact<T> a) {
  const T x = a.value();
  return x < T(0) ? -x : x + T(0);  // + 0 turns -0 into 0
}
template <class T> ISO_INLINE constexpr Exact<T> min(Exact<T> a, Exact<T> b) { return min(a.value(), b.value()); }
template <class T> ISO_INLINE constexpr Exact<T> max(Exact<T> a, Exact<T> b) { return max(a.value(), b.value()); }
// Single instructions or integer arithmetic compiled in the library: nothing to fuse.
template <class T> ISO_INLINE Exact<T> sqrt(Exact<T> a) { return isostep::sqrt(a.value()); }
template <class T> ISO_INLINE Exact<T> sin(Exact<T> a) { return isostep::sin(a.value()); }
template <class T> ISO_INLINE Exact<T> cos(Exact<T> a) { return isostep::cos(a.value()); }
template <class T> ISO_INLINE Exact<T> asin(Exact<T> a) { return isostep::asin(a.value()); }
template <class T> ISO_INLINE Exact<T> acos(Exact<T> a) { return isostep::acos(a.value()); }
template <class T> ISO_INLINE Exact<T> atan2(Exact<T> y, Exact<T> x) { return isostep::atan2(y.value(), x.value()); }
template <class T> ISO_INLINE Exact<T> exp(Exact<T> a) { return isostep::exp(a.value()); }
template <class T> ISO_INLINE Exact<T> log(Exact<T> a) { return isostep::log(a.value()); }
template <class T> ISO_INLINE constexpr bool is_finite(Exact<T> a) { return is_finite(a.value()); }
template <class T> ISO_INLINE constexpr double to_double(Exact<T> a) { return static_cast<double>(a.value()); }

}  // namespace isostep

template <class T> class std::numeric_limits<isostep::Exact<T>> : public std::numeric_limits<T> {
  using Number = isostep::Exact<T>;
  using Base = std::numeric_limits<T>;

 public:
  static constexpr Number min() noexcept { return Base::min(); }
  static constexpr Number max() noexcept { return Base::max(); }
  static constexpr Number lowest() noexcept { return Base::lowest(); }
  static constexpr Number epsilon() noexcept { return Base::epsilon(); }
  static constexpr Number round_error() noexcept { return Base::round_error(); }
  static constexpr Number infinity() noexcept { return Base::infinity(); }
  static constexpr Number quiet_NaN() noexcept { return Base::quiet_NaN(); }
  static constexpr Number signaling_NaN() noexcept { return Base::signaling_NaN(); }
  static constexpr Number denorm_min() noexcept { return Base::denorm_min(); }
};
