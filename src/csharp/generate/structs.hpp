// The C# enumerations and structs of the interface, and the table of their layout for a test.
// SPDX-License-Identifier: MIT
#pragma once

#include "output.hpp"
#include "schema.hpp"

namespace isostep::csharp {

void add_enums(const Schema& schema, Files& files);
void add_structs(const Schema& schema, Files& files);
/// For tests: what C# must lay out as C does, and the same of C's sessions as static assertions.
std::string layout_table(const Schema& schema);
std::string layout_assertions(const Schema& schema);

}  // namespace isostep::csharp
