// Shapes that no modeller would make: of no size, tiny, huge, thin, of many coplanar faces, steep, folded, with holes.
// SPDX-License-Identifier: MIT
#pragma once

#include "unit/collision/narrowphase/drawn_shapes.hpp"

namespace isostep::test {

/// A size of zero, tiny, ordinary or up to `largest` [m].
inline double any_size(Random& random, double largest) {
  switch (random.below(8)) {
    case 0: return 0;
    case 1: return random.power_of_ten(-5, -2);
    case 2: return largest * random.in(0.1, 1);
    case 3: return 0.5;
    default: return random.power_of_ten(-2, 0.5);
  }
}

/// Upright, by a quarter turn, a hair off either, or any way.
template <class S> Transform<S> any_pose(Random& random, Point p) {
  const Point axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const Point axis = axes[random.below(3)];
  const Point any = random.direction();
  const double quarters = std::acos(0.0) * random.below(4), hair = random.power_of_ten(-9, -1);
  switch (random.below(5)) {
    case 0: return at<S>(p);
    case 1: return at<S>(p, axis, quarters);
    case 2: return at<S>(p, axis, quarters + hair);
    case 3: return at<S>(p, any, hair);
    default: return at<S>(p, any, random.in(-3, 3));
  }
}

/// hostile_NAME for every shape of the list: one that is missing does not compile.
class HostileDrawer {
 public:
  /// `largest` [m]: of coordinates and sizes. Shapes with a blob are of a hundred that are drawn once.
  static DrawnShape draw(Random& random, ShapeType type, double largest) {
    const bool has_blob = type == ShapeType::hull || type == ShapeType::mesh || type == ShapeType::height_field;
    if (!has_blob) return made(random, type, largest);
    static std::map<std::pair<int, double>, std::vector<DrawnShape>> drawn;
    std::vector<DrawnShape>& shapes = drawn[{static_cast<int>(type), largest}];
    Random own(static_cast<std::uint64_t>(type) + 40);
    while (shapes.size() < 100) shapes.push_back(made(own, type, largest));
    return shapes[static_cast<std::size_t>(random.below(100))];
  }

 private:
  static DrawnShape made(Random& random, ShapeType type, double largest) {
    DrawnShape shape;
    switch (type) {
#define ISO_DRAW(name, Shape) \
  case ShapeType::name: shape = hostile_##name(random, largest); break;
      ISO_FOR_EACH_SHAPE(ISO_DRAW)
#undef ISO_DRAW
    }
    shape.find_reach();
    return shape;
  }
  static double size(Random& random, double largest) { return snap(any_size(random, largest)); }
  /// [m] Worlds take none that are smaller. Of no size or nearly so they break the narrow phase in fixed point, once in
  /// some thousands of pairs with capsules (a normal of 0) and with each other (an overflow in Q16.16).
  static constexpr double kLeastRevolved = 0.015625;
  static double revolved_size(Random& random, double largest) {
    return std::max(size(random, largest), kLeastRevolved);
  }

  static DrawnShape hostile_sphere(Random& random, double largest) {
    DrawnShape s;
    s.radius = size(random, largest);
    s.corners = {{0, 0, 0}};
    s.record = primitive_of(Sphere<double>{s.radius});
    return s;
  }
  static DrawnShape hostile_box(Random& random, double largest) {
    const double x = size(random, largest), y = size(random, largest), z = size(random, largest);
    return box_shape(x, y, z);
  }
  static DrawnShape hostile_capsule(Random& random, double largest) {
    DrawnShape s;
    s.radius = size(random, largest);
    const double half = size(random, largest);
    s.record = primitive_of(Capsule<double>{s.radius, half});
    s.corners = {{0, -half, 0}, {0, half, 0}};
    return s;
  }
  static DrawnShape hostile_half_space(Random& random, double largest) {
    DrawnShape s;
    const Point normal = random.direction();
    s.record = primitive_of(HalfSpace<double>{vec_of<double>(normal), snap(random.in(-largest, largest))});
    return s;
  }
  static DrawnShape hostile_cylinder(Random& random, double largest) {
    const double radius = revolved_size(random, largest), half = revolved_size(random, largest);
    DrawnShape s = revolved(radius, radius, half);
    s.record = primitive_of(Cylinder<double>{radius, half});
    return s;
  }
  static DrawnShape hostile_cone(Random& random, double largest) {
    const double radius = revolved_size(random, largest), half = revolved_size(random, largest);
    DrawnShape s = revolved(radius, 0, half);
    s.record = primitive_of(Cone<double>{radius, half});
    s.middle = {0, -half / 3, 0};
    return s;
  }
  static DrawnShape revolved(double low, double high, double half) {
    DrawnShape s;
    s.discs[0] = low, s.discs[1] = high, s.half = half;
    s.corners = {{0, -half, 0}, {0, half, 0}};
    s.inner = std::min(low, half);
    return s;
  }

