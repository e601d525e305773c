// ShapeCore<S>: a stored shape as a ConvexCore.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/convex_core.hpp"
#include "isostep/geometry/shape.hpp"

namespace isostep {

/// Holds the core of a solid of a shape's file (`Sphere<S>`, `Box<S>` ...), or of its part that lies `inset` [m]
/// inside, 0 up to its inner radius. core() refers to this memory.
template <class S> class ShapeCore {
 public:
  /// Takes the shape in the frame that `t` leads to.
  template <class Shape> ISO_INLINE ShapeCore(const Shape& shape, const Transform<S>& t, S inset) {
    radius_ = shape.visit_core(inset, [&](Vec3<S> v) ISO_INLINE_LAMBDA { add(to_world(t, v)); });
  }
  /// Takes the shape in its own frame.
  template <class Shape> ISO_INLINE ShapeCore(const Shape& shape, S inset) {
    radius_ = shape.visit_core(inset, [&](Vec3<S> v) ISO_INLINE_LAMBDA { add(v); });
  }
  ShapeCore(const ShapeCore&) = delete;
  ShapeCore& operator=(const ShapeCore&) = delete;

  /// Makes it a ball about the mean of the vertices. The ball is inside the shape for a radius up to the inner radius.
  ISO_INLINE void become_ball(S radius) {
    const Unit<S> share = divide_to<Unit<S>>(S(1), S(static_cast<std::int32_t>(count_)));
    Vec3<S> middle = Vec3<S>::zero();
    for (std::uint32_t i = 0; i < count_; ++i) middle += vertices_[i] * share;
    vertices_[0] = middle;
    count_ = 1;
    radius_ = radius;
  }
  /// Returns the core, valid as long as this object.
  ISO_INLINE ConvexCore<S> core() const { return {{vertices_, count_}, radius_}; }

 private:
  ISO_INLINE void add(Vec3<S> v) {
    ISO_ASSERT(count_ < ConvexHull::kMaxVertices);
    if (count_ < ConvexHull::kMaxVertices) vertices_[count_++] = v;
  }

  Vec3<S> vertices_[ConvexHull::kMaxVertices];  // [m]
  std::uint32_t count_ = 0;
  S radius_;  // [m]
};

/// True for a convex and bounded shape: it has a core and an inner radius, see Solid in shape.hpp.
template <class Shape> inline constexpr bool kIsSolid = Shape::kBounded;

}  // namespace isostep
