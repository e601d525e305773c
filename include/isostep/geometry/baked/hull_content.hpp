// HullContent<S>: what a hull's blob is in a scalar: its faces, its mass.
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "isostep/core/bytes.hpp"
#include "isostep/core/instantiate.hpp"
#include "isostep/geometry/baked/polyhedron.hpp"
#include "isostep/geometry/shape_fault.hpp"
#include "isostep/math/mat3.hpp"

namespace isostep {

/// The content of a hull as a homogeneous solid. Everything is rounded once, from exact integers.
template <class S> struct HullContent {
  ShapeFault fault = ShapeFault::none;  // else the rest is empty
  HullSolid<S> solid;
  Vec3<S> widths = Vec3<S>::zero();          // [m] of its box
  S half_width = S(0);                       // [m] half the largest of them
  Unit<S> filled = Unit<S>(0);               // [1] its volume over that of its box
  Vec3<S> centre_of_mass = Vec3<S>::zero();  // [m]
  /// [1] The inertia over mass and half_width^2, about the centre of mass.
  Mat3<Unit<S>> inertia = Mat3<Unit<S>>::diagonal(Vec3<Unit<S>>::zero());
  /// [1] The means of xx, yy, zz and of yz, zx, xy about the centre of mass, each coordinate over half the box's own
  /// width.
  Vec3<Unit<S>> variance = Vec3<Unit<S>>::zero(), product = variance;

  static std::shared_ptr<const void> make(Bytes bytes);
  ISO_INLINE std::size_t memory() const { return sizeof *this + solid.memory(); }  // [bytes]
};

#define ISO_HULL_CONTENT_OF(extern, S) extern template struct HullContent<S>;
ISO_EXTERN_FOR_EACH_SCALAR(ISO_HULL_CONTENT_OF)

}  // namespace isostep
