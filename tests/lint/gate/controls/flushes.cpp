// A control that the gate must see on 32-bit Arm: Advanced SIMD, which takes subnormal numbers for zero.
// SPDX-License-Identifier: MIT
#include <arm_neon.h>
__attribute__((target("fpu=neon"))) float32x2_t sum(float32x2_t a, float32x2_t b) { return vadd_f32(a, b); }
