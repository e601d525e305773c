// The pair kernels over AVX-512 lanes: compiled with that instruction set, called only where the processor has it.
// SPDX-License-Identifier: MIT
#include "isostep/collision/narrowphase/pair_kernel.inl"
#if defined(__AVX512F__) && defined(__AVX512DQ__) && defined(__AVX512VL__)
#include "isostep/scalar/lanes_avx512.hpp"
#define ISO_AVX512_TABLE(S, BOXES)                      \
  ISO_DEFINE_KERNEL_TABLE(PairKernels<S>, Simd::avx512, \
                          make_pair_kernels<S, kRegisterLanes<S, isa::Avx512>, isa::Avx512, BoxWork::BOXES>())
#else
#define ISO_AVX512_TABLE(S, BOXES) ISO_NO_KERNEL_TABLE(PairKernels<S>, Simd::avx512)
#endif
#define ISO_AVX512_POLYGONS(S) ISO_AVX512_TABLE(S, polygons)
#define ISO_AVX512_AXES(S) ISO_AVX512_TABLE(S, axes)
#define ISO_AVX512_ALONE(S) ISO_AVX512_TABLE(S, alone)

namespace isostep {

ISO_IF_FLOAT(ISO_AVX512_POLYGONS)
ISO_IF_DOUBLE(ISO_AVX512_POLYGONS)
ISO_IF_Q16_16(ISO_AVX512_AXES)
ISO_IF_Q32_32(ISO_AVX512_ALONE)

}  // namespace isostep
