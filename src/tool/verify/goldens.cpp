// The names of golden files.
// SPDX-License-Identifier: MIT
#include "goldens.hpp"

namespace isostep::tool {

std::optional<GoldenName> parse_golden_name(const std::string& name) {
  const std::size_t dot = name.find('.');
  constexpr std::string_view kEnd = ".txt";
  if (dot == std::string::npos || name.size() < dot + kEnd.size() + 2) return std::nullopt;
  if (name.compare(name.size() - kEnd.size(), kEnd.size(), kEnd) != 0) return std::nullopt;
  return GoldenName{name.substr(0, dot), name.substr(dot + 1, name.size() - kEnd.size() - dot - 1)};
}
std::string golden_name(const std::string& scene, const std::string& scalar) { return scene + "." + scalar + ".txt"; }

}  // namespace isostep::tool
