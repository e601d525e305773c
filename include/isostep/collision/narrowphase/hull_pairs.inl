// Bodies of hull_pairs.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/hull_pairs.hpp"
#include "isostep/collision/narrowphase/polyhedra.inl"
#include "isostep/collision/narrowphase/round_polyhedron.inl"
#include "isostep/geometry/baked/box_solid.hpp"
#include "isostep/geometry/baked/polyhedron_surface.inl"

namespace isostep {

template <class S>
void collide_sphere_hull(ShapeView<S> a, const Transform<S>& ta, ShapeView<S> b, const Transform<S>& tb, S margin,
                         Manifold<S>& out) {
  collide_sphere_polyhedron(a.primitive.radius, ta, detail::hull_of(b), tb, margin, out);
}
template <class S>
void collide_box_hull(ShapeView<S> a, const Transform<S>& ta, ShapeView<S> b, const Transform<S>& tb, S margin,
                      Manifold<S>& out) {
  const BoxSolid<S> box(a.primitive.half);
  collide_polyhedra(box.polyhedron(), ta, detail::hull_of(b), tb, margin, out);
}
template <class S>
void collide_capsule_hull(ShapeView<S> a, const Transform<S>& ta, ShapeView<S> b, const Transform<S>& tb, S margin,
                          Manifold<S>& out) {
  const Capsule<S> capsule = Capsule<S>::of(a.primitive);
  collide_capsule_polyhedron(capsule.half_height, capsule.radius, ta, detail::hull_of(b), tb, margin, out);
}
template <class S>
void collide_half_space_hull(ShapeView<S> a, const Transform<S>& ta, ShapeView<S> b, const Transform<S>& tb, S margin,
                             Manifold<S>& out) {
  const HalfSpace<S> space = HalfSpace<S>::of(a.primitive);
  collide_polyhedron_half_space(detail::hull_of(b), tb, space.normal, space.offset, ta, margin, out);
  out.normal = -out.normal;
}
template <class S>
void collide_hull_hull(ShapeView<S> a, const Transform<S>& ta, ShapeView<S> b, const Transform<S>& tb, S margin,
                       Manifold<S>& out) {
  collide_polyhedra(detail::hull_of(a), ta, detail::hull_of(b), tb, margin, out);
}

}  // namespace isostep
