// The name that says how the library's containers are laid out.
// SPDX-License-Identifier: MIT
#include "isostep/core/containers_tag.hpp"

namespace isostep::detail {
const int ISO_CONTAINERS_TAG = 0;
}  // namespace isostep::detail
