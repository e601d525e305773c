// Oracles in double for the geometry and query tests: random shapes, distance fields and quadrature clouds.
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "isostep/geometry/shape.hpp"

namespace isostep::oracle {

using D3 = Vec3<double>;

inline double length(D3 v) { return std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z); }
inline D3 unit(D3 v) { return v * (1 / length(v)); }

template <class S> D3 real(Vec3<S> v) { return {to_double(v.x), to_double(v.y), to_double(v.z)}; }
template <class S> Vec3<S> made(D3 v) { return {from_double<S>(v.x), from_double<S>(v.y), from_double<S>(v.z)}; }
template <class S> Primitive<double> real(const Primitive<S>& p) {
  return {p.type, 0, real(p.half), to_double(p.radius), real(p.normal), to_double(p.offset)};
}
template <class S> Transform<double> real(const Transform<S>& t) {
  return {real(t.position), {{real(t.rotation.rows[0]), real(t.rotation.rows[1]), real(t.rotation.rows[2])}}};
}

/// Numbers from raw generator words: the standard's distributions differ between libraries.
class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double in(double low, double high) { return low + (high - low) * (static_cast<double>(engine_()) / 4294967296.0); }
  /// Spread evenly over orders of magnitude.
  double size(double low, double high) { return low * isostep::exp(in(0, isostep::log(high / low))); }
  D3 point(double reach) {
    const double x = in(-reach, reach), y = in(-reach, reach);
    return {x, y, in(-reach, reach)};
  }
  D3 direction() {
    for (;;) {
      const D3 v = point(1);
      if (length(v) > 0.1 && length(v) < 1) return unit(v);
    }
  }
  /// Any way, low to high long. The length is drawn first: as an operator's two sides, compilers would disagree.
  D3 arrow(double low, double high) { return arrow_of(in(low, high)); }
  D3 arrow_of(double length) { return direction() * length; }
  template <class S> Quat<Unit<S>> orientation() {
    const D3 axis = direction();
    const double half = in(-3, 3);
    using U = Unit<S>;
    return normalise(Quat<U>{from_double<U>(axis.x * isostep::sin(half)), from_double<U>(axis.y * isostep::sin(half)),
                             from_double<U>(axis.z * isostep::sin(half)), from_double<U>(isostep::cos(half))});
  }
  /// kind 0 sphere, 1 box, 2 capsule, 3 cylinder, 4 cone.
  template <class S> Primitive<S> primitive(int kind, double low, double high) {
    const double a = size(low, high), b = size(low, high), c = size(low, high);
    if (kind == 0) return primitive_of(Sphere<S>{from_double<S>(a)});
    if (kind == 1) return primitive_of(Box<S>{made<S>({a, b, c})});
    if (kind == 3) return primitive_of(Cylinder<S>{from_double<S>(a), from_double<S>(b)});
    if (kind == 4) return primitive_of(Cone<S>{from_double<S>(a), from_double<S>(b)});
    return primitive_of(Capsule<S>{from_double<S>(a), from_double<S>(b)});
  }

 private:
  std::mt19937 engine_;
};

static_assert(kShapeTypes == 9, "an oracle knows each shape by itself: see signed_distance() and cloud_of()");

