// The names of the library's scalars as text.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "isostep/core/scalars.hpp"

namespace isostep {

/// In their order; "float, double" where ", " is between them.
ISO_INLINE std::string joined_scalar_names(std::string_view between) {
  std::string names;
  any_scalar([&](auto tag) ISO_INLINE_LAMBDA {
    if (!names.empty()) names += between;
    names += ScalarTraits<typename decltype(tag)::Type>::kName;
    return false;
  });
  return names;
}

}  // namespace isostep
