// The isostep program.
// SPDX-License-Identifier: MIT
#include "command_line.hpp"

int main(int argc, char** argv) { return isostep::tool::run_command_line(argc, argv); }
