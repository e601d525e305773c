// Shape casts: where a convex core that moves along a line, without turning, first touches another.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/convex_core.hpp"
#include "isostep/core/instantiate.hpp"

namespace isostep {

/// A plane that parts two solids which do not turn, wherever the first of them goes: a proof that outlasts a single
/// cast.
template <class S> struct Parting {
  Vec3<Unit<S>> normal = Vec3<Unit<S>>::zero();  // [1] towards the first, world frame
  Vec3<S> at = Vec3<S>::zero();                  // [m] its position when the plane was found
  S gap = S(0);                                  // [m] between the two then

  ISO_INLINE bool is_known() const { return !(normal == Vec3<Unit<S>>::zero()); }
  /// [m] Returns the least gap between the two all along a way; 0 or less without a plane.
  ISO_INLINE S least_gap(Vec3<S> from, Vec3<S> way) const {
    return gap + dot(from - at, normal) + min(dot(way, normal), S(0));
  }
  /// Returns true if that gap is more than `clear` [m].
  ISO_INLINE bool holds(Vec3<S> from, Vec3<S> way, S clear) const { return clear < least_gap(from, way); }
};

/// The motion of a core that is cast.
template <class S> struct CastMotion {
  Vec3<S> translation;   // [m] world frame
  Unit<S> max_fraction;  // [1] of it that is looked at, 0 ... 1
  S touch;               // [m] cores that overlap by no more than this at the start touch; deeper is inside
  /// [1] The latest fraction of interest: a hit after it may be missed, and changes no other.
  Unit<S> latest = Unit<S>(1);
  Parting<S>* parting = nullptr;  // a plane that parts the two: casts leave theirs
};

template <class S> struct CastHit {
  Unit<S> fraction;      // [1] of the translation
  Vec3<Unit<S>> normal;  // [1] of b's surface, world frame, from b to a
  Vec3<S> point;         // [m] of b's surface, world frame
  bool inside;           // they overlap at the start by more than `touch`: the normal is the shortest way out, by EPA
};

/// Finds the first fraction 0 ... max_fraction of its translation at which a touches b. Writes `hit` only if it returns
/// true. Cores that touch at the start miss if they move apart or along their surfaces, that is if they sink into each
/// other by at most `touch` and at most 1/256 of the way. Else they hit at 0.
/// Source:  Conservative advancement, Mirtich 1996, Impulse-based Dynamic Simulation of Rigid Body Systems, sec. 2.3.2:
///          with a separating plane from GJK, and without rotation, a step is one of Newton's method on the distance,
///          a convex function of the fraction, from its left.
/// Differs: a step ends where the plane that was proved to part them is passed, rounded down; after 32 steps it counts
///          as a hit where it is: early, never late. Formats of 32 bits are searched in Q32.32.
/// Error:   at `fraction` the cores are apart by 0 to 4 gap_noise() of their extents and distance, or a step of the
///          fraction (2^-30 in Q16.16, 2^-24 in float) times the way. A core that passes nearer than that may hit.
/// Limits:  positions within Limits<S>::position(), translation within twice that, at most 128 vertices.
template <class S>
bool cast_convex(const ConvexCore<S>& a, const Transform<S>& ta, const ConvexCore<S>& b, const Transform<S>& tb,
                 const CastMotion<S>& motion, CastHit<S>& hit);

#define ISO_SHAPE_CAST_OF(extern, S)                                                                   \
  extern template bool cast_convex<S>(const ConvexCore<S>&, const Transform<S>&, const ConvexCore<S>&, \
                                      const Transform<S>&, const CastMotion<S>&, CastHit<S>&);
ISO_EXTERN_FOR_EACH_SCALAR(ISO_SHAPE_CAST_OF)

}  // namespace isostep
