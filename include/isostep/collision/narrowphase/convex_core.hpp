// ConvexCore<S>: a convex solid as the hull of a few points, made round by a radius.
// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>

#include "isostep/geometry/baked/polyhedron.hpp"
#include "isostep/math/aabb.hpp"
#include "isostep/math/transform.hpp"
#include "isostep/scalar/finer.hpp"

namespace isostep {

/// A convex solid: all points within `radius` of the hull of the vertices. A sphere has one vertex, a capsule two, a
/// triangle three, a box eight, a hull its own. 1 to ConvexHull::kMaxVertices vertices, in any order, equal ones too.
template <class S> struct ConvexCore {
  ArrayView<Vec3<S>> vertices;  // [m] in the solid's frame
  S radius;                     // [m]
};

/// Holds the core of a polyhedron: the memory that core() refers to.
template <class S> class PolyhedronCore {
 public:
  ISO_INLINE explicit PolyhedronCore(const Polyhedron<S>& solid) : count_(solid.vertices.size()) {
    for (std::uint32_t i = 0; i < count_; ++i) vertices_[i] = solid.vertices[i];
  }
  PolyhedronCore(const PolyhedronCore&) = delete;
  PolyhedronCore& operator=(const PolyhedronCore&) = delete;

  ISO_INLINE ConvexCore<S> core() const { return {{vertices_, count_}, S(0)}; }

 private:
  Vec3<S> vertices_[ConvexHull::kMaxVertices];  // [m]
  std::uint32_t count_;
};

namespace detail {

/// Returns the bounds of a core in the frame that `at` leads to.
template <class S> Aabb<S> box_of(const ConvexCore<S>& core, const Transform<S>& at) {
  const Vec3<S> first = to_world(at, core.vertices[0]);
  Aabb<S> box = {first, first};
  for (const Vec3<S>& v : core.vertices) {
    const Vec3<S> p = to_world(at, v);
    box = {min(box.low, p), max(box.high, p)};
  }
  return grow(box, core.radius);
}

template <class Out, class T> ISO_INLINE Vec3<Out> finer_of(Vec3<T> v) {
  return {finer<Out>(v.x), finer<Out>(v.y), finer<Out>(v.z)};
}
/// Returns `a` in the coarser format, rounded down: never above a.
template <class Out, class In> ISO_INLINE Out coarser_down(In a) {
  const Out nearby = coarser<Out>(a);
  return finer<In>(nearby) > a ? nearby - resolution<Out>() : nearby;
}
template <class Out, class T> ISO_INLINE Vec3<Out> coarser_of(Vec3<T> v) {
  return {coarser<Out>(v.x), coarser<Out>(v.y), coarser<Out>(v.z)};
}
template <class S> ISO_INLINE Transform<Finer<S>> finer_of(const Transform<S>& t) {
  using F = Finer<S>;
  return {finer_of<F>(t.position),
          {{finer_of<Unit<F>>(t.rotation.rows[0]), finer_of<Unit<F>>(t.rotation.rows[1]),
            finer_of<Unit<F>>(t.rotation.rows[2])}}};
}

/// Returns frame b in the frame of a. Their distance is that of S, exact in fixed point.
template <class S> ISO_INLINE Transform<Finer<S>> fine_relative(const Transform<S>& ta, const Transform<S>& tb) {
  using F = Finer<S>;
  const Transform<S> a = {Vec3<S>::zero(), ta.rotation}, b = {tb.position - ta.position, tb.rotation};
  return relative<F>(finer_of(a), finer_of(b));
}

/// A core in the finer format, in which a gap of a few digits of S still has a direction.
template <class S> class FineCore {
  using F = Finer<S>;
  static constexpr bool kIsCopy = !std::same_as<F, S>;

 public:
  ISO_INLINE explicit FineCore(const ConvexCore<S>& core) : radius(finer<F>(core.radius)) {
    if constexpr (kIsCopy) {
      ISO_ASSERT(core.vertices.size() <= ConvexHull::kMaxVertices);
      const std::uint32_t count = min<std::uint32_t>(core.vertices.size(), ConvexHull::kMaxVertices);
      for (std::uint32_t i = 0; i < count; ++i) copy_[i] = finer_of<F>(core.vertices[i]);
      vertices = {copy_, count};
    } else {
      vertices = core.vertices;
    }
    for (const Vec3<F>& v : vertices) extent = max(extent, max_abs(v));
  }
  FineCore(const FineCore&) = delete;
  FineCore& operator=(const FineCore&) = delete;

  ArrayView<Vec3<F>> vertices;  // [m]
  F radius;                     // [m]
  F extent = F(0);              // [m] largest coordinate of a vertex

 private:
  Vec3<F> copy_[kIsCopy ? ConvexHull::kMaxVertices : 1];
};

}  // namespace detail
}  // namespace isostep
