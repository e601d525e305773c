// Bodies of polyhedra.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/face_clip.hpp"
#include "isostep/collision/narrowphase/polyhedra.hpp"
#include "isostep/collision/narrowphase/polyhedron_edges.hpp"
#include "isostep/math/segment.hpp"
#include "isostep/math/shortened.hpp"

namespace isostep {
namespace detail {

/// A face has at most half as many corners as there are edges. Cutting by a convex polygon adds at most its corners.
inline constexpr int kFacePoints = ConvexHull::kMaxEdges;
template <class S> using FacePolygon = ClipPolygon<S, kFacePoints>;

/// A reference face and the solid that touches it, in the frame of the face's solid.
template <class S> struct FaceContact {
  const Polyhedron<S>& reference;
  const Polyhedron<S>& incident;
  const Columns<S, ConvexHull::kMaxVertices>& vertices;  // [m] of the incident solid
  FaceAxis<S> axis;
  Tangents<Unit<S>> across;  // of the face's normal
};

/// Returns the face around a vertex that looks most against a direction. The first of equals.
template <class S>
ISO_INLINE std::uint32_t face_against(const Polyhedron<S>& solid, std::uint32_t vertex, Vec3<Unit<S>> up) {
  std::uint32_t best = 0xffffffffu;
  Unit<S> least = Unit<S>(0);
  solid.visit_spokes(vertex, [&](std::uint32_t half_edge) ISO_INLINE_LAMBDA {
    const std::uint32_t face = solid.half_edges[half_edge].face;
    const Unit<S> facing = dot(solid.normals[face], up);
    if (best != 0xffffffffu && (facing > least || (facing == least && face > best))) return;
    least = facing;
    best = face;
  });
  return best;
}

/// Projects a face's corners on a plane: vertex(i) returns a vertex in the plane's frame, height(p) [m] its height.
/// Edges of the face are named by their numbers.
template <class S, class Vertex, class Height>
ISO_INLINE void project_face(const Polyhedron<S>& solid, std::uint32_t face, const Tangents<Unit<S>>& across,
                             const Vertex& vertex, const Height& height, FacePolygon<S>& polygon) {
  std::uint32_t edge = solid.faces[face];
  polygon.count = 0;
  do {
    const std::uint32_t next = solid.half_edges[edge].next;
    const Vec3<S> p = vertex(solid.origin(next));
    polygon.points[polygon.count++] = {dot(across.t, p), dot(across.u, p), height(p), edge / 2, next / 2};
    edge = next;
  } while (edge != solid.faces[face]);
}

/// Calls visit(f) for a face and for all that look along it to within kFlat. A solid need not rest on one plane: each
/// of two that differ by less than contacts sink would tip it onto the other.
template <class S, class Visit>
ISO_INLINE void visit_flat_faces(const Polyhedron<S>& solid, std::uint32_t face, const Visit& visit) {
  constexpr double kFlat = 1 - 1.0 / 1024;  // cosine, of 2.5 degrees
  for (std::uint32_t f = 0; f < solid.faces.size(); ++f) {
    if (f == face || dot(solid.normals[f], solid.normals[face]) >= Unit<S>(kFlat)) visit(f);
  }
}
/// Adds a point unless it is there already: corners with equal names are one.
template <class S> ISO_INLINE void add_point(const ClipPoint<S>& p, FacePolygon<S>& points) {
  for (int i = 0; i < points.count; ++i) {
    if (points.points[i].before == p.before && points.points[i].after == p.after) return;
  }
  if (points.count < kFacePoints) points.points[points.count++] = p;
}
/// Returns the vertex that two edges share.
template <class S>
ISO_INLINE std::uint32_t vertex_between(const Polyhedron<S>& a, std::uint32_t before, std::uint32_t after) {
  const std::uint32_t first = a.origin(2 * before);
  return first == a.origin(2 * after) || first == a.origin(2 * after + 1) ? first : a.origin(2 * before + 1);
}
/// Names a corner that is a vertex of the solid by that vertex, twice: the name is the same on every face around it.
template <class S>
ISO_INLINE ClipPoint<S> named_by_vertex(const Polyhedron<S>& solid, std::uint32_t cut, ClipPoint<S> p) {
  if (p.before < cut && p.after < cut) p.before = p.after = vertex_between(solid, p.before, p.after);
  return p;
}

/// The cut function of clip() for lines at any angle.
inline constexpr auto kCutAcross = [](const auto& p, const auto& q, auto t, auto& at) ISO_INLINE_LAMBDA {
  at.u = p.u + (q.u - p.u) * t;
  at.v = p.v + (q.v - p.v) * t;
};

/// Cuts off the part beyond an edge of the reference face. The edge is named kReferenceEdge + its number.
inline constexpr std::uint32_t kReferenceEdge = 128;
template <class S>
ISO_INLINE bool clip_beyond(const Polyhedron<S>& solid, const Tangents<Unit<S>>& across, std::uint32_t half_edge,
                            const FacePolygon<S>& from, FacePolygon<S>& to) {
  const Vec3<Unit<S>> along = negate_if((half_edge & 1u) != 0, solid.directions[half_edge / 2]);
  const Vec3<S> corner = solid.vertices[solid.origin(half_edge)];
  const Unit<S> du = dot(across.t, along), dv = dot(across.u, along);
  const S u = dot(across.t, corner), v = dot(across.u, corner);
  S beyond[kFacePoints];
  for (int i = 0; i < from.count; ++i)
    beyond[i] = round_to<S>(product(from.points[i].u - u, dv) - product(from.points[i].v - v, du));
  return clip(from, beyond, kReferenceEdge + half_edge / 2, kCutAcross, to);
}

/// Takes only the vertex below the face, if rounding leaves nothing above the best face of overlapping solids.
template <class S> ISO_INLINE void take_deepest(const FaceContact<S>& contact, FacePolygon<S>& polygon) {
  const Vec3<S> p = contact.vertices.at(contact.axis.vertex);
  polygon.points[0] = {dot(contact.across.t, p), dot(contact.across.u, p), contact.axis.separation, contact.axis.vertex,
                       contact.axis.vertex};
  polygon.count = 1;
}

/// Adds the points of the face polygon. face: that of the incident solid.
template <class S>
ISO_INLINE void touch_faces(const FaceContact<S>& contact, std::uint32_t face, const Transform<S>& frame, S margin,
                            S tie, bool of_a, bool deepest, Manifold<S>& out) {
  const Polyhedron<S>& reference = contact.reference;
  const Vec3<Unit<S>> normal = reference.normals[contact.axis.face];
  const S offset = reference.offsets[contact.axis.face];
  FacePolygon<S> polygon;
  polygon.count = 0;
  const auto vertex = [&](std::uint32_t i) ISO_INLINE_LAMBDA { return contact.vertices.at(i); };
  const auto height = [&](Vec3<S> p) ISO_INLINE_LAMBDA { return dot(normal, p) - offset; };
  visit_flat_faces(contact.incident, face, [&](std::uint32_t flat) ISO_INLINE_LAMBDA {
    FacePolygon<S> polygons[2];
    project_face(contact.incident, flat, contact.across, vertex, height, polygons[0]);
    unsigned now = 0;
    std::uint32_t edge = reference.faces[contact.axis.face];
    do {
      now ^= clip_beyond(reference, contact.across, edge, polygons[now], polygons[now ^ 1u]) ? 1u : 0u;
      edge = reference.half_edges[edge].next;
    } while (edge != reference.faces[contact.axis.face]);
    for (int i = 0; i < polygons[now].count; ++i) {
      const ClipPoint<S>& p = polygons[now].points[i];
      if (p.height <= margin + kPatchReach<S>) add_point(named_by_vertex(contact.incident, kReferenceEdge, p), polygon);
    }
  });
  keep_patch(polygon, margin);
  if (polygon.count == 0 && deepest) take_deepest(contact, polygon);
  if (polygon.count == 0) return;
  if (polygon.count > kMaxContactPoints) reduce_to_four(polygon, tie);

  const Vec3<Unit<S>> outward = frame.rotation * normal;
  out.normal = of_a ? outward : -outward;
  const std::uint32_t name = 1u << 31 | (of_a ? 0u : 1u) << 30 | contact.axis.face << 23;
  for (int i = 0; i < polygon.count; ++i) {
    const ClipPoint<S>& p = polygon.points[i];
    const Vec3<S> local = contact.across.t * p.u + contact.across.u * p.v + normal * (offset + p.height * S(0.5));
    out.add(to_world(frame, local), p.height, name | p.before << 8 | p.after);
  }
}

/// The edges of the best cross and their nearest points, in a's frame.
template <class S> struct EdgeContact {
  EdgeAxis<S> axis;
  Vec3<S> on_a, on_b;  // [m] zero where none was found
};
template <class S, int W, class Isa>
ISO_INLINE EdgeContact<S> contact_of(const PolyhedronPair<S, W, Isa>& pair, const EdgeAxis<S>& best) {
  if (!best.found) return {best, Vec3<S>::zero(), Vec3<S>::zero()};
  const Segment<S> of_a = edge_of(pair.a, best.edge_a), of_b = seen_by(pair.b_in_a, edge_of(pair.b, best.edge_b));
  const ClosestPair<S> closest = closest_points(of_a, of_b);
  return {best, of_a.at(closest.s), of_b.at(closest.t)};
}

/// Returns true if the edges near both best faces contain the best cross of all. Solids that overlap then have a point
/// of one inside the other; solids that are apart along it have points that are no further apart than that, to within
/// the tolerance.
template <class S, int W, class Isa>
ISO_INLINE bool is_best(const PolyhedronPair<S, W, Isa>& pair, const EdgeContact<S>& contact, S margin) {
  const S separation = contact.axis.separation;
  if (separation > margin) return true;  // which one is open
  if (separation > S(0)) return !is_longer(contact.on_b - contact.on_a, separation + pair.tolerance);
  return height_over<S, W, Isa>(pair.a, contact.on_b) <= S(0);
}

/// Finds the edges whose cross is better than both best faces by the tolerance, among those near both. `is_known`: they
/// are proved the best of all, or there are none. `over_a` [m]: the height over a of that vertex of b which is lowest
/// over a's best face.
template <class S, int W, class Isa>
ISO_INLINE EdgeContact<S> near_edges(const PolyhedronPair<S, W, Isa>& pair, const FaceAxis<S>& face_a, S over_a,
                                     const FaceAxis<S>& face_b, S margin, bool& is_known) {
  const S best = max(face_a.separation, face_b.separation), limit = best + pair.tolerance;
  const S over_b = height_over<S, W, Isa>(pair.b, pair.vertices_a.at(face_b.vertex));
  is_known = over_b <= min(limit, S(0));
  if (is_known) return {{0, 0, Vec3<Unit<S>>::zero(), limit, false}, {}, {}};
  const EdgeContact<S> nearby = contact_of(pair, EdgeAxes<S, W, Isa>(pair, face_a, face_b, margin).best(limit, margin));
  const bool overlap = over_a <= S(0) || over_b <= S(0);
  // A contact over a face of solids that are apart has their true distance.
  is_known = nearby.axis.found ? is_best(pair, nearby, margin) : best > S(0) || overlap;
  return nearby;
}
template <class S, int W, class Isa>
ISO_INLINE EdgeContact<S> all_edges(const PolyhedronPair<S, W, Isa>& pair, S best, S margin) {
  return contact_of(pair, EdgeAxes<S, W, Isa>(pair).best(best + pair.tolerance, margin));
}
/// Returns true if a point of the manifold, halfway between the surfaces, is inside both: they overlap.
template <class S, int W, class Isa>
ISO_INLINE bool shares_a_point(const PolyhedronPair<S, W, Isa>& pair, const Transform<S>& ta, const Manifold<S>& m) {
  for (int i = 0; i < m.count; ++i) {
    const Vec3<S> in_a = transposed_times(ta.rotation, m.points[i].position - ta.position);
    if (height_over<S, W, Isa>(pair.a, in_a) <= S(0) &&
        height_over<S, W, Isa>(pair.b, to_local(pair.b_in_a, in_a)) <= S(0))
      return true;
  }
  return false;
}

/// Does collide_polyhedra() with W lanes of Isa.
template <class S, int W, class Isa>
ISO_INLINE void collide_polyhedra_over(const Polyhedron<S>& a, const Transform<S>& ta, const Polyhedron<S>& b,
                                       const Transform<S>& tb, S margin, Manifold<S>& out) {
  out.clear();
  PolyhedronPair<S, W, Isa> pair(a, ta, b, tb);
  if (pair.are_apart(margin)) return;
  const FaceAxis<S> face_a = best_face<S, W, Isa>(a, pair.vertices_b, b.vertices.size(), margin);
  if (face_a.separation > margin) return;
  const S smallest = min(a.inner_radius, b.inner_radius);
  const auto touch = [&](const FaceAxis<S>& face, bool of_b, bool deepest) ISO_INLINE_LAMBDA {
    const Polyhedron<S>&reference = of_b ? b : a, &incident = of_b ? a : b;
    const auto& vertices = of_b ? pair.vertices_a : pair.vertices_b;
    const Vec3<Unit<S>> normal = reference.normals[face.face];
    const Mat3<Unit<S>>& turn = pair.b_in_a.rotation;
    const Vec3<Unit<S>> up = of_b ? turn * normal : transposed_times(turn, normal);
    touch_faces({reference, incident, vertices, face, tangents_of(normal)}, face_against(incident, face.vertex, up),
                of_b ? tb : ta, margin, depth_tie(pair.tolerance, face_slack(smallest)), !of_b, deepest, out);
  };
  // No axis is better by the tolerance where the vertex below the best face lies nearer to none of the others.
  const S beyond_a = face_a.separation + pair.tolerance;
  const S over_a = height_over<S, W, Isa>(a, pair.vertices_b.at(face_a.vertex));
  if (over_a <= min(beyond_a, S(0))) {
    touch(face_a, false, false);
    if (out.count != 0) return;
  }
  pair.turn_a();
  const FaceAxis<S> face_b = best_face<S, W, Isa>(b, pair.vertices_a, a.vertices.size(), margin);
  if (face_b.separation > margin) return;
  const bool b_is_better = face_b.separation > face_a.separation;
  const Vec3<Unit<S>> up_b = pair.b_in_a.rotation * b.normals[face_b.face];
  const bool beside = -dot(a.normals[face_a.face], up_b) >= Unit<S>(kNearFace);  // as box_axes.hpp has it
  const bool prefers_b = face_b.separation > beyond_a && !(face_b.separation > -kMostBeside<S> && beside);
  const auto touch_preferred = [&]() ISO_INLINE_LAMBDA { touch(prefers_b ? face_b : face_a, prefers_b, false); };
  bool is_known = false;
  EdgeContact<S> edges = near_edges(pair, face_a, over_a, face_b, margin, is_known);
  const bool by_faces = !edges.axis.found;
  if (by_faces) {
    touch_preferred();
    is_known = is_known || shares_a_point(pair, ta, out);
  }
  if (!is_known) edges = all_edges(pair, max(face_a.separation, face_b.separation), margin);
  if (edges.axis.found) {
    out.clear();
    if (edges.axis.separation > margin) return;
    touch_preferred();
    if (tells_of(out, edges.axis.separation, edge_slack(smallest))) return;
    out.clear();
    out.normal = ta.rotation * edges.axis.normal;
    return out.add(to_world(ta, (edges.on_a + edges.on_b) * S(0.5)), edges.axis.separation,
                   edges.axis.edge_a << 7 | edges.axis.edge_b);
  }
  if (!by_faces) touch_preferred();
  // Nothing is above a face that was preferred to a better one: that one decides, and whether they are apart.
  if (out.count == 0 && max(face_a.separation, face_b.separation) <= S(0))
    touch(b_is_better ? face_b : face_a, b_is_better, true);
}

}  // namespace detail

template <class S>
void collide_polyhedra(const Polyhedron<S>& a, const Transform<S>& ta, const Polyhedron<S>& b, const Transform<S>& tb,
                       S margin, Manifold<S>& out) {
  detail::collide_polyhedra_over<S, 1, isa::Portable>(a, ta, b, tb, margin, out);
}

template <class S>
void collide_polyhedron_half_space(const Polyhedron<S>& a, const Transform<S>& ta, Vec3<Unit<S>> normal, S offset,
                                   const Transform<S>& tb, S margin, Manifold<S>& out) {
  using namespace detail;
  out.clear();
  const Vec3<Unit<S>> up = tb.rotation * normal, up_in_a = transposed_times(ta.rotation, up);
  const S origin = round_to<S>(dot_sum(ta.position - tb.position, up) - widen<SumOf<S, Unit<S>>>(offset));
  const Lowest<S> lowest = lowest_of(a.vertices, up_in_a);
  if (origin + lowest.height > margin) return;
  const Tangents<Unit<S>> across = tangents_of(up_in_a);
  FacePolygon<S> nearby;  // no polygon, but what is reduced to four alike
  nearby.count = 0;
  visit_flat_faces(a, face_against(a, lowest.vertex, up_in_a), [&](std::uint32_t face) ISO_INLINE_LAMBDA {
    std::uint32_t edge = a.faces[face];
    do {
      const std::uint32_t i = a.origin(edge);
      const Vec3<S> p = a.vertices[i];
      const S height = origin + dot(up_in_a, p);
      if (height <= margin + kPatchReach<S>) add_point({dot(across.t, p), dot(across.u, p), height, i, i}, nearby);
      edge = a.half_edges[edge].next;
    } while (edge != a.faces[face]);
  });
  if (nearby.count > kMaxContactPoints) reduce_to_four(nearby, depth_tie(S(0), face_slack(a.inner_radius)));
  out.normal = -up;
  for (int i = 0; i < nearby.count; ++i) {
    const ClipPoint<S>& p = nearby.points[i];
    out.add(to_world(ta, a.vertices[p.before]) - up * (p.height * S(0.5)), p.height, p.before);
  }
}

}  // namespace isostep
