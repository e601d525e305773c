// The closed set of shapes: all that their files say, called on the one record that the engine stores.
// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>

#include "isostep/core/fields.hpp"
#include "isostep/geometry/part_traits.hpp"
#include "isostep/geometry/shape_view.hpp"
#include "isostep/geometry/shapes/box.hpp"
#include "isostep/geometry/shapes/capsule.hpp"
#include "isostep/geometry/shapes/cone.hpp"
#include "isostep/geometry/shapes/cylinder.hpp"
#include "isostep/geometry/shapes/half_space.hpp"
#include "isostep/geometry/shapes/height_field.hpp"
#include "isostep/geometry/shapes/hull.hpp"
#include "isostep/geometry/shapes/mesh.hpp"
#include "isostep/geometry/shapes/sphere.hpp"

namespace isostep {

/// The members that the file of a shape defines. Transforms lead from the shape's frame to the frame of the results.
template <template <class> class Shape, class S>
concept ShapeOf = requires(Shape<S> shape, Primitive<S> stored, Shape<Literal> literal, Transform<S> t, Vec3<S> v,
                           Pose<S> pose, S s) {
  { Shape<S>::kType } -> std::convertible_to<ShapeType>;
  { Shape<S>::kBounded } -> std::convertible_to<bool>;           // else for static bodies alone
  { Shape<S>::kHasBlob } -> std::convertible_to<bool>;           // its content is too large for a record: blob.hpp
  { Shape<S>::kPrincipal } -> std::convertible_to<bool>;         // centre of mass and principal axes are its frame's
  { Shape<S>::of(literal) } -> std::same_as<Shape<S>>;           // rounded once
  { shape.primitive() } -> std::same_as<Primitive<S>>;           // unused fields are 0
  { shape.fault() } -> std::same_as<ShapeFault>;                 // of finite numbers
  { shape.normalised() } -> std::same_as<Shape<S>>;              // directions of unit length; bit for bit what was
  { shape.bounds(t) } -> std::same_as<Aabb<S>>;                  // see bounds.hpp
  { shape.mass(s) } -> std::same_as<S>;                          // [kg] of a density [kg/m^3]
  { shape.relative_volume(s) } -> std::same_as<Unit<S>>;         // [1] over (2 s)^3; s [m]: no point is further away
  { shape.cast(t, v, v) } -> std::same_as<detail::LocalHit<S>>;  // from origin v along translation v
  { shape.closest(t, v) } -> std::same_as<ClosestPoint<S>>;      // see closest_point.hpp
  shape.visit_lines(detail::NoLine{});                           // for debug drawing: line(from, to), its own frame
  shape.visit_triangles(detail::NoTriangle{});                   // of its blob: triangle(a, b, c), see DrawnTriangle
  { shape.drawn_at(pose, pose) } -> std::same_as<Pose<S>>;  // of body's origin and shape's frame: its middle, world
};
/// A convex solid, which can move and be swept. Its core is the part of it that ConvexCore has.
template <template <class> class Shape, class S>
concept Solid = requires(Shape<S> shape, S s, Vec3<Unit<S>> n, Unit<S> u, SolidFace<S>& face) {
  { shape.inner_radius() } -> std::same_as<S>;  // [m] of a ball that it holds
  // point(v) for each vertex of the core [m] of the solid that is `s` [m] deep in it, or deeper, 0 to inner_radius();
  // returns the radius [m] around them.
  { shape.visit_core(s, detail::NoPoint{}) } -> std::same_as<S>;
  { shape.middle() } -> std::same_as<Vec3<S>>;    // [m] by it contacts tell on which side of a surface it is
  { shape.support(n) } -> std::same_as<Vec3<S>>;  // [m] the point of the core furthest along n; of equals any one
  shape.find_face(n, u, face);                    // of the core, along n: see SolidFace; a disc may lean by sine u
};
/// The inverse of primitive(). A Content is what a scalar makes of a blob's bytes. fault_of tells what is wrong with
/// it, memory() how many bytes it takes.
template <template <class> class Shape, class S>
concept MadeOfPrimitive = requires(Primitive<S> stored) {
  { Shape<S>::of(stored) } -> std::same_as<Shape<S>>;
};
template <template <class> class Shape, class S>
concept MadeOfBlob = requires(Primitive<S> stored, const typename Shape<S>::Content* content, Bytes bytes) {
  { Shape<S>::of(stored, content) } -> std::same_as<Shape<S>>;
  { Shape<S>::Content::make(bytes) } -> std::same_as<std::shared_ptr<const void>>;
  { Shape<S>::fault_of(*content) } -> std::same_as<ShapeFault>;
  { content->memory() } -> std::same_as<std::size_t>;
};
/// Inertia over mass and s^2 [1] about the centre of mass, with s as above.
template <template <class> class Shape, class S>
concept HasPrincipalInertia = requires(Shape<S> shape, S s) {
  { shape.kappa() } -> std::same_as<Vec3<S>>;  // [1/m^2] see MassProperties
  { shape.relative_inertia(s) } -> std::same_as<Vec3<Unit<S>>>;
};
template <template <class> class Shape, class S>
concept HasInertiaTensor = requires(Shape<S> shape, S s) {
  { shape.centre_of_mass() } -> std::same_as<Vec3<S>>;  // [m]
  { shape.relative_inertia(s) } -> std::same_as<Mat3<Unit<S>>>;
};
#define ISO_COMPLETE(name, Shape)                                                                               \
  static_assert(ShapeOf<Shape, float>, "a shape's file lacks a member");                                        \
  static_assert(Shape<float>::kHasBlob ? MadeOfBlob<Shape, float> : MadeOfPrimitive<Shape, float>,              \
                "a shape's file lacks `of`, Content or fault_of");                                              \
  static_assert(Shape<float>::kPrincipal ? HasPrincipalInertia<Shape, float> : HasInertiaTensor<Shape, float>,  \
                "a shape's file lacks kappa, centre_of_mass or relative_inertia");                              \
  static_assert(!Shape<float>::kBounded || Solid<Shape, float>,                                                 \
                "the file of a shape that moves lacks inner_radius, visit_core, middle, support or find_face"); \
  static_assert(Shape<float>::kType == ShapeType::name, "a shape's kType is not its own");
ISO_FOR_EACH_SHAPE(ISO_COMPLETE)
#undef ISO_COMPLETE

/// A class of shapes, before a scalar is chosen.
template <template <class> class Shape> struct ShapeClass { template <class S> using Of = Shape<S>; };

/// Calls visit(ShapeClass<Sphere>{}) for spheres, and so on. A world refuses records of types that are not in the list.
template <class Visit> ISO_INLINE constexpr decltype(auto) visit_shape_type(ShapeType type, Visit&& visit) {
  switch (type) {
#define ISO_CASE(name, Shape) \
  case ShapeType::name: return visit(ShapeClass<Shape>{});
    ISO_FOR_EACH_SHAPE(ISO_CASE)
#undef ISO_CASE
  }
  ISO_TRAP();
}

/// Returns the shape that a valid record of this type holds.
template <template <class> class Shape, class S> ISO_INLINE constexpr Shape<S> shape_as(const ShapeView<S>& view) {
  if constexpr (Shape<S>::kHasBlob) {
    return Shape<S>::of(view.primitive, static_cast<const typename Shape<S>::Content*>(view.content));
  } else {
    return Shape<S>::of(view.primitive);
  }
}

/// Calls visit(Sphere<S>), visit(Box<S>) ... with the shape that a valid record holds, as its file declares it.
template <class S, class Visit>
ISO_INLINE constexpr decltype(auto) visit_shape(const ShapeView<S>& view, Visit&& visit) {
  return visit_shape_type(view.primitive.type, [&](auto tag) ISO_INLINE_LAMBDA -> decltype(auto) {
    return visit(shape_as<decltype(tag)::template Of>(view));
  });
}
template <class S, class Visit>
ISO_INLINE constexpr decltype(auto) visit_shape(const Primitive<S>& primitive, Visit&& visit) {
  return visit_shape(ShapeView<S>(primitive), visit);
}

/// Returns true if a dynamic body may have it.
ISO_INLINE constexpr bool is_bounded(ShapeType type) {
  return visit_shape_type(type, [](auto tag) ISO_INLINE_LAMBDA { return decltype(tag)::template Of<float>::kBounded; });
}

/// Returns a shape as it is stored.
#define ISO_PRIMITIVE_OF(name, Shape) \
  template <class S> ISO_INLINE constexpr Primitive<S> primitive_of(const Shape<S>& shape) { return shape.primitive(); }
ISO_FOR_EACH_SHAPE(ISO_PRIMITIVE_OF)
#undef ISO_PRIMITIVE_OF

inline constexpr std::uint32_t kMaxChildren = 1u << 16;  // parts of one shape

/// A part of a body's shape: a primitive at a pose in the body's frame, with traits and data of its own.
template <class S> struct Child {
  Primitive<S> primitive;
  Pose<S> pose;
  PartTraits<S> traits = {};
  std::uint64_t user_data = 0;  // the game's, for whom events and hits name the part

  ISO_FIELDS(primitive, pose, traits, user_data)
};
static_assert(kHasNoPadding<Child<float>> && kHasNoPadding<Child<double>>);

}  // namespace isostep
