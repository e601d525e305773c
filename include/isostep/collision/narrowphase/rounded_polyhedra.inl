// Bodies of rounded_polyhedra.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/narrowphase/polyhedron_triangle.hpp"
#include "isostep/collision/narrowphase/rounded.inl"
#include "isostep/collision/narrowphase/rounded_polyhedra.hpp"
#include "isostep/geometry/baked/polyhedron_surface.hpp"

namespace isostep {
namespace detail {

/// The edge with which a solid reaches furthest along a direction, both ends within `slack` [m] of its reach. The first
/// of equals.
template <class S> struct OuterEdge {
  std::uint32_t edge;
  bool found;
};
template <class S> ISO_INLINE OuterEdge<S> outer_edge(const Polyhedron<S>& solid, Vec3<Unit<S>> out, S slack) {
  S heights[ConvexHull::kMaxVertices], most = -highest<S>();
  for (std::uint32_t i = 0; i < solid.vertices.size(); ++i) {
    heights[i] = dot(out, solid.vertices[i]);
    most = max(most, heights[i]);
  }
  OuterEdge<S> best = {0, false};
  S furthest = most - slack;
  for (std::uint32_t k = 0; k < solid.edges(); ++k) {
    const S end = min(heights[solid.origin(2 * k)], heights[solid.origin(2 * k + 1)]);
    if (best.found ? end > furthest : end >= furthest) best = {k, true}, furthest = end;
  }
  return best;
}

/// Adds both ends of the stretch along which two edges lie beside each other, facing across the gap, if there are such.
template <class S>
ISO_INLINE bool touch_edges_beside(const RoundedPolyhedron<S>& a, const Transform<S>& ta, const RoundedPolyhedron<S>& b,
                                   const Transform<S>& tb, const CoreGap<S>& gap, S slack, S margin, Manifold<S>& out) {
  constexpr double kBeside = 0.0625;  // sine of the angle, 3.6 degrees
  const Transform<S> b_in_a = relative(ta, tb);
  const OuterEdge<S> of_a = outer_edge(a.core, gap.normal, slack);
  if (!of_a.found) return false;
  const OuterEdge<S> of_b = outer_edge(b.core, transposed_times(b_in_a.rotation, -gap.normal), slack);
  if (!of_b.found) return false;
  const Segment<S> edge = edge_of(a.core, of_a.edge), other = seen_by(b_in_a, edge_of(b.core, of_b.edge));
  const Vec3<Unit<S>> across = cross(edge.direction, other.direction);
  if (dot(across, across) > Unit<S>(kBeside * kBeside)) return false;
  const S middle = dot(other.centre - edge.centre, edge.direction);
  const S reach = other.half * abs(dot(edge.direction, other.direction));
  const S low = max(-edge.half, middle - reach), high = min(edge.half, middle + reach);
  if (!(low < high)) return false;
  out.normal = ta.rotation * gap.normal;
  for (std::uint32_t end = 0; end < 2; ++end) {
    const Vec3<S> p = edge.at(end == 0 ? low : high), q = other.at(other.nearest(p));
    out.add(to_world(ta, (p + q) * S(0.5)), dot(gap.normal, q - p), 1u << 28 | of_a.edge << 8 | of_b.edge << 1 | end);
  }
  grow_cores(out, a.radius, b.radius, margin);
  return out.count > 0;
}

/// Returns true if a face of the solid comes as near to the gap's direction as is_told_by() asks.
template <class S> ISO_INLINE bool has_face_across(const Polyhedron<S>& solid, Vec3<S> gap, S distance, S tolerance) {
  for (std::uint32_t f = 0; f < solid.faces.size(); ++f) {
    if (dot(solid.normals[f], gap) >= distance - tolerance) return true;
  }
  return false;
}

/// Finds the gap of two polyhedra, each as a core with its vertices in a row.
template <class S>
ISO_INLINE CoreGap<S> gap_between(const Polyhedron<S>& a, const Transform<S>& ta, const Polyhedron<S>& b,
                                  const Transform<S>& tb) {
  const PolyhedronCore<S> core_a(a), core_b(b);
  return gap_between(core_a.core(), ta, core_b.core(), tb);
}

/// Returns true if a triangle is further than `reach` above a face of a solid.
template <class S>
ISO_INLINE bool is_beyond_face(const Polyhedron<S>& solid, const SurfaceTriangle<S>& triangle, S reach) {
  for (std::uint32_t f = 0; f < solid.faces.size(); ++f) {
    const Vec3<Unit<S>> up = solid.normals[f];
    const S low = min(dot(up, triangle.points[0]), min(dot(up, triangle.points[1]), dot(up, triangle.points[2])));
    if (low - solid.offsets[f] > reach) return true;
  }
  return false;
}

/// Returns true if the contact of an edge or a point across a gap is the triangle's own, and not a neighbour's.
template <class S> ISO_INLINE bool is_owned(const SurfaceTriangle<S>& triangle, const CoreGap<S>& gap) {
  const Vec3<Unit<S>> direction = -gap.normal;
  if (gap.corners == 1) return triangle.owns_at_point(static_cast<int>(gap.corner[0]), direction);
  const std::uint32_t other = 3 - gap.corner[0] - gap.corner[1];  // of the points
  return triangle.owns_at_edge(static_cast<int>((other + 1) % 3), direction);
}

}  // namespace detail

template <class S>
void collide_rounded_polyhedra(const RoundedPolyhedron<S>& a, const Transform<S>& ta, const RoundedPolyhedron<S>& b,
                               const Transform<S>& tb, S margin, Manifold<S>& out, CollidePolyhedra<S> polyhedra) {
  using namespace detail;
  out.clear();
  const S radii = a.radius + b.radius;
  const CoreGap<S> gap = gap_between(a.core, ta, b.core, tb);
  if (gap.distance - radii > margin) return;
  const S tolerance = axis_tolerance(a.core.inner_radius, b.core.inner_radius, tb.position - ta.position);
  const Vec3<S> gap_in_b = transposed_times(tb.rotation, ta.rotation * -gap.across());
  // The separating axes are most of a pair's cost: they are asked only where they may decide.
  if (!gap.is_apart || has_face_across(a.core, gap.across(), gap.distance, tolerance) ||
      has_face_across(b.core, gap_in_b, gap.distance, tolerance)) {
    polyhedra(a.core, ta, b.core, tb, margin + radii, out);
    const bool of_faces = out.count > 0 && out.points[0].feature >> 31 != 0;
    const bool told = of_faces && gap.is_told_by(out, transposed_times(ta.rotation, out.normal), tolerance);
    if (told || !gap.is_apart) return grow_cores(out, a.radius, b.radius, margin);
    out.clear();
  }
  if (!touch_edges_beside(a, ta, b, tb, gap, tolerance * S(0.25), margin, out)) gap.touch(ta, a.radius, b.radius, out);
}

template <class S>
void collide_rounded_triangle(const RoundedPolyhedron<S>& a, const Transform<S>& ta, const SurfaceFrame<S>& frame,
                              const BakedTriangle& baked, S margin, Manifold<S>& out) {
  using namespace detail;
  out.clear();
  SurfaceTriangle<S> triangle(frame, baked);
  if (triangle.height < S(0)) return;
  const S reach = margin + a.radius;
  const Lowest<S> lowest = lowest_of(a.core.vertices, triangle.normal);
  const S height = lowest.height - triangle.offset;
  if (height > reach || is_beyond_face(a.core, triangle, reach)) return;
  triangle.find_edges(frame, baked);
  const Vec3<S> nearest = a.core.vertices[lowest.vertex];
  bool over = height > S(0);  // the triangle's inside: then nothing is nearer, and that is its plane's contact
  for (int k = 0; k < 3; ++k) over = over && triangle.inside_of(k, nearest) > S(0);
  if (over) {
    collide_polyhedron_triangle(a.core, ta, frame, baked, reach, out);
    return grow_cores(out, a.radius, S(0), margin);
  }
  const Transform<S> here = {Vec3<S>::zero(), Mat3<Unit<S>>::identity()};
  const PolyhedronCore<S> core(a.core);
  const CoreGap<S> gap = gap_between(core.core(), here, {triangle.points, S(0)}, here);
  if (gap.distance - a.radius > margin) return;
  collide_polyhedron_triangle(a.core, ta, frame, baked, reach, out);
  const S inner = a.core.inner_radius, tolerance = axis_tolerance(inner, max_abs(frame.centre) + inner);
  const Vec3<Unit<S>> normal = transposed_times(ta.rotation, out.normal);
  if (!gap.is_apart || gap.corners == 3 || gap.is_told_by(out, normal, tolerance))
    return grow_cores(out, a.radius, S(0), margin);
  const bool owned = is_owned(triangle, gap);
  // An edge of the solid over an edge of the surface that no core may touch can be nearer than its corners over the
  // triangle.
  constexpr double kUpright = 0x1p-8;  // [1]
  if (!owned && max_abs(normal + triangle.normal) <= Unit<S>(kUpright)) return grow_cores(out, a.radius, S(0), margin);
  out.clear();
  if (owned) gap.touch(ta, a.radius, S(0), out);
}

}  // namespace isostep
