// The instruction sets of the processor.
// SPDX-License-Identifier: MIT
#include "isostep/core/simd.hpp"

namespace isostep {

bool processor_has(Simd simd) {
  switch (simd) {
#if defined(__x86_64__) || defined(__i386__)
    // These look at what the operating system saves of the registers (XCR0) too. Of AVX-512 the subsets that kernels
    // are compiled with: every processor with 64-bit products (DQ) has all three.
    case Simd::sse2: return __builtin_cpu_supports("sse2") != 0;
    case Simd::avx2: return __builtin_cpu_supports("avx2") != 0;
    case Simd::avx512:
      return __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512dq") != 0 &&
             __builtin_cpu_supports("avx512vl") != 0;
#else
    case Simd::sse2:
    case Simd::avx2:
    case Simd::avx512: return false;
#endif
#if !defined(__AARCH64EL__) || !defined(__ARM_NEON)
    case Simd::neon: return false;  // where the target has it, so does every processor
#endif
#if !defined(__wasm_simd128__)
    case Simd::wasm: return false;
#endif
    default: break;
  }
  return true;
}

}  // namespace isostep
