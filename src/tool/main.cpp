// The isostep program.
// SPDX-License-Identifier: MIT
#include "commands.hpp"

int main(int argc, char** argv) { return isostep::tool::run_command_line(argc, argv); }
