// The geometry module's functions, compiled once for every shipped scalar.
// SPDX-License-Identifier: MIT
#include "isostep/geometry/baked/hull_content.inl"
#include "isostep/geometry/mass_properties.inl"
#include "isostep/geometry/mass_tensor.inl"
#include "isostep/geometry/validate.inl"

namespace isostep {

#define ISO_INSTANTIATE(S)                                                                     \
  template struct HullContent<S>;                                                              \
  ISO_CONTENT_OF(, S)                                                                          \
  template MassProperties<S> mass_properties<S>(std::span<const Child<S>>, S, Contents<S>);    \
  template struct MassTensor<S>;                                                               \
  template ShapeFault validate<S>(const Primitive<S>&);                                        \
  template ShapeFault validate<S>(const Pose<S>&);                                             \
  template ShapeFault validate<S>(std::span<const Child<S>>, std::span<const BlobRef>);        \
  template ShapeFaultPlace find_fault<S>(std::span<const Child<S>>, std::span<const BlobRef>); \
  template Child<S> normalised<S>(const Child<S>&);
ISO_FOR_EACH_SCALAR(ISO_INSTANTIATE)
#undef ISO_INSTANTIATE

}  // namespace isostep
