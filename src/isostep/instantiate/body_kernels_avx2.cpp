// The body kernels over AVX2 lanes: compiled with -mavx2, called only where the processor has it.
// SPDX-License-Identifier: MIT
#include "isostep/dynamics/solvers/body_kernel.inl"
#if defined(__AVX2__)
#include "isostep/scalar/lanes_avx2.hpp"
#define ISO_AVX2_TABLE(S)                             \
  ISO_DEFINE_KERNEL_TABLE(BodyKernels<S>, Simd::avx2, \
                          make_body_kernels<S, kRegisterLanes<S, isa::Avx2>, isa::Avx2>("avx2"))
#else
#define ISO_AVX2_TABLE(S) ISO_NO_KERNEL_TABLE(BodyKernels<S>, Simd::avx2)
#endif

namespace isostep {

ISO_FOR_EACH_SCALAR(ISO_AVX2_TABLE)

}  // namespace isostep
