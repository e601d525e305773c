// The common part of the narrow-phase tests: shapes and poses from doubles, random ones, and the independent answers in
// double.
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "isostep/collision/narrowphase/collide.hpp"
#include "random/splitmix64.hpp"

namespace isostep::test {

using Point = std::array<double, 3>;
inline Point operator+(Point a, Point b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
inline Point operator-(Point a, Point b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline Point operator*(Point a, double s) { return {a[0] * s, a[1] * s, a[2] * s}; }
inline double dot3(Point a, Point b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Point cross3(Point a, Point b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline double length3(Point a) { return std::sqrt(dot3(a, a)); }

template <class T> Point point_of(Vec3<T> v) { return {to_double(v.x), to_double(v.y), to_double(v.z)}; }
template <class T> Vec3<T> vec_of(Point p) {
  return {from_double<T>(p[0]), from_double<T>(p[1]), from_double<T>(p[2])};
}

/// Rounding of a length near `size` [m], some tens of operations deep.
template <class S> double rounding(double size) {
  if constexpr (!kIsFixed<S>) return 32 * static_cast<double>(resolution<S>()) * size;
  else return 8 * to_double(resolution<S>()) + 32 * to_double(resolution<Unit<S>>()) * size;
}

template <class S> Primitive<S> sphere_of(double radius) { return primitive_of(Sphere<S>{from_double<S>(radius)}); }
template <class S> Primitive<S> box_of(double x, double y, double z) {
  return primitive_of(Box<S>{vec_of<S>({x, y, z})});
}
template <class S> Primitive<S> capsule_of(double radius, double half_height) {
  return primitive_of(Capsule<S>{from_double<S>(radius), from_double<S>(half_height)});
}
template <class S> Primitive<S> half_space_of(Point normal, double offset) {
  const double l = length3(normal);
  return primitive_of(HalfSpace<S>{vec_of<Unit<S>>(normal * (1 / l)), from_double<S>(offset)});
}
/// The scalar of the same format that wraps: a half turn's matrix relies on it, 1 - 2 being in range where 2 is not.
template <class S> struct Wrapping { using Type = S; };
template <class Rep, int F> struct Wrapping<Fixed<Rep, F, Overflow::trap>> { using Type = Fixed<Rep, F>; };

/// The transform at p, turned by `angle` about `axis`.
template <class S> Transform<S> at(Point p, Point axis = {0, 1, 0}, double angle = 0) {
  using U = Unit<typename Wrapping<S>::Type>;
  const double s = isostep::sin(angle / 2) / length3(axis);
  const Quat<U> q = {from_double<U>(axis[0] * s), from_double<U>(axis[1] * s), from_double<U>(axis[2] * s),
                     from_double<U>(isostep::cos(angle / 2))};
  const Mat3<U> turn = to_matrix(normalise(q));
  Transform<S> t;
  t.position = vec_of<S>(p);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) t.rotation.rows[i][j] = from_bits<Unit<S>>(to_bits(turn.rows[i][j]));
  }
  return t;
}
template <class S>
Manifold<S> touch(const Primitive<S>& a, const Transform<S>& ta, const Primitive<S>& b, const Transform<S>& tb,
                  double margin = 0.02) {
  Manifold<S> m;
  collide(a, ta, b, tb, from_double<S>(margin), m);
  return m;
}
template <class S> double deepest(const Manifold<S>& m) {
  double least = 1e300;
  for (int i = 0; i < m.count; ++i) least = std::min(least, to_double(m.points[i].separation));
  return least;
}

/// SplitMix64 (Steele, Lea, Flood 2014): the same cases on every machine. Angles and powers are of isostep's own
/// functions: those of <cmath> differ between processors.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  std::uint64_t bits() { return splitmix64(state_); }
  double in(double low, double high) { return low + (high - low) * static_cast<double>(bits() >> 11) * 0x1p-53; }
  /// 10^low to 10^high, spread evenly over orders of magnitude.
  double power_of_ten(double low, double high) { return isostep::exp(in(low, high) * 2.302585092994046); }
  int below(int n) { return static_cast<int>(bits() % static_cast<std::uint64_t>(n)); }
  Point point(double size) {
    const double x = in(-size, size), y = in(-size, size);
    return {x, y, in(-size, size)};
  }
  Point direction() {
    for (;;) {
      const Point p = point(1);
      const double l = length3(p);
      if (l > 0.1 && l < 1) return p * (1 / l);
    }
  }

 private:
  std::uint64_t state_;
};
/// [1] Evenly over the sphere, by the golden angle.
inline std::vector<Point> directions(int count) {
  std::vector<Point> all;
  for (int i = 0; i < count; ++i) {
    const double y = 1 - 2 * (i + 0.5) / count, r = std::sqrt(1 - y * y), turn = i * 2.399963229728653;
    all.push_back({r * isostep::cos(turn), y, r * isostep::sin(turn)});
  }
  return all;
}

template <class S> Transform<S> random_pose(Random& random, double size) {
  const Point p = random.point(size), axis = random.direction();
  return at<S>(p, axis, random.in(-3, 3));
}

/// A primitive where its rounded numbers put it, in double: a core box with axes and a radius, or a plane.
struct Solid {
  ShapeType type;
  Point centre, half;
  std::array<Point, 3> axes;
  double radius;
  Point normal;
  double offset;

  Point local(Point p) const {
    const Point d = p - centre;
    return {dot3(d, axes[0]), dot3(d, axes[1]), dot3(d, axes[2])};
  }
  /// The distance of p from the core; 0 inside.
  double core_distance(Point p) const {
    const Point q = local(p);
    Point e{};
    for (std::size_t k = 0; k < 3; ++k) e[k] = std::max(std::abs(q[k]) - half[k], 0.0);
    return length3(e);
  }
  /// The distance of p from the solid; 0 inside.
  double outside(Point p) const {
    if (type == ShapeType::half_space) return std::max(dot3(normal, p) - offset, 0.0);
    return std::max(core_distance(p) - radius, 0.0);
  }
  Point corner(int i) const {
    Point p = centre;
    for (std::size_t k = 0; k < 3; ++k) p = p + axes[k] * ((i >> k & 1) ? half[k] : -half[k]);
    return p;
  }
  /// A core of one dimension, at `along` [m] from its centre.
  Point on_axis(double along) const { return centre + axes[1] * along; }
};
template <class S> Solid solid(const Primitive<S>& p, const Transform<S>& t) {
  Solid s;
  s.type = p.type;
  s.centre = point_of(t.position);
  s.half = point_of(p.half);
  for (int k = 0; k < 3; ++k) s.axes[static_cast<std::size_t>(k)] = point_of(t.rotation.column(k));
  s.radius = to_double(p.radius);
  const Point n = point_of(p.normal);
  s.normal = s.axes[0] * n[0] + s.axes[1] * n[1] + s.axes[2] * n[2];
  s.offset = to_double(p.offset) + dot3(s.normal, s.centre);
  return s;
}

/// The largest separation of two core boxes along separating axes, all fifteen normalised and none preferred.
inline double sat(const Solid& a, const Solid& b, double least_sine = 1e-4) {
  double best = -1e300;
  const Point gap = b.centre - a.centre;
  const auto examine = [&](Point n) {
    const double l = length3(n);
    if (l < least_sine) return;
    n = n * (1 / l);
    double s = std::abs(dot3(gap, n));
    for (std::size_t k = 0; k < 3; ++k)
      s -= a.half[k] * std::abs(dot3(a.axes[k], n)) + b.half[k] * std::abs(dot3(b.axes[k], n));
    best = std::max(best, s);
  };
  for (std::size_t i = 0; i < 3; ++i) {
    examine(a.axes[i]);
    examine(b.axes[i]);
    for (std::size_t j = 0; j < 3; ++j) examine(cross3(a.axes[i], b.axes[j]));
  }
  return best;
}

/// The least value of a convex function on [low, high], by golden sections to 1e-9 of the interval.
template <class F> double least(F f, double low, double high) {
  const double g = 0.6180339887498949;
  double x = high - g * (high - low), y = low + g * (high - low), fx = f(x), fy = f(y);
  for (int i = 0; i < 45; ++i) {
    if (fx < fy) {
      high = y, y = x, fy = fx, x = high - g * (high - low), fx = f(x);
    } else {
      low = x, x = y, fx = fy, y = low + g * (high - low), fy = f(y);
    }
  }
  return std::min({fx, fy, f(low), f(high)});
}

/// The separation of any two primitives but a pair of half-spaces: distance of the cores by minimisation, or the depth
/// by separating axes where the cores overlap, less the radii.
inline double true_separation(const Solid& a, const Solid& b) {
  if (a.type > b.type) return true_separation(b, a);
  const double radii = a.radius + b.radius;
  if (b.type == ShapeType::half_space) {
    double s = 1e300;
    for (int i = 0; i < 8; ++i) s = std::min(s, dot3(b.normal, a.corner(i)) - b.offset);
    return s - a.radius;
  }
  if (a.type == ShapeType::box && b.type == ShapeType::box) return sat(a, b) - radii;
  const Solid& line = b.type == ShapeType::capsule ? b : a;  // the core that is a segment or a point
  const Solid& other = b.type == ShapeType::capsule ? a : b;
  const double distance =
      least([&](double s) { return other.core_distance(line.on_axis(s)); }, -line.half[1], line.half[1]);
  if (distance > 1e-7 || other.type != ShapeType::box) return distance - radii;
  return std::min(sat(other, line, 1e-6), 0.0) - radii;
}

}  // namespace isostep::test
