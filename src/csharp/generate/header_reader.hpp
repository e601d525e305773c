// Reads those parts of the C headers that interface.json does not describe: statuses, constants, sessions.
// SPDX-License-Identifier: MIT
#pragma once

#include "schema.hpp"

namespace isostep::csharp {

/// Appends the enumerations, structs and functions of `text`, which is written like isostep.h, to `schema`.
void read_header(const std::string& text, Schema& schema);

}  // namespace isostep::csharp
