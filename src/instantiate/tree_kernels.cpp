// Which tree kernels a machine runs.
// SPDX-License-Identifier: MIT
#include "isostep/dynamics/joints/tree_kernels.hpp"

namespace isostep {
namespace {

template <class S> const TreeKernels<S>* kernels_of(Simd simd) {
  switch (simd) {
    case Simd::avx512: return detail::avx512_tree_kernels<S>();
    case Simd::avx2: return detail::avx2_tree_kernels<S>();
    case Simd::sse2: return detail::sse2_tree_kernels<S>();
    case Simd::neon: return detail::neon_tree_kernels<S>();
    case Simd::wasm: return detail::wasm_tree_kernels<S>();
    default: return detail::scalar_tree_kernels<S>();
  }
}

}  // namespace

#define ISO_DEFINE_CHOICE(S) \
  template <> const TreeKernels<S>* tree_kernels<S>(Simd simd) { return choose_kernels(simd, &kernels_of<S>); }
ISO_FOR_EACH_SCALAR(ISO_DEFINE_CHOICE)

}  // namespace isostep
