// Signed distances of surfaces, in double: the part of distance.hpp that needs their triangles.
// SPDX-License-Identifier: MIT
#pragma once

#include "distance.hpp"

namespace isostep::scenes {

/// The signed_distance() where a or b is a mesh or a height field. Gaps beyond 1 m count as infinite.
double surface_distance(const Solid& a, const Solid& b);

}  // namespace isostep::scenes
