// The names of whoever runs in the laboratory, in full and with a few words for those who meet them here.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tool/lab/result.hpp"

namespace isostep::tool::lab {

/// "jolt" of "jolt" and of "jolt-best", which is the same engine with the settings that its documentation has for
/// precision.
std::string engine_of(std::string_view row);
bool is_best(std::string_view row);

/// "Jolt 5, jolt-physics 1.1.0 from npm"; an engine that is not known is called as it is.
std::string full_name(std::string_view engine);

/// Returns the engine of each result, as often as it ran.
std::vector<std::string> engines_in(const std::vector<LabResult>& results);
/// A head, and a line a name with what it is: solvers, scalars and, of the engines in `rows`, each once. Plain text.
std::vector<std::vector<std::string>> who_is_who(const std::vector<std::string>& rows);

}  // namespace isostep::tool::lab
