// Bodies of gjk.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/gjk.hpp"
#include "isostep/collision/narrowphase/polyhedron_axes.hpp"

namespace isostep {
namespace detail {

/// A point of the difference a - b, in a's frame, and the vertices that it is made of.
template <class S> struct SupportPoint {
  Vec3<S> point;  // [m]
  std::uint32_t vertex_a, vertex_b;
};

/// Up to four support points, and the shares that make the point nearest to the origin.
template <class S> struct Simplex {
  SupportPoint<S> points[4] = {};
  Unit<S> shares[4] = {};  // they add up to 1, but for rounding
  int count = 0;
  Vec3<S> nearest;       // [m]
  Vec3<Unit<S>> across;  // [1] of three of them: of their triangle
};

/// Returns the direction and distance of the nearest point. For a triangle it is the normal, good at any distance.
template <class S> ISO_INLINE Heading<S> heading_of(const Simplex<S>& simplex) {
  if (simplex.count != 3) return heading_of(simplex.nearest);
  const S height = dot(simplex.across, simplex.points[0].point);
  return {negate_if(height < S(0), simplex.across), abs(height)};
}

template <class S> ISO_INLINE void keep_one(Simplex<S>& simplex, int i) {
  simplex.points[0] = simplex.points[i];
  simplex.shares[0] = Unit<S>(1);
  simplex.count = 1;
  simplex.nearest = simplex.points[0].point;
}

/// Returns the nearest simplex on the segment from point i to point j.
template <class S> ISO_INLINE Simplex<S> nearest_on_segment(const Simplex<S>& from, int i, int j) {
  Simplex<S> to;
  to.points[0] = from.points[i];
  to.points[1] = from.points[j];
  const Vec3<S> p = from.points[i].point;
  const Heading<S> way = heading_of(from.points[j].point - p);
  const S along = -dot(way.direction, p);
  if (!(along > S(0))) {
    keep_one(to, 0);
  } else if (!(along < way.length)) {
    keep_one(to, 1);
  } else {
    to.count = 2;
    to.shares[1] = divide_to<Unit<S>>(along, way.length);
    to.shares[0] = Unit<S>(1) - to.shares[1];
    to.nearest = p + way.direction * along;
  }
  return to;
}

template <class S> ISO_INLINE bool is_nearer(const Simplex<S>& a, const Simplex<S>& b) {
  return dot_sum(a.nearest, a.nearest) < dot_sum(b.nearest, b.nearest);
}

/// [1] Returns the normal of the triangle of three of the points. Zero if they lie on a line.
template <class S> ISO_INLINE Vec3<Unit<S>> normal_of(const Simplex<S>& of, int i, int j, int k) {
  const Vec3<S> p = of.points[i].point;
  return normalise(cross(normalise(of.points[j].point - p), normalise(of.points[k].point - p)));
}

/// Returns the nearest simplex on the triangle of three of the points. The share of a corner is the distance of its
/// edge from the point over that from the corner itself.
template <class S> ISO_INLINE Simplex<S> nearest_on_triangle(const Simplex<S>& from, int i, int j, int k) {
  using U = Unit<S>;
  const int corners[3] = {i, j, k};
  const Vec3<U> normal = normal_of(from, i, j, k);
  Simplex<S> inside;
  inside.count = 3;
  inside.across = normal;
  inside.nearest = normal * dot(normal, from.points[i].point);
  bool is_inside = normal != Vec3<U>::zero();
  for (int c = 0; c < 3; ++c) {
    const Vec3<S> corner = from.points[corners[c]].point, begin = from.points[corners[(c + 1) % 3]].point;
    const Vec3<U> inward = cross(normal, normalise(from.points[corners[(c + 2) % 3]].point - begin));
    const S height = dot(inward, corner - begin), share = dot(inward, -begin);
    is_inside = is_inside && share > S(0) && share < height;
    inside.points[c] = from.points[corners[c]];
    if (is_inside) inside.shares[c] = divide_to<U>(share, height);
  }
  if (is_inside) return inside;
  Simplex<S> best = nearest_on_segment(from, i, j);
  const Simplex<S> second = nearest_on_segment(from, j, k), third = nearest_on_segment(from, k, i);
  if (is_nearer(second, best)) best = second;
  if (is_nearer(third, best)) best = third;
  return best;
}

/// The faces of a tetrahedron: three corners, and the one opposite.
inline constexpr int kTetrahedronFaces[4][4] = {{0, 1, 2, 3}, {0, 3, 1, 2}, {0, 2, 3, 1}, {1, 3, 2, 0}};

/// Finds the nearest simplex on a tetrahedron, over the faces that have the origin outside, or are too flat to tell.
/// Returns false if there is no such face.
template <class S> ISO_INLINE bool nearest_on_tetrahedron(const Simplex<S>& from, Simplex<S>& best) {
  S size = S(0);
  for (const SupportPoint<S>& point : from.points) size = max(size, max_abs(point.point));
  const S flat = gap_noise(size);
  bool outside = false;
  for (const auto& [i, j, k, opposite] : kTetrahedronFaces) {
    const Vec3<S> p = from.points[i].point;
    const Vec3<Unit<S>> normal = normal_of(from, i, j, k);
    const S of_origin = -dot(normal, p), of_opposite = dot(normal, from.points[opposite].point - p);
    const bool inside = of_opposite > flat ? of_origin >= S(0) : of_opposite < -flat && of_origin <= S(0);
    if (inside) continue;
    const Simplex<S> face = nearest_on_triangle(from, i, j, k);
    if (!outside || is_nearer(face, best)) best = face;
    outside = true;
  }
  return outside;
}

/// Reduces the simplex to its part nearest to the origin. Returns false if the origin is inside.
template <class S> ISO_INLINE bool shrink(Simplex<S>& simplex) {
  if (simplex.count == 2) simplex = nearest_on_segment(simplex, 0, 1);
  else if (simplex.count == 3) simplex = nearest_on_triangle(simplex, 0, 1, 2);
  else {
    Simplex<S> best = simplex;
    if (!nearest_on_tetrahedron(simplex, best)) return false;
    simplex = best;
  }
  return true;
}

template <class S> class Gjk {
  using U = Unit<S>;
  static constexpr int kMostIterations = 32;

 public:
  ISO_INLINE Gjk(ArrayView<Vec3<S>> a, ArrayView<Vec3<S>> b, const Transform<S>& b_in_a)
      : a_(a), b_(b), b_in_a_(b_in_a) {}

  /// Returns the support point in a's frame. The direction points from b to a.
  ISO_INLINE SupportPoint<S> support(Vec3<U> direction) const {
    const std::uint32_t i = lowest_of(a_, -direction).vertex;
    const std::uint32_t j = lowest_of(b_, transposed_times(b_in_a_.rotation, direction)).vertex;
    return point_of(i, j);
  }
  ISO_INLINE SupportPoint<S> point_of(std::uint32_t i, std::uint32_t j) const {
    return {a_[i] - to_world(b_in_a_, b_[j]), i, j};
  }

  ISO_INLINE Simplex<S> begin() const {
    Simplex<S> simplex = {};
    simplex.points[0] = support(normalise(b_in_a_.position));
    keep_one(simplex, 0);
    return simplex;
  }
  /// Returns a former simplex with its vertices where they are now. The search ends sooner from there.
  ISO_INLINE Simplex<S> begin(const Simplex<S>& before) const {
    Simplex<S> simplex = before;
    for (int i = 0; i < simplex.count; ++i)
      simplex.points[i] = point_of(before.points[i].vertex_a, before.points[i].vertex_b);
    if (simplex.count == 1) keep_one(simplex, 0);
    else if (!shrink(simplex)) keep_one(simplex, 0);
    return simplex;
  }

  /// Runs the search. Leaves the last simplex in `simplex`.
  ISO_INLINE GjkDistance<S> run(Simplex<S>& simplex) const {
    return run(simplex, [](S, S) ISO_INLINE_LAMBDA { return false; });
  }
  /// Ends sooner if `enough(separation, distance)` holds for a plane and two points that the search has found.
  template <class Enough> ISO_INLINE GjkDistance<S> run(Simplex<S>& simplex, const Enough& enough) const {
    int iterations = 1;
    S separation = S(0);
    for (; iterations < kMostIterations; ++iterations) {
      const Heading<S> heading = heading_of(simplex);
      if (heading.length <= gap_noise(max_abs(b_in_a_.position))) return witnesses(simplex, iterations);
      const SupportPoint<S> next = support(-heading.direction);
      separation = dot(heading.direction, next.point);
      if (has(simplex, next) || !(separation < heading.length) || enough(separation, heading.length)) break;
      Simplex<S> grown = simplex;
      grown.points[grown.count++] = next;
      if (!shrink(grown)) {
        const GjkDistance<S> overlap = witnesses(simplex, iterations);
        simplex = grown;
        return overlap;
      }
      if (!is_nearer(grown, simplex)) break;
      simplex = grown;
    }
    const Heading<S> heading = heading_of(simplex);
    GjkDistance<S> result = witnesses(simplex, iterations);
    result.distance = heading.length;
    result.normal = -heading.direction;
    result.separation =
        iterations < kMostIterations ? separation : dot(heading.direction, support(-heading.direction).point);
    return result;
  }

  /// Returns the result at distance 0, which is overlap.
  ISO_INLINE GjkDistance<S> witnesses(const Simplex<S>& simplex, std::int32_t iterations) const {
    Vec3<S> on_a = Vec3<S>::zero(), on_b = on_a;
    for (int i = 0; i < simplex.count; ++i) {
      on_a += a_[simplex.points[i].vertex_a] * simplex.shares[i];
      on_b += b_[simplex.points[i].vertex_b] * simplex.shares[i];
    }
    return {S(0), Vec3<U>::zero(), on_a, to_world(b_in_a_, on_b), iterations, S(0)};
  }

 private:
  static ISO_INLINE bool has(const Simplex<S>& simplex, const SupportPoint<S>& point) {
    for (int i = 0; i < simplex.count; ++i) {
      if (simplex.points[i].vertex_a == point.vertex_a && simplex.points[i].vertex_b == point.vertex_b) return true;
    }
    return false;
  }

  ArrayView<Vec3<S>> a_, b_;  // [m] vertices, each solid's in its own frame
  const Transform<S>& b_in_a_;
};

}  // namespace detail

template <class S>
GjkDistance<S> gjk_distance(const ConvexCore<S>& a, const Transform<S>& ta, const ConvexCore<S>& b,
                            const Transform<S>& tb) {
  const Transform<S> b_in_a = relative(ta, tb);
  const detail::Gjk<S> search(a.vertices, b.vertices, b_in_a);
  detail::Simplex<S> simplex = search.begin();
  GjkDistance<S> result = search.run(simplex);
  result.normal = ta.rotation * result.normal;
  result.on_a = to_world(ta, result.on_a);
  result.on_b = to_world(ta, result.on_b);
  return result;
}

template <class S>
GjkDistance<S> gjk_distance(const Polyhedron<S>& a, const Transform<S>& ta, const Polyhedron<S>& b,
                            const Transform<S>& tb) {
  const PolyhedronCore<S> core_a(a), core_b(b);
  return gjk_distance(core_a.core(), ta, core_b.core(), tb);
}

}  // namespace isostep
