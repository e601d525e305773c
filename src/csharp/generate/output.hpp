// The files that the generator makes: kept in memory, then written.
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace isostep::csharp {

using Words = std::map<std::string, std::string>;

/// The text with every @WORD@ replaced. A word that `words` lacks ends the program: a template is wrong.
std::string expand(const std::string& text, const Words& words);

/// The whole file; one that cannot be read ends the program.
std::string read_file(const std::filesystem::path& path);

/// Text by path, relative to the package.
using Files = std::map<std::string, std::string>;

/// Writes `files` below `folder`; one that cannot be written ends the program.
void write_files(const std::filesystem::path& folder, const Files& files);

}  // namespace isostep::csharp
