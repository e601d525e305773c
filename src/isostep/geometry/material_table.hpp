// Tables of materials as the content of meshes and height fields has them: at its end, and only where there is one.
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "isostep/geometry/baked/surface_material.hpp"
#include "isostep/state/archive.hpp"

namespace isostep {

Result<void> check_table(std::span<const SurfaceMaterial> table);
void write_table(Writer& writer, const std::vector<SurfaceMaterial>& table);
std::vector<SurfaceMaterial> read_table(Reader& reader);

}  // namespace isostep
