// The common part of the tests of elementary functions: MPFR as oracle, errors in ulp, arguments of every magnitude.
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>
#include <mpfr.h>

#include <cstdint>
#include <limits>
#include <string>

#include "isostep/scalar/scalar.hpp"
#include "random/splitmix64.hpp"

#if !defined(ISOSTEP_MATH_SAMPLES)
#define ISOSTEP_MATH_SAMPLES 6000  // per function and scalar; the README's figures are from 200000
#endif

namespace isostep {
namespace {

/// A real number of 200 bits.
class Real {
 public:
  Real() { mpfr_init2(value_, 200); }
  Real(const Real&) = delete;
  Real& operator=(const Real&) = delete;
  ~Real() { mpfr_clear(value_); }
  operator mpfr_ptr() { return value_; }

 private:
  mpfr_t value_;
};

template <class S> void set(mpfr_ptr out, S value) {
  if constexpr (kIsFixed<S>) mpfr_set_si_2exp(out, value.raw(), -S::kFracBits, MPFR_RNDN);
  if constexpr (!kIsFixed<S>) mpfr_set_d(out, static_cast<double>(value), MPFR_RNDN);
}
template <class S> S get(mpfr_ptr value) {
  if constexpr (kIsFixed<S>) {
    Real scaled;
    mpfr_mul_2si(scaled, value, S::kFracBits, MPFR_RNDN);
    return S::from_raw(static_cast<typename S::Raw>(mpfr_get_si(scaled, MPFR_RNDN)));
  } else if constexpr (sizeof(S) == 4) {
    return mpfr_get_flt(value, MPFR_RNDN);
  } else {
    return mpfr_get_d(value, MPFR_RNDN);
  }
}

/// |got - want| in units of the last place of `want`; a want outside a fixed format counts as +-highest().
/// Below 2^floor the unit of a float stays that of 2^floor.
template <class S> double ulp_error(S got, mpfr_ptr want, int floor = -100000) {
  Real g;
  set(g, got);
  int ulp = 0;
  if constexpr (kIsFixed<S>) {
    Real end;
    set(end, S::highest());
    if (mpfr_cmpabs(want, end) > 0) mpfr_copysign(want, end, want, MPFR_RNDN);
    ulp = -S::kFracBits;
  } else {
    const int digits = std::numeric_limits<S>::digits;
    const int least = std::numeric_limits<S>::min_exponent - digits;
    if (mpfr_zero_p(want)) return got == S(0) ? 0 : 1e9;
    ulp = static_cast<int>(mpfr_get_exp(want)) - digits;
    if (ulp < least) ulp = least;
    if (ulp < floor - digits + 1) ulp = floor - digits + 1;
  }
  mpfr_sub(g, g, want, MPFR_RNDN);
  mpfr_mul_2si(g, g, -ulp, MPFR_RNDN);
  const double error = mpfr_get_d(g, MPFR_RNDN);
  return error < 0 ? -error : error;
}

class Random {  // splitmix64
 public:
  std::uint64_t bits() { return test::splitmix64(state_); }
  int below(int n) { return static_cast<int>(bits() % static_cast<unsigned>(n)); }

 private:
  std::uint64_t state_ = 20240229;
};

/// Magnitudes spread over all of the format: random bits shifted for fixed point, random exponents for float.
template <class S> S any_of(Random& random, int low = -60, int high = 60) {
  if constexpr (kIsFixed<S>) {
    const auto raw = static_cast<typename S::Raw>(random.bits());
    return S::from_raw(static_cast<typename S::Raw>(raw >> random.below(S::kBits - 1)));
  } else {
    double value = 1 + static_cast<double>(random.bits() >> 12) * 0x1p-52;
    for (int k = low + random.below(high - low + 1); k != 0; k += k < 0 ? 1 : -1) value *= k < 0 ? 0.5 : 2;
    return static_cast<S>(random.below(2) != 0 ? -value : value);
  }
}
template <class S> S nudged(S a, int steps) {
  return from_bits<S>(static_cast<RawBits<S>>(to_bits(a) + static_cast<RawBits<S>>(steps)));
}

class Worst {
 public:
  void see(double error) { worst_ = error > worst_ ? error : worst_; }
  ~Worst() { ::testing::Test::RecordProperty(name_, std::to_string(worst_)); }
  explicit Worst(const char* name) : name_(name) {}
  double ulp() const { return worst_; }

 private:
  const char* name_;
  double worst_ = 0;
};

}  // namespace
}  // namespace isostep
