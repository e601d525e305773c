// The separating axes of two polyhedra, and the best of them.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/box_tolerance.hpp"
#include "isostep/geometry/baked/polyhedron_surface.hpp"
#include "isostep/math/columns.hpp"
#include "isostep/scalar/lanes_math.hpp"

namespace isostep::detail {

/// The point of the arc between the normals of an edge's faces that looks across a direction, which one of them looks
/// along and the other against. Of short edges it is as exact as of long ones; a cross of the two is not.
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

/// The vertex lowest along a direction; of equals the first.
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

/// Two polyhedra; what belongs to b is also there as a's frame sees it, and a's vertices as b's does. Found W at a time
/// in lanes of Isa: the bits are those of one at a time.
template <class S, int W, class Isa> struct PolyhedronPair {
  static constexpr int kMost = ConvexHull::kMaxVertices;  // and edges, and faces
  using U = Unit<S>;
  using L = Lanes<S, W, Isa>;
  using UL = Lanes<U, W, Isa>;

  const Polyhedron<S>& a;
  const Polyhedron<S>& b;
  Transform<S> b_in_a;
  Columns<S, kMost> vertices_a;  // [m] in b's frame
  Columns<S, kMost> vertices_b;  // [m] in a's frame
  S tolerance;                   // [m] what an axis must be better by to replace one that is preferred

  ISO_INLINE PolyhedronPair(const Polyhedron<S>& of_a, const Transform<S>& ta, const Polyhedron<S>& of_b,
                            const Transform<S>& tb)
      : a(of_a), b(of_b), b_in_a(relative(ta, tb)) {
    const Transform<L> lanes = {broadcast<L>(b_in_a.position), broadcast<UL>(b_in_a.rotation)};
    for (std::uint32_t i = 0; i < a.vertices.size(); i += W)
      vertices_a.store(i, to_local(lanes, a.vertices.template load<L>(i)));
    for (std::uint32_t i = 0; i < b.vertices.size(); i += W)
      vertices_b.store(i, to_world(lanes, b.vertices.template load<L>(i)));
    tolerance =
        axis_tolerance(min(a.inner_radius, b.inner_radius), max_abs(b_in_a.position) + a.inner_radius + b.inner_radius);
  }
};

template <class S> struct FaceAxis {
  std::uint32_t face;
  std::uint32_t vertex;  // of the other, deepest below it; of equals the first
  S separation;          // [m]
};

/// The face with the largest separation from the other's `count` vertices; of equals the first. Ends where one exceeds
/// `reach`: then which one is open.
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

template <class S> struct EdgeAxis {
  std::uint32_t edge_a, edge_b;
  Vec3<Unit<S>> normal;  // [1] out of a, a's frame
  S separation;          // [m]
  bool found;
};

/// The crosses of edges whose arcs meet. Edge 2 k of a has face L on its left and R on its right, and its direction is
/// that of L x R; its arc leads from L to R, that of b's edge from -L to -R. They meet where the edge of each leads out
/// of one face of the other's and into the other, in the same order. All of b's edges are looked at W at a time.
template <class S, int W, class Isa> class EdgeAxes {
  using Pair = PolyhedronPair<S, W, Isa>;
  using U = Unit<S>;
  using UL = typename Pair::UL;
  static constexpr int kMost = ConvexHull::kMaxEdges;

 public:
  ISO_INLINE explicit EdgeAxes(const Pair& pair) : pair_(pair) {
    const Mat3<UL> turn = broadcast<UL>(pair.b_in_a.rotation);
    Columns<U, kMost> normals;
    for (std::uint32_t f = 0; f < pair.b.faces.size(); f += W)
      normals.store(f, turn * pair.b.normals.template load<UL>(f));
    for (std::uint32_t j = 0; j < pair.b.edges(); j += W)
      directions_.store(j, turn * pair.b.directions.template load<UL>(j));
    for (std::uint32_t j = 0; j < pair.b.edges(); ++j) {
      left_.set(j, normals.at(pair.b.half_edges[2 * j].face));
      right_.set(j, normals.at(pair.b.half_edges[2 * j + 1].face));
    }
    left_.template pad<W>(pair.b.edges());
    right_.template pad<W>(pair.b.edges());
    for (std::uint32_t f = 0; f < pair.a.faces.size(); ++f) find_sides(pair.a.normals[f], sides_of_a_[f]);
  }

  /// Those better than `limit`; ends where one exceeds `reach`.
  ISO_INLINE EdgeAxis<S> best(S limit, S reach) const {
    const Polyhedron<S>& a = pair_.a;
    EdgeAxis<S> best = {0, 0, Vec3<U>::zero(), limit, false};
    for (std::uint32_t i = 0; i < a.edges(); ++i) {
      const Sides &left = sides_of_a_[a.half_edges[2 * i].face], &right = sides_of_a_[a.half_edges[2 * i + 1].face];
      const Vec3<UL> direction = broadcast<UL>(a.directions[i]);
      for (std::uint32_t block = 0; block < blocks(); ++block) {
        const std::uint32_t out = left.plus[block] & right.minus[block], in = left.minus[block] & right.plus[block];
        if ((out | in) == 0) continue;
        for (std::uint32_t met = meeting(direction, block, out, in); met != 0; met &= met - 1) {
          examine(i, block * W + static_cast<std::uint32_t>(first_bit(met)), best);
          if (best.found && best.separation > reach) return best;
        }
      }
    }
    return best;
  }

 private:
  /// b's edges by the side of a plane to which they lead, a bit each; an edge along it is in neither.
  struct Sides {
    std::uint32_t plus[kMost / W], minus[kMost / W];
  };

  ISO_INLINE std::uint32_t blocks() const { return (pair_.b.edges() + W - 1) / W; }
  ISO_INLINE void find_sides(Vec3<U> normal, Sides& sides) const {
    const Vec3<UL> up = broadcast<UL>(normal);
    const UL zero = UL::zero();
    for (std::uint32_t block = 0; block < blocks(); ++block) {
      const UL along = dot(up, directions_.template load<UL>(block * W));
      sides.plus[block] = to_bits(less(zero, along));
      sides.minus[block] = to_bits(less(along, zero));
    }
    const std::uint32_t last = blocks() - 1, own = 0xffffffffu >> (32 - (pair_.b.edges() - last * W));
    sides.plus[last] &= own;
    sides.minus[last] &= own;
  }
  /// Those that lead `out` of the left face of a's edge or `in`, and whose own faces the edge has on its sides.
  ISO_INLINE std::uint32_t meeting(const Vec3<UL>& direction, std::uint32_t block, std::uint32_t out,
                                   std::uint32_t in) const {
    const UL zero = UL::zero();
    const UL at_left = dot(direction, left_.template load<UL>(block * W));
    const UL at_right = dot(direction, right_.template load<UL>(block * W));
    return (out & to_bits(less(zero, at_left) & less(at_right, zero))) |
           (in & to_bits(less(at_left, zero) & less(zero, at_right)));
  }
  ISO_INLINE void examine(std::uint32_t i, std::uint32_t j, EdgeAxis<S>& best) const {
    const Polyhedron<S>& a = pair_.a;
    const Vec3<U> direction = directions_.at(j);
    const Vec3<S> gap = pair_.vertices_b.at(pair_.b.origin(2 * j)) - a.vertices[a.origin(2 * i)];
    if (best.separation >= S(0) && !(side_of_arc(i, direction, gap) > S(0))) return;
    const Vec3<U> across = cross(a.directions[i], direction);
    if (dot(across, across) < U(kLeastSine * kLeastSine)) return;
    const Vec3<U> n = point_of_arc(a, i, direction);
    const S separation = dot(n, gap);
    if (separation > best.separation) best = {i, j, n, separation, true};
  }
  /// [m] with the sign of the separation: along a vector that is the point of the arc but for its length, at most 1/2.
  /// Most arcs that meet look from one solid deep into the other, and need no more.
  ISO_INLINE S side_of_arc(std::uint32_t i, Vec3<U> direction, Vec3<S> gap) const {
    const Polyhedron<S>& a = pair_.a;
    const Vec3<U> left = a.normals[a.half_edges[2 * i].face], right = a.normals[a.half_edges[2 * i + 1].face];
    const U half = U(0.5), at_left = dot(left, direction) * half, at_right = dot(right, direction) * half;
    const S side = round_to<S>(product(dot(right, gap), at_left) - product(dot(left, gap), at_right));
    return at_left > U(0) ? side : -side;
  }

  static constexpr double kLeastSine = 0.005;  // of edges; nearer to parallel, a face's axis is as good

  const Pair& pair_;
  Columns<U, kMost> directions_;    // of b's edges, in a's frame
  Columns<U, kMost> left_, right_;  // normals of the faces beside each of them
  Sides sides_of_a_[kMost];         // by face of a
};

}  // namespace isostep::detail
