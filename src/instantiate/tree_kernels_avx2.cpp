// The tree kernels over AVX2 lanes: compiled with -mavx2, called only where the processor has it.
// SPDX-License-Identifier: MIT
#include "isostep/dynamics/joints/tree_kernel.inl"
#if defined(__AVX2__)
#include "isostep/scalar/lanes_avx2.hpp"
#endif

namespace isostep {

#if defined(__AVX2__)
#define ISO_DEFINE_AVX2_KERNELS(S, W)                                                    \
  template <> const TreeKernels<S>* detail::avx2_tree_kernels<S>() {                     \
    static constexpr TreeKernels<S> kTable = make_tree_kernels<S, W, isa::Avx2>("avx2"); \
    return &kTable;                                                                      \
  }
#else
#define ISO_DEFINE_AVX2_KERNELS(S, W) \
  template <> const TreeKernels<S>* detail::avx2_tree_kernels<S>() { return nullptr; }
#endif
#define ISO_AVX2_NARROW(S) ISO_DEFINE_AVX2_KERNELS(S, 8)
#define ISO_AVX2_WIDE(S) ISO_DEFINE_AVX2_KERNELS(S, 4)
ISO_IF_FLOAT(ISO_AVX2_NARROW)
ISO_IF_DOUBLE(ISO_AVX2_WIDE)
ISO_IF_Q16_16(ISO_AVX2_NARROW)
ISO_IF_Q32_32(ISO_AVX2_WIDE)

}  // namespace isostep
