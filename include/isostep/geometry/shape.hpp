// The closed set of shapes: what a user writes (Sphere, Box, ...) and the one record that the engine stores.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/math/aabb.hpp"
#include "isostep/math/transform.hpp"
#include "isostep/scalar/literal.hpp"

namespace isostep {

/// Centre at the local origin.
template <class S = Literal> struct Sphere {
  S radius;  // [m]
};
template <class S = Literal> struct Box {
  Vec3<S> half_extents;  // [m]
};
/// A segment along local y from -half_height to +half_height, thickened by radius.
template <class S = Literal> struct Capsule {
  S radius;       // [m]
  S half_height;  // [m] of the cylinder alone
};
/// All points p with normal . p <= offset, in the body's frame. For static bodies.
template <class S> struct HalfSpace {
  Vec3<Unit<S>> normal;  // [1]
  S offset;              // [m]
};
Sphere(Literal)->Sphere<Literal>;
Box(Vec3<Literal>)->Box<Literal>;
Capsule(Literal, Literal)->Capsule<Literal>;

enum class ShapeType : std::uint32_t { sphere, box, capsule, half_space };
inline constexpr int kShapeTypes = 4;

/// One primitive as stored: a core box (a point for spheres, a segment along y for capsules) thickened by a radius, or
/// a half-space. No padding: 2 x 4 bytes and eight numbers of one width.
template <class S> struct Primitive {
  ShapeType type;
  std::uint32_t reserved;  // 0
  Vec3<S> half;            // [m] half extents of the core
  S radius;                // [m] added around the core
  Vec3<Unit<S>> normal;    // [1] half-space only
  S offset;                // [m] half-space only

  template <class Visitor, class Self> static ISO_INLINE constexpr void fields(Visitor&& visit, Self&& self) {
    visit("type", self.type);
    visit("reserved", self.reserved);
    visit("half", self.half);
    visit("radius", self.radius);
    visit("normal", self.normal);
    visit("offset", self.offset);
  }
};

template <class S> ISO_INLINE constexpr Primitive<S> primitive_of(const Sphere<S>& sphere) {
  return {ShapeType::sphere, 0, Vec3<S>::zero(), sphere.radius, Vec3<Unit<S>>::zero(), S(0)};
}
template <class S> ISO_INLINE constexpr Primitive<S> primitive_of(const Box<S>& box) {
  return {ShapeType::box, 0, box.half_extents, S(0), Vec3<Unit<S>>::zero(), S(0)};
}
template <class S> ISO_INLINE constexpr Primitive<S> primitive_of(const Capsule<S>& capsule) {
  return {ShapeType::capsule, 0, {S(0), capsule.half_height, S(0)}, capsule.radius, Vec3<Unit<S>>::zero(), S(0)};
}
template <class S> ISO_INLINE constexpr Primitive<S> primitive_of(const HalfSpace<S>& half_space) {
  return {ShapeType::half_space, 0, Vec3<S>::zero(), S(0), half_space.normal, half_space.offset};
}

/// One part of a body's shape: a primitive at a pose in the body's frame.
template <class S> struct Child {
  Primitive<S> primitive;
  Pose<S> pose;

  template <class Visitor, class Self> static ISO_INLINE constexpr void fields(Visitor&& visit, Self&& self) {
    visit("primitive", self.primitive);
    visit("pose", self.pose);
  }
};

}  // namespace isostep
