// Kernels built with -O3 -mfma -ffp-contract=fast. No test framework here: its inline functions would carry the flags
// along.
// SPDX-License-Identifier: MIT
#include "exact_fma_kernels.hpp"

#include "isostep/scalar/exact.hpp"

namespace isostep::test {
namespace {

template <class Sums, class T> ISO_INLINE Sums sums(T a, T b, T c) {
  const Exact<T> x = a, y = b, z = c;
  const Exact<T> product = x * y;
  return {(x * y + z).value(), (x * y - z).value(), (z - x * y).value(), (product + (product + z)).value()};
}

}  // namespace

float bare_float(float a, float b, float c) { return a * b + c; }
double bare_double(double a, double b, double c) { return a * b + c; }
FloatSums exact_float(float a, float b, float c) { return sums<FloatSums>(a, b, c); }
DoubleSums exact_double(double a, double b, double c) { return sums<DoubleSums>(a, b, c); }

void rotate_exact(const double* x, const double* y, double c, double s, double* out, int n) {
  const Exact<double> cosine = c, sine = s;
  for (int i = 0; i < n; ++i) {
    const Exact<double> a = x[i], b = y[i];
    out[2 * i] = (a * cosine - b * sine).value();
    out[2 * i + 1] = (a * sine + b * cosine).value();
  }
}

}  // namespace isostep::test
