// What the files of surfaces, meshes and height fields, have in common.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/geometry/baked/surface_blob.hpp"
#include "isostep/geometry/baked/surface_queries.hpp"
#include "isostep/geometry/shapes/shape_parts.hpp"

namespace isostep::detail {

/// All points of a surface are within the extent of a shape.
template <class S, class Content> ISO_INLINE ShapeFault fault_of_surface(const Content& content) {
  if (!content.surface) return ShapeFault::blob_not_valid;
  const MeshBox box = content.surface->bounds();
  const std::int64_t extent = floor_scaled(Limits<S>::extent(), content.surface->exponent());
  for (int axis = 0; axis < 3; ++axis) {
    if (-box.low[axis] > extent || box.high[axis] > extent) return ShapeFault::size_too_large;
  }
  return ShapeFault::none;
}
template <class G, class S> ISO_INLINE Aabb<S> bounds_of_surface(const G& surface, const Transform<S>& t) {
  const Aabb<S> box = box_of_surface<G, S>(surface);
  Vec3<S> low = t.rotation * box.low, high = low;
  for (int corner = 1; corner < 8; ++corner) {
    const Vec3<S> p = t.rotation * Vec3<S>{(corner & 1) != 0 ? box.high.x : box.low.x,
                                           (corner & 2) != 0 ? box.high.y : box.low.y,
                                           (corner & 4) != 0 ? box.high.z : box.low.z};
    low = min(low, p);
    high = max(high, p);
  }
  return {t.position + low, t.position + high};
}
template <class S, class G, class Visit> ISO_INLINE void visit_points_of_surface(const G& surface, const Visit& visit) {
  for (std::uint32_t id = 0; id < surface.triangle_count(); ++id) {
    if (!surface.has_triangle(id)) continue;
    const BakedTriangle triangle = surface.triangle(id);
    Vec3<S> points[3];
    for (int i = 0; i < 3; ++i) {
      points[i] = {from_lattice<S>(triangle.points[i].x, surface.exponent()),
                   from_lattice<S>(triangle.points[i].y, surface.exponent()),
                   from_lattice<S>(triangle.points[i].z, surface.exponent())};
    }
    visit(id, points);
  }
}
/// Each edge once: by its triangle of the lower id.
template <class S, class G, class Line> ISO_INLINE void visit_lines_of_surface(const G& surface, const Line& line) {
  visit_points_of_surface<S>(surface, [&](std::uint32_t id, const Vec3<S>(&p)[3]) ISO_INLINE_LAMBDA {
    for (int k = 0; k < 3; ++k) {
      if (id < surface.neighbour(id, k)) line(p[k], p[(k + 1) % 3]);
    }
  });
}

}  // namespace isostep::detail