/// The distance in the half-plane of a point x from a cone's axis: the side's line, else the nearest of the outline's
/// two segments.
inline double cone_distance(double r, double h, double x, double y) {
  const double slant = std::hypot(2 * h, r);
  const double within = std::fmax((2 * h * x + r * (y - h)) / slant, -y - h);
  if (within <= 0) return within;
  const auto to_segment = [&](double ax, double ay, double bx, double by) {
    const double dx = bx - ax, dy = by - ay;
    const double t = std::fmin(std::fmax(((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy), 0), 1);
    return std::hypot(x - ax - t * dx, y - ay - t * dy);
  };
  return std::fmin(to_segment(0, -h, r, -h), to_segment(r, -h, 0, h));
}

/// The signed distance of p, in the primitive's frame: exact everywhere.
inline double signed_distance(const Primitive<double>& s, D3 p) {
  if (s.type == ShapeType::half_space) return dot(s.normal, p) - s.offset;
  if (s.type == ShapeType::sphere) return length(p) - s.radius;
  if (s.type == ShapeType::capsule) {
    const double past = std::fabs(p.y) - s.half.y;
    return (past > 0 ? std::hypot(p.x, past, p.z) : std::hypot(p.x, p.z)) - s.radius;
  }
  if (s.type == ShapeType::cylinder) {
    const double aside = std::hypot(p.x, p.z) - s.radius, above = std::fabs(p.y) - s.half.y;
    const double within = std::fmax(aside, above);
    return within < 0 ? within : std::hypot(std::fmax(aside, 0), std::fmax(above, 0));
  }
  if (s.type == ShapeType::cone) return cone_distance(s.radius, s.half.y, std::hypot(p.x, p.z), p.y);
  const D3 q = {std::fabs(p.x) - s.half.x, std::fabs(p.y) - s.half.y, std::fabs(p.z) - s.half.z};
  const double inside = std::fmax(q.x, std::fmax(q.y, q.z));
  return inside < 0 ? inside : std::hypot(std::fmax(q.x, 0), std::fmax(q.y, 0), std::fmax(q.z, 0));
}

struct PointMass {
  D3 at;
  double volume;
};

/// Two-point Gauss rule on [low, high]: exact for cubics.
inline void gauss(double low, double high, double (&x)[2]) {
  const double mid = (low + high) / 2, off = (high - low) / 2 / std::sqrt(3.0);
  x[0] = mid - off;
  x[1] = mid + off;
}

/// Discs stacked along y between low and high, squared radius q(y) at most quadratic: Gauss of six points along y, two
/// in radius squared, eight angles. Exact for second moments, which are polynomials of degree six in y.
template <class Q> void add_revolved(std::vector<PointMass>& cloud, double low, double high, Q q) {
  static const double node[3] = {0.2386191860831969, 0.6612093864662645, 0.9324695142031521};
  static const double weight[3] = {0.4679139345726910, 0.3607615730481386, 0.1713244923791704};
  for (int i = 0; i < 6; ++i) {
    const double y = (low + high) / 2 + (high - low) / 2 * (i < 3 ? -node[i] : node[i - 3]);
    double squares[2];
    gauss(0, q(y), squares);
    for (double square : squares) {
      const double volume = (high - low) / 2 * weight[i % 3] * q(y) / 2 * std::acos(-1.0) / 8;
      for (int a = 0; a < 8; ++a) {
        const double angle = a * std::acos(-1.0) / 4, r = std::sqrt(square);
        cloud.push_back({{r * isostep::cos(angle), y, r * isostep::sin(angle)}, volume});
      }
    }
  }
}

/// Point masses of density 1 with the primitive's volume and first and second moments, in its frame.
inline std::vector<PointMass> cloud_of(const Primitive<double>& p) {
  std::vector<PointMass> cloud;
  const double h = p.half.y, r = p.radius;
  if (p.type == ShapeType::box) {
    double x[2], y[2], z[2];
    gauss(-p.half.x, p.half.x, x);
    gauss(-p.half.y, p.half.y, y);
    gauss(-p.half.z, p.half.z, z);
    for (double a : x) {
      for (double b : y) {
        for (double c : z) cloud.push_back({{a, b, c}, p.half.x * p.half.y * p.half.z});
      }
    }
    return cloud;
  }
  if (p.type == ShapeType::cylinder || p.type == ShapeType::cone) {
    const bool cone = p.type == ShapeType::cone;
    add_revolved(cloud, -h, h, [&](double y) { return cone ? r * r * (h - y) * (h - y) / (4 * h * h) : r * r; });
    return cloud;
  }
  add_revolved(cloud, -h - r, -h, [&](double y) { return r * r - (y + h) * (y + h); });
  add_revolved(cloud, h, h + r, [&](double y) { return r * r - (y - h) * (y - h); });
  if (h > 0) add_revolved(cloud, -h, h, [&](double) { return r * r; });
  return cloud;
}

}  // namespace isostep::oracle
