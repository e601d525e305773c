// The contact kernels over NEON lanes, which every 64-bit Arm has. 64-bit fixed point has no use for two
// lanes: its wide products are faster one by one.
// SPDX-License-Identifier: MIT
#include "isostep/dynamics/solvers/contact_kernel.inl"
#if defined(__AARCH64EL__) && defined(__ARM_NEON)
#include "isostep/scalar/lanes_neon.hpp"
#endif

namespace isostep {

#if defined(__AARCH64EL__) && defined(__ARM_NEON)
#define ISO_DEFINE_NEON_KERNELS(S, W)                                                          \
  template <> const ContactKernels<S>* detail::neon_kernels<S>() {                             \
    static constexpr ContactKernels<S> kTable = make_contact_kernels<S, W, isa::Neon>("neon"); \
    return &kTable;                                                                            \
  }
#else
#define ISO_DEFINE_NEON_KERNELS(S, W) \
  template <> const ContactKernels<S>* detail::neon_kernels<S>() { return nullptr; }
#endif
#define ISO_NO_NEON_KERNELS(S) \
  template <> const ContactKernels<S>* detail::neon_kernels<S>() { return nullptr; }

#define ISO_NEON_NARROW(S) ISO_DEFINE_NEON_KERNELS(S, 4)
#define ISO_NEON_WIDE(S) ISO_DEFINE_NEON_KERNELS(S, 2)
ISO_IF_FLOAT(ISO_NEON_NARROW)
ISO_IF_DOUBLE(ISO_NEON_WIDE)
ISO_IF_Q16_16(ISO_NEON_NARROW)
ISO_IF_Q32_32(ISO_NO_NEON_KERNELS)

}  // namespace isostep
