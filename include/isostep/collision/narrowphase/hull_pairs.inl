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
  collide_sphere_polyhedron(a.primitive.radius, ta, shape_as<Hull>(b).polyhedron(), tb, margin, out);
}
template <class S>
void collide_box_hull(ShapeView<S> a, const Transform<S>& ta, ShapeView<S> b, const Transform<S>& tb, S margin,
                      Manifold<S>& out, CollidePolyhedra<S> polyhedra) {
  const BoxSolid<S> box(a.primitive.half);
  polyhedra(box.polyhedron(), ta, shape_as<Hull>(b).polyhedron(), tb, margin, out);
}
template <class S>
void collide_capsule_hull(ShapeView<S> a, const Transform<S>& ta, ShapeView<S> b, const Transform<S>& tb, S margin,
                          Manifold<S>& out) {
  const Capsule<S> capsule = shape_as<Capsule>(a);
  collide_capsule_polyhedron(capsule.half_height, capsule.radius, ta, shape_as<Hull>(b).polyhedron(), tb, margin, out);
}
template <class S>
void collide_half_space_hull(ShapeView<S> a, const Transform<S>& ta, ShapeView<S> b, const Transform<S>& tb, S margin,
                             Manifold<S>& out) {
  const HalfSpace<S> space = shape_as<HalfSpace>(a);
  collide_polyhedron_half_space(shape_as<Hull>(b).polyhedron(), tb, space.normal, space.offset, ta, margin, out);
  out.normal = -out.normal;
}
template <class S>
void collide_hull_hull(ShapeView<S> a, const Transform<S>& ta, ShapeView<S> b, const Transform<S>& tb, S margin,
                       Manifold<S>& out, CollidePolyhedra<S> polyhedra) {
  polyhedra(shape_as<Hull>(a).polyhedron(), ta, shape_as<Hull>(b).polyhedron(), tb, margin, out);
}

}  // namespace isostep
