// The body kernels over AVX-512 lanes: compiled with that instruction set, called only where the processor has it.
// SPDX-License-Identifier: MIT
#include "isostep/dynamics/solvers/body_kernel.inl"
#if defined(__AVX512F__) && defined(__AVX512DQ__) && defined(__AVX512VL__)
#include "isostep/scalar/lanes_avx512.hpp"
#define ISO_AVX512_TABLE(S)                             \
  ISO_DEFINE_KERNEL_TABLE(BodyKernels<S>, Simd::avx512, \
                          make_body_kernels<S, kRegisterLanes<S, isa::Avx512>, isa::Avx512>("avx512"))
#else
#define ISO_AVX512_TABLE(S) ISO_NO_KERNEL_TABLE(BodyKernels<S>, Simd::avx512)
#endif

namespace isostep {

ISO_FOR_EACH_SCALAR(ISO_AVX512_TABLE)

}  // namespace isostep
