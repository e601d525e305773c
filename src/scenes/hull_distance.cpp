// Distances of hulls: separating axes for cores that meet a hull, closest points of its triangles for round ones that
// do not.
// SPDX-License-Identifier: MIT
#include "hull_distance.hpp"

#include <limits>

#include "isostep/scalar/math.hpp"
#include "nearest_point.hpp"
#include "round_distance.hpp"

namespace isostep::scenes {
namespace {

using V = Vec3<double>;

/// A core in the world: a point, a segment, a box or a hull.
struct Core {
  std::vector<V> points;
  std::vector<V> normals;  // axes that its faces give
  std::vector<V> edges;    // and directions of its edges
};
Core core_of(const Solid& s) {
  Core core;
  for (const V p : core_points(s)) core.points.push_back(s.centre + s.axes * p);
  if (s.type == ShapeType::hull) {
    for (const V n : s.hull->normals) core.normals.push_back(s.axes * n);
    for (const auto& e : s.hull->edges) core.edges.push_back(s.axes * (e[1] - e[0]));
    return core;
  }
  for (int axis = 0; axis < 3; ++axis) {
    V unit = {0, 0, 0};
    unit[axis] = 1;
    if (s.half[axis] > 0) core.edges.push_back(s.axes * unit);
    if (s.type == ShapeType::box) core.normals.push_back(s.axes * unit);
  }
  return core;
}

struct Interval {
  double low, high;
};
Interval along(const Core& core, V axis) {
  Interval interval = {std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const V p : core.points) {
    interval.low = min(interval.low, dot(axis, p));
    interval.high = max(interval.high, dot(axis, p));
  }
  return interval;
}

double widest_gap(const Core& a, const Core& b) {
  double widest = -std::numeric_limits<double>::infinity();
  const auto try_axis = [&](V axis) {
    const double size = sqrt(dot(axis, axis));
    if (size < 1e-12) return;  // parallel edges: the faces speak for them
    const Interval of_a = along(a, axis * (1 / size)), of_b = along(b, axis * (1 / size));
    widest = max(widest, max(of_b.low - of_a.high, of_a.low - of_b.high));
  };
  for (const V n : a.normals) try_axis(n);
  for (const V n : b.normals) try_axis(n);
  for (const V e : a.edges) {
    for (const V f : b.edges) try_axis(cross(e, f));
  }
  return widest;
}

/// A round core, the two ends of a segment, that is outside of a hull: by halving, since a convex set's distance along
/// a segment is convex.
double outside_distance(V from, V to, const SolidHull& hull) {
  const auto distance = [&](double s) {
    const V p = from + (to - from) * s;
    double nearest = std::numeric_limits<double>::infinity();
    for (const auto& t : hull.triangles) nearest = min(nearest, length(p - nearest_on_triangle(p, t)));
    return nearest;
  };
  double low = 0, high = 1;
  for (int i = 0; i < 64; ++i) {
    const double a = low + (high - low) / 3, b = high - (high - low) / 3;
    (distance(a) < distance(b) ? high : low) = distance(a) < distance(b) ? b : a;
  }
  return distance((low + high) / 2);
}

}  // namespace

double hull_distance(const Solid& a, const Solid& b) {
  if (!(a.type == ShapeType::hull)) return hull_distance(b, a);
  const Core core = core_of(a);
  if (b.type == ShapeType::half_space) return along(core, b.normal).low - b.offset - a.radius;
  const double gap = widest_gap(core, core_of(b)), radii = a.radius + b.radius;
  if (gap <= 0) return gap - radii;
  if (b.type == ShapeType::box || b.type == ShapeType::hull) return radii > 0 ? round_distance(a, b) : gap;
  const V middle = transposed_times(a.axes, b.centre - a.centre);
  const V half = transposed_times(a.axes, b.axes * b.half);
  return outside_distance(middle - half, middle + half, *a.hull) - radii;
}

}  // namespace isostep::scenes
