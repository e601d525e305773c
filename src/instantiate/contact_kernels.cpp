// Which contact kernels a machine runs.
// SPDX-License-Identifier: MIT
#include "isostep/dynamics/solvers/contact_kernels.hpp"

namespace isostep {
namespace {

/// These look at what the operating system saves of the registers (XCR0) too.
bool has_avx2() {
#if defined(__x86_64__) || defined(__i386__)
  return __builtin_cpu_supports("avx2") != 0;
#else
  return false;
#endif
}

/// The subsets that the kernels are compiled with: every processor with 64-bit products (DQ) has all three.
bool has_avx512() {
#if defined(__x86_64__) || defined(__i386__)
  return __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512dq") != 0 &&
         __builtin_cpu_supports("avx512vl") != 0;
#else
  return false;
#endif
}

/// The best are the widest, for every scalar. A settled step on Zen 5, g++ 12, AVX-512 beside AVX2 [ms]:
///           float          double         Q16.16         Q32.32
///   S3   2.17  2.50     2.82  3.47     3.25  4.01     6.6  11.9
///   S4   1.63  1.71     1.93  2.17     2.19  2.45     3.9   5.7
///   S5   4.58  4.87     7.2   8.1      6.4   7.5     14.8  21.0
/// A stack of five boxes is 0.2 to 1.6 us slower in all but Q32.32. Narrower blocks for what is left over of a colour
/// gain nothing anywhere.
template <class S> const ContactKernels<S>* choose(Simd simd) {
  const ContactKernels<S>* avx512 = has_avx512() ? detail::avx512_kernels<S>() : nullptr;
  const ContactKernels<S>* avx2 = has_avx2() ? detail::avx2_kernels<S>() : nullptr;
  const ContactKernels<S>* sse2 = detail::sse2_kernels<S>();
  if (simd == Simd::avx512) return avx512;
  if (simd == Simd::avx2) return avx2;
  if (simd == Simd::sse2) return sse2;
  if (simd == Simd::scalar) return detail::scalar_kernels<S>();
  if (avx512 != nullptr) return avx512;
  if (avx2 != nullptr) return avx2;
  return sse2 != nullptr ? sse2 : detail::scalar_kernels<S>();
}

}  // namespace

#define ISO_DEFINE_CHOICE(S) \
  template <> const ContactKernels<S>* contact_kernels<S>(Simd simd) { return choose<S>(simd); }
ISO_FOR_EACH_SCALAR(ISO_DEFINE_CHOICE)

}  // namespace isostep
