// Scene files: JSON in and out. The format is in src/tool/README.md; an error names the place of what is not known.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "scene.hpp"

namespace isostep::scenes {

/// Throws SceneError: "/bodies/3/mass: expected a number, found a string", or "12:5: ..." where it is no JSON.
/// What only a scalar can tell, its range and what its world accepts, `build` tells. Baked files that parts name are
/// relative to `folder`.
Scene read_scene(std::string_view json, const std::string& folder = {});

/// Reads back as the same scene, number for number.
std::string write_scene(const Scene& scene);

}  // namespace isostep::scenes
