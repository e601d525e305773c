// Quickhull: the triangulated convex hull of distinct grid points.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "isostep/geometry/baked/grid_point.hpp"

namespace isostep {

/// A triangle of the hull, counter-clockwise seen from outside. Triangles that share a plane are not merged.
struct HullTriangle {
  std::uint32_t vertices[3];    // indices of points
  std::uint32_t neighbours[3];  // triangles, across the edge from vertex i to the one after it
};

/// Takes the furthest point above a facet as the next vertex, until no facet has one. Source: Barber, Dobkin and
/// Huhdanpaa, The quickhull algorithm for convex hulls, ACM TOMS 22, 1996.
class Quickhull {
 public:
  ISO_INLINE explicit Quickhull(std::span<const GridPoint> points) : points_(points) {}
  ISO_INLINE ~Quickhull() = default;

  /// Returns the triangles of the hull; none where the points are one, lie on a line or in a plane.
  std::vector<HullTriangle> run();
  /// Runs up to so many vertices, at least four: those that reach furthest beyond the ones before.
  std::vector<HullTriangle> run(std::uint32_t vertices);

 private:
  static constexpr std::uint32_t kNone = 0xffffffffu;

  struct Facet {
    HullTriangle triangle;
    GridVector normal;          // [steps^2]
    std::uint32_t first_above;  // a list of points strictly above, linked by next_above_
    bool visible, gone;
  };
  struct HorizonEdge {
    std::uint32_t from, to;  // as the facet below the horizon's other side has it
    std::uint32_t facet;     // which stays
  };

  bool begin();
  std::uint32_t facet_with_furthest() const;
  void take(std::uint32_t facet);
  std::vector<HullTriangle> result() const;
  std::uint32_t furthest_from_line(std::uint32_t a, std::uint32_t b) const;
  std::uint32_t furthest_from_plane(std::uint32_t a, std::uint32_t b, std::uint32_t c) const;
  std::uint32_t add_facet(std::uint32_t a, std::uint32_t b, std::uint32_t c);
  std::int64_t height(const Facet& facet, std::uint32_t point) const;
  void give(std::uint32_t point, std::uint32_t first_facet);
  std::uint32_t furthest_above(const Facet& facet) const;
  void find_horizon(std::uint32_t seen_from, std::uint32_t facet);
  void cover(std::uint32_t apex);

  std::span<const GridPoint> points_;
  std::vector<Facet> facets_;
  std::vector<std::uint32_t> next_above_;  // by point
  std::vector<std::uint32_t> visible_;     // facets that the new vertex sees
  std::vector<HorizonEdge> horizon_;
  std::vector<std::uint32_t> starting_at_;  // by point: the new facet whose edge of the horizon starts there
};

}  // namespace isostep
