// The scalars that the library holds: visited in their order, or found by name.
// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "isostep/core/instantiate.hpp"

namespace isostep {

template <class S> struct ScalarTag { using Type = S; };

/// Calls visit(ScalarTag<S>{}) for each scalar until one call returns true. Returns true if one did.
template <class Visit> ISO_INLINE bool any_scalar(Visit&& visit) {
  bool found = false;
#define ISO_VISIT(S) found = found || visit(ScalarTag<S>{});
  ISO_FOR_EACH_SCALAR(ISO_VISIT)
#undef ISO_VISIT
  return found;
}

/// Calls visit(ScalarTag<S>{}) for the scalar of that name. Returns false if the library has none.
template <class Visit> ISO_INLINE bool with_scalar(std::string_view name, Visit&& visit) {
  return any_scalar([&](auto tag) ISO_INLINE_LAMBDA {
    if (name != ScalarTraits<typename decltype(tag)::Type>::kName) return false;
    visit(tag);
    return true;
  });
}

}  // namespace isostep
