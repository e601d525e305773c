// Contacts of every shape with a cylinder or a cone, asked for by records.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/manifold.hpp"
#include "isostep/core/instantiate.hpp"
#include "isostep/geometry/shape.hpp"

namespace isostep {

/// b is the cylinder or cone in all of them; in the last one both are.
template <class S>
void collide_sphere_round(ShapeView<S> a, const Transform<S>& ta, ShapeView<S> b, const Transform<S>& tb, S margin,
                          Manifold<S>& out);
template <class S>
void collide_box_round(ShapeView<S> a, const Transform<S>& ta, ShapeView<S> b, const Transform<S>& tb, S margin,
                       Manifold<S>& out);
template <class S>
void collide_capsule_round(ShapeView<S> a, const Transform<S>& ta, ShapeView<S> b, const Transform<S>& tb, S margin,
                           Manifold<S>& out);
template <class S>
void collide_half_space_round(ShapeView<S> a, const Transform<S>& ta, ShapeView<S> b, const Transform<S>& tb, S margin,
                              Manifold<S>& out);
template <class S>
void collide_hull_round(ShapeView<S> a, const Transform<S>& ta, ShapeView<S> b, const Transform<S>& tb, S margin,
                        Manifold<S>& out);
template <class S>
void collide_round_round(ShapeView<S> a, const Transform<S>& ta, ShapeView<S> b, const Transform<S>& tb, S margin,
                         Manifold<S>& out);

#define ISO_ROUND_PAIR(extern, name, S) \
  extern template void name<S>(ShapeView<S>, const Transform<S>&, ShapeView<S>, const Transform<S>&, S, Manifold<S>&);
#define ISO_ROUND_PAIRS_OF(extern, S)                 \
  ISO_ROUND_PAIR(extern, collide_sphere_round, S)     \
  ISO_ROUND_PAIR(extern, collide_box_round, S)        \
  ISO_ROUND_PAIR(extern, collide_capsule_round, S)    \
  ISO_ROUND_PAIR(extern, collide_half_space_round, S) \
  ISO_ROUND_PAIR(extern, collide_hull_round, S)       \
  ISO_ROUND_PAIR(extern, collide_round_round, S)
ISO_EXTERN_FOR_EACH_SCALAR(ISO_ROUND_PAIRS_OF)

namespace detail {
/// The solid that a cylinder's or cone's record holds.
template <class S> ISO_INLINE Revolved<S> revolved_of(const Primitive<S>& primitive) {
  return primitive.type == ShapeType::cylinder ? Revolved<S>::cylinder(primitive.radius, primitive.half.y)
                                               : Revolved<S>::cone(primitive.radius, primitive.half.y);
}
}  // namespace detail

}  // namespace isostep
