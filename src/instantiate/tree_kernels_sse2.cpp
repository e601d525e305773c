// The tree kernels over SSE2 lanes, which every x86-64 has. Fixed point has no use for them: its wide products are
// faster one by one.
// SPDX-License-Identifier: MIT
#include "isostep/dynamics/joints/tree_kernel.inl"
#if defined(__SSE2__)
#include "isostep/scalar/lanes_sse2.hpp"
#endif

namespace isostep {

#if defined(__SSE2__)
#define ISO_DEFINE_SSE2_KERNELS(S, W)                                                    \
  template <> const TreeKernels<S>* detail::sse2_tree_kernels<S>() {                     \
    static constexpr TreeKernels<S> kTable = make_tree_kernels<S, W, isa::Sse2>("sse2"); \
    return &kTable;                                                                      \
  }
#else
#define ISO_DEFINE_SSE2_KERNELS(S, W) \
  template <> const TreeKernels<S>* detail::sse2_tree_kernels<S>() { return nullptr; }
#endif
#define ISO_NO_SSE2_KERNELS(S) \
  template <> const TreeKernels<S>* detail::sse2_tree_kernels<S>() { return nullptr; }

#define ISO_SSE2_FLOAT(S) ISO_DEFINE_SSE2_KERNELS(S, 4)
#define ISO_SSE2_DOUBLE(S) ISO_DEFINE_SSE2_KERNELS(S, 2)
ISO_IF_FLOAT(ISO_SSE2_FLOAT)
ISO_IF_DOUBLE(ISO_SSE2_DOUBLE)
ISO_IF_Q16_16(ISO_NO_SSE2_KERNELS)
ISO_IF_Q32_32(ISO_NO_SSE2_KERNELS)

}  // namespace isostep
