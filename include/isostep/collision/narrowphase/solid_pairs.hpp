// The pairs of all solids: any two whose shapes have no function of their own.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/manifold.hpp"
#include "isostep/core/instantiate.hpp"
#include "isostep/geometry/shape.hpp"

namespace isostep {

/// Contacts of two solids where they are nearer than `margin` [m]; the normal points from a to b.
/// Axis:   see SolidGap: that of the two faces that look at each other, or across two lines, where a point proves that
///         none is better; else what GJK finds of the solids moved apart; else EPA's.
/// Points: of a solid on a flat face up to four that are over it, of two lines beside each other the ends, else one.
///         Flat faces go before lines and points unless those are better by 1/128 of the smaller inner radius.
template <class S>
void collide_solids(ShapeView<S> a, const Transform<S>& ta, ShapeView<S> b, const Transform<S>& tb, S margin,
                    Manifold<S>& out);
/// A ball and a solid: the nearest point of the solid to the centre.
template <class S>
void collide_sphere_solid(ShapeView<S> a, const Transform<S>& ta, ShapeView<S> b, const Transform<S>& tb, S margin,
                          Manifold<S>& out);
/// A half-space and a solid: what of the solid looks down.
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
