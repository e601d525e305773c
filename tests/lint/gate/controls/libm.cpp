// A control that the gate must see: a call of the C library's mathematics.
// SPDX-License-Identifier: MIT
#include <cmath>

double sine(double a) { return std::sin(a); }
float power(float a, float b) { return std::pow(a, b); }
