// The common part of the tests of fracture: solids, patterns, and pieces as points in metres.
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <vector>

#include "isostep/fracture/fracture.hpp"
#include "unit/world/worlds.hpp"

namespace isostep::test {

inline GridHull cube() { return grid_box(Box<double>{{0.5, 0.5, 0.5}}).value(); }
/// A prism of nine corners about y, tilted: no corner of a piece falls on the grid by itself.
inline std::vector<Vec3<double>> rock_corners() {
  std::vector<Vec3<double>> points;
  for (int i = 0; i < 9; ++i) {
    const double angle = 2 * kPi * i / 9;
    const double x = 0.6 * isostep::cos(angle), z = 0.4 * isostep::sin(angle);
    points.push_back({x + 0.1, -0.45 + 0.2 * x, z});
    points.push_back({0.8 * x, 0.5 - 0.1 * z, 0.9 * z + 0.1});
  }
  return points;
}
inline BlobRef rock_blob() { return hull_blob(std::span<const Vec3<double>>(rock_corners())).value(); }
inline GridHull rock() {
  const BlobRef blob = rock_blob();
  return read_hull(blob->bytes()).value();
}

inline FractureImpact blow(const GridHull& solid, D3 point, D3 direction) {
  return grid_impact(solid, point, direction).value();
}
struct NamedPattern {
  const char* name;
  FracturePattern pattern;
};
inline std::vector<NamedPattern> patterns() {
  return {{"boxes", EightBoxes{}},
          {"grain", GrainPlanes{{1, 5, 2}, 4, 2}},
          {"radial", RadialCracks{7, 2}},
          {"voronoi", VoronoiCells{20, 128}}};
}

/// Points of a piece [steps] in the frame of its solid.
inline std::vector<D3> corners_of(const FracturePiece& piece) {
  std::vector<D3> corners;
  const D3 origin = D3{double(piece.origin.x), double(piece.origin.y), double(piece.origin.z)} * 0.5;
  const GridPoint h = piece.half_extents;
  if (piece.blob == nullptr) {
    for (int i = 0; i < 8; ++i) {
      const D3 corner = {(i & 4) != 0 ? 0.5 * h.x : -0.5 * h.x, (i & 2) != 0 ? 0.5 * h.y : -0.5 * h.y,
                         (i & 1) != 0 ? 0.5 * h.z : -0.5 * h.z};
      corners.push_back(origin + corner);
    }
    return corners;
  }
  const Result<GridHull> read = read_hull(piece.blob->bytes());
  for (const GridPoint p : read.value().hull.vertices)
    corners.push_back(origin + D3{double(p.x), double(p.y), double(p.z)});
  return corners;
}
/// A piece's hull, in its frame; boxes with doubled coordinates.
inline ConvexHull hull_of(const FracturePiece& piece) {
  return piece.blob != nullptr ? read_hull(piece.blob->bytes()).value().hull
                               : grid_box(piece.half_extents, 0).value().hull;
}
inline D3 unit_normal(const ConvexHull& hull, std::size_t face) {
  const GridVector n = hull.normal(static_cast<std::uint8_t>(face));
  const D3 v = {double(n.x), double(n.y), double(n.z)};
  return v * (1 / length(v));
}
/// All that decides what a fracture is.
inline std::vector<std::uint8_t> bytes_of(const Fracture& fracture) {
  std::vector<std::uint8_t> bytes;
  Writer writer(bytes);
  writer.write(fracture.volume6);
  writer.write(fracture.refused);
  for (const FracturePiece& piece : fracture.pieces) {
    writer.write(piece.origin);
    writer.write(piece.half_extents);
    writer.write(piece.volume6);
    for (const std::int64_t c : piece.centre) writer.write(c);
    writer.write_bytes(piece.blob == nullptr ? Bytes{} : piece.blob->bytes());
  }
  return bytes;
}

}  // namespace isostep::test
