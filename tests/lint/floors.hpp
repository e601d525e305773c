// The rule of floors: a file includes its own folder and folders on lower floors, and no includes lead back.
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

namespace isostep_lint {

void check_floors(const std::filesystem::path& root);

}  // namespace isostep_lint
