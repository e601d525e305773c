// interface.json: all that a binding needs to know, as one object.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "functions.hpp"
#include "schema.hpp"

namespace isostep::c_header {

std::string json_text(const Schema& schema, const std::vector<Function>& functions);

}  // namespace isostep::c_header
