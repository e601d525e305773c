// Distances to cylinders and cones.
// SPDX-License-Identifier: MIT
#pragma once

#include "distance.hpp"

namespace isostep::scenes {

ISO_INLINE bool is_revolved(ShapeType type) { return type == ShapeType::cylinder || type == ShapeType::cone; }

/// [m] The reach of a solid along a direction of the world, from the world's origin.
double support(const Solid& solid, Vec3<double> direction);

/// The distance of a cylinder or cone and any other solid, or a half-space: the widest gap along any axis, by ascent
/// from many.
double round_distance(const Solid& a, const Solid& b);

/// The depth of a point, in its own frame, inside of a cylinder or cone; less than 0: it is outside.
double depth_in_round(const Solid& solid, Vec3<double> p);

}  // namespace isostep::scenes
