// Bodies of polyhedron_triangle.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/polyhedra.inl"
#include "isostep/collision/narrowphase/polyhedron_triangle.hpp"

namespace isostep {
namespace detail {

/// The axis that decides how a polyhedron touches a triangle, all in the polyhedron's frame.
template <class S> struct TriangleAxis {
  enum Kind { plane, face, edges, neighbour } kind;
  S separation;           // [m]
  std::uint32_t feature;  // a face, or an edge of the polyhedron
  int edge;               // of the triangle
  Vec3<Unit<S>> normal;   // [1] out of the polyhedron, of edges
};

template <class S> class TriangleAxes {
  using U = Unit<S>;

 public:
  ISO_INLINE TriangleAxes(const Polyhedron<S>& a, const SurfaceTriangle<S>& triangle) : a_(a), triangle_(triangle) {}

  /// Returns false if a face is further off than `margin`.
  ISO_INLINE bool are_faces_near(S margin, S limit) {
    for (std::uint32_t f = 0; f < a_.faces.size(); ++f) {
      S heights[3];
      const S least = heights_over(f, heights);
      if (least > margin) return false;
      has_better_face_ = has_better_face_ || least > limit;
    }
    return true;
  }
  /// Takes faces that are better than `best` by the tolerance.
  ISO_INLINE void look_at_faces(S tolerance, TriangleAxis<S>& best) const {
    S limit = best.separation + tolerance;
    for (std::uint32_t f = 0; has_better_face_ && f < a_.faces.size(); ++f) {
      S heights[3];
      const S least = heights_over(f, heights);
      if (!(least > limit) || !owns(-a_.normals[f], heights, least)) continue;
      best = {TriangleAxis<S>::face, least, f, 0, a_.normals[f]};
      limit = least;
    }
  }
  /// Takes the planes of neighbours that have the centre on their outer side. `lowest`: the vertex lowest along the
  /// triangle's normal.
  ISO_INLINE void look_at_neighbours(Vec3<S> centre, std::uint32_t lowest, S tolerance, TriangleAxis<S>& best) {
    const S limit = best.separation + (best.kind == TriangleAxis<S>::plane ? tolerance : S(0));
    for (int k = 0; k < 3; ++k) {
      const SurfaceEdge<S>& edge = triangle_.edges[k];
      if (!edge.touchable) continue;
      const Lowest<S> below = lowest_of(a_.vertices, edge.other);
      has_arcs_[k] = below.vertex != lowest;
      if (!edge.has_neighbour || dot(edge.other, centre - triangle_.points[k]) < S(0)) continue;
      const S separation = below.height - dot(edge.other, triangle_.points[k]);
      if (separation > limit && separation > best.separation)
        best = {TriangleAxis<S>::neighbour, separation, 0, k, edge.other};
    }
  }
  /// Takes crosses of edges. Call it after look_at_neighbours(). A vertex that is lowest at both ends of an edge's arc
  /// is lowest in between, and no edge of the polyhedron has an arc that meets it.
  ISO_INLINE void look_at_edges(S tolerance, TriangleAxis<S>& best) const {
    for (int k = 0; k < 3; ++k) {
      if (!has_arcs_[k]) continue;
      for (std::uint32_t i = 0; i < a_.edges(); ++i) {
        if (arcs_meet(i, k)) examine(i, k, tolerance, best);
      }
    }
  }

 private:
  static constexpr double kLeastSine = 0.005;  // of edges; nearer to parallel, a face's axis is as good
  static constexpr double kAlongEdge = 0.02;   // sine within which a face lies along an edge

  ISO_INLINE S heights_over(std::uint32_t f, S (&heights)[3]) const {
    S least = highest<S>();
    for (int i = 0; i < 3; ++i) {
      heights[i] = dot(a_.normals[f], triangle_.points[i]) - a_.offsets[f];
      least = min(least, heights[i]);
    }
    return least;
  }
  /// Returns true if the surface can be touched from a direction, at its points that are lowest above a face.
  ISO_INLINE bool owns(Vec3<U> direction, const S (&heights)[3], S least) const {
    for (int k = 0; k < 3; ++k) {
      const bool along = abs(dot(direction, triangle_.edges[k].along)) <= U(kAlongEdge);
      const bool ends = heights[k] == least || heights[(k + 1) % 3] == least;  // one of them is the least, exactly
      if (along && ends && triangle_.owns_at_edge(k, direction)) return true;
      if (heights[k] == least && triangle_.owns_at_point(k, direction)) return true;
    }
    return false;
  }
  /// Returns true if the arc of an edge meets the arc from the triangle's normal to its neighbour's. The arcs are those
  /// of EdgeAxes.
  ISO_INLINE bool arcs_meet(std::uint32_t i, int k) const {
    const SurfaceEdge<S>& edge = triangle_.edges[k];
    const Vec3<U> along = a_.directions[i];
    const U at_own = dot(along, triangle_.normal), at_other = dot(along, edge.other);
    const bool out = at_own > U(0) && at_other < U(0), in = at_own < U(0) && at_other > U(0);
    if (!out && !in) return false;
    const U left = dot(a_.normals[a_.half_edges[2 * i].face], edge.along);
    const U right = dot(a_.normals[a_.half_edges[2 * i + 1].face], edge.along);
    return out ? left > U(0) && right < U(0) : left < U(0) && right > U(0);
  }
  ISO_INLINE void examine(std::uint32_t i, int k, S tolerance, TriangleAxis<S>& best) const {
    const Vec3<U> along = triangle_.edges[k].along, across = cross(a_.directions[i], along);
    if (dot(across, across) < U(kLeastSine * kLeastSine)) return;
    const Vec3<U> normal = point_of_arc(a_, i, along);
    const S separation = dot(normal, triangle_.points[k] - a_.vertices[a_.origin(2 * i)]);
    const S lead = best.kind == TriangleAxis<S>::edges ? S(0) : tolerance;
    if (separation > best.separation + lead) best = {TriangleAxis<S>::edges, separation, i, k, normal};
  }

  const Polyhedron<S>& a_;
  const SurfaceTriangle<S>& triangle_;
  bool has_better_face_ = false;
  bool has_arcs_[3] = {};
};

/// The names of the triangle's edges in polygons start here.
inline constexpr std::uint32_t kTriangleEdge = 128;

template <class S>
ISO_INLINE bool clip_to_edge(const SurfaceTriangle<S>& triangle, const Tangents<Unit<S>>& across, int k, S slack,
                             const FacePolygon<S>& from, FacePolygon<S>& to) {
  const Vec3<Unit<S>> inward = triangle.edges[k].inward;
  const Unit<S> du = dot(across.t, inward), dv = dot(across.u, inward);
  const S u = dot(across.t, triangle.points[k]), v = dot(across.u, triangle.points[k]);
  S beyond[kFacePoints];
  for (int i = 0; i < from.count; ++i) {
    const ClipPoint<S>& p = from.points[i];
    beyond[i] = -round_to<S>(product(p.u - u, du) + product(p.v - v, dv)) - slack;
  }
  return clip(from, beyond, kTriangleEdge + static_cast<std::uint32_t>(k), kCutAcross, to);
}

/// Returns true if only flat edges made the corner.
template <class S> ISO_INLINE bool is_cut_flat(const SurfaceTriangle<S>& triangle, const ClipPoint<S>& p) {
  const bool before = p.before >= kTriangleEdge, after = p.after >= kTriangleEdge;
  if (!before && !after) return false;
  return (!before || triangle.edges[p.before - kTriangleEdge].flat) &&
         (!after || triangle.edges[p.after - kTriangleEdge].flat);
}
/// Marks the corners of a face that would be kept if the triangle went on in its plane, by the edge that begins there:
/// its neighbours choose the same ones. A face that is not level with it to within `margin` keeps all.
template <class S> struct KeptCorners {
  bool kept[kTriangleEdge];

  ISO_INLINE KeptCorners(FacePolygon<S> face, S margin, S tie) {
    bool level = face.count > kMaxContactPoints;
    for (int i = 0; i < face.count; ++i) {
      level = level && abs(face.points[i].height) <= margin;
      kept[face.points[i].after] = true;
    }
    if (!level) return;
    for (int i = 0; i < face.count; ++i) kept[face.points[i].after] = false;
    reduce_to_four(face, tie);
    for (int i = 0; i < face.count; ++i) kept[face.points[i].after] = true;
  }
};

/// Adds the points of the polyhedron's lowest face over the triangle, and of faces that lie as flat.
template <class S>
ISO_INLINE void touch_plane(const Polyhedron<S>& a, const Transform<S>& ta, const SurfaceTriangle<S>& triangle,
                            std::uint32_t lowest, S margin, S tie, Manifold<S>& out) {
  const Tangents<Unit<S>> across = tangents_of(triangle.normal);
  const std::uint32_t face = face_against(a, lowest, triangle.normal);
  FacePolygon<S> polygon;
  polygon.count = 0;
  const auto vertex = [&](std::uint32_t i) ISO_INLINE_LAMBDA { return a.vertices[i]; };
  const auto height = [&](Vec3<S> p) ISO_INLINE_LAMBDA { return triangle.height_of(p); };
  const S slack = triangle.slack();
  visit_flat_faces(a, face, [&](std::uint32_t flat) ISO_INLINE_LAMBDA {
    FacePolygon<S> polygons[2];
    project_face(a, flat, across, vertex, height, polygons[0]);
    const KeptCorners<S> corners(polygons[0], margin, tie);
    unsigned now = 0;
    bool ends = false;  // the surface, or its plane, under the face
    for (int k = 0; k < 3; ++k) {
      const bool cuts = clip_to_edge(triangle, across, k, slack, polygons[now], polygons[now ^ 1u]);
      now ^= cuts ? 1u : 0u;
      ends = ends || (cuts && !triangle.edges[k].flat);
    }
    for (int i = 0; i < polygons[now].count; ++i) {
      const ClipPoint<S>& p = polygons[now].points[i];
      const bool own = p.before < kTriangleEdge && p.after < kTriangleEdge;
      const bool counts = own ? ends || corners.kept[p.after] : !is_cut_flat(triangle, p);
      if (p.height <= margin + kPatchReach<S> && counts) add_point(named_by_vertex(a, kTriangleEdge, p), polygon);
    }
  });
  keep_patch(polygon, margin);
  if (polygon.count == 0) return;
  if (polygon.count > kMaxContactPoints) reduce_to_four(polygon, tie);
  out.normal = -(ta.rotation * triangle.normal);
  for (int i = 0; i < polygon.count; ++i) {
    const ClipPoint<S>& p = polygon.points[i];
    const bool own = p.before < kTriangleEdge && p.after < kTriangleEdge;
    const std::uint32_t name = own ? triangle_feature::kOfConvexAlone | p.before : 1u << 31 | p.before << 8 | p.after;
    const Vec3<S> local = across.t * p.u + across.u * p.v + triangle.normal * (triangle.offset + p.height * S(0.5));
    out.add(to_world(ta, local), p.height, name);
  }
}

/// Adds the points of the triangle over a face of the polyhedron.
template <class S>
ISO_INLINE void touch_face(const Polyhedron<S>& a, const Transform<S>& ta, const SurfaceTriangle<S>& triangle,
                           std::uint32_t face, S margin, Manifold<S>& out) {
  const Vec3<Unit<S>> normal = a.normals[face];
  const Tangents<Unit<S>> across = tangents_of(normal);
  FacePolygon<S> polygons[2];
  polygons[0].count = 3;
  for (std::uint32_t i = 0; i < 3; ++i) {
    const Vec3<S> p = triangle.points[i];
    polygons[0].points[i] = {dot(across.t, p), dot(across.u, p), dot(normal, p) - a.offsets[face], (i + 2) % 3, i};
  }
  unsigned now = 0;
  std::uint32_t edge = a.faces[face];
  do {
    now ^= clip_beyond(a, across, edge, polygons[now], polygons[now ^ 1u]) ? 1u : 0u;
    edge = a.half_edges[edge].next;
  } while (edge != a.faces[face]);
  FacePolygon<S>& polygon = polygons[now];
  keep_patch(polygon, margin);
  if (polygon.count == 0) return;
  if (polygon.count > kMaxContactPoints) reduce_to_four(polygon, depth_tie(S(0), face_slack(a.inner_radius)));
  out.normal = ta.rotation * normal;
  for (int i = 0; i < polygon.count; ++i) {
    const ClipPoint<S>& p = polygon.points[i];
    const Vec3<S> local = across.t * p.u + across.u * p.v + normal * (a.offsets[face] + p.height * S(0.5));
    out.add(to_world(ta, local), p.height, 3u << 30 | face << 16 | p.before << 8 | p.after);
  }
}

/// Adds the point where the edges cross. If their nearest points are not one above the other, to within `slack` [m],
/// the edges do not touch, nor do the shapes there.
template <class S>
ISO_INLINE void touch_edge(const Polyhedron<S>& a, const Transform<S>& ta, const SurfaceTriangle<S>& triangle,
                           const TriangleAxis<S>& axis, S slack, Manifold<S>& out) {
  const SurfaceEdge<S>& edge = triangle.edges[axis.edge];
  const S half = edge.length * S(0.5);
  const Segment<S> of_a = edge_of(a, axis.feature),
                   of_triangle = {triangle.points[axis.edge] + edge.along * half, edge.along, half};
  const ClosestPair<S> closest = closest_points(of_a, of_triangle);
  const Vec3<S> on_a = of_a.at(closest.s), on_triangle = of_triangle.at(closest.t);
  if (longer_than(on_triangle - on_a - axis.normal * axis.separation, slack)) return;
  out.normal = ta.rotation * axis.normal;
  out.add(to_world(ta, (on_a + on_triangle) * S(0.5)), axis.separation,
          1u << 29 | axis.feature << 8 | static_cast<std::uint32_t>(axis.edge));
}

}  // namespace detail

template <class S>
void collide_polyhedron_triangle(const Polyhedron<S>& a, const Transform<S>& ta, const SurfaceFrame<S>& frame,
                                 const BakedTriangle& baked, S margin, Manifold<S>& out) {
  using namespace detail;
  using Axis = TriangleAxis<S>;
  out.clear();
  SurfaceTriangle<S> triangle(frame, baked);
  if (triangle.height < S(0)) return;
  const Lowest<S> lowest = lowest_of(a.vertices, triangle.normal);
  Axis best = {Axis::plane, lowest.height - triangle.offset, 0, 0, triangle.normal};
  if (best.separation > margin) return;
  const S tolerance = axis_tolerance(a.inner_radius, max_abs(frame.centre) + a.inner_radius);
  TriangleAxes<S> axes(a, triangle);
  if (!axes.are_faces_near(margin, best.separation + tolerance)) return;
  triangle.find_edges(frame, baked);
  axes.look_at_faces(tolerance, best);
  axes.look_at_neighbours(frame.centre, lowest.vertex, tolerance, best);
  axes.look_at_edges(tolerance, best);
  if (best.separation > margin) return;
  switch (best.kind) {
    case Axis::plane:
      return touch_plane(a, ta, triangle, lowest.vertex, margin, depth_tie(tolerance, face_slack(a.inner_radius)), out);
    case Axis::face: return touch_face(a, ta, triangle, best.feature, margin, out);
    case Axis::edges: return touch_edge(a, ta, triangle, best, tolerance * S(4), out);
    case Axis::neighbour: return;
  }
}

}  // namespace isostep
