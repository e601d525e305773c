// The golden hashes that this build carries.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace isostep::tool {

/// A file of replays/goldens as it was when the tool was built.
struct GoldenText {
  const char* name;  // "S1x5.float.txt"
  const char* text;
};
/// Ascending by name.
std::span<const GoldenText> golden_texts();

struct GoldenName {
  std::string scene, scalar;
};
/// Nothing for a name that is not "SCENE.SCALAR.txt".
std::optional<GoldenName> parse_golden_name(const std::string& name);
std::string golden_name(const std::string& scene, const std::string& scalar);

/// One line a frame: its number from 0, a blank, and 16 hexadecimal digits.
std::string hash_lines(const std::vector<std::uint64_t>& hashes);
/// Nothing for any other text.
std::optional<std::vector<std::uint64_t>> parse_hash_lines(std::string_view text);

}  // namespace isostep::tool
