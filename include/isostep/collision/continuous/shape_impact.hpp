// How far a solid that moves gets before it would pass a shape at rest.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/continuous/core_motion.hpp"
#include "isostep/core/instantiate.hpp"
#include "isostep/geometry/shape.hpp"

namespace isostep {

/// A shape and where its frame is in another.
template <class S> struct PlacedShape {
  ShapeView<S> shape;
  Transform<S> at;
};

/// [m] How deep another solid's middle may get into a shape and still be pushed out the way it came: its inner radius,
/// at most 1 m. A surface without an inside has none.
template <class S> S thickness(const ShapeView<S>& shape);

/// The fraction of its motion, 0 ... 1, up to which `a`, a solid, does not pass `b`, which is at rest at `pose_of_b`.
/// Placed in the frames of the poses.
/// Method:  `a` is swept as a solid that is kGraze deep in it (a quarter of its inner radius, if that is less): what
///          does not touch that one grazes. Where it touches, the fraction is that at which all of `a` does: there the
///          two are apart by a quarter to a half of kGraze. Where all of `a` touches from the start, it is the former.
///          If even that does, the solid a quarter of the inner radius deep in `a` is swept, then balls in its middle
///          of three quarters and one quarter of that radius. The last goes nowhere but away from what it touches.
template <class S>
Unit<S> free_fraction(const PlacedShape<S>& a, const CoreMotion<S>& motion, const PlacedShape<S>& b,
                      const Pose<S>& pose_of_b);

namespace detail {
template <class S> inline constexpr S kThick = S(1);           // [m]
template <class S> inline constexpr S kGraze = S(0.00390625);  // [m]
}  // namespace detail

#define ISO_SHAPE_IMPACT_OF(extern, S)                                                    \
  extern template S thickness<S>(const ShapeView<S>&);                                    \
  extern template Unit<S> free_fraction<S>(const PlacedShape<S>&, const CoreMotion<S>&,   \
                                           const PlacedShape<S>&, const Pose<S>&);
#define ISO_EXTERN(S) ISO_SHAPE_IMPACT_OF(extern, S)
ISO_FOR_EACH_SCALAR(ISO_EXTERN)
#undef ISO_EXTERN

}  // namespace isostep
