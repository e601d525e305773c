// The tree kernels over AVX-512 lanes: compiled with that instruction set, called only where the processor has it.
// SPDX-License-Identifier: MIT
#include "isostep/dynamics/joints/tree_kernel.inl"
#if defined(__AVX512F__) && defined(__AVX512DQ__) && defined(__AVX512VL__)
#include "isostep/scalar/lanes_avx512.hpp"
#endif

namespace isostep {

#if defined(__AVX512F__) && defined(__AVX512DQ__) && defined(__AVX512VL__)
#define ISO_DEFINE_AVX512_KERNELS(S, W)                                                      \
  template <> const TreeKernels<S>* detail::avx512_tree_kernels<S>() {                       \
    static constexpr TreeKernels<S> kTable = make_tree_kernels<S, W, isa::Avx512>("avx512"); \
    return &kTable;                                                                          \
  }
#else
#define ISO_DEFINE_AVX512_KERNELS(S, W) \
  template <> const TreeKernels<S>* detail::avx512_tree_kernels<S>() { return nullptr; }
#endif
#define ISO_AVX512_NARROW(S) ISO_DEFINE_AVX512_KERNELS(S, 16)
#define ISO_AVX512_WIDE(S) ISO_DEFINE_AVX512_KERNELS(S, 8)
ISO_IF_FLOAT(ISO_AVX512_NARROW)
ISO_IF_DOUBLE(ISO_AVX512_WIDE)
ISO_IF_Q16_16(ISO_AVX512_NARROW)
ISO_IF_Q32_32(ISO_AVX512_WIDE)

}  // namespace isostep
