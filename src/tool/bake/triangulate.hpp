// Polygons into triangles, by cutting ears off.
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "isostep/math/vec3.hpp"

namespace isostep::tool::bake {

/// Triangles of a polygon's corners, by their numbers, each in the polygon's own direction: two fewer than corners. The
/// polygon may have dents, and need not be quite flat. One that crosses itself is cut all the same, somehow.
/// Source: Meisters 1975, Polygons have ears; the direction is that of Newell's normal.
std::vector<std::array<std::uint32_t, 3>> triangulated(std::span<const Vec3<double>> polygon);

}  // namespace isostep::tool::bake
