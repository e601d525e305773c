// The flight kernels of one lane: the reference.
// SPDX-License-Identifier: MIT
#include "isostep/particles/flight_kernel.inl"

namespace isostep {

ISO_FOR_EACH_SCALAR(ISO_DEFINE_SCALAR_FLIGHT_KERNELS)

}  // namespace isostep
