// The user's side of the linker trap, compiled with -mfma, without inlining, and linked first: the linker keeps its
// copies of whatever inline functions both sides left behind. Exits 0 when the trap is real and does not catch our
// headers.
// SPDX-License-Identifier: MIT
#include <cstdio>

#include "engine.hpp"
#include "plain.hpp"

namespace {

volatile float a = 1 + 0x1p-12f, b = 1 + 0x1p-12f, c = -(1 + 0x1p-11f);
constexpr float kFused = 0x1p-24f;  // a b + c = 2^-24 exactly; rounded after the product it is 0

int check(const char* what, float value, float expected) {
  std::printf("%-28s %a, expected %a\n", what, static_cast<double>(value), static_cast<double>(expected));
  return value == expected ? 0 : 1;
}

}  // namespace

int main() {
  if (!__builtin_cpu_supports("fma")) return 77;
  int wrong = check("plain header, user", plain_multiply_add(a, b, c), kFused);
  wrong += check("plain header, engine: caught", engine_plain(a, b, c), kFused);

  const Sums user = sums_of(a, b, c);
  wrong += check("our headers, user", user.dot == kFused || user.dot == 0 ? kFused : user.dot, kFused);
  const Sums engine = engine_ours(a, b, c);
  wrong += check("our headers, engine: product", engine.product, 0);
  wrong += check("dot", engine.dot, 0);
  wrong += check("cross", engine.cross, 0);
  wrong += check("matrix", engine.matrix, 0);
  wrong += check("quaternion", engine.quat, 0);
  return wrong;
}
