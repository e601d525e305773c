// The body kernels over SSE2 lanes, which every x86-64 has. Fixed point has no use for them: its wide products are
// faster one by one.
// SPDX-License-Identifier: MIT
#include "isostep/dynamics/solvers/body_kernel.inl"
#if defined(__SSE2__)
#include "isostep/scalar/lanes_sse2.hpp"
#define ISO_SSE2_TABLE(S)                             \
  ISO_DEFINE_KERNEL_TABLE(BodyKernels<S>, Simd::sse2, \
                          make_body_kernels<S, kRegisterLanes<S, isa::Sse2>, isa::Sse2>("sse2"))
#else
#define ISO_SSE2_TABLE(S) ISO_NO_KERNEL_TABLE(BodyKernels<S>, Simd::sse2)
#endif
#define ISO_NO_SSE2_TABLE(S) ISO_NO_KERNEL_TABLE(BodyKernels<S>, Simd::sse2)

namespace isostep {

ISO_IF_FLOAT(ISO_SSE2_TABLE)
ISO_IF_DOUBLE(ISO_SSE2_TABLE)
ISO_IF_Q16_16(ISO_NO_SSE2_TABLE)
ISO_IF_Q32_32(ISO_NO_SSE2_TABLE)

}  // namespace isostep
