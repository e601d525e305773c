// Quads and blocks as triangles.
// SPDX-License-Identifier: MIT
#include "mesh_builder.hpp"

#include <cmath>

namespace isostep::scenes {

double on_lattice(double metres) { return std::floor(1024 * metres + 0.5) / 1024; }
Point on_lattice(Point p) { return {on_lattice(p.x), on_lattice(p.y), on_lattice(p.z)}; }
Point unit_of(Point v) {
  const double length = std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
  return {v.x / length, v.y / length, v.z / length};
}

std::vector<double> evenly(double from, double to, int count) {
  std::vector<double> planes;
  for (int i = 0; i <= count; ++i) planes.push_back(from + (to - from) * i / count);
  return planes;
}
bool is_between(const std::vector<double>& planes, int i, double from, double to) {
  const std::size_t at = static_cast<std::size_t>(i);
  return planes[at] >= from && planes[at + 1] <= to;
}

double MeshBuilder::vertex(Point p) {
  const Point at = on_lattice(p);
  const auto [known, fresh] = vertices_.try_emplace({at.x, at.y, at.z}, static_cast<double>(part_.vertices.size()));
  if (fresh) part_.vertices.push_back(vector_of(at));
  return known->second;
}
void MeshBuilder::triangle(double a, double b, double c) {
  if (a == b || b == c || c == a) return;
  part_.triangles.push_back({a, b, c});
  part_.materials.push_back(material_);
}
void MeshBuilder::quad(Point a, Point b, Point c, Point d) {
  const double i = vertex(a), j = vertex(b), k = vertex(c), l = vertex(d);
  triangle(i, j, k);
  triangle(k, l, i);
}

namespace {

/// The corners of a cell's face, the two axes across in an order that makes it look along `axis`, or against it.
std::array<std::array<int, 3>, 4> corners_of(std::array<int, 3> at, int axis, bool upward) {
  const auto u = static_cast<std::size_t>((axis + 1) % 3), v = static_cast<std::size_t>((axis + 2) % 3);
  if (upward) ++at[static_cast<std::size_t>(axis)];
  std::array<std::array<int, 3>, 4> corners = {at, at, at, at};
  for (const std::size_t c : {1u, 2u}) ++corners[c][upward ? u : v];
  for (const std::size_t c : {2u, 3u}) ++corners[c][upward ? v : u];
  return corners;
}

}  // namespace

void MeshBuilder::add_cells(const Planes& planes, const Filled& filled, const Warp& warp) {
  const int nx = static_cast<int>(planes.x.size()) - 1, ny = static_cast<int>(planes.y.size()) - 1,
            nz = static_cast<int>(planes.z.size()) - 1;
  const auto is_filled = [&](int i, int j, int k) {
    if (planes.round) i = (i + nx) % nx;
    return i >= 0 && j >= 0 && k >= 0 && i < nx && j < ny && k < nz && filled(i, j, k);
  };
  const auto place = [&](const std::array<int, 3>& p) {
    return warp({planes.x[static_cast<std::size_t>(p[0])], planes.y[static_cast<std::size_t>(p[1])],
                 planes.z[static_cast<std::size_t>(p[2])]});
  };
  const auto close = [&](int i, int j, int k, int axis, bool upward) {
    const int step = upward ? 1 : -1;
    if (is_filled(i + step * (axis == 0), j + step * (axis == 1), k + step * (axis == 2))) return;
    const auto corners = corners_of({i, j, k}, axis, upward);
    quad(place(corners[0]), place(corners[1]), place(corners[2]), place(corners[3]));
  };
  for (int j = 0; j < ny; ++j) {
    for (int k = 0; k < nz; ++k) {
      for (int i = 0; i < nx; ++i) {
        if (!is_filled(i, j, k)) continue;
        for (int axis = 0; axis < 3; ++axis) close(i, j, k, axis, true), close(i, j, k, axis, false);
      }
    }
  }
}

void MeshBuilder::add_column(Point foot, double radius, double height, int sides) {
  const Planes planes = {evenly(0, kTurn, sides), {0, height}, {0, radius}, true};
  const auto round = [&](Point p) {
    const SinCos<double> angle = sin_cos(p.x);
    return Point{foot.x + p.z * angle.sin, foot.y + p.y, foot.z + p.z * angle.cos};
  };
  add_cells(
      planes, [](int, int, int) { return true; }, round);
}

}  // namespace isostep::scenes
