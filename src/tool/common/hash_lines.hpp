// A list of frame hashes as text: golden files, and what `run --hashes` writes.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace isostep::tool {

/// One line a frame: its number from 0, a blank, and 16 hexadecimal digits.
std::string hash_lines(const std::vector<std::uint64_t>& hashes);
/// Nothing for any other text.
std::optional<std::vector<std::uint64_t>> parse_hash_lines(std::string_view text);

}  // namespace isostep::tool
