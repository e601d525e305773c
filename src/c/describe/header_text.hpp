// The generated part of isostep.h, and the checks that its layout is what the library computes.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "schema.hpp"

namespace isostep::c_header {

inline constexpr char kRegionBegin[] = "/* Structs: written by isostep_interface from the C++ headers. */\n";
inline constexpr char kRegionEnd[] = "/* End of structs */\n";

/// Enumerations, structs of the four families and lists of names.
std::string region_text(const Schema& schema);
/// `header` with another region between its marks; empty where it has no marks.
std::string with_region(const std::string& header, const std::string& region);
/// layout/layout_checks.inl: one line a struct, which compares its offsets in C with those that the library writes to.
std::string checks_text(const Schema& schema);

}  // namespace isostep::c_header
