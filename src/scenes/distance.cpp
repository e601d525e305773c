// Distances of solids: separating axes for cores that meet, closest points for cores that do not.
// SPDX-License-Identifier: MIT
#include "distance.hpp"

#include <limits>

#include "hull_distance.hpp"
#include "isostep/scalar/math.hpp"
#include "round_distance.hpp"
#include "surface_distance.hpp"

namespace isostep::scenes {
namespace {

static_assert(kShapeTypes == 9,
              "an oracle knows each shape by itself: see reach(), core_distance(), signed_distance()");

using V = Vec3<double>;

V column(const Mat3<double>& m, int i) { return m * V{i == 0 ? 1.0 : 0.0, i == 1 ? 1.0 : 0.0, i == 2 ? 1.0 : 0.0}; }
double length(V v) { return sqrt(dot(v, v)); }

/// Half the width of the core along a direction.
double reach(const Solid& s, V direction) {
  const V local = transposed_times(s.axes, direction);
  return abs(local.x) * s.half.x + abs(local.y) * s.half.y + abs(local.z) * s.half.z;
}

/// The widest gap of the cores along any axis that can separate two boxes, segments or points; less than 0: they meet.
/// Axes: the face normals of each, and the cross products of the edges.
double core_gap(const Solid& a, const Solid& b) {
  double widest = -std::numeric_limits<double>::infinity();
  const auto try_axis = [&](V axis) {
    const double size = length(axis);
    if (size < 1e-9) return;  // parallel edges: the faces speak for them
    const V unit = axis * (1 / size);
    widest = max(widest, abs(dot(unit, b.centre - a.centre)) - reach(a, unit) - reach(b, unit));
  };
  for (int i = 0; i < 3; ++i) {
    try_axis(column(a.axes, i));
    try_axis(column(b.axes, i));
    for (int j = 0; j < 3; ++j) try_axis(cross(column(a.axes, i), column(b.axes, j)));
  }
  return widest;
}

double point_to_box(V point, const Solid& box) {
  const V p = transposed_times(box.axes, point - box.centre);
  const V outside = {max(abs(p.x) - box.half.x, 0.0), max(abs(p.y) - box.half.y, 0.0), max(abs(p.z) - box.half.z, 0.0)};
  return length(outside);
}

/// The distance between segments c + t d, t in -1..1.
/// Source: Ericson 2005, Real-Time Collision Detection, 5.1.9, with the parameters centred.
double segment_to_segment(V c1, V d1, V c2, V d2) {
  const V r = c1 - c2;
  const double a = dot(d1, d1), e = dot(d2, d2), b = dot(d1, d2), c = dot(d1, r), f = dot(d2, r);
  const double tiny = 1e-24;
  double s = 0, t = 0;
  if (a > tiny) {
    const double denominator = a * e - b * b;
    if (denominator > 1e-12 * a * e) s = clamp((b * f - c * e) / denominator, -1.0, 1.0);
    t = e > tiny ? clamp((b * s + f) / e, -1.0, 1.0) : 0.0;
    s = clamp((b * t - c) / a, -1.0, 1.0);
    if (e > tiny) t = clamp((b * s + f) / e, -1.0, 1.0);
  } else if (e > tiny) {
    t = clamp(f / e, -1.0, 1.0);
  }
  return length(r + d1 * s - d2 * t);
}

V half_segment(const Solid& s) { return column(s.axes, 1) * s.half.y; }

/// A segment outside a box is nearest to it at an end of its own or at an edge of the box.
double segment_to_box(const Solid& segment, const Solid& box) {
  const V d = half_segment(segment);
  double nearest = min(point_to_box(segment.centre + d, box), point_to_box(segment.centre - d, box));
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (int corner = 0; corner < 4; ++corner) {
      const V side = column(box.axes, u) * ((corner & 1) != 0 ? box.half[u] : -box.half[u]) +
                     column(box.axes, v) * ((corner & 2) != 0 ? box.half[v] : -box.half[v]);
      nearest = min(nearest,
                    segment_to_segment(segment.centre, d, box.centre + side, column(box.axes, axis) * box.half[axis]));
    }
  }
  return nearest;
}

double core_distance(const Solid& a, const Solid& b) {
  const bool a_box = a.type == ShapeType::box, b_box = b.type == ShapeType::box;
  if (!a_box && !b_box) return segment_to_segment(a.centre, half_segment(a), b.centre, half_segment(b));
  const double gap = core_gap(a, b);
  if (gap <= 0 || (a_box && b_box)) return gap;
  return a_box ? segment_to_box(b, a) : segment_to_box(a, b);
}

}  // namespace

double signed_distance(const Solid& a, const Solid& b) {
  if (a.surface != nullptr || b.surface != nullptr) return surface_distance(a, b);
  if (is_revolved(a.type) || is_revolved(b.type)) return round_distance(a, b);
  if (a.type == ShapeType::hull || b.type == ShapeType::hull) return hull_distance(a, b);
  if (a.type == ShapeType::half_space && b.type == ShapeType::half_space)
    return std::numeric_limits<double>::infinity();
  if (a.type == ShapeType::half_space) return signed_distance(b, a);
  if (b.type == ShapeType::half_space) return dot(b.normal, a.centre) - b.offset - reach(a, b.normal) - a.radius;
  return core_distance(a, b) - a.radius - b.radius;
}

}  // namespace isostep::scenes
