// Bodies of revolved_pairs.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/capsule_revolved.inl"
#include "isostep/collision/narrowphase/revolved_pairs.hpp"
#include "isostep/collision/narrowphase/revolved_polyhedron.inl"
#include "isostep/collision/narrowphase/revolved_revolved.inl"
#include "isostep/collision/narrowphase/rounded_revolved.inl"
#include "isostep/geometry/baked/box_solid.hpp"

namespace isostep {

template <class S>
void collide_sphere_round(ShapeView<S> a, const Transform<S>& ta, ShapeView<S> b, const Transform<S>& tb, S margin,
                          Manifold<S>& out) {
  out.clear();
  const S radius = a.primitive.radius;
  const Vec3<S> centre = to_local(tb, ta.position);
  const ClosestPoint<S> nearest = detail::revolved_of(b.primitive).closest(centre);
  if (nearest.distance - radius > margin) return;
  detail::touch_round(centre, nearest.distance, nearest.normal, radius, tb, 0, out);
}
template <class S>
void collide_box_round(ShapeView<S> a, const Transform<S>& ta, ShapeView<S> b, const Transform<S>& tb, S margin,
                       Manifold<S>& out) {
  const BoxSolid<S> box(a.primitive.half);
  collide_revolved_polyhedron(detail::revolved_of(b.primitive), tb, box.polyhedron(), ta, margin, out);
  out.normal = -out.normal;
}
template <class S>
void collide_capsule_round(ShapeView<S> a, const Transform<S>& ta, ShapeView<S> b, const Transform<S>& tb, S margin,
                           Manifold<S>& out) {
  const Capsule<S> capsule = shape_as<Capsule>(a);
  collide_capsule_revolved(capsule.half_height, capsule.radius, ta, detail::revolved_of(b.primitive), tb, margin, out);
}
template <class S>
void collide_half_space_round(ShapeView<S> a, const Transform<S>& ta, ShapeView<S> b, const Transform<S>& tb, S margin,
                              Manifold<S>& out) {
  const HalfSpace<S> space = shape_as<HalfSpace>(a);
  collide_revolved_half_space(detail::revolved_of(b.primitive), tb, space.normal, space.offset, ta, margin, out);
  out.normal = -out.normal;
}
template <class S>
void collide_hull_round(ShapeView<S> a, const Transform<S>& ta, ShapeView<S> b, const Transform<S>& tb, S margin,
                        Manifold<S>& out) {
  const Hull<S> hull = shape_as<Hull>(a);
  const detail::Revolved<S> solid = detail::revolved_of(b.primitive);
  if (hull.is_rounded()) {
    collide_rounded_revolved(solid, tb, rounded_of(hull), ta, margin, out);
  } else {
    collide_revolved_polyhedron(solid, tb, hull.polyhedron(), ta, margin, out);
  }
  out.normal = -out.normal;
}
template <class S>
void collide_round_round(ShapeView<S> a, const Transform<S>& ta, ShapeView<S> b, const Transform<S>& tb, S margin,
                         Manifold<S>& out) {
  collide_revolved_revolved(detail::revolved_of(a.primitive), ta, detail::revolved_of(b.primitive), tb, margin, out);
}

}  // namespace isostep
