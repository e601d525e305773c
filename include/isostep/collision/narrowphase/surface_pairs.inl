// Bodies of surface_pairs.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/polyhedron_triangle.inl"
#include "isostep/collision/narrowphase/round_triangle.inl"
#include "isostep/collision/narrowphase/rounded_polyhedra.inl"
#include "isostep/collision/narrowphase/solid_triangle.inl"
#include "isostep/collision/narrowphase/surface_pairs.hpp"
#include "isostep/geometry/baked/box_solid.hpp"
#include "isostep/geometry/baked/surface_queries.inl"
#include "isostep/geometry/bounds.hpp"

namespace isostep {

namespace detail {
/// Returns the frame of b's surface beside a. Gives equal bits anywhere if the difference of the positions is exact.
template <class S>
ISO_INLINE SurfaceFrame<S> frame_from(const ShapeView<S>& a, const Transform<S>& ta, const Transform<S>& tb,
                                      int exponent) {
  const Transform<S> turn_a = {Vec3<S>::zero(), ta.rotation}, b_from_a = {tb.position - ta.position, tb.rotation};
  return {turn_a, middle_of(a), b_from_a, exponent};
}
}  // namespace detail

template <class S>
void collide_with_triangle(ShapeView<S> a, const Transform<S>& ta, ShapeView<S> b, std::uint32_t triangle,
                           const Transform<S>& tb, S margin, Manifold<S>& out) {
  detail::visit_surface(b, [&](const auto& surface) ISO_INLINE_LAMBDA {
    const BakedTriangle baked = surface.triangle(triangle);
    const SurfaceFrame<S> frame(ta, detail::middle_of(a), tb, surface.exponent());
    switch (a.primitive.type) {
      case ShapeType::sphere: return collide_sphere_triangle(a.primitive.radius, ta, frame, baked, margin, out);
      case ShapeType::capsule: {
        const Capsule<S> capsule = shape_as<Capsule>(a);
        return collide_capsule_triangle(capsule.half_height, capsule.radius, ta, frame, baked, margin, out);
      }
      case ShapeType::box: {
        const BoxSolid<S> box(a.primitive.half);
        return collide_polyhedron_triangle(box.polyhedron(), ta, frame, baked, margin, out);
      }
      case ShapeType::hull: {
        const Hull<S> hull = shape_as<Hull>(a);
        if (!hull.is_rounded()) return collide_polyhedron_triangle(hull.polyhedron(), ta, frame, baked, margin, out);
        return collide_rounded_triangle(rounded_of(hull), ta, frame, baked, margin, out);
      }
      default:
        if (!is_bounded(a.primitive.type)) return out.clear();
        return collide_solid_triangle(a, ta, detail::frame_from(a, ta, tb, surface.exponent()), baked, margin, out);
    }
  });
}

template <class S>
void collide_with_surface(ShapeView<S> a, const Transform<S>& ta, ShapeView<S> b, const Transform<S>& tb, S margin,
                          Manifold<S>& out) {
  out.clear();
  S deepest = highest<S>();
  std::uint32_t of = kNoTriangle;
  visit_triangles_near(a, ta, b, tb, margin, [&](std::uint32_t triangle) {
    Manifold<S> found;
    collide_with_triangle(a, ta, b, triangle, tb, margin, found);
    S least = highest<S>();
    for (int i = 0; i < found.count; ++i) least = min(least, found.points[i].separation);
    if (found.count == 0 || deepest < least || (deepest == least && of < triangle)) return true;
    deepest = least;
    of = triangle;
    out = found;
    return true;
  });
}

template <class S>
void collide_surface_with(ShapeView<S> a, const Transform<S>& ta, ShapeView<S> b, const Transform<S>& tb, S margin,
                          Manifold<S>& out) {
  collide_with_surface(b, tb, a, ta, margin, out);
  out.normal = -out.normal;
}

}  // namespace isostep
