// The names of the library's scalars as text.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "isostep/core/scalars.hpp"

namespace isostep {

/// Returns the names of the scalars of this build, in the order of ISOSTEP_SCALARS.
ISO_INLINE std::vector<std::string> scalar_names() {
  std::vector<std::string> names;
  any_scalar([&](auto tag) ISO_INLINE_LAMBDA {
    names.emplace_back(ScalarTraits<typename decltype(tag)::Type>::kName);
    return false;
  });
  return names;
}

/// Returns "float, double" where `between` is ", ".
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
