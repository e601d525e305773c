// Sums of products compiled with -mfma -ffp-contract=fast: what a user's own flags may do to code around the library.
// SPDX-License-Identifier: MIT
#pragma once

namespace isostep::test {

/// a b + c over T itself: the control, which is expected to fuse.
float bare_float(float a, float b, float c);
double bare_double(double a, double b, double c);
/// The sums, over Exact<T> too, in every shape that a compiler fuses: a b + c, a b - c, c - a b, and through variables.
struct FloatSums {
  float plus, minus, from, twice;
};
struct DoubleSums {
  double plus, minus, from, twice;
};
FloatSums exact_float(float a, float b, float c);
DoubleSums exact_double(double a, double b, double c);
/// The rotation (x c - y s, x s + y c) of n points, a loop that gcc's vectoriser fuses in spite of -ffp-contract=off.
void rotate_exact(const double* x, const double* y, double c, double s, double* out, int n);

}  // namespace isostep::test
