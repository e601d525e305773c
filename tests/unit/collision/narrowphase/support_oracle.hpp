// The distance of two drawn shapes along any direction, in double, and the direction along which that is most: an
// oracle that knows no features, only how far a shape reaches.
// SPDX-License-Identifier: MIT
#pragma once

#include "unit/collision/narrowphase/drawn_shapes.hpp"

namespace isostep::test {

/// A drawn shape where it lies, from the first one's origin.
class PlacedShape {
 public:
  PlacedShape(const DrawnShape& shape, const Transform<double>& t, Point origin) : shape_(&shape) {
    for (int k = 0; k < 3; ++k) axes_[k] = point_of(t.rotation.column(k));
    for (const Point p : shape.corners) corners_.push_back(turned(p));
    for (const Point p : shape.faces) faces.push_back(turned(p));
    for (const Point p : shape.edges) edges.push_back(turned(p));
    if (is_plane()) plane_normal_ = turned(point_of(shape.record.normal));
    move_to(point_of(t.position) - origin);
  }
  void move_to(Point at) { at_ = at; }
  Point at() const { return at_; }
  const DrawnShape& shape() const { return *shape_; }
  bool is_plane() const { return shape_->type() == ShapeType::half_space; }
  Point plane_normal() const { return plane_normal_; }
  Point turned(Point p) const { return axes_[0] * p[0] + axes_[1] * p[1] + axes_[2] * p[2]; }
  Point world(Point p) const { return at_ + turned(p); }
  /// The reach of the shape along n; of a half-space along its normal alone.
  double reach(Point n) const {
    if (is_plane()) return dot3(n, at_) + shape_->record.offset;
    double most = -1e300;
    for (const Point p : corners_) most = std::max(most, dot3(n, p));
    if (shape_->has_discs()) {
      const double along = dot3(n, axes_[1]), across = std::sqrt(std::max(0.0, 1 - along * along));
      most = std::max(most, std::max(shape_->discs[0] * across - shape_->half * along,
                                     shape_->discs[1] * across + shape_->half * along));
    }
    return most + shape_->radius + dot3(n, at_);
  }

  /// The point that does; not of a half-space.
  Point support(Point n) const { return core_support(n) + n * (shape_->radius / length3(n)); }
  /// That of the core.
  Point core_support(Point n) const {
    Point furthest = {0, 0, 0};
    double most = -1e300;
    for (const Point p : corners_) {
      if (dot3(n, p) > most) most = dot3(n, p), furthest = p;
    }
    for (int end = 0; end < 2 && shape_->has_discs(); ++end) {
      const Point across = n - axes_[1] * dot3(n, axes_[1]);
      const double length = length3(across);
      Point p = axes_[1] * (end == 0 ? -shape_->half : shape_->half);
      if (length > 0) p = p + across * (shape_->discs[end] / length);
      if (dot3(n, p) > most) most = dot3(n, p), furthest = p;
    }
    return at_ + furthest;
  }

  std::vector<Point> faces, edges;  // [1] directions

 private:
  const DrawnShape* shape_;
  Point axes_[3], at_, plane_normal_ = {0, 0, 0};
  std::vector<Point> corners_;
};

/// The largest separation of two shapes over directions from a to b, as far as looking finds it: no larger than it is.
class SupportOracle {
 public:
  struct Best {
    double separation;  // [m]
    Point normal;       // [1]
  };
  SupportOracle(const PlacedShape& a, const PlacedShape& b) : a_(a), b_(b) {}

