// The pair kernels over SSE2 lanes, which every x86-64 has. Two doubles at once gain nothing; fixed point's wide
// products are faster one by one.
// SPDX-License-Identifier: MIT
#include "isostep/collision/narrowphase/pair_kernel.inl"
#if defined(__SSE2__)
#include "isostep/scalar/lanes_sse2.hpp"
#define ISO_SSE2_TABLE(S, BOXES)                      \
  ISO_DEFINE_KERNEL_TABLE(PairKernels<S>, Simd::sse2, \
                          make_pair_kernels<S, kRegisterLanes<S, isa::Sse2>, isa::Sse2, BoxWork::BOXES>())
#else
#define ISO_SSE2_TABLE(S, BOXES) ISO_NO_KERNEL_TABLE(PairKernels<S>, Simd::sse2)
#endif
#define ISO_SSE2_POLYGONS(S) ISO_SSE2_TABLE(S, polygons)
#define ISO_NO_SSE2_TABLE(S) ISO_NO_KERNEL_TABLE(PairKernels<S>, Simd::sse2)

namespace isostep {

ISO_IF_FLOAT(ISO_SSE2_POLYGONS)
ISO_IF_DOUBLE(ISO_NO_SSE2_TABLE)
ISO_IF_Q16_16(ISO_NO_SSE2_TABLE)
ISO_IF_Q32_32(ISO_NO_SSE2_TABLE)

}  // namespace isostep
