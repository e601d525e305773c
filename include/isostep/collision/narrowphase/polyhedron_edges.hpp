// The crosses of two polyhedra's edges among their separating axes.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/polyhedron_axes.hpp"

namespace isostep::detail {

template <class S> struct EdgeAxis {
  std::uint32_t edge_a, edge_b;
  Vec3<Unit<S>> normal;  // [1] out of a, a's frame
  S separation;          // [m]
  bool found;
};

/// The crosses of edges whose arcs meet. Edge 2 k of a has face L on its left and R on its right, and the direction
/// of L x R. Its arc leads from L to R, the arc of b's edge from -L to -R. They meet if the edge of each leads out of
/// one face of the other's and into the other, in the same order. For each edge of a, W edges of b are tested at
/// once.
///
/// Two edges that are the best axis of all are as far apart, or as deep in each other, as the solids are: `d`. So one
/// edge has a point within |d| of the other solid, which is below each of its faces. The other solid reaches down to
/// the separation of the face, so that what is within |d| of it is above that less |d|. Edges outside these layers,
/// of both of the best faces, are left out: in S10 nine of ten pairs of edges. For solids that are apart the best
/// cross may be that of edges which are not near each other: the caller must check whether it is.
template <class S, int W, class Isa> class EdgeAxes {
  using Pair = PolyhedronPair<S, W, Isa>;
  using U = Unit<S>;
  using L = typename Pair::L;
  using UL = typename Pair::UL;
  static constexpr std::uint32_t kMost = ConvexHull::kMaxEdges;

 public:
  /// Uses all edges.
  ISO_INLINE explicit EdgeAxes(const Pair& pair) : pair_(pair) {
    edges_a_.count = edges_b_.count = 0;
    for (std::uint32_t i = 0; i < pair.a.edges(); ++i) edges_a_.add_if(true, i);
    for (std::uint32_t j = 0; j < pair.b.edges(); ++j) edges_b_.add_if(true, j);
    turn_edges_of_b();
  }
  /// Uses the edges that can be the best axis of solids at most `reach` [m] apart, or overlapping by any depth.
  ISO_INLINE EdgeAxes(const Pair& pair, const FaceAxis<S>& face_a, const FaceAxis<S>& face_b, S reach) : pair_(pair) {
    edges_a_.count = edges_b_.count = 0;
    const Polyhedron<S>&a = pair.a, &b = pair.b;
    const S within = max(reach, -max(face_a.separation, face_b.separation)) + pair.tolerance;
    const Plane of_a = plane_of(a, face_a.face), of_b = plane_of(b, face_b.face);
    find_near(a, {of_a.normal, of_a.offset + face_a.separation - within}, pair.vertices_a,
              {of_b.normal, of_b.offset + within}, edges_a_);
    find_near(b, {of_b.normal, of_b.offset + face_b.separation - within}, pair.vertices_b,
              {of_a.normal, of_a.offset + within}, edges_b_);
    turn_edges_of_b();
  }

  /// Returns the best cross better than `limit`. The search ends once one exceeds `reach`.
  ISO_INLINE EdgeAxis<S> best(S limit, S reach) const {
    EdgeAxis<S> best = {0, 0, Vec3<U>::zero(), limit, false};
    for (std::uint32_t at = 0; at < edges_a_.count; ++at) {
      for (std::uint32_t first = 0; first < edges_b_.count; first += W) {
        for (std::uint32_t met = meeting(edges_a_.numbers[at], first); met != 0; met &= met - 1) {
          examine(edges_a_.numbers[at], first + static_cast<std::uint32_t>(first_bit(met)), best);
          if (best.found && best.separation > reach) return best;
        }
      }
    }
    return best;
  }

 private:
  struct Plane {
    Vec3<U> normal;
    S offset;  // [m]
  };
  struct Edges {
    std::uint32_t count;
    std::uint8_t numbers[kMost];

    ISO_INLINE void add_if(bool kept, std::uint32_t edge) {  // without a branch: none could be foreseen
      numbers[count] = static_cast<std::uint8_t>(edge);
      count += kept ? 1u : 0u;
    }
  };
  static ISO_INLINE Plane plane_of(const Polyhedron<S>& solid, std::uint32_t face) {
    return {solid.normals[face], solid.offsets[face]};
  }
  /// Finds the edges that reach above one plane and below another. The second plane and the vertices `seen` are in the
  /// other's frame.
  static ISO_INLINE void find_near(const Polyhedron<S>& solid, const Plane& floor,
                                   const Columns<S, ConvexHull::kMaxVertices>& seen, const Plane& ceiling,
                                   Edges& edges) {
    constexpr unsigned kAbove = 1, kBelow = 2;
    const Vec3<UL> up = broadcast<UL>(floor.normal), over = broadcast<UL>(ceiling.normal);
    const L low = L::broadcast(floor.offset), high = L::broadcast(ceiling.offset);
    std::uint8_t sides[ConvexHull::kMaxVertices];
    for (std::uint32_t first = 0; first < solid.vertices.size(); first += W) {
      const std::uint32_t above = to_bits(less(low, dot(up, solid.vertices.template load<L>(first))));
      const std::uint32_t below = to_bits(less(dot(over, seen.template load<L>(first)), high));
      for (std::uint32_t i = 0; i < W; ++i)
        sides[first + i] = static_cast<std::uint8_t>((above >> i & 1u) * kAbove | (below >> i & 1u) * kBelow);
    }
    for (std::uint32_t k = 0; k < solid.edges(); ++k)
      edges.add_if((sides[solid.origin(2 * k)] | sides[solid.origin(2 * k + 1)]) == (kAbove | kBelow), k);
  }
  ISO_INLINE void turn_edges_of_b() {
    const Polyhedron<S>& b = pair_.b;
    if (edges_b_.count == 0) return;
    for (std::uint32_t k = 0; k < edges_b_.count; ++k) {
      const std::uint32_t j = edges_b_.numbers[k];
      directions_.set(k, b.directions[j]);
      left_.set(k, b.normals[b.half_edges[2 * j].face]);
      right_.set(k, b.normals[b.half_edges[2 * j + 1].face]);
    }
    turn_from_b(directions_);
    turn_from_b(left_);
    turn_from_b(right_);
  }
  ISO_INLINE void turn_from_b(Columns<U, kMost>& columns) const {
    const Mat3<UL> turn = broadcast<UL>(pair_.b_in_a.rotation);
    columns.template pad<W>(edges_b_.count);
    for (std::uint32_t first = 0; first < edges_b_.count; first += W)
      columns.store(first, turn * columns.template load<UL>(first));
  }

  /// Returns those of W edges of b whose arcs meet that of edge i of a, a bit each.
  ISO_INLINE std::uint32_t meeting(std::uint32_t i, std::uint32_t first) const {
    const Polyhedron<S>& a = pair_.a;
    const UL zero = UL::zero();
    const Vec3<UL> along = directions_.template load<UL>(first);
    const UL from_left = dot(broadcast<UL>(a.normals[a.half_edges[2 * i].face]), along);
    const UL from_right = dot(broadcast<UL>(a.normals[a.half_edges[2 * i + 1].face]), along);
    const auto out = less(zero, from_left) & less(from_right, zero);
    const auto in = less(from_left, zero) & less(zero, from_right);
    const std::uint32_t left = edges_b_.count - first, own = left < W ? (1u << left) - 1 : 0xffffffffu >> (32 - W);
    if ((to_bits(out | in) & own) == 0) return 0;
    const Vec3<UL> direction = broadcast<UL>(a.directions[i]);
    const UL at_left = dot(direction, left_.template load<UL>(first));
    const UL at_right = dot(direction, right_.template load<UL>(first));
    return own & to_bits((out & less(zero, at_left) & less(at_right, zero)) |
                         (in & less(at_left, zero) & less(zero, at_right)));
  }
  /// Examines edge i of a with the edge of b at place k.
  ISO_INLINE void examine(std::uint32_t i, std::uint32_t k, EdgeAxis<S>& best) const {
    const Polyhedron<S>& a = pair_.a;
    const std::uint32_t j = edges_b_.numbers[k];
    const Vec3<U> direction = directions_.at(k);
    const Vec3<S> gap = pair_.vertices_b.at(pair_.b.origin(2 * j)) - a.vertices[a.origin(2 * i)];
    if (best.separation >= S(0) && !(side_of_arc(i, direction, gap) > S(0))) return;
    const Vec3<U> across = cross(a.directions[i], direction);
    if (dot(across, across) < U(kLeastSine * kLeastSine)) return;
    const Vec3<U> n = point_of_arc(a, i, direction);
    const S separation = dot(n, gap);
    if (separation > best.separation) best = {i, j, n, separation, true};
  }
  /// [m] Returns a number with the sign of the separation: that along a vector of length at most 1/2 towards the point
  /// of the arc. Most arcs that meet look from one solid deep into the other, and need no more.
  ISO_INLINE S side_of_arc(std::uint32_t i, Vec3<U> direction, Vec3<S> gap) const {
    const Polyhedron<S>& a = pair_.a;
    const Vec3<U> left = a.normals[a.half_edges[2 * i].face], right = a.normals[a.half_edges[2 * i + 1].face];
    const U half = U(0.5), at_left = dot(left, direction) * half, at_right = dot(right, direction) * half;
    const S side = round_to<S>(product(dot(right, gap), at_left) - product(dot(left, gap), at_right));
    return at_left > U(0) ? side : -side;
  }

  static constexpr double kLeastSine = 0.005;  // of edges; nearer to parallel, a face's axis is as good

  const Pair& pair_;
  Edges edges_a_, edges_b_;
  // The columns are of b's edges, in a's frame, each at its place in edges_b_.
  Columns<U, kMost> directions_;
  Columns<U, kMost> left_, right_;  // normals of the faces beside
};

}  // namespace isostep::detail
