// The pair kernels over AVX2 lanes: compiled with -mavx2, called only where the processor has it.
// SPDX-License-Identifier: MIT
#include "isostep/collision/narrowphase/pair_kernel.inl"
#if defined(__AVX2__)
#include "isostep/scalar/lanes_avx2.hpp"
#define ISO_AVX2_TABLE(S, BOXES)                      \
  ISO_DEFINE_KERNEL_TABLE(PairKernels<S>, Simd::avx2, \
                          make_pair_kernels<S, kRegisterLanes<S, isa::Avx2>, isa::Avx2, BoxWork::BOXES>())
#else
#define ISO_AVX2_TABLE(S, BOXES) ISO_NO_KERNEL_TABLE(PairKernels<S>, Simd::avx2)
#endif
#define ISO_AVX2_POLYGONS(S) ISO_AVX2_TABLE(S, polygons)
#define ISO_AVX2_AXES(S) ISO_AVX2_TABLE(S, axes)
#define ISO_AVX2_ALONE(S) ISO_AVX2_TABLE(S, alone)

namespace isostep {

ISO_IF_FLOAT(ISO_AVX2_POLYGONS)
ISO_IF_DOUBLE(ISO_AVX2_POLYGONS)
ISO_IF_Q16_16(ISO_AVX2_AXES)
ISO_IF_Q32_32(ISO_AVX2_ALONE)

}  // namespace isostep
