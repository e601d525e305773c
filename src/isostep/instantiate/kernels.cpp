// The kernels that a machine runs.
// SPDX-License-Identifier: MIT
#include "isostep/collision/narrowphase/pair_kernels.hpp"
#include "isostep/dynamics/joints/tree_kernels.hpp"
#include "isostep/dynamics/solvers/body_kernels.hpp"
#include "isostep/dynamics/solvers/contact_kernels.hpp"
#include "isostep/particles/flight.hpp"

namespace isostep {

namespace {
/// Those of one lane where an instruction set has none of these: contact_kernels tells whether it is there at all.
template <class Kernels> const Kernels* choose_or_scalar(Simd simd) {
  const Kernels* const kernels = choose_kernels<Kernels>(simd);
  return kernels != nullptr ? kernels : detail::kernel_table<Kernels, Simd::scalar>();
}
}  // namespace

// The best are the widest, for every scalar. A settled step on Zen 5, g++ 12, AVX-512 beside AVX2 [ms]:
//           float          double         Q16.16         Q32.32
//   S3   2.17  2.50     2.82  3.47     3.25  4.01     6.6  11.9
//   S4   1.63  1.71     1.93  2.17     2.19  2.45     3.9   5.7
//   S5   4.58  4.87     7.2   8.1      6.4   7.5     14.8  21.0
// A stack of five boxes is 0.2 to 1.6 us slower in all but Q32.32. Narrower blocks for what is left over of a colour
// gain nothing anywhere.
#define ISO_DEFINE_CHOICE(S)                                                                                          \
  template <> const ContactKernels<S>* contact_kernels<S>(Simd simd) {                                                \
    return choose_kernels<ContactKernels<S>>(simd);                                                                   \
  }                                                                                                                   \
  template <> const TreeKernels<S>* tree_kernels<S>(Simd simd) { return choose_kernels<TreeKernels<S>>(simd); }       \
  template <> const FlightKernels<S>* flight_kernels<S>(Simd simd) { return choose_kernels<FlightKernels<S>>(simd); } \
  template <> const BodyKernels<S>* body_kernels<S>(Simd simd) { return choose_or_scalar<BodyKernels<S>>(simd); }     \
  template <> const PairKernels<S>* pair_kernels<S>(Simd simd) { return choose_or_scalar<PairKernels<S>>(simd); }
ISO_FOR_EACH_SCALAR(ISO_DEFINE_CHOICE)

}  // namespace isostep
