// The body kernels over NEON lanes, which every 64-bit Arm has. 64-bit fixed point has no use for two
// lanes: its wide products are faster one by one.
// SPDX-License-Identifier: MIT
#include "isostep/dynamics/solvers/body_kernel.inl"
#if defined(__AARCH64EL__) && defined(__ARM_NEON)
#include "isostep/scalar/lanes_neon.hpp"
#define ISO_NEON_TABLE(S)                             \
  ISO_DEFINE_KERNEL_TABLE(BodyKernels<S>, Simd::neon, \
                          make_body_kernels<S, kRegisterLanes<S, isa::Neon>, isa::Neon>("neon"))
#else
#define ISO_NEON_TABLE(S) ISO_NO_KERNEL_TABLE(BodyKernels<S>, Simd::neon)
#endif
#define ISO_NO_NEON_TABLE(S) ISO_NO_KERNEL_TABLE(BodyKernels<S>, Simd::neon)

namespace isostep {

ISO_IF_FLOAT(ISO_NEON_TABLE)
ISO_IF_DOUBLE(ISO_NEON_TABLE)
ISO_IF_Q16_16(ISO_NEON_TABLE)
ISO_IF_Q32_32(ISO_NO_NEON_TABLE)

}  // namespace isostep
