// The whole program as a function, for main and for tests.
// SPDX-License-Identifier: MIT
#pragma once

namespace isostep::tool {

/// An exit status for these words.
int run_command_line(int argc, const char* const* argv);

}  // namespace isostep::tool
