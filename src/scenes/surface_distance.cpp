// Points against triangles, and triangles' corners against solids.
// SPDX-License-Identifier: MIT
#include "surface_distance.hpp"

#include <limits>

#include "isostep/scalar/math.hpp"
#include "nearest_point.hpp"
#include "round_distance.hpp"

namespace isostep::scenes {
namespace {

using V = Vec3<double>;
constexpr double kFar = std::numeric_limits<double>::infinity();

/// The height of a point over the triangles: negative under the surface. Near an edge the sign is that of the triangle
/// whose plane the point is furthest from.
double height_over(V p, const SolidSurface& surface, const std::vector<std::size_t>& near) {
  double least = kFar, off_plane = 0, sign = 1;
  for (const std::size_t i : near) {
    const auto& t = surface.triangles[i];
    const V normal = cross(t[1] - t[0], t[2] - t[0]);
    const double distance = length(p - nearest_on_triangle(p, t));
    const double height = dot(normal, p - t[0]) / length(normal);
    const bool nearer = distance < least - 1e-9, equal = distance <= least + 1e-9;
    if (!nearer && !(equal && abs(height) > off_plane)) continue;
    least = min(least, distance);
    off_plane = abs(height);
    sign = height < 0 ? -1 : 1;
  }
  return sign * least;
}

/// The depth of a point inside of a solid that is no ball or capsule, in its own frame.
double depth_inside(V p, const Solid& body) {
  if (is_revolved(body.type)) return depth_in_round(body, p);
  double depth = kFar;
  if (body.type == ShapeType::hull) {
    for (std::size_t f = 0; f < body.hull->normals.size(); ++f) {
      double reach = -kFar;
      for (const V v : body.hull->vertices) reach = max(reach, dot(body.hull->normals[f], v));
      depth = min(depth, reach - dot(body.hull->normals[f], p));
    }
    if (depth >= 0 || !(body.radius > 0)) return depth + body.radius;
    double outside = kFar;
    for (const auto& t : body.hull->triangles) outside = min(outside, length(p - nearest_on_triangle(p, t)));
    return body.radius - outside;
  }
  for (int axis = 0; axis < 3; ++axis) depth = min(depth, body.half[axis] - abs(p[axis]));
  return depth;
}

double thick_distance(const Solid& body, const Solid& ground, const std::vector<std::size_t>& near) {
  constexpr int kSamples = 32;  // of a capsule's core, ends included: planes are nearest to those
  const V middle = transposed_times(ground.axes, body.centre - ground.centre);
  const V half = transposed_times(ground.axes, body.axes * body.half);
  double least = kFar;
  for (int i = 0; i <= kSamples; ++i)
    least = min(least, height_over(middle + half * (2.0 * i / kSamples - 1), *ground.surface, near));
  return least - body.radius;
}

}  // namespace

double surface_distance(const Solid& a, const Solid& b) {
  if (a.surface != nullptr && b.surface == nullptr) return surface_distance(b, a);
  if (a.surface != nullptr || a.type == ShapeType::half_space) return kFar;
  const auto in_ground = [&](V world) { return transposed_times(b.axes, world - b.centre); };
  const std::vector<V> corners = core_points(a);
  double reach = a.radius;
  for (const V corner : corners) reach = max(reach, length(corner) + a.radius);
  const std::vector<std::size_t> near = b.surface->near(in_ground(a.centre), reach + 1);
  if (near.empty()) return kFar;
  if (a.type == ShapeType::sphere || a.type == ShapeType::capsule) return thick_distance(a, b, near);
  double least = kFar;
  const double skin = a.type == ShapeType::hull ? a.radius : 0;
  for (const V corner : corners)
    least = min(least, height_over(in_ground(a.centre + a.axes * corner), *b.surface, near) - skin);
  for (const std::size_t i : near) {
    for (const V point : b.surface->triangles[i]) {
      const double depth = depth_inside(transposed_times(a.axes, b.centre + b.axes * point - a.centre), a);
      if (depth > 0) least = min(least, -depth);
    }
  }
  return least;
}

}  // namespace isostep::scenes
