// The command bake: its options; it returns an exit status.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace isostep::tool {

struct BakeOptions {
  std::string file;         // OBJ, glTF, ...
  std::string out;          // the blob's file
  std::string as = "mesh";  // or hull
  std::string object;       // its faces alone; empty: all
  double scale = 1;         // [m] a unit of the file
  std::string up = "y";     // the file's axis that points up; z becomes y
  int exponent = -1;        // a step is 2^-exponent m; -1: the finest grid that holds all
  int points = 0;           // a hull's at most; 0: all
  bool json = false;
};
int command_bake(const BakeOptions& options);

}  // namespace isostep::tool
