// Solids that are cast along a line against a stored shape of any type.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/collision/query/shape_cast.hpp"
#include "isostep/geometry/surfaces.hpp"

namespace isostep {

/// A cast: the solid, its pose at the start, and its motion.
template <class S> struct SolidCast {
  ConvexCore<S> core;  // in the solid's frame
  Transform<S> start;  // [m] from there to the world
  CastMotion<S> motion;
  bool back_faces;  // meets triangles from behind too
  /// Passes shapes that the solid overlaps by more than motion.touch at the start. For a surface, every triangle that
  /// it touches then.
  bool skip_inside;
};

template <class S> struct SolidHit {
  Unit<S> fraction;        // [1] of the translation
  Vec3<Unit<S>> normal;    // [1] of the shape's surface, world frame, against the solid
  Vec3<S> point;           // [m] of the shape's surface, world frame
  bool inside;             // they overlap at the start by more than `touch`
  std::uint8_t material;   // of the triangle; 0 where the shape has none
  std::uint32_t triangle;  // of a mesh or height field; else 0
};
/// Receives hits one by one, in no order.
template <class S> struct SolidHitTaker {
  void* user;
  void (*take)(void* user, const SolidHit<S>& hit);
};

/// Finds the first fraction at which the solid touches the shape: cast_convex for every shape of the list. Writes `hit`
/// only if it returns true. Of triangles hit at once the lowest is reported. A half-space takes one step instead of a
/// search.
/// Triangles:   are hit on the side that the solid moves against. That must be the outward side, unless `back_faces` is
///              set. A triangle that the solid overlaps from the start is hit if the mean of the solid's vertices is on
///              that side of it; the normal is the triangle's. A solid that touches a triangle's plane at the start and
///              moves along or away misses that triangle: nothing catches on the edges of a flat floor.
/// Error:       that of cast_convex. Limits: its own, and surfaces within Limits<S>::extent().
template <class S>
bool cast_solid(const SolidCast<S>& cast, ShapeView<S> shape, const Transform<S>& transform, SolidHit<S>& hit);
/// Reports all hits: every triangle that it would hit if that were alone; one hit of another shape.
template <class S>
void cast_solid_all(const SolidCast<S>& cast, ShapeView<S> shape, const Transform<S>& transform,
                    const SolidHitTaker<S>& taker);

namespace detail {
/// [m] Returns the margin around a box within which a cast may hit: more than the error of a cast.
template <class S> ISO_INLINE S cast_margin(S farthest) { return gap_noise(farthest) * S(8); }
}  // namespace detail

#define ISO_SOLID_CAST_OF(extern, S)                                                                        \
  extern template bool cast_solid<S>(const SolidCast<S>&, ShapeView<S>, const Transform<S>&, SolidHit<S>&); \
  extern template void cast_solid_all<S>(const SolidCast<S>&, ShapeView<S>, const Transform<S>&,            \
                                         const SolidHitTaker<S>&);
ISO_EXTERN_FOR_EACH_SCALAR(ISO_SOLID_CAST_OF)

}  // namespace isostep
