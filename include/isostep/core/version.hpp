// The versions of the interface and of the results, and what this library was built with.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/scalar/platform.hpp"

namespace isostep {

inline constexpr int kVersionMajor = 0;
inline constexpr int kVersionMinor = 1;
inline constexpr int kVersionPatch = 0;
inline constexpr char kVersionText[] = "0.1.0";

/// The version of the results: a digest of replays/goldens.txt, the golden hashes. Two builds of one behaviour version
/// promise each other's frame hashes, whatever else differs.
std::uint64_t behaviour_version();

/// The library's compiler and architecture, not those of the file that includes this header. They are informative:
/// nothing is ever refused because of them.
const char* compiler_name();
const char* architecture_name();

}  // namespace isostep
