// A control that the gate must see, by -ffp-contract=fast and on an instruction set that can: products and sums in one.
// SPDX-License-Identifier: MIT
#if defined(__wasm__)
#define CAN_FUSE __attribute__((target("simd128,relaxed-simd")))
#elif defined(__x86_64__) || defined(__i386__)
#define CAN_FUSE __attribute__((target("fma")))
#elif defined(__arm__) && !defined(__clang__)
#define CAN_FUSE __attribute__((target("fpu=neon-vfpv4")))
#else
#define CAN_FUSE
#endif

#if defined(__wasm__)
// Nothing in WebAssembly fuses but the relaxed operations, which no compiler makes of a * b + c.
using Four = float __attribute__((vector_size(16)));
#if __clang_major__ >= 16  // __has_builtin asks for the file's own features, not the function's
CAN_FUSE Four fused_vector(Four a, Four b, Four c) { return __builtin_wasm_relaxed_madd_f32x4(a, b, c); }
#else
CAN_FUSE Four fused_vector(Four a, Four b, Four c) { return __builtin_wasm_fma_f32x4(a, b, c); }
#endif
#else
CAN_FUSE double fused_add(double a, double b, double c) { return a * b + c; }
CAN_FUSE double fused_subtract(double a, double b, double c) { return a * b - c; }
CAN_FUSE float fused_negative(float a, float b, float c) { return c - a * b; }
#endif
