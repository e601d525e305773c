// Queries of worlds for every shipped scalar.
// SPDX-License-Identifier: MIT
#include "isostep/instantiate/world_queries.inl"

namespace isostep {

ISO_FOR_EACH_SCALAR(ISO_INSTANTIATE_WORLD_QUERIES)

}  // namespace isostep
