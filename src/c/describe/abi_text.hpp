// abi.txt: what a program that was built with a header relies on, a fact a line, for the gate that compares releases.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "functions.hpp"
#include "schema.hpp"

namespace isostep::c_header {

/// "function NAME RETURNS(TYPES)", "enumerator NAME VALUE", "sized NAME SIZE" or "plain NAME SIZE", and
/// "member STRUCT.NAME OFFSET SIZE KIND". Members within members are those of a struct of their own.
std::string abi_text(const Schema& schema, const std::vector<Function>& functions);

}  // namespace isostep::c_header
