// Exact signed distances between primitives, in double: an oracle beside the engine's own narrow phase.
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "hull_points.hpp"
#include "isostep/geometry/shape.hpp"
#include "isostep/math/transform.hpp"
#include "surface_points.hpp"

namespace isostep::scenes {

/// A primitive where it lies in the world.
struct Solid {
  ShapeType type;
  Vec3<double> centre;  // [m] of its frame
  Mat3<double> axes;    // [1] to world
  Vec3<double> half;    // [m] of the core: box, or (0, half height, 0) of a capsule, cylinder or cone
  double radius;        // [m] around the core, of a hull too; of a cylinder or cone its own
  Vec3<double> normal;  // [1] half-space, world
  double offset;        // [m] half-space, world: normal . p <= offset is inside
  std::shared_ptr<const SolidHull> hull = nullptr;
  std::shared_ptr<const SolidSurface> surface = nullptr;
};

/// Greater than 0: the gap [m], or less than it where no axis shows all of it; less than 0: the overlap, the shortest
/// way out. Exact for every overlap, and for every gap but of two boxes or hulls, where it is the widest of the axes
/// that can separate them. Of a surface and a box or hull: by how far the body's vertices are under the surface, or the
/// surface's points inside the body; of two surfaces, or a half-space and a surface, infinite.
double signed_distance(const Solid& a, const Solid& b);

}  // namespace isostep::scenes
