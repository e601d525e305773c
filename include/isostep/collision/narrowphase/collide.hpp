// collide: the contact manifold of any two shapes.
// SPDX-License-Identifier: MIT
#pragma once

#include <type_traits>

#include "isostep/collision/narrowphase/polyhedra.hpp"
#include "isostep/core/instantiate.hpp"
#include "isostep/geometry/shape.hpp"

namespace isostep {

/// Fills `out` with the contact points of shapes within `margin` >= 0. For others sets count 0 and a zero normal.
/// Frame:  both transforms lead to one frame near the shapes: origin at a body's centre of mass, axes as the world's.
///         Only the difference of the positions enters normal, separation and features; moving both moves the points.
/// Order:  collide(b, a) gives the same points and the opposite normal to rounding; between unlike types exactly.
///         Two boxes whose best faces agree within axis_tolerance take a's as reference, so there the order shows.
/// Limits: Q16.16: extents and distances below 100 m; Q32.32: 1000 m. Degenerate sizes (0) are allowed. Two half-spaces
///         never touch.
/// `polyhedra`: collide_polyhedra, or a kernel with the same bits.
template <class S>
void collide(std::type_identity_t<ShapeView<S>> a, const Transform<S>& ta, std::type_identity_t<ShapeView<S>> b,
             const Transform<S>& tb, S margin, Manifold<S>& out,
             std::type_identity_t<CollidePolyhedra<S>> polyhedra = collide_polyhedra<S>);

/// A shape, or one triangle of a surface.
template <class S> struct LeafView {
  ShapeView<S> shape;
  std::uint32_t triangle;  // 0 of what is no surface
};
/// collide() for leaves.
template <class S>
void collide_leaves(const LeafView<S>& a, const Transform<S>& ta, const LeafView<S>& b, const Transform<S>& tb,
                    S margin, Manifold<S>& out, CollidePolyhedra<S> polyhedra = collide_polyhedra<S>);

#define ISO_COLLIDE_OF(extern, S)                                                                          \
  extern template void collide<S>(ShapeView<S>, const Transform<S>&, ShapeView<S>, const Transform<S>&, S, \
                                  Manifold<S>&, CollidePolyhedra<S>);                                      \
  extern template void collide_leaves<S>(const LeafView<S>&, const Transform<S>&, const LeafView<S>&,      \
                                         const Transform<S>&, S, Manifold<S>&, CollidePolyhedra<S>);
ISO_EXTERN_FOR_EACH_SCALAR(ISO_COLLIDE_OF)

}  // namespace isostep
