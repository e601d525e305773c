// free_way: a solid moves until it would pass a shape, at rest or moving too.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/continuous/core_motion.hpp"
#include "isostep/core/instantiate.hpp"
#include "isostep/geometry/shape.hpp"

namespace isostep {

/// A shape and the placement of its frame in another frame.
template <class S> struct PlacedShape {
  ShapeView<S> shape;
  Transform<S> at;
};

/// [m] Returns the depth to which another solid's middle may get into a shape and still be pushed out the way it came:
/// its inner radius, at most 1 m. Zero for a surface without an inside.
template <class S> S thickness(const ShapeView<S>& shape);

/// The part of its motion that a solid is free to make.
template <class S> struct FreeWay {
  Unit<S> fraction;      // [1] 0 ... 1; 1: all the way
  bool is_held;          // only its middle is stopped there: it may turn
  Vec3<S> middle;        // [m] in its frame, if it is held
  Vec3<Unit<S>> normal;  // [1] where the middle may not go on, if it is held
};

/// Finds how far `a`, a solid, moves before it would pass `b`. `b` moves as well if it is a solid; half-spaces and
/// surfaces stay at the start of `of_b`. Both are placed in the frames of the poses.
/// Method:  sweeps a solid that lies kGraze inside `a` (a quarter of its inner radius, if that is less) until the two
///          overlap by half to three quarters of that: whatever misses the inner solid only grazes. To stop where all
///          of `a` touches would hold a solid that slides or tips over. Contacts close gaps of that size.
///          If the inner solid overlaps by as much from the start, sweeps one twice as deep in `a`, and so on up to
///          half of the inner radius: where one end touches, the other is stopped at the surface as well.
///          If even that one overlaps, sweeps a ball in its middle, of three quarters of that radius down to a
///          sixteenth. The smallest one only moves away from what it touches.
///          Where an earlier step stopped `a`, a motion that dips in at once, a turn with a contact at one end, would
///          stop for ever. It goes as far as a solid another kGraze deep, unless that makes no progress either.
template <class S>
FreeWay<S> free_way(const PlacedShape<S>& a, const CoreMotion<S>& motion, const PlacedShape<S>& b,
                    const CoreMotion<S>& of_b);

/// Returns true if `a`, a solid, overlaps `b` by more than kTooDeep, or by more than half of its inner radius if that
/// is less. Contacts handle shallower overlaps.
template <class S>
bool is_deep(const PlacedShape<S>& a, const Pose<S>& pose_of_a, const PlacedShape<S>& b, const Pose<S>& pose_of_b);

/// Returns true if they touch at the start: apart, or overlapping by at most half of kGraze. Sets `on_a` to the place
/// of the touch, at most kGraze deep in `a`.
template <class S>
bool touches_at_start(const PlacedShape<S>& a, const CoreMotion<S>& motion, const PlacedShape<S>& b,
                      const Pose<S>& pose_of_b, Vec3<S>& on_a);

namespace detail {
template <class S> inline constexpr S kThick = S(1);            // [m]
template <class S> inline constexpr S kGraze = S(0.00390625);   // [m]
template <class S> inline constexpr S kTooDeep = S(0.0078125);  // [m] twice as much: what is stopped is not deep
}  // namespace detail

#define ISO_SHAPE_IMPACT_OF(extern, S)                                                                           \
  extern template S thickness<S>(const ShapeView<S>&);                                                           \
  extern template FreeWay<S> free_way<S>(const PlacedShape<S>&, const CoreMotion<S>&, const PlacedShape<S>&,     \
                                         const CoreMotion<S>&);                                                  \
  extern template bool is_deep<S>(const PlacedShape<S>&, const Pose<S>&, const PlacedShape<S>&, const Pose<S>&); \
  extern template bool touches_at_start<S>(const PlacedShape<S>&, const CoreMotion<S>&, const PlacedShape<S>&,   \
                                           const Pose<S>&, Vec3<S>&);
ISO_EXTERN_FOR_EACH_SCALAR(ISO_SHAPE_IMPACT_OF)

}  // namespace isostep
