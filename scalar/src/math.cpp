// Compiles sin, cos, atan2, asin, acos, exp, log and power for the shipped scalars: the only copy a program holds.
// SPDX-License-Identifier: MIT
#include "isostep/scalar/math.inl"

namespace isostep {

#define ISO_FLOAT_MATH(S)                                     \
  S sin(S x) { return detail::sin_float(x); }                 \
  S cos(S x) { return detail::cos_float(x); }                 \
  SinCos<S> sin_cos(S x) { return detail::sin_cos_float(x); } \
  S atan2(S y, S x) { return detail::atan2_float(y, x); }     \
  S asin(S x) { return detail::asin_float(x); }               \
  S acos(S x) { return detail::acos_float(x); }               \
  S exp(S x) { return detail::exp_float(x); }                 \
  S log(S x) { return detail::log_float(x); }                 \
  S power(S base, S exponent) { return detail::power_float(base, exponent); }
ISO_FLOAT_MATH(float)
ISO_FLOAT_MATH(double)
#undef ISO_FLOAT_MATH

ISO_SCALAR_MATH(, Q16_16)
ISO_SCALAR_MATH(, Q32_32)

}  // namespace isostep
