// Which tree kernels a machine runs.
// SPDX-License-Identifier: MIT
#include "isostep/dynamics/joints/tree_kernels.hpp"
#include "isostep/dynamics/solvers/contact_kernels.hpp"

namespace isostep {
namespace {

template <class S> const TreeKernels<S>* kernels_of(Simd simd) {
  switch (simd) {
    case Simd::avx512: return detail::avx512_tree_kernels<S>();
    case Simd::avx2: return detail::avx2_tree_kernels<S>();
    case Simd::sse2: return detail::sse2_tree_kernels<S>();
    default: return detail::scalar_tree_kernels<S>();
  }
}
/// The contact kernels know what the processor has.
template <class S> const TreeKernels<S>* choose(Simd simd) {
  if (simd != Simd::best) return contact_kernels<S>(simd) != nullptr ? kernels_of<S>(simd) : nullptr;
  for (const Simd wide : {Simd::avx512, Simd::avx2, Simd::sse2}) {
    if (const TreeKernels<S>* kernels = choose<S>(wide)) return kernels;
  }
  return kernels_of<S>(Simd::scalar);
}

}  // namespace

#define ISO_DEFINE_CHOICE(S) \
  template <> const TreeKernels<S>* tree_kernels<S>(Simd simd) { return choose<S>(simd); }
ISO_FOR_EACH_SCALAR(ISO_DEFINE_CHOICE)

}  // namespace isostep
