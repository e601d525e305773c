// A control that the symbol test must see: inline functions of ours that stay functions at -O0.
// SPDX-License-Identifier: MIT
#include <algorithm>

namespace isostep {
inline float leaky(float a) {
  const auto twice = [](float x) { return x + x; };
  return twice(a);
}
struct Leaky {
  float value;
  Leaky();
};
inline Leaky::Leaky() : value(leaky(1) * leaky(2)) {}
}  // namespace isostep

float call_leaky() { return isostep::leaky(1) + isostep::Leaky().value; }
