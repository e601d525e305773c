// The builders of mass-aggregate bodies, compiled once for every shipped scalar.
// SPDX-License-Identifier: MIT
#include "isostep/particles/bodies/instantiate.inl"

namespace isostep {

ISO_FOR_EACH_SCALAR(ISO_INSTANTIATE_PARTICLE_BODIES)

}  // namespace isostep
