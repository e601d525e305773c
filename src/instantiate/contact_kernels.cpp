// Which contact kernels a machine runs.
// SPDX-License-Identifier: MIT
#include "isostep/dynamics/solvers/contact_kernels.hpp"

namespace isostep {
namespace {

bool has_avx2() {
#if defined(__x86_64__) || defined(__i386__)
  return __builtin_cpu_supports("avx2") != 0;
#else
  return false;
#endif
}

template <class S> const ContactKernels<S>* choose(Simd simd) {
  const ContactKernels<S>* avx2 = has_avx2() ? detail::avx2_kernels<S>() : nullptr;
  const ContactKernels<S>* sse2 = detail::sse2_kernels<S>();
  if (simd == Simd::avx2) return avx2;
  if (simd == Simd::sse2) return sse2;
  if (simd == Simd::scalar) return detail::scalar_kernels<S>();
  if (avx2 != nullptr) return avx2;
  return sse2 != nullptr ? sse2 : detail::scalar_kernels<S>();
}

}  // namespace

#define ISO_DEFINE_CHOICE(S) \
  template <> const ContactKernels<S>* contact_kernels<S>(Simd simd) { return choose<S>(simd); }
ISO_FOR_EACH_SCALAR(ISO_DEFINE_CHOICE)

}  // namespace isostep
