// The pair kernels over NEON lanes, which every 64-bit Arm has. Two lanes of 64 bits keep to one, as
// those of SSE2 do.
// SPDX-License-Identifier: MIT
#include "isostep/collision/narrowphase/pair_kernel.inl"
#if defined(__AARCH64EL__) && defined(__ARM_NEON)
#include "isostep/scalar/lanes_neon.hpp"
#define ISO_NEON_TABLE(S, BOXES)                      \
  ISO_DEFINE_KERNEL_TABLE(PairKernels<S>, Simd::neon, \
                          make_pair_kernels<S, kRegisterLanes<S, isa::Neon>, isa::Neon, BoxWork::BOXES>())
#else
#define ISO_NEON_TABLE(S, BOXES) ISO_NO_KERNEL_TABLE(PairKernels<S>, Simd::neon)
#endif
#define ISO_NEON_POLYGONS(S) ISO_NEON_TABLE(S, polygons)
#define ISO_NEON_AXES(S) ISO_NEON_TABLE(S, axes)
#define ISO_NO_NEON_TABLE(S) ISO_NO_KERNEL_TABLE(PairKernels<S>, Simd::neon)

namespace isostep {

ISO_IF_FLOAT(ISO_NEON_POLYGONS)
ISO_IF_DOUBLE(ISO_NO_NEON_TABLE)
ISO_IF_Q16_16(ISO_NEON_AXES)
ISO_IF_Q32_32(ISO_NO_NEON_TABLE)

}  // namespace isostep
