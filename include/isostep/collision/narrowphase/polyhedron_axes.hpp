// The separating axes of two polyhedra, and the best of them.
// SPDX-License-Identifier: MIT
#pragma once

#include <bit>

#include "isostep/collision/narrowphase/box_tolerance.hpp"
#include "isostep/geometry/baked/polyhedron_surface.hpp"

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
template <class S> ISO_INLINE Lowest<S> lowest_of(std::span<const Vec3<S>> vertices, Vec3<Unit<S>> up) {
  Lowest<S> lowest = {0, dot(up, vertices[0])};
  for (std::uint32_t i = 1; i < vertices.size(); ++i) {
    const S height = dot(up, vertices[i]);
    if (height < lowest.height) lowest = {i, height};
  }
  return lowest;
}

/// Two polyhedra; what belongs to b is also there as a's frame sees it, and a's vertices as b's does.
template <class S> struct PolyhedronPair {
  static constexpr std::uint32_t kMost = ConvexHull::kMaxVertices;  // and edges, and faces

  const Polyhedron<S>& a;
  const Polyhedron<S>& b;
  Transform<S> b_in_a;
  Vec3<S> vertices_a[kMost];  // [m] in b's frame
  Vec3<S> vertices_b[kMost];  // [m] in a's frame
  S tolerance;                // [m] what an axis must be better by to replace one that is preferred

  ISO_INLINE PolyhedronPair(const Polyhedron<S>& of_a, const Transform<S>& ta, const Polyhedron<S>& of_b,
                            const Transform<S>& tb)
      : a(of_a), b(of_b), b_in_a(relative(ta, tb)) {
    for (std::size_t i = 0; i < a.vertices.size(); ++i) vertices_a[i] = to_local(b_in_a, a.vertices[i]);
    for (std::size_t i = 0; i < b.vertices.size(); ++i) vertices_b[i] = to_world(b_in_a, b.vertices[i]);
    tolerance =
        axis_tolerance(min(a.inner_radius, b.inner_radius), max_abs(b_in_a.position) + a.inner_radius + b.inner_radius);
  }
};

template <class S> struct FaceAxis {
  std::uint32_t face;
  std::uint32_t vertex;  // of the other, deepest below it
  S separation;          // [m]
};

/// The face with the largest separation from the other's vertices; of equals the first. Ends where one exceeds `reach`.
template <class S> ISO_INLINE FaceAxis<S> best_face(const Polyhedron<S>& of, std::span<const Vec3<S>> others, S reach) {
  FaceAxis<S> best = {0, 0, S(0)};
  for (std::uint32_t f = 0; f < of.faces.size(); ++f) {
    const Lowest<S> lowest = lowest_of(others, of.normals[f]);
    const S separation = lowest.height - of.offsets[f];
    if (f != 0 && !(separation > best.separation)) continue;
    best = {f, lowest.vertex, separation};
    if (separation > reach) break;
  }
  return best;
}

template <class S> struct EdgeAxis {
  std::uint32_t edge_a, edge_b;
  Vec3<Unit<S>> normal;  // [1] out of a, a's frame
  S separation;          // [m]
  bool found;
};

/// Edges by the side of a face's normal to which they lead; an edge along the face is in neither.
struct Sides {
  EdgeSet plus, minus;
};

/// The crosses of edges whose arcs meet. Edge 2 k of a has face L on its left and R on its right, and its direction is
/// that of L x R; its arc leads from L to R, that of b's edge from -L to -R. They meet where the edge of each leads out
/// of one face of the other's and into the other, in the same order.
template <class S> class EdgeAxes {
  using U = Unit<S>;
  static constexpr std::uint32_t kMost = ConvexHull::kMaxEdges;

 public:
  ISO_INLINE explicit EdgeAxes(const PolyhedronPair<S>& pair) : pair_(pair) {
    for (std::uint32_t f = 0; f < pair.b.faces.size(); ++f) normals_b_[f] = pair.b_in_a.rotation * pair.b.normals[f];
    for (std::uint32_t j = 0; j < pair.b.edges(); ++j) directions_b_[j] = pair.b_in_a.rotation * pair.b.directions[j];
    const Sum<U> zero = product(U(0), U(0));
    for (std::uint32_t f = 0; f < pair.a.faces.size(); ++f) {
      Sides& sides = sides_of_a_[f];
      sides = {EdgeSet::none(), EdgeSet::none()};
      for (std::uint32_t j = 0; j < pair.b.edges(); ++j) {
        const Sum<U> along = dot_sum(pair.a.normals[f], directions_b_[j]);
        sides.plus.insert_if(along > zero, j);
        sides.minus.insert_if(along < zero, j);
      }
    }
  }

  /// Those better than `limit`; ends where one exceeds `reach`.
  ISO_INLINE EdgeAxis<S> best(S limit, S reach) const {
    EdgeAxis<S> best = {0, 0, Vec3<U>::zero(), limit, false};
    for (std::uint32_t i = 0; i < pair_.a.edges(); ++i) {
      const EdgeSet meeting = edges_meeting(i);
      for (std::uint32_t word = 0; word < 2; ++word) {
        for (std::uint64_t left = meeting.words[word]; left != 0; left &= left - 1) {
          examine(i, 64 * word + static_cast<std::uint32_t>(std::countr_zero(left)), best);
          if (best.found && best.separation > reach) return best;
        }
      }
    }
    return best;
  }

 private:
  /// Of b, with edge i of a.
  ISO_INLINE EdgeSet edges_meeting(std::uint32_t i) const {
    const Polyhedron<S>&a = pair_.a, &b = pair_.b;
    EdgeSet left_plus = EdgeSet::none(), left_minus = left_plus, right_plus = left_plus, right_minus = left_plus;
    const Sum<U> zero = product(U(0), U(0));
    for (std::uint32_t f = 0; f < b.faces.size(); ++f) {
      const Sum<U> along = dot_sum(a.directions[i], normals_b_[f]);
      const EdgeSet plus = EdgeSet::all_if(along > zero), minus = EdgeSet::all_if(along < zero);
      left_plus = left_plus | (plus & b.left_of[f]);
      right_plus = right_plus | (plus & b.right_of[f]);
      left_minus = left_minus | (minus & b.left_of[f]);
      right_minus = right_minus | (minus & b.right_of[f]);
    }
    const Sides &left = sides_of_a_[a.half_edges[2 * i].face], &right = sides_of_a_[a.half_edges[2 * i + 1].face];
    return (left_plus & right_minus & left.plus & right.minus) | (left_minus & right_plus & left.minus & right.plus);
  }
  ISO_INLINE void examine(std::uint32_t i, std::uint32_t j, EdgeAxis<S>& best) const {
    const Polyhedron<S>& a = pair_.a;
    const Vec3<U> across = cross(a.directions[i], directions_b_[j]);
    if (dot(across, across) < U(kLeastSine * kLeastSine)) return;
    const Vec3<U> n = point_of_arc(a, i, directions_b_[j]);
    const S separation = dot(n, pair_.vertices_b[pair_.b.origin(2 * j)] - a.vertices[a.origin(2 * i)]);
    if (separation > best.separation) best = {i, j, n, separation, true};
  }

  static constexpr double kLeastSine = 0.005;  // of edges; nearer to parallel, a face's axis is as good

  const PolyhedronPair<S>& pair_;
  Vec3<U> normals_b_[kMost], directions_b_[kMost];  // in a's frame
  Sides sides_of_a_[kMost];                         // b's edges, by face of a
};

}  // namespace isostep::detail
