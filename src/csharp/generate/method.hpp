// One function of C as a method of a C# class.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "schema.hpp"

namespace isostep::csharp {

struct MadeMethod {
  std::string text;    // empty where some argument's meaning is not known
  std::string viewed;  // of a method that returns a view: what that shows
};
/// Makes a method of the class over `handle` ("iso_world"), the function's first argument; static where that is "".
MadeMethod make_method(const Function& function, const Schema& schema, const std::string& handle);

bool starts(const std::string& text, const std::string& with);
bool ends(const std::string& text, const std::string& with);
/// The function's name without iso_ and the family's prefix.
std::string short_name(const Function& function);

}  // namespace isostep::csharp
