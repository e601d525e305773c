// The direction of an integer vector, and the place of a point of a surface, in a scalar.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/geometry/baked/grid_point.hpp"
#include "isostep/geometry/baked/mesh_point.hpp"
#include "isostep/math/vec3.hpp"
#include "isostep/scalar/lattice.hpp"
#include "isostep/scalar/lattice_direction.hpp"

namespace isostep::detail {

/// The direction rounded once, whatever its length, for geometry that is baked. Components are below 2^51.
template <class U> ISO_INLINE Vec3<U> exact_unit_of_steps(GridVector v) {
  const auto d = exact_lattice_direction<U>(v.x, v.y, v.z);
  return {d.x, d.y, d.z};
}
/// The direction to the last digits of U, for vectors found in every step.
template <class U> ISO_INLINE Vec3<U> unit_of_steps(GridVector v) {
  const auto d = lattice_direction<U>(v.x, v.y, v.z);
  return {d.x, d.y, d.z};
}

/// [m] A step is 2^-exponent m.
template <class S> ISO_INLINE Vec3<S> point_of_steps(MeshPoint p, int exponent) {
  return {from_lattice<S>(p.x, exponent), from_lattice<S>(p.y, exponent), from_lattice<S>(p.z, exponent)};
}

}  // namespace isostep::detail
