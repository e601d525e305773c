// The C# numbers: tables from the library's headers, formats and vectors from templates.
// SPDX-License-Identifier: MIT
#pragma once

#include "output.hpp"

namespace isostep::csharp {

/// Adds the numbers. `source` is the repository.
void add_numbers(const std::filesystem::path& source, Files& files);

}  // namespace isostep::csharp
