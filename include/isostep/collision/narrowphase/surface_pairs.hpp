// Convexes against surfaces, meshes and height fields: triangle by triangle, or as a whole.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/manifold.hpp"
#include "isostep/core/instantiate.hpp"
#include "isostep/geometry/bounds.hpp"
#include "isostep/geometry/surfaces.hpp"

namespace isostep {

/// Calls visit(triangle) for triangles of surface b whose boxes meet that of a, grown by `margin`, until it returns
/// false. The order depends on the surface alone.
template <class S, class Visit>
ISO_INLINE bool visit_triangles_near(ShapeView<S> a, const Transform<S>& ta, ShapeView<S> b, const Transform<S>& tb,
                                     S margin, Visit&& visit) {
  return detail::visit_surface(b, [&](const auto& surface) ISO_INLINE_LAMBDA {
    const Aabb<S> box = grow(bounds(a, relative(tb, ta)), margin);
    MeshBox steps;
    for (int axis = 0; axis < 3; ++axis) {
      steps.low[axis] = floor_scaled(box.low[axis], surface.exponent());
      steps.high[axis] = floor_scaled(box.high[axis], surface.exponent()) + 1;
    }
    return surface.query(steps, visit);
  });
}

/// Collides a convex a with one triangle of surface b: round_triangle.hpp, polyhedron_triangle.hpp. The normal points
/// from a into the surface.
template <class S>
void collide_with_triangle(ShapeView<S> a, const Transform<S>& ta, ShapeView<S> b, std::uint32_t triangle,
                           const Transform<S>& tb, S margin, Manifold<S>& out);

/// Collides with all triangles. Returns the manifold with the deepest point, of equals that of the lowest triangle.
template <class S>
void collide_with_surface(ShapeView<S> a, const Transform<S>& ta, ShapeView<S> b, const Transform<S>& tb, S margin,
                          Manifold<S>& out);

/// Collides a convex b whose type comes after surfaces in the list of shapes. The normal points out of surface a.
template <class S>
void collide_surface_with(ShapeView<S> a, const Transform<S>& ta, ShapeView<S> b, const Transform<S>& tb, S margin,
                          Manifold<S>& out);

#define ISO_SURFACE_PAIRS_OF(extern, S)                                                                              \
  extern template void collide_with_triangle<S>(ShapeView<S>, const Transform<S>&, ShapeView<S>, std::uint32_t,      \
                                                const Transform<S>&, S, Manifold<S>&);                               \
  extern template void collide_with_surface<S>(ShapeView<S>, const Transform<S>&, ShapeView<S>, const Transform<S>&, \
                                               S, Manifold<S>&);                                                     \
  extern template void collide_surface_with<S>(ShapeView<S>, const Transform<S>&, ShapeView<S>, const Transform<S>&, \
                                               S, Manifold<S>&);
ISO_EXTERN_FOR_EACH_SCALAR(ISO_SURFACE_PAIRS_OF)

}  // namespace isostep
