// Calls of every function with arguments that a test draws: C++ for the random caller of tests/c.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "functions.hpp"
#include "schema.hpp"

namespace isostep::c_header {

/// ISO_CALL(name, returns nothing but a status, arguments) a function, and ISO_MEMBER(struct, offset, size, kind) a
/// member, grouped by ISO_STRUCT(name, size, whether it begins with that).
std::string calls_text(const Schema& schema, const std::vector<Function>& functions);

}  // namespace isostep::c_header
