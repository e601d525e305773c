// Exact signed distances of hulls, in double: the part of distance.hpp that needs their faces.
// SPDX-License-Identifier: MIT
#pragma once

#include "distance.hpp"

namespace isostep::scenes {

/// The signed_distance() where a or b is a hull.
double hull_distance(const Solid& a, const Solid& b);

}  // namespace isostep::scenes
