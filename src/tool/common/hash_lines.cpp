// Frame hashes to text and back.
// SPDX-License-Identifier: MIT
#include "hash_lines.hpp"

#include <charconv>

#include "tool.hpp"

namespace isostep::tool {

std::string hash_lines(const std::vector<std::uint64_t>& hashes) {
  std::string text;
  for (std::size_t i = 0; i < hashes.size(); ++i) text += std::to_string(i) + " " + hex(hashes[i]) + "\n";
  return text;
}

std::optional<std::vector<std::uint64_t>> parse_hash_lines(std::string_view text) {
  std::vector<std::uint64_t> hashes;
  while (!text.empty()) {
    const std::string number = std::to_string(hashes.size()) + " ";
    std::size_t end = text.find('\n');
    if (end == std::string_view::npos) return std::nullopt;
    std::string_view line = text.substr(0, end);
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    std::uint64_t hash = 0;
    if (line.size() != number.size() + 16 || line.substr(0, number.size()) != number) return std::nullopt;
    const char* first = line.data() + number.size();
    const auto [stop, error] = std::from_chars(first, first + 16, hash, 16);
    if (error != std::errc{} || stop != first + 16) return std::nullopt;
    hashes.push_back(hash);
    text.remove_prefix(end + 1);
  }
  return hashes;
}

}  // namespace isostep::tool
