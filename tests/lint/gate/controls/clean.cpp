// A control that the gate must let pass: two roundings where two operations are written, exact integers, conversions.
// SPDX-License-Identifier: MIT
#include <cstdint>

double multiply_and_add(double a, double b, double c) { return a * b + c; }
float multiply_and_subtract(float a, float b, float c) { return c - a * b; }
std::int64_t of_integers(std::int64_t a, std::int64_t b, std::int64_t c) { return a * b + c; }
std::int32_t of_short_integers(std::int32_t a, std::int32_t b, std::int32_t c) { return c - a * b; }
std::int64_t quotient(std::int64_t a, std::int64_t b) { return a / b; }
void of_vectors(std::int32_t* a, const std::int32_t* b, const std::int32_t* c) {
  for (int i = 0; i < 64; ++i) a[i] += b[i] * c[i];
}
double from_integer(std::int64_t a) { return static_cast<double>(a); }
float from_short_integer(std::int32_t a) { return static_cast<float>(a); }
std::int64_t to_integer(double a) { return static_cast<std::int64_t>(a); }
