// Names of the shipped scalars, for typed tests whose failures should say which one failed.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <type_traits>

#include "isostep/scalar/fixed.hpp"

namespace isostep {

struct ScalarName {
  template <class S> static std::string GetName(int) {
    return std::is_same_v<S, float>    ? "float"
           : std::is_same_v<S, double> ? "double"
           : std::is_same_v<S, Q16_16> ? "Q16_16"
                                       : "Q32_32";
  }
};

}  // namespace isostep
