// Bodies of epa.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/epa.hpp"
#include "isostep/collision/narrowphase/gjk.inl"

namespace isostep {
namespace detail {

/// A polytope inside the difference of two cores, around the origin. It grows where its surface is nearest to that.
template <class F, class Search = Gjk<F>> class Epa {
  using U = Unit<F>;
  static constexpr int kMostRounds = 64, kMostPoints = kMostRounds + 4;
  static constexpr int kMostFaces = 2 * kMostPoints, kMostEdges = 3 * kMostFaces;

 public:
  struct Axis {
    EpaStatus status;
    F depth;          // [m]
    Vec3<U> normal;   // [1] from a to b, a's frame
    Simplex<F> face;  // the part of the polytope that is nearest
    std::int32_t rounds;
  };

  ISO_INLINE Epa(const Search& search, F extent) : Epa(search, gap_noise(extent), gap_noise(extent) * F(8)) {}
  /// `enough` [m]: the search ends with an axis once no other is better by more.
  ISO_INLINE Epa(const Search& search, F flat, F enough) : search_(search), flat_(flat), enough_(enough) {}

  /// Starts from a simplex that contains the origin, or is as near to it as rounding tells.
  ISO_INLINE Axis run(const Simplex<F>& simplex) {
    Axis best = {EpaStatus::unfinished, highest<F>(), Vec3<U>::zero(), simplex, 0};
    if (!begin(simplex, best)) return best;
    for (best.rounds = 1; best.rounds <= kMostRounds; ++best.rounds) {
      const int nearest = nearest_face();
      const Face face = faces_[nearest];
      const SupportPoint<F> next = search_.support(face.normal);
      const F reach = dot(face.normal, next.point);
      if (reach < best.depth) take(face, reach, best);
      if (best.depth - face.height <= enough_) best.status = EpaStatus::converged;
      if (best.status == EpaStatus::converged || has(next) || !expand(nearest, next)) break;
    }
    if (best.status == EpaStatus::converged) best.face = face_under_origin();
    return best;
  }

 private:
  struct Face {
    int corners[3];  // counter-clockwise seen from outside
    Vec3<U> normal;  // [1] outward
    F height;        // [m] of its plane over the origin
    bool alive;
  };
  struct Edge {
    int from, to;
  };

  ISO_INLINE void take(const Face& face, F reach, Axis& best) const {
    best.depth = reach;
    best.normal = face.normal;
    best.face = nearest_on(face);
  }
  ISO_INLINE Simplex<F> nearest_on(const Face& face) const {
    Simplex<F> corners = {};
    for (int c = 0; c < 3; ++c) corners.points[c] = points_[face.corners[c]];
    return nearest_on_triangle(corners, 0, 1, 2);
  }
  /// Returns the nearest face. Of several in one plane, the face that the origin is above.
  ISO_INLINE Simplex<F> face_under_origin() const {
    const F height = faces_[nearest_face()].height + flat_;
    Simplex<F> best = {};
    for (int f = 0; f < face_count_; ++f) {
      if (!faces_[f].alive || faces_[f].height > height) continue;
      const Simplex<F> face = nearest_on(faces_[f]);
      if (best.count == 0 || is_nearer(face, best)) best = face;
    }
    return best;
  }
  ISO_INLINE bool has(const SupportPoint<F>& point) const {
    for (int i = 0; i < count_; ++i) {
      if (points_[i].vertex_a == point.vertex_a && points_[i].vertex_b == point.vertex_b) return true;
    }
    return false;
  }
  ISO_INLINE int nearest_face() const {
    int nearest = -1;
    for (int f = 0; f < face_count_; ++f) {
      if (faces_[f].alive && (nearest < 0 || faces_[f].height < faces_[nearest].height)) nearest = f;
    }
    return nearest;
  }

  /// Adds the support point along a direction, either way, that `height` finds above its limit. False if none is.
  template <class Height> ISO_INLINE bool grow(Vec3<U> direction, const Height& height) {
    for (int way = 0; way < 2; ++way) {
      const SupportPoint<F> next = search_.support(negate_if(way != 0, direction));
      if (!(height(next.point - points_[0].point) > flat_)) continue;
      points_[count_++] = next;
      return true;
    }
    return false;
  }
  /// Grows the simplex to four points that are no plane. False: there are none, and the best axis is across it.
  ISO_INLINE bool begin(const Simplex<F>& simplex, Axis& best) {
    for (; count_ < simplex.count; ++count_) points_[count_] = simplex.points[count_];
    const auto along = [](Vec3<F> v) ISO_INLINE_LAMBDA { return max_abs(v); };
    for (int axis = 0; axis < 3 && count_ == 1; ++axis) {
      Vec3<U> direction = Vec3<U>::zero();
      direction[axis] = U(1);
      grow(direction, along);
    }
    if (count_ == 1) return give_up(EpaStatus::flat, Vec3<U>{U(1), U(0), U(0)}, best);
    const Vec3<U> line = normalise(points_[1].point - points_[0].point);
    const Tangents<U> across = tangents_of(line);
    const auto aside = [line](Vec3<F> v) ISO_INLINE_LAMBDA { return max_abs(v - line * dot(line, v)); };
    if (count_ == 2 && !grow(across.t, aside) && !grow(across.u, aside))
      return give_up(EpaStatus::flat, across.t, best);
    const Vec3<U> up = normalise(cross(line, normalise(points_[2].point - points_[0].point)));
    const auto above = [up](Vec3<F> v) ISO_INLINE_LAMBDA { return abs(dot(up, v)); };
    if (count_ == 3 && !grow(up, above)) return give_up(EpaStatus::flat, up, best);
    return enclose(up) || give_up(EpaStatus::unfinished, up, best);
  }
  ISO_INLINE bool give_up(EpaStatus status, Vec3<U> axis, Axis& best) const {
    const F there = dot(axis, search_.support(axis).point), back = -dot(axis, search_.support(-axis).point);
    best.status = status;
    keep_one(best.face, 0);
    best.normal = negate_if(back < there, axis);
    best.depth = min(there, back);
    return false;
  }
  /// Builds the tetrahedron of the first four points. `up` is across the first three.
  ISO_INLINE bool enclose(Vec3<U> up) {
    const bool above = dot(up, points_[3].point - points_[0].point) > F(0);
    const int j = above ? 2 : 1, k = above ? 1 : 2;
    return add_face(0, j, k) && add_face(0, 3, j) && add_face(j, 3, k) && add_face(k, 3, 0);
  }
  ISO_INLINE bool add_face(int i, int j, int k) {
    int slot = 0;
    while (slot < face_count_ && faces_[slot].alive) ++slot;
    if (slot == kMostFaces) return false;
    const Vec3<F> p = points_[i].point;
    const Vec3<U> normal = normalise(cross(normalise(points_[j].point - p), normalise(points_[k].point - p)));
    if (normal == Vec3<U>::zero()) return false;
    faces_[slot] = {{i, j, k}, normal, dot(normal, p), true};
    face_count_ = max(face_count_, slot + 1);
    return true;
  }

  /// Expands by a point beyond face `nearest`: replaces all faces below it by new ones from it to their outline.
  ISO_INLINE bool expand(int nearest, const SupportPoint<F>& next) {
    Edge outline[kMostEdges];
    int edges = 0;
    for (int f = 0; f < face_count_; ++f) {
      Face& face = faces_[f];
      if (!face.alive || (f != nearest && !(dot(face.normal, next.point) - face.height > flat_))) continue;
      face.alive = false;
      for (int c = 0; c < 3; ++c) edges = add_edge(outline, edges, {face.corners[c], face.corners[(c + 1) % 3]});
    }
    if (count_ == kMostPoints) return false;
    points_[count_] = next;
    for (int e = 0; e < edges; ++e) {
      if (!add_face(outline[e].from, outline[e].to, count_)) return false;
    }
    ++count_;
    return edges >= 3;
  }
  /// Adds an edge to the outline. An edge that two of the faces share is removed.
  static ISO_INLINE int add_edge(Edge* outline, int edges, Edge edge) {
    for (int e = 0; e < edges; ++e) {
      if (outline[e].from != edge.to || outline[e].to != edge.from) continue;
      for (int after = e + 1; after < edges; ++after) outline[after - 1] = outline[after];
      return edges - 1;
    }
    outline[edges] = edge;
    return edges + 1;
  }

  const Search& search_;
  F flat_;    // [m] what is no height
  F enough_;  // [m]
  SupportPoint<F> points_[kMostPoints];
  Face faces_[kMostFaces];
  int count_ = 0, face_count_ = 0;
};

/// Finds the penetration of two cores in a's frame, radii included. If they are apart, `status` says so.
template <class S, class F = Finer<S>>
ISO_INLINE EpaPenetration<F> penetration_of(const FineCore<S>& a, const FineCore<S>& b, const Transform<F>& b_in_a) {
  const Gjk<F> search(a.vertices, b.vertices, b_in_a);
  Simplex<F> simplex = search.begin();
  const GjkDistance<F> found = search.run(simplex);
  const F radii = a.radius + b.radius;
  EpaPenetration<F> result = {EpaStatus::converged, radii - found.distance, found.normal, found.on_a,
                              found.on_b,           found.iterations};
  if (found.distance == F(0)) {
    const F extent = a.extent + b.extent + max_abs(b_in_a.position);
    const typename Epa<F>::Axis axis = Epa<F>(search, extent).run(simplex);
    const GjkDistance<F> witnesses = search.witnesses(axis.face, axis.rounds);
    result = {axis.status, axis.depth + radii, axis.normal, witnesses.on_a, witnesses.on_b, axis.rounds};
  } else if (found.distance > radii) {
    result.status = EpaStatus::apart;
  }
  result.on_a += result.normal * a.radius;
  result.on_b -= result.normal * b.radius;
  return result;
}

}  // namespace detail

template <class S>
EpaPenetration<S> epa_penetration(const ConvexCore<S>& a, const Transform<S>& ta, const ConvexCore<S>& b,
                                  const Transform<S>& tb) {
  using namespace detail;
  using F = Finer<S>;
  const FineCore<S> fine_a(a), fine_b(b);
  const Mat3<Unit<F>> turn = finer_of(ta).rotation;
  const EpaPenetration<F> found = penetration_of(fine_a, fine_b, fine_relative(ta, tb));
  return {found.status,
          coarser<S>(found.depth),
          coarser_of<Unit<S>>(turn * found.normal),
          ta.position + coarser_of<S>(turn * found.on_a),
          ta.position + coarser_of<S>(turn * found.on_b),
          found.rounds};
}
template <class S>
EpaPenetration<S> epa_penetration(const Polyhedron<S>& a, const Transform<S>& ta, const Polyhedron<S>& b,
                                  const Transform<S>& tb) {
  const PolyhedronCore<S> core_a(a), core_b(b);
  return epa_penetration(core_a.core(), ta, core_b.core(), tb);
}

}  // namespace isostep
