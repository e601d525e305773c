// A list of frame hashes as text: what `run --hashes` writes.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace isostep::tool {

/// One line a frame: its number from 0, a blank, and 16 hexadecimal digits.
std::string hash_lines(const std::vector<std::uint64_t>& hashes);

}  // namespace isostep::tool
