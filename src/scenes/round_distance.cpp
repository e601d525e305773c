// The widest gap of two convex solids along an axis, from how far they reach: nothing is known of what touches.
// SPDX-License-Identifier: MIT
#include "round_distance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace isostep::scenes {
namespace {

using V = Vec3<double>;

V unit(V v) { return v * (1 / std::sqrt(dot(v, v))); }

/// Spread evenly over the sphere, by the golden angle.
const std::vector<V>& directions() {
  static const std::vector<V> kDirections = [] {
    constexpr int kCount = 1024;
    std::vector<V> all;
    for (int i = 0; i < kCount; ++i) {
      const double y = 1 - 2 * (i + 0.5) / kCount, r = std::sqrt(1 - y * y), turn = i * 2.399963229728653;
      all.push_back({r * std::cos(turn), y, r * std::sin(turn)});
    }
    return all;
  }();
  return kDirections;
}

double gap_along(const Solid& a, const Solid& b, V n) { return -support(a, n) - support(b, -n); }

/// Steps around n that shrink where none is better.
double climb(const Solid& a, const Solid& b, V n) {
  double best = gap_along(a, b, n);
  int rounds = 0;
  for (double step = 0.06; step > 1e-9 && rounds < 400; ++rounds) {
    const V u = unit(cross(n, std::abs(n.x) < 0.6 ? V{1, 0, 0} : V{0, 1, 0})), v = cross(n, u);
    bool better = false;
    for (int k = 0; k < 12; ++k) {
      const double turn = std::numbers::pi * (k + 0.5 * (rounds % 2)) / 6;
      const V next = unit(n + u * (step * std::cos(turn)) + v * (step * std::sin(turn)));
      const double gap = gap_along(a, b, next);
      if (!(gap > best)) continue;
      best = gap, n = next, better = true;
    }
    step *= better ? 1.2 : 0.5;
  }
  return best;
}

}  // namespace

double support(const Solid& solid, V direction) {
  const V n = transposed_times(solid.axes, direction);
  const double centre = dot(direction, solid.centre), across = std::hypot(n.x, n.z);
  const double h = solid.half.y, r = solid.radius;
  if (solid.type == ShapeType::cylinder) return centre + h * std::abs(n.y) + r * across;
  if (solid.type == ShapeType::cone) return centre + std::max(r * across - h * n.y, h * n.y);
  if (solid.type != ShapeType::hull)
    return centre + std::abs(n.x) * solid.half.x + std::abs(n.y) * h + std::abs(n.z) * solid.half.z + r;
  double most = -std::numeric_limits<double>::infinity();
  for (const V v : solid.hull->vertices) most = std::max(most, dot(n, v));
  return centre + most + r;
}

double round_distance(const Solid& a, const Solid& b) {
  if (a.type == ShapeType::half_space) return round_distance(b, a);
  if (b.type == ShapeType::half_space) return -support(a, -b.normal) - b.offset;
  std::vector<std::pair<double, V>> starts;
  for (const V n : directions()) starts.push_back({gap_along(a, b, n), n});
  for (const Solid* s : {&a, &b}) {
    const V axis = s->axes * V{0, 1, 0};
    for (const V n : {axis, -axis}) starts.push_back({gap_along(a, b, n), n});
  }
  constexpr std::size_t kClimbs = 12;
  std::partial_sort(starts.begin(), starts.begin() + kClimbs, starts.end(),
                    [](const auto& p, const auto& q) { return p.first > q.first; });
  double best = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < kClimbs; ++i) best = std::max(best, climb(a, b, starts[i].second));
  return best;
}

double depth_in_round(const Solid& solid, V p) {
  const double h = solid.half.y, r = solid.radius, across = std::hypot(p.x, p.z);
  if (solid.type == ShapeType::cylinder) return std::min(r - across, h - std::abs(p.y));
  const double slant = std::hypot(2 * h, r);
  return std::min(p.y + h, (r * (h - p.y) - 2 * h * across) / slant);
}

}  // namespace isostep::scenes
