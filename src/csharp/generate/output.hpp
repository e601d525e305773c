// The files that the generator makes: kept in memory, then written, or compared with what is there.
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

/// Writes what differs. With `check` it writes nothing and says what differs, or is there and should not be.
/// Returns how many files differ.
int write_or_check(const std::filesystem::path& package, const Files& files, bool check);

}  // namespace isostep::csharp
