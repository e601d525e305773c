// Ears of polygons.
// SPDX-License-Identifier: MIT
#include "triangulate.hpp"

namespace isostep::tool::bake {
namespace {

using V = Vec3<double>;

class Polygon {
 public:
  explicit Polygon(std::span<const V> points) : points_(points), normal_{0, 0, 0} {
    for (std::uint32_t i = 0; i < points.size(); ++i) {
      normal_ += cross(points[i] - points[0], points[(i + 1) % points.size()] - points[0]);
      rest_.push_back(i);
    }
  }

  std::vector<std::array<std::uint32_t, 3>> cut() {
    std::vector<std::array<std::uint32_t, 3>> triangles;
    while (rest_.size() > 3) {
      const std::size_t ear = find_ear();
      triangles.push_back(corner(ear));
      rest_.erase(rest_.begin() + static_cast<std::ptrdiff_t>(ear));
    }
    triangles.push_back(corner(1));
    return triangles;
  }

 private:
  /// The corner with its neighbours.
  std::array<std::uint32_t, 3> corner(std::size_t i) const {
    return {rest_[(i + rest_.size() - 1) % rest_.size()], rest_[i], rest_[(i + 1) % rest_.size()]};
  }
  /// The second corner where there is none: a triangle begins with the first.
  std::size_t find_ear() const {
    for (std::size_t n = 0; n < rest_.size(); ++n) {
      const std::size_t i = (n + 1) % rest_.size();
      if (is_ear(corner(i))) return i;
    }
    return 1;
  }
  double area(const V& a, const V& b, const V& c) const { return dot(cross(b - a, c - a), normal_); }
  bool is_ear(const std::array<std::uint32_t, 3>& triangle) const {
    const V a = points_[triangle[0]], b = points_[triangle[1]], c = points_[triangle[2]];
    if (!(area(a, b, c) > 0)) return false;
    for (const std::uint32_t other : rest_) {
      const V p = points_[other];
      if (p == a || p == b || p == c) continue;
      if (area(a, b, p) >= 0 && area(b, c, p) >= 0 && area(c, a, p) >= 0) return false;
    }
    return true;
  }

  std::span<const V> points_;
  V normal_;
  std::vector<std::uint32_t> rest_;
};

}  // namespace

std::vector<std::array<std::uint32_t, 3>> triangulated(std::span<const V> polygon) { return Polygon(polygon).cut(); }

}  // namespace isostep::tool::bake
