// The functions of isostep.h, from its text: as the preprocessor leaves it, and as it is for the comments.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace isostep::c_header {

struct Argument {
  std::string type, name;
};
struct Function {
  std::string name, returns, family, comment;  // family: "q32", or empty
  std::vector<Argument> arguments;
};

/// `expanded`: what `cc -E -P -DISO_API=ISO_FUNCTION` makes of the header. `header`: its text.
std::vector<Function> read_functions(const std::string& expanded, const std::string& header);

}  // namespace isostep::c_header
