// The .meta files that Unity wants beside every file of a package, which it may not write there itself.
// SPDX-License-Identifier: MIT
#pragma once

#include "output.hpp"

namespace isostep::csharp {

/// Writes one for every file and folder of the package. A GUID is a digest of the path: the same wherever and whenever
/// it is made.
void write_metas(const std::filesystem::path& package);

}  // namespace isostep::csharp
