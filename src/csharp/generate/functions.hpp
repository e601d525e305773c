// The C# declarations of all functions, and the methods of the classes over them.
// SPDX-License-Identifier: MIT
#pragma once

#include "output.hpp"
#include "schema.hpp"

namespace isostep::csharp {

/// Adds Native: every function as C has it.
void add_functions(const Schema& schema, Files& files);
/// Adds to World, Session ... a method for each function whose arguments say by themselves what they mean.
void add_methods(const Schema& schema, Files& files);

/// The type in C#'s declarations of a C type.
std::string native_type(const std::string& c_type, const std::string& family, const Schema& schema, bool qualified);

}  // namespace isostep::csharp
