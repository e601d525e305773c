// The program that `./isostep demo` builds: the tool without laboratory, pages and differ, which take long to compile.
// SPDX-License-Identifier: MIT
#include "commands.hpp"

int main(int argc, char** argv) { return isostep::tool::run_demo(argc, argv); }
