// The pair kernels over AVX-512 lanes: compiled with that instruction set, called only where the processor has it.
// SPDX-License-Identifier: MIT
#include "isostep/collision/narrowphase/pair_kernel.inl"
#if defined(__AVX512F__) && defined(__AVX512DQ__) && defined(__AVX512VL__)
#include "isostep/scalar/lanes_avx512.hpp"
#endif

namespace isostep {

#if defined(__AVX512F__) && defined(__AVX512DQ__) && defined(__AVX512VL__)
#define ISO_DEFINE_AVX512_PAIRS(S, W, BOXES)                                                         \
  template <> const PairKernels<S>* detail::avx512_pair_kernels<S>() {                               \
    static constexpr PairKernels<S> kTable = make_pair_kernels<S, W, isa::Avx512, BoxWork::BOXES>(); \
    return &kTable;                                                                                  \
  }
#else
#define ISO_DEFINE_AVX512_PAIRS(S, W, BOXES) \
  template <> const PairKernels<S>* detail::avx512_pair_kernels<S>() { return nullptr; }
#endif
#define ISO_AVX512_FLOAT(S) ISO_DEFINE_AVX512_PAIRS(S, 16, polygons)
#define ISO_AVX512_DOUBLE(S) ISO_DEFINE_AVX512_PAIRS(S, 8, polygons)
#define ISO_AVX512_Q16_16(S) ISO_DEFINE_AVX512_PAIRS(S, 16, axes)
#define ISO_AVX512_Q32_32(S) ISO_DEFINE_AVX512_PAIRS(S, 8, alone)
ISO_IF_FLOAT(ISO_AVX512_FLOAT)
ISO_IF_DOUBLE(ISO_AVX512_DOUBLE)
ISO_IF_Q16_16(ISO_AVX512_Q16_16)
ISO_IF_Q32_32(ISO_AVX512_Q32_32)

}  // namespace isostep
