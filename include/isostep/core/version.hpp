// The version of the interface, and what this library was built with; the version of the results is a digest of the
// golden hashes and lives with them.
// SPDX-License-Identifier: MIT
#pragma once

namespace isostep {

inline constexpr int kVersionMajor = 0;
inline constexpr int kVersionMinor = 1;
inline constexpr int kVersionPatch = 0;
inline constexpr char kVersionText[] = "0.1.0";

/// Of the library, not of the file that includes this header. Informative: nothing is ever refused because of them.
const char* compiler_name();
const char* architecture_name();

}  // namespace isostep
