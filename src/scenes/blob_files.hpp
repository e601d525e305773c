// The baked files that the parts of a scene name: `isostep bake` writes them.
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "isostep/geometry/blob.hpp"
#include "scene.hpp"

namespace isostep::scenes {

/// Parts of that type may name a file.
bool has_blob(ShapeType type);

/// Each file is read once, however many parts name it.
class BlobFiles {
 public:
  /// Names are relative to the folder of the scene file.
  explicit BlobFiles(const std::string& folder) : folder_(folder) {}

  /// Throws SceneError with the place of the name, the name and what was expected. Whether the bytes make a shape,
  /// `build` tells.
  BlobRef read(const std::string& name, ShapeType type, const std::string& place);

 private:
  std::filesystem::path folder_;
  std::map<std::string, BlobRef> read_;
};

}  // namespace isostep::scenes
