// What the header says by hand between the marks of sessions: enumerations, structs of plain members; for the schema.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "schema.hpp"

namespace isostep::c_header {

/// Adds the enumerations that have a type, and the structs. Those with pointers in them have two layouts, others are
/// the same on every target. Returns what cannot be described, a member of an unknown type or a hole; else nothing.
std::string add_section(const std::string& header, Schema& schema);

}  // namespace isostep::c_header