  double along(Point n) const { return -a_.reach(n) - b_.reach(n * -1); }
  Best best() const {
    if (a_.is_plane()) return exactly(a_.plane_normal());
    if (b_.is_plane()) return exactly(b_.plane_normal() * -1);
    Best first = {-1e300, {0, 1, 0}}, second = first;
    const auto look = [&](Point n) {
      const double separation = along(n);
      if (separation > first.separation) second = first, first = {separation, n};
      else if (separation > second.separation && dot3(n, first.normal) < 0.9) second = {separation, n};
    };
    const auto look_both_ways = [&](Point n) {
      const double length = length3(n);
      if (length < 1e-6) return;
      look(n * (1 / length));
      look(n * (-1 / length));
    };
    static const std::vector<Point> kAround = directions(60);
    for (const Point n : kAround) look(n);
    for (const Point n : a_.faces) look_both_ways(n);
    for (const Point n : b_.faces) look_both_ways(n);
    for (const Point e : a_.edges) {
      for (const Point f : b_.edges) look_both_ways(cross3(e, f));
    }
    look_both_ways(b_.at() - a_.at());
    if (a_.shape().is_rounded() || b_.shape().is_rounded()) look_both_ways(core_gap());
    const Best climbed = climb(first), other = climb(second);
    return climbed.separation > other.separation ? climbed : other;
  }
  /// Steps to whatever is better nearby, ever smaller ones.
  Best climb(Best best) const {
    double step = 0.15;
    for (int round = 0; round < 60 && step > 1e-7; ++round) {
      Point u = cross3(best.normal, std::abs(best.normal[0]) < 0.6 ? Point{1, 0, 0} : Point{0, 1, 0});
      u = u * (1 / length3(u));
      const Point v = cross3(best.normal, u);
      const double start = best.separation;
      Best next = best;
      for (int k = 0; k < 6; ++k) {
        const double turn = std::acos(-1.0) * (k + 0.5 * (round % 2)) / 3;
        const Point n = best.normal + u * (step * isostep::cos(turn)) + v * (step * isostep::sin(turn));
        const Point way = n * (1 / length3(n));
        const double separation = along(way);
        if (separation > next.separation) next = {separation, way};
      }
      best = next;
      if (!(best.separation > start)) step *= 0.4;
    }
    return best;
  }

  /// [m] no less than it is, 0 for overlap.
  double distance() const {
    return length3(gap([this](Point way) { return b_.support(way) - a_.support(way * -1); }));
  }

 private:
  /// The shortest way from a's core to b's, zero for overlap.
  Point core_gap() const {
    return gap([this](Point way) { return b_.core_support(way) - a_.core_support(way * -1); });
  }
  /// The gap of the difference of two solids, from its point furthest along a way: GJK.
  template <class Support> Point gap(const Support& support) const {
    std::vector<Point> simplex;
    Point nearest = b_.at() - a_.at();
    if (length3(nearest) == 0) return nearest;
    for (int round = 0; round < 100; ++round) {
      const Point way = nearest * (-1 / length3(nearest));
      const Point next = support(way);
      if (!simplex.empty() && dot3(next, way) + length3(nearest) < 1e-12) break;
      simplex.push_back(next);
      nearest = nearest_of(simplex);
      if (simplex.size() == 4 || length3(nearest) < 1e-12) return {0, 0, 0};
    }
    return nearest;
  }
  /// The vector from the hull of up to four points to the origin; leaves the points it is between. Four: the origin is
  /// in it.
  static Point nearest_of(std::vector<Point>& simplex) {
    std::vector<Point> kept;
    Point best = {0, 0, 0};
    double least = 1e300;
    const auto offer = [&](Point p, std::vector<Point> of) {
      if (dot3(p, p) < least) least = dot3(p, p), best = p, kept = std::move(of);
    };
    const std::size_t count = simplex.size();
    for (std::size_t i = 0; i < count; ++i) {
      offer(simplex[i], {simplex[i]});
      for (std::size_t j = i + 1; j < count; ++j) {
        const Point along = simplex[j] - simplex[i];
        const double t = -dot3(simplex[i], along) / dot3(along, along);
        if (t > 0 && t < 1) offer(simplex[i] + along * t, {simplex[i], simplex[j]});
        for (std::size_t k = j + 1; k < count; ++k) {
          const Point& a = simplex[i];
          const Point n = cross3(simplex[j] - a, simplex[k] - a);
          const Point p = n * (dot3(n, a) / dot3(n, n));
          const auto inside = [&](Point x, Point y) { return dot3(cross3(y - x, p - x), n) >= 0; };
          if (inside(a, simplex[j]) && inside(simplex[j], simplex[k]) && inside(simplex[k], a))
            offer(p, {a, simplex[j], simplex[k]});
        }
      }
    }
    if (count == 4 && holds_origin(simplex)) return {0, 0, 0};
    simplex = kept;
    return best;
  }
  static bool holds_origin(const std::vector<Point>& p) {
    for (std::size_t i = 0; i < 4; ++i) {
      const Point &a = p[(i + 1) % 4], &b = p[(i + 2) % 4], &c = p[(i + 3) % 4];
      const Point n = cross3(b - a, c - a);
      if (dot3(n, p[i] - a) * dot3(n, a * -1) < 0) return false;
    }
    return true;
  }
  Best exactly(Point n) const { return {along(n), n}; }
  const PlacedShape& a_;
  const PlacedShape& b_;
};

}  // namespace isostep::test
