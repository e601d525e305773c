// A random shape of each type, whose numbers every scalar holds exactly, and what an oracle in double knows of it.
// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <memory>
#include <typeindex>
#include <vector>

#include "isostep/geometry/baked/hull_blob.hpp"
#include "isostep/geometry/baked/surface_blob.hpp"
#include "unit/collision/narrowphase/cases.hpp"

namespace isostep::test {

/// The hull of points and of discs across y, thickened; or a half-space; or triangles of which one side counts.
struct DrawnShape {
  using Contents = std::map<std::type_index, std::shared_ptr<const void>>;  // by scalar

  Primitive<double> record = {};
  BlobRef blob;
  std::shared_ptr<Contents> contents = std::make_shared<Contents>();
  std::vector<Point> corners;               // [m] of the hull
  std::vector<Point> faces, edges;          // [1] directions of a polyhedron's
  std::vector<std::array<Point, 3>> sides;  // [m] triangles of a surface
  double discs[2] = {0, 0};                 // [m] radii at y = -half, half
  double half = 0, radius = 0;              // [m]
  Point middle = {0, 0, 0};                 // [m] what must be in front of a triangle
  double inner = 1e9;  // [m] the size whose 1/128 the choice of an axis may cost; huge where nothing is chosen
  double reach = 0;    // [m] of it from its origin

  ShapeType type() const { return record.type; }
  bool is_surface() const { return !sides.empty(); }
  bool is_rounded() const { return type() == ShapeType::hull && radius > 0; }
  /// Finds the reach of corners and discs, unless it is known to be more.
  void find_reach() {
    for (const Point p : corners) reach = std::max(reach, length3(p) + radius);
    for (const double r : discs) reach = std::max(reach, length3({r, half, 0}));
  }
  bool has_discs() const { return discs[0] > 0 || discs[1] > 0; }
  template <class S> Primitive<S> primitive() const {
    return {record.type,
            record.blob,
            vec_of<S>(point_of(record.half)),
            from_double<S>(record.radius),
            vec_of<Unit<S>>(point_of(record.normal)),
            from_double<S>(record.offset)};
  }
  /// The content of its blob; made once, and kept by the shape and its copies.
  template <class S> const void* content() const {
    if (blob == nullptr) return nullptr;
    std::shared_ptr<const void>& content = (*contents)[typeid(S)];
    if (content != nullptr) return content.get();
    if (type() == ShapeType::hull) content = HullContent<S>::make(blob->bytes());
    else if (type() == ShapeType::mesh) content = SurfaceContent<TriangleMesh>::make(blob->bytes());
    else content = SurfaceContent<BakedHeightField>::make(blob->bytes());
    return content.get();
  }
};

/// Rounds to 2^-16 m, which floats hold exactly up to 128 m.
inline double snap(double x) { return std::round(x * 65536) / 65536; }
inline Point snap(Point p) { return {snap(p[0]), snap(p[1]), snap(p[2])}; }

/// Sizes of a shape [m], every magnitude as often as another.
struct SizeClass {
  double least, most;
  double size(Random& random) const { return snap(least * isostep::exp(random.in(0, isostep::log(most / least)))); }
};
inline constexpr SizeClass kSizeClasses[] = {
    {0.1, 1},
    {0.015625, 0.0625},  // the smallest that Q16.16 takes
    {4, 20},
    {0.001953125, 0.0078125}  // not for Q16.16
};
inline constexpr int kSizes = 4, kMinute = 3;

inline DrawnShape box_shape(double x, double y, double z) {
  DrawnShape s;
  s.record = primitive_of(Box<double>{{x, y, z}});
  for (int i = 0; i < 8; ++i) s.corners.push_back({i & 1 ? x : -x, i & 2 ? y : -y, i & 4 ? z : -z});
  s.edges = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (const Point p : s.edges) s.faces.push_back(p), s.faces.push_back(p * -1);
  s.inner = std::min({x, y, z});
  s.reach = length3({x, y, z});
  return s;
}

/// It has drawn_NAME for every shape of the list: one that is missing does not compile.
class ShapeDrawer {
 public:
  static DrawnShape draw(Random& random, ShapeType type, int size) {
    DrawnShape shape;
    const SizeClass& sizes = kSizeClasses[size];
    switch (type) {
#define ISO_DRAW(name, Shape) \
  case ShapeType::name: shape = drawn_##name(random, sizes); break;
      ISO_FOR_EACH_SHAPE(ISO_DRAW)
#undef ISO_DRAW
    }
    shape.find_reach();
    return shape;
  }

