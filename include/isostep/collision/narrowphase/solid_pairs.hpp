// The pairs of all solids: any two whose shapes have no function of their own.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/manifold.hpp"
#include "isostep/core/instantiate.hpp"
#include "isostep/geometry/shape.hpp"

namespace isostep {

/// Finds the contacts of two solids where they are nearer than `margin` [m]. The normal points from a to b.
/// Axis:   see SolidGap: that of two faces that look at each other, or across two lines, if a point proves that none is
///         better; else the one that GJK finds for the solids moved apart; else EPA's.
/// Points: up to four of a solid over a flat face, the ends of two lines beside each other, else one. Flat faces go
///         before lines and points unless those are better by 1/128 of the smaller inner radius.
template <class S>
void collide_solids(ShapeView<S> a, const Transform<S>& ta, ShapeView<S> b, const Transform<S>& tb, S margin,
                    Manifold<S>& out);
/// Collides a ball with a solid, at the solid's point nearest to the centre.
template <class S>
void collide_sphere_solid(ShapeView<S> a, const Transform<S>& ta, ShapeView<S> b, const Transform<S>& tb, S margin,
                          Manifold<S>& out);
/// Collides a half-space with a solid, at the part of the solid that looks down.
template <class S>
void collide_half_space_solid(ShapeView<S> a, const Transform<S>& ta, ShapeView<S> b, const Transform<S>& tb, S margin,
                              Manifold<S>& out);

#define ISO_SOLID_PAIR(extern, name, S) \
  extern template void name<S>(ShapeView<S>, const Transform<S>&, ShapeView<S>, const Transform<S>&, S, Manifold<S>&);
#define ISO_SOLID_PAIRS_OF(extern, S)             \
  ISO_SOLID_PAIR(extern, collide_solids, S)       \
  ISO_SOLID_PAIR(extern, collide_sphere_solid, S) \
  ISO_SOLID_PAIR(extern, collide_half_space_solid, S)
ISO_EXTERN_FOR_EACH_SCALAR(ISO_SOLID_PAIRS_OF)

}  // namespace isostep
