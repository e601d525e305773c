// The item of an array that the path of a field goes through.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string_view>

namespace isostep::tool {

struct PathItem {
  std::string_view array;  // "bodies" of "bodies[17].position.x"; empty: the path goes through no array
  std::size_t index;
};
inline PathItem first_item(std::string_view path) {
  const std::size_t open = path.find('['), close = path.find(']');
  if (open == std::string_view::npos || close == std::string_view::npos) return {{}, 0};
  std::size_t index = 0;
  for (const char c : path.substr(open + 1, close - open - 1)) index = 10 * index + static_cast<std::size_t>(c - '0');
  return {path.substr(0, open), index};
}

}  // namespace isostep::tool
