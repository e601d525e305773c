// Frame hashes to text.
// SPDX-License-Identifier: MIT
#include "hash_lines.hpp"

#include "tool.hpp"

namespace isostep::tool {

std::string hash_lines(const std::vector<std::uint64_t>& hashes) {
  std::string text;
  for (std::size_t i = 0; i < hashes.size(); ++i) text += std::to_string(i) + " " + hex(hashes[i]) + "\n";
  return text;
}

}  // namespace isostep::tool
