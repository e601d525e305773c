// Contacts of every shape with a hull: polyhedra.hpp and round_polyhedron.hpp, asked for by records.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/polyhedra.hpp"
#include "isostep/core/instantiate.hpp"
#include "isostep/geometry/shape.hpp"

namespace isostep {

/// b is the hull in all five. `polyhedra`: see collide().
template <class S>
void collide_sphere_hull(ShapeView<S> a, const Transform<S>& ta, ShapeView<S> b, const Transform<S>& tb, S margin,
                         Manifold<S>& out);
template <class S>
void collide_box_hull(ShapeView<S> a, const Transform<S>& ta, ShapeView<S> b, const Transform<S>& tb, S margin,
                      Manifold<S>& out, CollidePolyhedra<S> polyhedra);
template <class S>
void collide_capsule_hull(ShapeView<S> a, const Transform<S>& ta, ShapeView<S> b, const Transform<S>& tb, S margin,
                          Manifold<S>& out);
template <class S>
void collide_half_space_hull(ShapeView<S> a, const Transform<S>& ta, ShapeView<S> b, const Transform<S>& tb, S margin,
                             Manifold<S>& out);
template <class S>
void collide_hull_hull(ShapeView<S> a, const Transform<S>& ta, ShapeView<S> b, const Transform<S>& tb, S margin,
                       Manifold<S>& out, CollidePolyhedra<S> polyhedra);

#define ISO_HULL_PAIR(extern, name, S, ...)                                                             \
  extern template void name<S>(ShapeView<S>, const Transform<S>&, ShapeView<S>, const Transform<S>&, S, \
                               Manifold<S>& __VA_OPT__(, ) __VA_ARGS__);
#define ISO_HULL_PAIRS_OF(extern, S)                              \
  ISO_HULL_PAIR(extern, collide_sphere_hull, S)                   \
  ISO_HULL_PAIR(extern, collide_box_hull, S, CollidePolyhedra<S>) \
  ISO_HULL_PAIR(extern, collide_capsule_hull, S)                  \
  ISO_HULL_PAIR(extern, collide_half_space_hull, S)               \
  ISO_HULL_PAIR(extern, collide_hull_hull, S, CollidePolyhedra<S>)
ISO_EXTERN_FOR_EACH_SCALAR(ISO_HULL_PAIRS_OF)

}  // namespace isostep
