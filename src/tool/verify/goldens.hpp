// The golden hashes: replays/goldens.txt, a line for each named scene in each scalar.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace isostep::tool {

/// One line: "SCENE SCALAR FRAMES DIGEST HASH...", hashes of 16 hexadecimal digits.
struct Golden {
  std::string scene, scalar;
  std::size_t frames = 0;
  std::uint64_t digest = 0;               // XXH3-64 of the hashes of all frames, 8 bytes each, little-endian
  std::vector<std::uint64_t> marks = {};  // hashes after every sixtieth frame, and the last
};

constexpr std::size_t kGoldenSpacing = 60;  // [frames] from mark to mark

/// The line for a scene whose frames have these hashes.
Golden golden_of(const std::string& scene, const std::string& scalar, const std::vector<std::uint64_t>& hashes);
/// The frame, counted from 0, after which mark `i` is.
std::size_t frame_of_mark(const Golden& golden, std::size_t i);
/// Ends without a line break.
std::string text_of(const Golden& golden);
/// Reads a line; nothing for text of any other form.
std::optional<Golden> parse_golden(std::string_view line);

/// The lines of a file; line breaks of either kind, the last one may lack.
std::vector<std::string_view> golden_lines(std::string_view file);

/// Frames that are hashed of a scene: past the first contacts and the wake of impacts; all scenes take some minutes.
int golden_frames(std::string_view scene);

}  // namespace isostep::tool