  /// Slabs, needles, prisms of many sides, balls of points on a coarse grid, boxes with a corner that is hardly cut.
  static DrawnShape hostile_hull(Random& random, double largest) {
    for (;;) {
      const double x = hull_size(random, largest), y = hull_size(random, largest), z = hull_size(random, largest);
      std::vector<Vec3<double>> points;
      const int kind = random.below(4), sides = 3 + random.below(30);
      for (int i = 0; i < 2 * sides && kind == 0; ++i) {
        const double turn = std::acos(-1.0) * (i / 2) / sides * 2;
        points.push_back({x * isostep::cos(turn), i % 2 == 0 ? -y : y, z * isostep::sin(turn)});
      }
      for (int i = 0; i < 8 && kind == 1; ++i)
        points.push_back({i & 1 ? x : -x, i & 2 ? y : -y, (i & 4 ? z : -z) * (i == 7 ? 0.999 : 1)});
      for (int i = 0; i < 4 + sides && kind >= 2; ++i) {
        const Point p = kind == 2 ? random.direction() : random.point(1);
        const double grid = kind == 2 ? 8 : 65536;
        points.push_back({x * std::round(p[0] * grid) / grid, y * std::round(p[1] * grid) / grid, z * p[2]});
      }
      for (Vec3<double>& p : points) p = vec_of<double>(snap(point_of(p)));
      auto blob = hull_blob(std::span<const Vec3<double>>(points));
      if (!blob.ok()) continue;
      DrawnShape s;
      s.blob = blob.value();
      s.record = primitive_of(Hull<double>{1});
      const GridHull read = read_hull(s.blob->bytes()).value();
      for (const GridPoint p : read.hull.vertices)
        s.corners.push_back(Point{double(p.x), double(p.y), double(p.z)} * std::ldexp(1.0, -read.exponent));
      const HullContent<double>& content = *static_cast<const HullContent<double>*>(s.content<double>());
      if (content.fault != ShapeFault::none) continue;
      s.middle = point_of(content.centre_of_mass);
      s.inner = content.solid.polyhedron().inner_radius;
      return s;
    }
  }
  static double hull_size(Random& random, double largest) {
    return std::max(any_size(random, largest / 2), 0.0009765625);
  }

  /// A sheet of slivers, a fan of long triangles, a step that is folded back, one large triangle.
  static DrawnShape hostile_mesh(Random& random, double largest) {
    const int kind = random.below(4);
    const double wide = std::max(any_size(random, largest / 2), 0.125),
                 deep = kind == 0 ? std::max(wide / 256, 0.0078125) : wide;
    std::vector<Point> points;
    std::vector<MeshTriangle> triangles;
    constexpr std::uint32_t kPlaces = 4;
    if (kind < 2) {
      for (std::uint32_t k = 0; k < kPlaces; ++k) {
        for (std::uint32_t i = 0; i < kPlaces; ++i)
          points.push_back({wide * (i / 3.0 - 0.5), wide * random.in(-0.2, 0.2), deep * (k / 3.0 - 0.5)});
      }
      for (std::uint32_t k = 0; k + 1 < kPlaces; ++k) {
        for (std::uint32_t i = 0; i + 1 < kPlaces; ++i) {
          const std::uint32_t from = k * kPlaces + i;
          triangles.push_back({{from, from + kPlaces, from + 1}});
          triangles.push_back({{from + kPlaces + 1, from + 1, from + kPlaces}});
        }
      }
    } else if (kind == 2) {
      points = {{0, wide * random.in(-0.5, 0.5), 0}};
      for (int i = 0; i < 8; ++i) points.push_back({wide * isostep::cos(0.785 * i), 0, wide * isostep::sin(0.785 * i)});
      for (std::uint32_t i = 0; i < 8; ++i) triangles.push_back({{0, 1 + (i + 1) % 8, 1 + i}});
    } else {
      const double fold = wide * random.in(-0.9, 0.9);
      points = {{-wide, 0, -deep}, {-wide, 0, deep}, {0, 0, -deep}, {0, 0, deep}, {fold, wide / 8, 0}};
      triangles = {{{0, 1, 2}}, {{3, 2, 1}}, {{2, 3, 4}}};
    }
    DrawnShape s;
    std::vector<Vec3<double>> rounded;
    for (Point& p : points) p = snap(p), rounded.push_back(vec_of<double>(p));
    for (const MeshTriangle& t : triangles)
      s.sides.push_back({points[t.vertices[0]], points[t.vertices[1]], points[t.vertices[2]]});
    s.corners = points;
    s.blob = mesh_blob(rounded, triangles).value();
    s.record = primitive_of(Mesh<double>{1});
    return s;
  }
  /// Cliffs, plateaus, and at times a hole.
  static DrawnShape hostile_height_field(Random& random, double largest) {
    constexpr std::uint32_t kPlaces = 4;
    const double pitch = std::max(any_size(random, largest / 4), 0.0078125);
    const double high = random.below(3) == 0 ? 4 * pitch : pitch / 8;
    std::vector<double> heights;
    for (std::uint32_t i = 0; i < kPlaces * kPlaces; ++i)
      heights.push_back(random.below(3) == 0 ? 0 : std::min(largest / 2, high) * random.in(-1, 1));
    std::vector<std::uint8_t> materials((kPlaces - 1) * (kPlaces - 1), 0);
    if (random.below(3) == 0) materials[static_cast<std::size_t>(random.below(9))] = BakedHeightField::kHole;
    DrawnShape s;
    s.blob = height_field_blob({kPlaces, kPlaces, pitch}, heights, materials).value();
    s.record = primitive_of(HeightField<double>{1});
    const auto* content = static_cast<const SurfaceContent<BakedHeightField>*>(s.content<double>());
    const BakedHeightField& field = *content->surface;
    const double step = std::ldexp(1.0, -field.exponent());
    for (std::uint32_t id = 0; id < field.triangle_count(); ++id) {
      if (!field.has_triangle(id)) continue;
      std::array<Point, 3> side;
      for (std::size_t i = 0; i < 3; ++i) {
        const MeshPoint p = field.corners(id).points[i];
        side[i] = Point{double(p.x), double(p.y), double(p.z)} * step;
        s.corners.push_back(side[i]);
      }
      s.sides.push_back(side);
    }
    return s;
  }
};

}  // namespace isostep::test
