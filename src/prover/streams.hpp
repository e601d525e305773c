// Files and standard streams as bytes; states as text.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "isostep/core/bytes.hpp"

namespace isostep::prover {

/// Windows would change line ends.
void make_streams_binary();

/// The whole file; "-": standard input. Empty, or why it cannot be read.
std::string read_file(std::string_view path, std::vector<std::uint8_t>& bytes);
/// Prints to standard output.
void print(std::string_view text);

/// 64 digits a line.
std::string hex_text(Bytes bytes);
/// Its bytes; blanks and line ends do not matter. False for anything else.
bool read_hex(Bytes text, std::vector<std::uint8_t>& bytes);

}  // namespace isostep::prover
