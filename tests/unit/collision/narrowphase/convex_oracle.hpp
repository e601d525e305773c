// The separation of two convex shapes by how far they reach, in double, and distances to their surfaces: an oracle that
// knows nothing of features.
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "unit/collision/narrowphase/cases.hpp"
#include "unit/geometry/oracle.hpp"

namespace isostep::test {

/// A stored shape where it lies.
struct Convex {
  Primitive<double> primitive;
  Transform<double> at;

  template <class S>
  Convex(const Primitive<S>& p, const Transform<S>& t) : primitive(oracle::real(p)), at(oracle::real(t)) {}

  Point local(Point p) const {
    const Vec3<double> v = transposed_times(at.rotation, Vec3<double>{p[0], p[1], p[2]});
    return {v.x, v.y, v.z};
  }
  bool is_plane() const { return primitive.type == ShapeType::half_space; }
  Point normal() const { return point_of(at.rotation * primitive.normal); }
  double offset() const { return primitive.offset + dot3(normal(), point_of(at.position)); }
  /// How far it reaches along n.
  double support(Point n) const {
    const Point m = local(n);
    const double centre = dot3(n, point_of(at.position)), across = std::hypot(m[0], m[2]);
    const double h = primitive.half.y, r = primitive.radius;
    if (primitive.type == ShapeType::cylinder) return centre + r * across + h * std::abs(m[1]);
    if (primitive.type == ShapeType::cone) return centre + std::max(r * across - h * m[1], h * m[1]);
    return centre + primitive.half.x * std::abs(m[0]) + h * std::abs(m[1]) + primitive.half.z * std::abs(m[2]) + r;
  }
  /// Negative inside.
  double distance(Point p) const {
    const Point q = local(p - point_of(at.position));
    return oracle::signed_distance(primitive, {q[0], q[1], q[2]});
  }
};

/// The largest of the separations along axes, by climbing from the best of many.
class ConvexOracle {
 public:
  static double separation(const Convex& a, const Convex& b) {
    if (a.is_plane()) return separation(b, a);
    if (b.is_plane()) return -a.support(b.normal() * -1) - b.offset();
    std::vector<std::pair<double, Point>> starts;
    for (const Point n : directions()) starts.push_back({along(a, b, n), n});
    std::partial_sort(starts.begin(), starts.begin() + kClimbs, starts.end(),
                      [](const auto& p, const auto& q) { return p.first > q.first; });
    double best = -1e300;
    for (int i = 0; i < kClimbs; ++i) best = std::max(best, climb(a, b, starts[static_cast<std::size_t>(i)].second));
    return best;
  }
  static double along(const Convex& a, const Convex& b, Point n) { return -a.support(n) - b.support(n * -1); }

 private:
  static constexpr int kClimbs = 8, kDirections = 800;

  static const std::vector<Point>& directions() {
    static const std::vector<Point> kAll = [] {
      std::vector<Point> all;
      for (int i = 0; i < kDirections; ++i) {
        const double y = 1 - 2 * (i + 0.5) / kDirections, r = std::sqrt(1 - y * y), turn = i * 2.399963229728653;
        all.push_back({r * std::cos(turn), y, r * std::sin(turn)});
      }
      return all;
    }();
    return kAll;
  }
  static double climb(const Convex& a, const Convex& b, Point n) {
    double best = along(a, b, n);
    int rounds = 0;
    for (double step = 0.06; step > 1e-8 && rounds < 150; ++rounds) {
      Point u = cross3(n, std::abs(n[0]) < 0.6 ? Point{1, 0, 0} : Point{0, 1, 0});
      u = u * (1 / length3(u));
      const Point v = cross3(n, u);
      bool better = false;
      for (int k = 0; k < 12; ++k) {
        const double turn = std::acos(-1.0) * (k + 0.5 * (rounds % 2)) / 6;
        Point next = n + u * (step * std::cos(turn)) + v * (step * std::sin(turn));
        next = next * (1 / length3(next));
        const double gap = along(a, b, next);
        if (gap > best) best = gap, n = next, better = true;
      }
      step *= better ? 1.2 : 0.5;
    }
    return best;
  }
};

}  // namespace isostep::test
