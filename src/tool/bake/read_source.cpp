// The choice of the reader of a file.
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cctype>
#include <filesystem>

#include "source_mesh.hpp"

namespace isostep::tool::bake {

SourceMesh read_source(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return ending == ".obj" ? read_obj(path) : read_by_assimp(path);
}

std::uint32_t place_of(const std::string& name, std::vector<std::string>& names) {
  const auto place = static_cast<std::uint32_t>(std::find(names.begin(), names.end(), name) - names.begin());
  if (place == names.size()) names.push_back(name);
  return place;
}

}  // namespace isostep::tool::bake
