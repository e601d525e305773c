// The functions that an object may not ask the linker for.
// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "concern.hpp"

namespace isostep_lint {

/// The concern about an undefined symbol, as nm prints it.
Concern concern_of_call(std::string_view symbol);

}  // namespace isostep_lint
