// The solid part of a level, told from its triangles alone: an oracle beside the engine.
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <map>
#include <vector>

#include "scenes/build.hpp"
#include "scenes/hull_points.hpp"
#include "scenes/surface_points.hpp"

namespace isostep::scenes {

/// The inside of closed surfaces that may overlap, and of a ground that is open below.
class LevelSolid {
 public:
  explicit LevelSolid(const Scene& scene) {
    for (const SceneBody& body : scene.bodies) {
      for (const ScenePart& part : body.parts) {
        const Vec3<double> at = number(body.position) + number(part.position);
        if (part.type == ShapeType::mesh) {
          const auto surface = solid_surface(*mesh_of_part(part, ""));
          for (const Triangle& t : surface->triangles) add(t, at);
        } else {
          const auto hull = solid_hull(*hull_of_part(part, ""));
          for (const Triangle& t : hull->triangles) add(t, at);
        }
      }
    }
  }
  /// A point is inside if the way straight up from it leaves once more than it enters.
  bool holds(Vec3<double> p) const {
    p = p + Vec3<double>{1.3e-7, 0, 0.7e-7};  // off the edges, which lie on a lattice
    const auto cell = cells_.find({std::floor(p.x), std::floor(p.z)});
    if (cell == cells_.end()) return false;
    int leaves = 0;
    for (const std::size_t i : cell->second) leaves += crossing(triangles_[i], p);
    return leaves > 0;
  }

 private:
  using Triangle = std::array<Vec3<double>, 3>;

  static Vec3<double> number(const Vector& v) {
    return {value_of<double>(v[0], ""), value_of<double>(v[1], ""), value_of<double>(v[2], "")};
  }
  void add(const Triangle& local, Vec3<double> at) {
    const Triangle t = {local[0] + at, local[1] + at, local[2] + at};
    const Vec3<double> low = min(t[0], min(t[1], t[2])), high = max(t[0], max(t[1], t[2]));
    for (double x = std::floor(low.x); x <= high.x; ++x) {
      for (double z = std::floor(low.z); z <= high.z; ++z) cells_[{x, z}].push_back(triangles_.size());
    }
    triangles_.push_back(t);
  }
  /// 1 where the way up from p comes out through it, -1 where it goes in.
  static int crossing(const Triangle& t, Vec3<double> p) {
    const Vec3<double> normal = cross(t[1] - t[0], t[2] - t[0]);
    if (normal.y == 0) return 0;
    const double sign = normal.y > 0 ? 1 : -1;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3<double> side = t[(i + 1) % 3] - t[i], to = p - t[i];
      if (sign * (side.z * to.x - side.x * to.z) < 0) return 0;
    }
    return dot(normal, t[0] - p) / normal.y > 0 ? static_cast<int>(sign) : 0;
  }

  std::vector<Triangle> triangles_;
  std::map<std::pair<double, double>, std::vector<std::size_t>> cells_;  // by x and z, 1 m wide
};

}  // namespace isostep::scenes