 private:
  static DrawnShape drawn_sphere(Random& random, const SizeClass& sizes) {
    DrawnShape s;
    s.radius = sizes.size(random);
    s.corners = {{0, 0, 0}};
    s.record = primitive_of(Sphere<double>{s.radius});
    return s;
  }
  static DrawnShape drawn_box(Random& random, const SizeClass& sizes) {
    const double x = sizes.size(random), y = sizes.size(random), z = sizes.size(random);
    return box_shape(x, y, z);
  }
  static DrawnShape drawn_capsule(Random& random, const SizeClass& sizes) {
    DrawnShape s;
    s.radius = sizes.size(random);
    const double half = sizes.size(random);
    s.record = primitive_of(Capsule<double>{s.radius, half});
    s.corners = {{0, -half, 0}, {0, half, 0}};
    s.edges = {{0, 1, 0}};
    return s;
  }
  static DrawnShape drawn_half_space(Random& random, const SizeClass& sizes) {
    DrawnShape s;
    s.record = primitive_of(HalfSpace<double>{vec_of<double>(random.direction()), sizes.size(random)});
    return s;
  }
  static DrawnShape drawn_cylinder(Random& random, const SizeClass& sizes) {
    const double radius = sizes.size(random), half = sizes.size(random);
    DrawnShape s = revolved(radius, radius, half);
    s.record = primitive_of(Cylinder<double>{radius, half});
    return s;
  }
  static DrawnShape drawn_cone(Random& random, const SizeClass& sizes) {
    const double radius = sizes.size(random), half = sizes.size(random);
    DrawnShape s = revolved(radius, 0, half);
    s.record = primitive_of(Cone<double>{radius, half});
    s.middle = {0, -half / 3, 0};
    return s;
  }
  static DrawnShape revolved(double low, double high, double half) {
    DrawnShape s;
    s.discs[0] = low, s.discs[1] = high, s.half = half;
    s.faces = {{0, 1, 0}, {0, -1, 0}};
    s.edges = {{0, 1, 0}};
    s.inner = std::min(low, half);
    return s;
  }
  /// Draws a hull of a box's size; every fourth one is a prism or a wedge with parallel faces, every third one is
  /// rounded.
  static DrawnShape drawn_hull(Random& random, const SizeClass& sizes) {
    const double x = sizes.size(random), y = sizes.size(random), z = sizes.size(random);
    std::vector<Vec3<double>> points = {{x, y, z}, {-x, -y, z}, {-x, y, -z}, {x, -y, -z}};
    if (random.below(4) == 0) {
      points = {{-x, -y, -z}, {x, -y, -z}, {-x, y, -z}, {-x, -y, z}, {x, -y, z}, {-x, y, z}};
    } else {
      for (int more = random.below(6); more > 0; --more) {
        const Point p = random.point(1);
        points.push_back({snap(p[0] * x), snap(p[1] * y), snap(p[2] * z)});
      }
    }
    DrawnShape s;
    s.blob = hull_blob(std::span<const Vec3<double>>(points)).value();
    Random own = random;  // so that the cores are those that were drawn before hulls were rounded
    if (own.below(3) == 0) s.radius = sizes.size(own);
    s.record = primitive_of(Hull<double>{1, s.radius});
    const GridHull read = read_hull(s.blob->bytes()).value();
    const auto in_metres = [&](std::uint8_t i) {
      const GridPoint p = read.hull.vertices[i];
      return Point{double(p.x), double(p.y), double(p.z)} * std::ldexp(1.0, -read.exponent);
    };
    for (std::uint8_t i = 0; i < read.hull.vertices.size(); ++i) s.corners.push_back(in_metres(i));
    for (std::uint8_t f = 0; f < read.hull.faces.size(); ++f) {
      const GridVector n = read.hull.normal(f);
      const Point p = {double(n.x), double(n.y), double(n.z)};
      s.faces.push_back(p * (1 / length3(p)));
    }
    for (std::size_t e = 0; e < read.hull.half_edges.size(); e += 2) {
      const Point p = in_metres(read.hull.half_edges[e + 1].origin) - in_metres(read.hull.half_edges[e].origin);
      s.edges.push_back(p * (1 / length3(p)));
    }
    const HullContent<double>& content = *static_cast<const HullContent<double>*>(s.content<double>());
    s.middle = point_of(content.centre_of_mass);
    s.inner = content.solid.polyhedron().inner_radius;
    return s;
  }
  /// One triangle.
  static DrawnShape drawn_mesh(Random& random, const SizeClass& sizes) {
    for (;;) {
      DrawnShape s;
      std::vector<Vec3<double>> points;
      for (int i = 0; i < 3; ++i) s.corners.push_back(snap(random.direction() * (2 * sizes.size(random))));
      for (const Point p : s.corners) points.push_back(vec_of<double>(p));
      s.sides.push_back({s.corners[0], s.corners[1], s.corners[2]});
      const Point along = s.corners[1] - s.corners[0], other = s.corners[2] - s.corners[0];
      const double area = length3(cross3(along, other)),
                   widest = std::max({length3(along), length3(other), length3(along - other)});
      if (area < 0.2 * widest * widest) continue;
      add_surface(s);
      const std::vector<MeshTriangle> triangles = {{{0, 1, 2}}};
      s.blob = mesh_blob(points, triangles).value();
      s.record = primitive_of(Mesh<double>{1});
      return s;
    }
  }
  /// One flat cell: a square of two triangles.
  static DrawnShape drawn_height_field(Random& random, const SizeClass& sizes) {
    DrawnShape s;
    const double pitch = 2 * sizes.size(random);
    s.corners = {{0, 0, 0}, {0, 0, pitch}, {pitch, 0, 0}, {pitch, 0, pitch}};
    s.sides = {{s.corners[0], s.corners[1], s.corners[2]}, {s.corners[3], s.corners[2], s.corners[1]}};
    add_surface(s);
    const std::vector<double> heights(4, 0.0);
    s.blob = height_field_blob({2, 2, pitch}, heights).value();
    s.record = primitive_of(HeightField<double>{1});
    return s;
  }
  static void add_surface(DrawnShape& s) {
    const Point n = cross3(s.sides[0][1] - s.sides[0][0], s.sides[0][2] - s.sides[0][0]);
    s.faces = {n * (1 / length3(n))};
    for (std::size_t i = 0; i < 3; ++i) {
      const Point along = s.sides[0][(i + 1) % 3] - s.sides[0][i];
      s.edges.push_back(along * (1 / length3(along)));
    }
  }
};

}  // namespace isostep::test
