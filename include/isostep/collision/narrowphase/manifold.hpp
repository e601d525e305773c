// Manifold<S>: where two shapes touch, up to four points with one normal; what the narrow phase hands to the solver.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/math/transform.hpp"

namespace isostep {

inline constexpr int kMaxContactPoints = 4;  // of two parts: a face on a face needs no more to rest

/// [m] The reach of a patch: if two shapes are within the margin, points that are further apart by up to this belong to
/// the contact too. A box that falls almost flat then touches with all of its edge or face in one step. One corner
/// alone would spin it.
template <class S> inline constexpr S kPatchReach = S(0.0625);

template <class S> struct ManifoldPoint {
  Vec3<S> position;       // [m] midway between the two surfaces, in the frame that both transforms lead to
  S separation;           // [m] along the normal, negative = overlap
  std::uint32_t feature;  // names the pair of features that touch: the same from frame to frame, unique in a manifold
};

template <class S> struct Manifold {
  Vec3<Unit<S>> normal;  // [1] from a to b, in the transforms' outer frame; zero when count is 0
  std::int32_t count;    // 0..4; points past it hold nothing
  ManifoldPoint<S> points[kMaxContactPoints];

  ISO_INLINE constexpr void clear() {
    normal = Vec3<Unit<S>>::zero();
    count = 0;
  }
  /// The caller must keep count at most kMaxContactPoints.
  ISO_INLINE constexpr void add(Vec3<S> position, S separation, std::uint32_t feature) {
    points[count] = {position, separation, feature};
    ++count;
  }
};

namespace detail {

/// Returns the axis k of a local frame, or its opposite, in that frame.
template <class U> ISO_INLINE constexpr Vec3<U> unit_axis(int k, bool negative) {
  Vec3<U> axis = Vec3<U>::zero();
  axis[k] = negative ? U(-1) : U(1);
  return axis;
}
template <class T> ISO_INLINE constexpr T negate_if(bool negative, T value) { return negative ? -value : value; }

/// Returns true if |v| > length, for length >= 0. Exact in fixed point, without a root.
template <class S> ISO_INLINE constexpr bool longer_than(Vec3<S> v, S length) {
  return dot_sum(v, v) > product(length, length);
}

}  // namespace detail
}  // namespace isostep
