// The C# enumerations and structs of the interface, and the table of their layout for a test.
// SPDX-License-Identifier: MIT
#pragma once

#include "output.hpp"
#include "schema.hpp"

namespace isostep::csharp {

void add_enums(const Schema& schema, Files& files);
void add_structs(const Schema& schema, Files& files);
/// The layout that C# must share with C, for tests, and that of C's sessions as static assertions.
std::string layout_table(const Schema& schema);
std::string layout_assertions(const Schema& schema);

}  // namespace isostep::csharp
