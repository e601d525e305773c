// SolidFace<S>: the part of a convex solid that looks along a direction, as contacts lie on it.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/math/vec3.hpp"

namespace isostep {

/// A point, a line, or a flat face. A solid chooses by the direction alone: a face that looks most along it, or the
/// line or point that reaches furthest.
template <class S> struct SolidFace {
  static constexpr int kMost = 64;  // corners

  int count = 0;               // of corners: 1 a point, 2 a line, more a flat face, in order around it
  bool is_disc = false;        // the corners are some of a circle, evenly around it
  Vec3<Unit<S>> normal;        // [1] outward, of a flat face
  std::uint32_t name = 0;      // of a flat face, below 128
  Vec3<S> points[kMost];       // [m]
  std::uint32_t names[kMost];  // of the corners, below 128: the same in whatever face they are

  ISO_INLINE void add(Vec3<S> point, std::uint32_t corner) {
    points[count] = point;
    names[count++] = corner;
  }
  ISO_INLINE bool is_flat() const { return count > 2; }
};

}  // namespace isostep
