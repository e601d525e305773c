// A shape for the tests alone: a cube, as a file in shapes/ would declare it.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/geometry/shapes/box.hpp"

namespace isostep {

template <class S = Literal> struct Probe {
  static constexpr ShapeType kType = ShapeType::probe;
  static constexpr bool kBounded = true;
  static constexpr bool kHasBlob = false;
  static constexpr bool kPrincipal = true;

  S half_side;  // [m]

  static ISO_INLINE constexpr Probe of(const Primitive<S>& p) { return {p.half.x}; }
  static ISO_INLINE constexpr Probe of(const Probe<Literal>& cube) { return {from_literal<S>(cube.half_side)}; }
  ISO_INLINE constexpr Primitive<S> primitive() const {
    return {kType, 0, box().half_extents, S(0), Vec3<Unit<S>>::zero(), S(0)};
  }
  ISO_INLINE constexpr ShapeFault fault() const { return detail::fault_of_size(half_side); }
  ISO_INLINE constexpr Probe normalised() const { return *this; }
  ISO_INLINE constexpr Aabb<S> bounds(const Transform<S>& t) const { return box().bounds(t); }
  ISO_INLINE S inner_radius() const { return box().inner_radius(); }
  template <class Point> ISO_INLINE S visit_core(S inset, const Point& point) const {
    return box().visit_core(inset, point);
  }
  ISO_INLINE S mass(S density) const { return box().mass(density); }
  ISO_INLINE Vec3<S> kappa() const { return box().kappa(); }
  ISO_INLINE Unit<S> relative_volume(S scale) const { return box().relative_volume(scale); }
  ISO_INLINE Vec3<Unit<S>> relative_inertia(S scale) const { return box().relative_inertia(scale); }
  ISO_INLINE detail::LocalHit<S> cast(const Transform<S>& t, Vec3<S> origin, Vec3<S> translation) const {
    return box().cast(t, origin, translation);
  }
  ISO_INLINE ClosestPoint<S> closest(const Transform<S>& t, Vec3<S> query) const {  // of the cube
    return box().closest(t, query);
  }
  template <class Line> ISO_INLINE void visit_lines(const Line& line) const { box().visit_lines(line); }
  template <class Triangle> ISO_INLINE void visit_triangles(const Triangle&) const {}
  ISO_INLINE Pose<S> drawn_at(const Pose<S>&, const Pose<S>& pose) const { return pose; }
  ISO_INLINE constexpr Box<S> box() const { return {{half_side, half_side, half_side}}; }
};
Probe(Literal)->Probe<Literal>;

}  // namespace isostep
