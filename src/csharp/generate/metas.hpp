// The .meta files that Unity wants beside every file of a package, which it may not write there itself.
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "output.hpp"

namespace isostep::csharp {

/// One for every file and folder of the package: those on disk, and those of `files`, to which they are added. A GUID
/// is a digest of the path: the same wherever and whenever it is made.
void add_metas(const std::filesystem::path& package, Files& files);

/// Metas on disk that belong to nothing, and files that were once made and are no longer.
std::vector<std::filesystem::path> orphans_of(const std::filesystem::path& package, const Files& files);

}  // namespace isostep::csharp
