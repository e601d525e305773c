// Rays and nearest points of surfaces for every shipped scalar.
// SPDX-License-Identifier: MIT
#include "isostep/geometry/baked/surface_queries.inl"

namespace isostep {

#define ISO_INSTANTIATE(S) ISO_SURFACE_QUERIES_OF(, S)
ISO_FOR_EACH_SCALAR(ISO_INSTANTIATE)
#undef ISO_INSTANTIATE

}  // namespace isostep
