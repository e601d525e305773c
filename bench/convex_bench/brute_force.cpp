// Every axis, and every vertex with every triangle and edge with edge.
// SPDX-License-Identifier: MIT
#include "brute_force.hpp"

#include <algorithm>
#include <limits>

#include "scenes/nearest_point.hpp"

namespace isostep::bench {
namespace {

using V = Vec3<double>;
using Segment = std::array<V, 2>;

constexpr double kNone = std::numeric_limits<double>::infinity();

double widest_gap(const PlacedHull& a, const PlacedHull& b) {
  double widest = -kNone;
  for (const V n : a.normals) widest = std::max(widest, gap_along(a, b, n));
  for (const V n : b.normals) widest = std::max(widest, gap_along(a, b, -n));
  for (const Segment& e : a.edges) {
    for (const Segment& f : b.edges) {
      const V d = e[1] - e[0], g = f[1] - f[0], axis = cross(d, g);
      if (dot(axis, axis) < 1e-12 * dot(d, d) * dot(g, g)) continue;  // parallel: the faces speak for them
      widest = std::max({widest, gap_along(a, b, axis), gap_along(a, b, -axis)});
    }
  }
  return widest;
}

/// The distance where the lines come nearest, if that is inside of both; the ends are with the triangles.
double distance_of_edges(const Segment& e, const Segment& f) {
  const V d = e[1] - e[0], g = f[1] - f[0], between = e[0] - f[0];
  const double dd = dot(d, d), gg = dot(g, g), dg = dot(d, g), det = dd * gg - dg * dg;
  if (det < 1e-12 * dd * gg) return kNone;
  const double s = (dg * dot(g, between) - gg * dot(d, between)) / det;
  const double t = (dd * dot(g, between) - dg * dot(d, between)) / det;
  if (s < 0 || s > 1 || t < 0 || t > 1) return kNone;
  return length(between + d * s - g * t);
}

double distance_of_vertices(const PlacedHull& a, const PlacedHull& b) {
  double least = kNone;
  for (const V v : a.vertices) {
    for (const auto& t : b.triangles) least = std::min(least, length(v - scenes::nearest_on_triangle(v, t)));
  }
  return least;
}

}  // namespace

PlacedHull placed_hull(const BenchHull& hull, const Transform<double>& at) {
  PlacedHull placed;
  for (const V v : hull.solid->vertices) placed.vertices.push_back(to_world(at, v));
  for (const V n : hull.solid->normals) placed.normals.push_back(at.rotation * n);
  for (const Segment& e : hull.solid->edges) placed.edges.push_back({to_world(at, e[0]), to_world(at, e[1])});
  for (const auto& t : hull.solid->triangles) {
    placed.triangles.push_back({to_world(at, t[0]), to_world(at, t[1]), to_world(at, t[2])});
  }
  return placed;
}

double gap_along(const PlacedHull& a, const PlacedHull& b, V direction) {
  double high = -kNone, low = kNone;
  for (const V v : a.vertices) high = std::max(high, dot(direction, v));
  for (const V v : b.vertices) low = std::min(low, dot(direction, v));
  return (low - high) / length(direction);
}

Exact brute_force(const PlacedHull& a, const PlacedHull& b) {
  const double gap = widest_gap(a, b);
  if (gap <= 0) return {gap, 0};
  double distance = std::min(distance_of_vertices(a, b), distance_of_vertices(b, a));
  for (const Segment& e : a.edges) {
    for (const Segment& f : b.edges) distance = std::min(distance, distance_of_edges(e, f));
  }
  return {gap, distance};
}

}  // namespace isostep::bench
