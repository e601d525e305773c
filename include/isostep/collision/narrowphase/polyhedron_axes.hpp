// Two polyhedra in each other's frames, and the faces among their separating axes.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/box_tolerance.hpp"
#include "isostep/geometry/baked/polyhedron_surface.hpp"
#include "isostep/math/columns.hpp"
#include "isostep/scalar/lanes_math.hpp"

namespace isostep::detail {

/// Returns the point of the arc between the normals of an edge's faces that is perpendicular to a direction, which one
/// normal looks along and the other against. It is as exact for short edges as for long ones; a cross product is not.
template <class S>
ISO_INLINE Vec3<Unit<S>> point_of_arc(const Polyhedron<S>& solid, std::uint32_t k, Vec3<Unit<S>> direction) {
  using U = Unit<S>;
  const Vec3<U> left = solid.normals[solid.half_edges[2 * k].face];
  const Vec3<U> right = solid.normals[solid.half_edges[2 * k + 1].face];
  const U half = U(0.5);  // so that their difference fits U
  const U at_left = dot(left, direction) * half, at_right = dot(right, direction) * half;
  const U t = divide_to<U>(at_left, at_left - at_right);
  return normalise(left * (half - half * t) + right * (half * t));
}

/// The vertex lowest along a direction. The first of equals.
template <class S> struct Lowest {
  std::uint32_t vertex;
  S height;  // [m]
};
template <class Vertices, class U> ISO_INLINE auto lowest_of(const Vertices& vertices, Vec3<U> up) {
  using S = decltype(dot(up, vertices[0]));
  Lowest<S> lowest = {0, dot(up, vertices[0])};
  for (std::uint32_t i = 1; i < vertices.size(); ++i) {
    const S height = dot(up, vertices[i]);
    if (height < lowest.height) lowest = {i, height};
  }
  return lowest;
}

/// Two polyhedra, with b's vertices in a's frame too and, after turn_a(), a's in b's. These are computed W at a time in
/// lanes of Isa, with the bits of one at a time.
template <class S, int W, class Isa> struct PolyhedronPair {
  static constexpr int kMost = ConvexHull::kMaxVertices;  // and edges, and faces
  using U = Unit<S>;
  using L = Lanes<S, W, Isa>;
  using UL = Lanes<U, W, Isa>;

  const Polyhedron<S>& a;
  const Polyhedron<S>& b;
  Transform<S> b_in_a;
  Columns<S, kMost> vertices_a;  // [m] in b's frame: after turn_a()
  Columns<S, kMost> vertices_b;  // [m] in a's frame
  S tolerance;                   // [m] what an axis must be better by to replace one that is preferred

  ISO_INLINE PolyhedronPair(const Polyhedron<S>& of_a, const Transform<S>& ta, const Polyhedron<S>& of_b,
                            const Transform<S>& tb)
      : a(of_a), b(of_b), b_in_a(relative(ta, tb)) {
    const Transform<L> lanes = {broadcast<L>(b_in_a.position), broadcast<UL>(b_in_a.rotation)};
    for (std::uint32_t i = 0; i < b.vertices.size(); i += W)
      vertices_b.store(i, to_world(lanes, b.vertices.template load<L>(i)));
    tolerance = axis_tolerance(a.inner_radius, b.inner_radius, b_in_a.position);
  }
  ISO_INLINE void turn_a() {
    const Transform<L> lanes = {broadcast<L>(b_in_a.position), broadcast<UL>(b_in_a.rotation)};
    for (std::uint32_t i = 0; i < a.vertices.size(); i += W)
      vertices_a.store(i, to_local(lanes, a.vertices.template load<L>(i)));
  }

  /// Returns true if they are further apart than `reach` [m] along the line from a's origin to b's. In S10 that finds
  /// nine of ten pairs that are apart. False if the origins coincide.
  ISO_INLINE bool are_apart(S reach) const {
    const Vec3<U> along = normalise(b_in_a.position);
    const Vec3<UL> up = broadcast<UL>(along), down = broadcast<UL>(-along);
    return lowest(vertices_b, b.vertices.size(), up) + lowest(a.vertices, a.vertices.size(), down) > reach;
  }

 private:
  template <class Vertices> static ISO_INLINE S lowest(const Vertices& vertices, std::uint32_t count, Vec3<UL> up) {
    L lowest = dot(up, vertices.template load<L>(0));
    for (std::uint32_t i = W; i < count; i += W) lowest = min(lowest, dot(up, vertices.template load<L>(i)));
    return lowest_lane(lowest);
  }
};

template <class S> struct FaceAxis {
  std::uint32_t face;
  std::uint32_t vertex;  // of the other, deepest below it; of equals the first
  S separation;          // [m]
};

/// Returns the face with the largest separation from the other's `count` vertices, the first of equals. Once one
/// exceeds `reach` the search ends, and any such face may be returned.
template <class S, int W, class Isa>
ISO_INLINE FaceAxis<S> best_face(const Polyhedron<S>& of, const Columns<S, ConvexHull::kMaxVertices>& others,
                                 std::uint32_t count, S reach) {
  using Pair = PolyhedronPair<S, W, Isa>;
  using L = typename Pair::L;
  const std::uint32_t faces = of.faces.size();
  FaceAxis<S> best = {0, 0, S(0)};
  for (std::uint32_t first = 0; first < faces; first += W) {
    const Vec3<typename Pair::UL> up = of.normals.template load<typename Pair::UL>(first);
    L lowest = dot(up, broadcast<L>(others.at(0)));
    for (std::uint32_t i = 1; i < count; ++i) {
      const L height = dot(up, broadcast<L>(others.at(i)));
      lowest = select(less(height, lowest), height, lowest);
    }
    alignas(64) S heights[W];
    lowest.store(heights);
    for (std::uint32_t f = first; f < min(first + W, faces); ++f) {
      const S separation = heights[f - first] - of.offsets[f];
      if (f == 0 || separation > best.separation) best = {f, 0, separation};
    }
    if (best.separation > reach) return best;
  }
  const Vec3<Unit<S>> up = of.normals[best.face];
  S least = dot(up, others.at(0));
  for (std::uint32_t i = 1; i < count; ++i) {
    const S height = dot(up, others.at(i));
    if (height < least) least = height, best.vertex = i;
  }
  return best;
}

/// [m] Returns the height of a point over the face that it is least below. No axis separates two solids by more than
/// the height of a point of one over the other.
template <class S, int W, class Isa> ISO_INLINE S height_over(const Polyhedron<S>& of, Vec3<S> point) {
  using Pair = PolyhedronPair<S, W, Isa>;
  const Vec3<typename Pair::L> at = broadcast<typename Pair::L>(point);
  S highest = dot(of.normals[0], point) - of.offsets[0];
  for (std::uint32_t first = 0; first < of.faces.size(); first += W) {
    alignas(64) S heights[W];
    dot(of.normals.template load<typename Pair::UL>(first), at).store(heights);
    for (std::uint32_t f = first; f < min(first + W, of.faces.size()); ++f)
      highest = max(highest, heights[f - first] - of.offsets[f]);
  }
  return highest;
}

}  // namespace isostep::detail
