// Golden hashes to text and back.
// SPDX-License-Identifier: MIT
#include "goldens.hpp"

#include <algorithm>
#include <charconv>

#include "isostep/state/hash.hpp"
#include "tool/common/tool.hpp"

namespace isostep::tool {
namespace {

/// XXH3-64 of the hashes' bytes, little-endian on every machine.
std::uint64_t digest_of(const std::vector<std::uint64_t>& hashes) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(8 * hashes.size());
  for (const std::uint64_t hash : hashes) {
    for (int i = 0; i < 64; i += 8) bytes.push_back(static_cast<std::uint8_t>(hash >> i));
  }
  return hash_bytes(bytes.data(), bytes.size());
}

std::size_t mark_count(std::size_t frames) { return (frames + kGoldenSpacing - 1) / kGoldenSpacing; }

/// The text before the next blank, which is taken off too.
std::string_view take_word(std::string_view& line) {
  const std::size_t end = std::min(line.find(' '), line.size());
  const std::string_view word = line.substr(0, end);
  line.remove_prefix(std::min(end + 1, line.size()));
  return word;
}

template <class Number> bool read_number(std::string_view word, int base, Number& number) {
  const char* end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, number, base);
  return error == std::errc{} && stop == end;
}
bool read_hash(std::string_view word, std::uint64_t& hash) { return word.size() == 16 && read_number(word, 16, hash); }

}  // namespace

Golden golden_of(const std::string& scene, const std::string& scalar, const std::vector<std::uint64_t>& hashes) {
  Golden golden = {scene, scalar, hashes.size(), digest_of(hashes)};
  for (std::size_t i = 0; i < mark_count(hashes.size()); ++i) golden.marks.push_back(hashes[frame_of_mark(golden, i)]);
  return golden;
}

std::size_t frame_of_mark(const Golden& golden, std::size_t i) {
  return std::min((i + 1) * kGoldenSpacing, golden.frames) - 1;
}

std::string text_of(const Golden& golden) {
  std::string text =
      golden.scene + " " + golden.scalar + " " + std::to_string(golden.frames) + " " + hex(golden.digest);
  for (const std::uint64_t mark : golden.marks) text += " " + hex(mark);
  return text;
}

std::optional<Golden> parse_golden(std::string_view line) {
  Golden golden;
  std::string_view rest = line;
  golden.scene = take_word(rest);
  golden.scalar = take_word(rest);
  const bool counted = read_number(take_word(rest), 10, golden.frames);
  if (!counted || !read_hash(take_word(rest), golden.digest)) return std::nullopt;
  while (!rest.empty()) {
    std::uint64_t mark = 0;
    if (!read_hash(take_word(rest), mark)) return std::nullopt;
    golden.marks.push_back(mark);
  }
  const bool whole = golden.frames != 0 && golden.marks.size() == mark_count(golden.frames);
  if (!whole || text_of(golden) != line) return std::nullopt;
  return golden;
}

std::vector<std::string_view> golden_lines(std::string_view file) {
  std::vector<std::string_view> lines;
  while (!file.empty()) {
    const std::size_t end = std::min(file.find('\n'), file.size());
    std::string_view line = file.substr(0, end);
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    lines.push_back(line);
    file.remove_prefix(std::min(end + 1, file.size()));
  }
  return lines;
}

int golden_frames(std::string_view scene) {
  struct Row {
    std::string_view scene;
    int frames;
  };
  constexpr Row kRows[] = {{"S1s", 240},         {"S3", 30},           {"S5", 60},
                           {"S8", 120},          {"S9", 100},          {"mixed", 300},
                           {"medley", 180},      {"bridge", 300},      {"ballistic", 240},
                           {"fireworks", 240},   {"springs", 300},     {"S18c", 360},
                           {"figures", 30},      {"trees", 60},        {"joint_grid", 10},
                           {"washer", 20},       {"large_world", 60},  {"large_pyramid", 10},
                           {"many_pyramids", 5}, {"convex_pile", 20},  {"junkyard", 20},
                           {"human_rain", 20},   {"jolt_pyramid", 40}, {"max_bodies", 1}};
  for (const Row& row : kRows) {
    if (scene == row.scene) return row.frames;
  }
  return 120;
}

}  // namespace isostep::tool
