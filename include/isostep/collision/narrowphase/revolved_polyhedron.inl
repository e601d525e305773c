// Bodies of revolved_polyhedron.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/revolved_polyhedron.hpp"
#include "isostep/collision/narrowphase/revolved_touch.hpp"
#include "isostep/geometry/baked/polyhedron_surface.hpp"

namespace isostep {
namespace detail {

/// A polyhedron as the solid of revolution beside it sees it, and their axes.
template <class S> class RevolvedFacets {
  using U = Unit<S>;
  using Axis = RevolvedAxis<S>;

 public:
  ISO_INLINE RevolvedFacets(const Revolved<S>& solid, const Polyhedron<S>& b, const Transform<S>& b_in_a)
      : solid_(solid), b_(b), b_in_a_(b_in_a) {}

  /// False: they are further apart than `margin`.
  ISO_INLINE bool find(S margin, S tolerance, Axis& best) {
    if (!find_face(margin, best)) return false;
    for (std::uint32_t i = 0; i < b_.vertices.size(); ++i) vertices_[i] = to_world(b_in_a_, b_.vertices[i]);
    for (int end = 0; end < 2; ++end) {
      if (!(solid_.radii[end] > S(0))) continue;
      const Vec3<U> n = unit_axis<U>(1, end == 0);
      const S separation = lowest(n) - solid_.half;
      if (separation > margin) return false;
      best.offer(Axis::cap, separation, n, 0, end, best.kind == Axis::cap ? S(0) : tolerance);
    }
    for (std::uint32_t i = 0; i < b_.vertices.size(); ++i) look_at_vertex(i, tolerance, best);
    if (best.separation > margin) return false;
    for (std::uint32_t k = 0; k < b_.edges() && best.separation <= margin; ++k)
      look_at_line(solid_, line(k), k, tolerance, best);
    return best.separation <= margin;
  }
  ISO_INLINE void touch(const Axis& best, const RevolvedTouch<S>& touch) const {
    switch (best.kind) {
      case Axis::face: touch.over_face(face(best.feature)); return;
      case Axis::cap: return on_cap(best, touch);
      case Axis::side_vertex: return at_vertex(best, touch);
      case Axis::side_edge: return at_edge(best, touch);
      case Axis::rim: return at_rim(best, touch);
    }
  }
  /// Of a disc that lies flat, where no point of its rim is over the other: of the lowest vertices, to `tie` [m], that
  /// which is nearest to the axis. Else the lowest point of the rim.
  ISO_INLINE void at_lowest(const Axis& best, S tie, const RevolvedTouch<S>& touch) const {
    if (solid_.reach(best.normal).across > U(kFlatDisc)) return at_rim(best, touch);
    const S limit = lowest(best.normal) + tie;
    Vec3<S> nearest = vertices_[0];
    S least = highest<S>();
    for (std::uint32_t i = 0; i < b_.vertices.size(); ++i) {
      const Vec3<S> p = vertices_[i];
      const S aside = direction_of(p.x, S(0), p.z).length;
      if (dot(best.normal, p) <= limit && aside < least) least = aside, nearest = p;
    }
    touch.at(nearest - best.normal * (best.separation * S(0.5)), best.separation, best.normal, name_of(best));
  }
  ISO_INLINE void at_rim(const Axis& best, const RevolvedTouch<S>& touch) const {
    const Reach<S> reach = solid_.reach(best.normal);
    const Vec3<S> p = solid_.rim(reach.end(), reach.radial);
    touch.at(p + best.normal * (best.separation * S(0.5)), best.separation, best.normal, name_of(best) | best.end);
  }

 private:
  static ISO_INLINE std::uint32_t name_of(const Axis& best) {
    return static_cast<std::uint32_t>(best.kind) << 28 | best.feature << 1;
  }
  ISO_INLINE Vec3<U> normal(std::uint32_t f) const { return b_in_a_.rotation * b_.normals[f]; }
  ISO_INLINE S offset(std::uint32_t f, Vec3<U> normal_in_a) const {
    return b_.offsets[f] + dot(normal_in_a, b_in_a_.position);
  }
  ISO_INLINE bool find_face(S margin, Axis& best) const {
    for (std::uint32_t f = 0; f < b_.faces.size(); ++f) {
      const Vec3<U> up = normal(f);
      const S separation = -solid_.reach(-up).most() - offset(f, up);
      if (separation > margin) return false;
      if (f == 0 || separation > best.separation) best = {Axis::face, separation, -up, f, 0};
    }
    return true;
  }
  ISO_INLINE S lowest(Vec3<U> n) const {
    S least = dot(n, vertices_[0]);
    for (std::uint32_t i = 1; i < b_.vertices.size(); ++i) least = min(least, dot(n, vertices_[i]));
    return least;
  }
  ISO_INLINE void look_at_vertex(std::uint32_t i, S tolerance, Axis& best) const {
    const Vec3<U> n = side_towards(solid_, vertices_[i]);
    const S lead = best.kind >= Axis::side_vertex ? S(0) : tolerance, reach = solid_.reach(n).most();
    if (dot(n, vertices_[i]) - reach > best.separation + lead)
      best.offer(Axis::side_vertex, lowest(n) - reach, n, i, 0, lead);
  }
  ISO_INLINE LineOfOther<S> line(std::uint32_t k) const {
    const Vec3<U> along = b_in_a_.rotation * b_.directions[k];
    return {vertices_[b_.origin(2 * k)],
            along,
            {cross(normal(b_.half_edges[2 * k].face), along), cross(along, normal(b_.half_edges[2 * k + 1].face))}};
  }

  ISO_INLINE FaceOfOther<S> face(std::uint32_t f) const {
    FaceOfOther<S> face;
    face.normal = normal(f);
    face.offset = offset(f, face.normal);
    face.own = 1u << 31 | f << 16;
    face.cut = face.own | 1u << 30;
    std::uint32_t e = b_.faces[f];
    do {
      const Vec3<U> along = b_in_a_.rotation * b_.directions[e / 2];
      const Vec3<U> outward = cross((e & 1u) != 0 ? -along : along, face.normal);
      face.sides.sides[face.sides.count++] = {outward, dot(outward, vertices_[b_.origin(e)]), kSideName + e / 2, false};
      e = b_.half_edges[e].next;
    } while (e != b_.faces[f]);
    return face;
  }
  /// The other's face that looks most against the disc.
  ISO_INLINE void on_cap(const Axis& best, const RevolvedTouch<S>& touch) const {
    std::uint32_t face = 0;
    U least = U(1);
    for (std::uint32_t f = 0; f < b_.faces.size(); ++f) {
      const U facing = dot(normal(f), best.normal);
      if (facing < least) least = facing, face = f;
    }
    std::uint32_t edges[ConvexHull::kMaxEdges];
    int count = 0;
    std::uint32_t e = b_.faces[face];
    do {
      edges[count++] = e;
      e = b_.half_edges[e].next;
    } while (e != b_.faces[face]);
    touch.under_disc(
        static_cast<int>(best.end), count, [&](int i) ISO_INLINE_LAMBDA { return vertices_[b_.origin(edges[i])]; },
        [&](int i) ISO_INLINE_LAMBDA { return edges[i] / 2; },
        static_cast<std::uint32_t>(Axis::cap) << 28 | best.end << 27 | face << 16);
  }
  ISO_INLINE bool beside(std::uint32_t k, const Axis& best, const RevolvedTouch<S>& touch) const {
    const Vec3<S> from = vertices_[b_.origin(2 * k)];
    const Vec3<U> along = b_in_a_.rotation * b_.directions[k];
    const S length = dot(along, vertices_[b_.origin(2 * k + 1)] - from);
    return touch.beside(from, along, length, best.normal,
                        static_cast<std::uint32_t>(Axis::side_edge) << 28 | 1u << 27 | k << 1);
  }
  /// Or along the edge there that looks most across the normal.
  ISO_INLINE void at_vertex(const Axis& best, const RevolvedTouch<S>& touch) const {
    std::uint32_t nearest = 0;
    S least = highest<S>();
    b_.visit_spokes(best.feature, [&](std::uint32_t e) ISO_INLINE_LAMBDA {
      const S height = dot(best.normal, vertices_[b_.origin(e ^ 1u)]);
      if (height < least || (height == least && e / 2 < nearest)) least = height, nearest = e / 2;
    });
    if (beside(nearest, best, touch)) return;
    const Vec3<S> p = vertices_[best.feature];
    touch.at(p - best.normal * (best.separation * S(0.5)), best.separation, best.normal, name_of(best));
  }
  ISO_INLINE void at_edge(const Axis& best, const RevolvedTouch<S>& touch) const {
    if (beside(best.feature, best, touch)) return;
    const Segment<S> side = side_line(solid_, solid_.reach(best.normal).radial);
    const Segment<S> edge = seen_by(b_in_a_, edge_of(b_, best.feature));
    const ClosestPair<S> closest = closest_points(side, edge);
    touch.at((side.at(closest.s) + edge.at(closest.t)) * S(0.5), best.separation, best.normal, name_of(best));
  }

  const Revolved<S>& solid_;
  const Polyhedron<S>& b_;
  const Transform<S>& b_in_a_;
  Vec3<S> vertices_[ConvexHull::kMaxVertices];
};

}  // namespace detail

template <class S>
void collide_revolved_polyhedron(const detail::Revolved<S>& solid, const Transform<S>& ta, const Polyhedron<S>& b,
                                 const Transform<S>& tb, S margin, Manifold<S>& out) {
  using namespace detail;
  out.clear();
  const Transform<S> b_in_a = relative(ta, tb);
  const S size = min(solid.half, solid.radii[0]);
  const S tolerance = axis_tolerance(size, b.inner_radius, b_in_a.position);
  RevolvedFacets<S> facets(solid, b, b_in_a);
  RevolvedAxis<S> best = {RevolvedAxis<S>::face, S(0), Vec3<Unit<S>>::zero(), 0, 0};
  if (!facets.find(margin, tolerance, best)) return;
  const RevolvedTouch<S> touch(solid, ta, margin, tolerance * S(0.125), out);
  facets.touch(best, touch);
  if (out.count == 0 && best.separation <= S(0)) facets.at_lowest(best, tolerance, touch);
}

template <class S>
void collide_revolved_half_space(const detail::Revolved<S>& solid, const Transform<S>& ta, Vec3<Unit<S>> normal,
                                 S offset, const Transform<S>& tb, S margin, Manifold<S>& out) {
  using namespace detail;
  out.clear();
  const Vec3<Unit<S>> up = tb.rotation * normal;
  const S height = round_to<S>(dot_sum(ta.position - tb.position, up) - widen<SumOf<S, Unit<S>>>(offset));
  FaceOfOther<S> plane;
  plane.normal = transposed_times(ta.rotation, up);
  plane.offset = -height;
  plane.own = plane.cut = 0;
  const S tolerance = axis_tolerance(min(solid.half, solid.radii[0]), abs(height));
  RevolvedTouch<S>(solid, ta, margin, tolerance * S(0.125), out).over_face(plane);
  if (out.count > 0) out.normal = -up;
}

}  // namespace isostep
