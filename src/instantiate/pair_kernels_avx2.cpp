// The pair kernels over AVX2 lanes: compiled with -mavx2, called only where the processor has it.
// SPDX-License-Identifier: MIT
#include "isostep/collision/narrowphase/pair_kernel.inl"
#if defined(__AVX2__)
#include "isostep/scalar/lanes_avx2.hpp"
#endif

namespace isostep {

#if defined(__AVX2__)
#define ISO_DEFINE_AVX2_PAIRS(S, W, BOXES)                                                         \
  template <> const PairKernels<S>* detail::avx2_pair_kernels<S>() {                               \
    static constexpr PairKernels<S> kTable = make_pair_kernels<S, W, isa::Avx2, BoxWork::BOXES>(); \
    return &kTable;                                                                                \
  }
#else
#define ISO_DEFINE_AVX2_PAIRS(S, W, BOXES) \
  template <> const PairKernels<S>* detail::avx2_pair_kernels<S>() { return nullptr; }
#endif
#define ISO_AVX2_FLOAT(S) ISO_DEFINE_AVX2_PAIRS(S, 8, polygons)
#define ISO_AVX2_DOUBLE(S) ISO_DEFINE_AVX2_PAIRS(S, 4, polygons)
#define ISO_AVX2_Q16_16(S) ISO_DEFINE_AVX2_PAIRS(S, 8, axes)
#define ISO_AVX2_Q32_32(S) ISO_DEFINE_AVX2_PAIRS(S, 4, alone)
ISO_IF_FLOAT(ISO_AVX2_FLOAT)
ISO_IF_DOUBLE(ISO_AVX2_DOUBLE)
ISO_IF_Q16_16(ISO_AVX2_Q16_16)
ISO_IF_Q32_32(ISO_AVX2_Q32_32)

}  // namespace isostep
