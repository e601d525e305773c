// Bodies of hull_pairs.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/hull_pairs.hpp"
#include "isostep/collision/narrowphase/polyhedra.inl"
#include "isostep/collision/narrowphase/round_polyhedron.inl"
#include "isostep/collision/narrowphase/rounded_polyhedra.inl"
#include "isostep/geometry/baked/box_solid.hpp"
#include "isostep/geometry/baked/polyhedron_surface.inl"

namespace isostep {

namespace detail {
/// Moves the points of a sphere or capsule, thickened by the radius of a rounded b, from b's core out to its skin.
template <class S> ISO_INLINE void move_to_skin(S radius, Manifold<S>& out) {
  for (int i = 0; i < out.count; ++i) out.points[i].position -= out.normal * radius;
}
}  // namespace detail

template <class S>
void collide_sphere_hull(ShapeView<S> a, const Transform<S>& ta, ShapeView<S> b, const Transform<S>& tb, S margin,
                         Manifold<S>& out) {
  const Hull<S> hull = shape_as<Hull>(b);
  collide_sphere_polyhedron(a.primitive.radius + hull.radius, ta, hull.polyhedron(), tb, margin, out);
  if (hull.is_rounded()) detail::move_to_skin(hull.radius, out);
}
template <class S>
void collide_box_hull(ShapeView<S> a, const Transform<S>& ta, ShapeView<S> b, const Transform<S>& tb, S margin,
                      Manifold<S>& out, CollidePolyhedra<S> polyhedra) {
  const BoxSolid<S> box(a.primitive.half);
  const Hull<S> hull = shape_as<Hull>(b);
  if (!hull.is_rounded()) return polyhedra(box.polyhedron(), ta, hull.polyhedron(), tb, margin, out);
  collide_rounded_polyhedra({box.polyhedron(), S(0)}, ta, rounded_of(hull), tb, margin, out, polyhedra);
}
template <class S>
void collide_capsule_hull(ShapeView<S> a, const Transform<S>& ta, ShapeView<S> b, const Transform<S>& tb, S margin,
                          Manifold<S>& out) {
  const Capsule<S> capsule = shape_as<Capsule>(a);
  const Hull<S> hull = shape_as<Hull>(b);
  const S radius = capsule.radius + hull.radius;
  collide_capsule_polyhedron(capsule.half_height, radius, ta, hull.polyhedron(), tb, margin, out);
  if (hull.is_rounded()) detail::move_to_skin(hull.radius, out);
}
template <class S>
void collide_half_space_hull(ShapeView<S> a, const Transform<S>& ta, ShapeView<S> b, const Transform<S>& tb, S margin,
                             Manifold<S>& out) {
  const HalfSpace<S> space = shape_as<HalfSpace>(a);
  const Hull<S> hull = shape_as<Hull>(b);
  const S reach = margin + hull.radius;
  collide_polyhedron_half_space(hull.polyhedron(), tb, space.normal, space.offset, ta, reach, out);
  if (hull.is_rounded()) detail::grow_cores(out, hull.radius, S(0), margin);
  out.normal = -out.normal;
}
template <class S>
void collide_hull_hull(ShapeView<S> a, const Transform<S>& ta, ShapeView<S> b, const Transform<S>& tb, S margin,
                       Manifold<S>& out, CollidePolyhedra<S> polyhedra) {
  const Hull<S> of_a = shape_as<Hull>(a), of_b = shape_as<Hull>(b);
  if (!of_a.is_rounded() && !of_b.is_rounded())
    return polyhedra(of_a.polyhedron(), ta, of_b.polyhedron(), tb, margin, out);
  collide_rounded_polyhedra(rounded_of(of_a), ta, rounded_of(of_b), tb, margin, out, polyhedra);
}

}  // namespace isostep
