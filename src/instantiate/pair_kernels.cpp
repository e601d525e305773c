// Which pair kernels a machine runs.
// SPDX-License-Identifier: MIT
#include "isostep/collision/narrowphase/pair_kernels.hpp"

namespace isostep {
namespace {

template <class S> const PairKernels<S>* kernels_of(Simd simd) {
  switch (simd) {
    case Simd::avx512: return detail::avx512_pair_kernels<S>();
    case Simd::avx2: return detail::avx2_pair_kernels<S>();
    case Simd::sse2: return detail::sse2_pair_kernels<S>();
    case Simd::neon: return detail::neon_pair_kernels<S>();
    case Simd::wasm: return detail::wasm_pair_kernels<S>();
    default: return detail::scalar_pair_kernels<S>();
  }
}

}  // namespace

#define ISO_DEFINE_CHOICE(S)                                                    \
  template <> const PairKernels<S>* pair_kernels<S>(Simd simd) {                \
    const PairKernels<S>* const kernels = choose_kernels(simd, &kernels_of<S>); \
    return kernels != nullptr ? kernels : detail::scalar_pair_kernels<S>();     \
  }
ISO_FOR_EACH_SCALAR(ISO_DEFINE_CHOICE)

}  // namespace isostep
