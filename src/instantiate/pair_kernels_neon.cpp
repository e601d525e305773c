// The pair kernels over NEON lanes, which every 64-bit Arm has. Two lanes of 64 bits keep to one, as
// those of SSE2 do.
// SPDX-License-Identifier: MIT
#include "isostep/collision/narrowphase/pair_kernel.inl"
#if defined(__AARCH64EL__) && defined(__ARM_NEON)
#include "isostep/scalar/lanes_neon.hpp"
#endif

namespace isostep {

#define ISO_NO_NEON_PAIRS(S) \
  template <> const PairKernels<S>* detail::neon_pair_kernels<S>() { return nullptr; }
#if defined(__AARCH64EL__) && defined(__ARM_NEON)
#define ISO_DEFINE_NEON_PAIRS(S, BOXES)                                                            \
  template <> const PairKernels<S>* detail::neon_pair_kernels<S>() {                               \
    static constexpr PairKernels<S> kTable = make_pair_kernels<S, 4, isa::Neon, BoxWork::BOXES>(); \
    return &kTable;                                                                                \
  }
#else
#define ISO_DEFINE_NEON_PAIRS(S, BOXES) ISO_NO_NEON_PAIRS(S)
#endif
#define ISO_NEON_FLOAT_PAIRS(S) ISO_DEFINE_NEON_PAIRS(S, polygons)
#define ISO_NEON_Q16_16_PAIRS(S) ISO_DEFINE_NEON_PAIRS(S, axes)
ISO_IF_FLOAT(ISO_NEON_FLOAT_PAIRS)
ISO_IF_DOUBLE(ISO_NO_NEON_PAIRS)
ISO_IF_Q16_16(ISO_NEON_Q16_16_PAIRS)
ISO_IF_Q32_32(ISO_NO_NEON_PAIRS)

}  // namespace isostep
