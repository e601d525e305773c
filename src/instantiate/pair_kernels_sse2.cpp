// The pair kernels over SSE2 lanes, which every x86-64 has. Two doubles at once gain nothing; fixed point's wide
// products are faster one by one.
// SPDX-License-Identifier: MIT
#include "isostep/collision/narrowphase/pair_kernel.inl"
#if defined(__SSE2__)
#include "isostep/scalar/lanes_sse2.hpp"
#endif

namespace isostep {

#define ISO_NO_SSE2_PAIRS(S) \
  template <> const PairKernels<S>* detail::sse2_pair_kernels<S>() { return nullptr; }
#if defined(__SSE2__)
#define ISO_SSE2_FLOAT_PAIRS(S)                                                                       \
  template <> const PairKernels<S>* detail::sse2_pair_kernels<S>() {                                  \
    static constexpr PairKernels<S> kTable = make_pair_kernels<S, 4, isa::Sse2, BoxWork::polygons>(); \
    return &kTable;                                                                                   \
  }
#else
#define ISO_SSE2_FLOAT_PAIRS(S) ISO_NO_SSE2_PAIRS(S)
#endif
ISO_IF_FLOAT(ISO_SSE2_FLOAT_PAIRS)
ISO_IF_DOUBLE(ISO_NO_SSE2_PAIRS)
ISO_IF_Q16_16(ISO_NO_SSE2_PAIRS)
ISO_IF_Q32_32(ISO_NO_SSE2_PAIRS)

}  // namespace isostep
