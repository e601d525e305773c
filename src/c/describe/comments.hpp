// Comments of members, from the C++ headers that declare them.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "schema.hpp"

namespace isostep::c_header {

/// Fills Member::comment of every struct from the headers below `root`/include and of src/c/layout. Units in brackets
/// and what follows them; nothing where the C++ says nothing.
void read_comments(const std::string& root, Schema& schema);

}  // namespace isostep::c_header
