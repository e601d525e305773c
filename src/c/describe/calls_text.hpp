// Calls of every function with arguments that a test draws: C++ for the random caller of tests/c.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "functions.hpp"
#include "schema.hpp"

namespace isostep::c_header {

/// ISO_CALL(name, arguments) for a function that returns a status, ISO_ASK for another; ISO_STRUCT(name, whether it
/// begins with its size) and ISO_MEMBER(struct, offset, size, kind, of) after it; ISO_INIT(name) for what has an _init.
std::string calls_text(const Schema& schema, const std::vector<Function>& functions);

}  // namespace isostep::c_header
