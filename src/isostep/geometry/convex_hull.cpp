// The faces of a convex hull from the triangles of quickhull.
// SPDX-License-Identifier: MIT
#include "isostep/geometry/baked/convex_hull.hpp"

#include <algorithm>

#include "isostep/core/lower_bound.hpp"
#include "isostep/core/stable_sort.hpp"
#include "isostep/scalar/environment.hpp"
#include "isostep/scalar/wide_int.hpp"
#include "quickhull.hpp"

namespace isostep {
namespace {

constexpr std::uint32_t kNone = 0xffffffffu;

struct PointKey {
  ISO_INLINE std::uint64_t operator()(GridPoint p) const { return p.key(); }
};
struct NumberKey {
  ISO_INLINE std::uint64_t operator()(std::uint64_t number) const { return number; }
};

template <class Record, class Key> void sort(std::vector<Record>& records, const Key& key) {
  std::vector<Record> scratch(records.size());
  stable_sort(records.data(), scratch.data(), static_cast<std::uint32_t>(records.size()), key);
}

Error error(ErrorCode code, ShortText<112> message) { return {code, message, "points"}; }
Error too_many(std::size_t count, const char* what, std::uint32_t limit) {
  ShortText<112> text = "the hull has ";
  text.append_number(count).append(" ").append(what).append(", at most ").append_number(limit);
  return error(ErrorCode::limit, text.append(" are possible"));
}

Error out_of_grid() { return error(ErrorCode::invalid, "a coordinate has more than 19 bits"); }
Error no_volume() { return error(ErrorCode::invalid, "the points span no volume"); }

/// Collects the distinct points in ascending order. Returns false when a coordinate is out of the grid.
bool take_distinct(std::span<const GridPoint> points, std::vector<GridPoint>& distinct) {
  constexpr std::int32_t kLimit = GridPoint::kLimit;
  distinct.assign(points.begin(), points.end());
  for (const GridPoint p : points) {
    for (const std::int32_t v : {p.x, p.y, p.z}) {
      if (v <= -kLimit || v >= kLimit) return false;
    }
  }
  sort(distinct, PointKey{});
  std::size_t count = 0;
  for (const GridPoint p : distinct) {
    if (count == 0 || !(distinct[count - 1] == p)) distinct[count++] = p;
  }
  distinct.resize(count);
  return true;
}

/// Faces as loops of points: the planes of the triangles, without points that are no corner.
class FaceLoops {
 public:
  FaceLoops(std::span<const GridPoint> points, std::span<const HullTriangle> triangles)
      : points_(points), triangles_(triangles) {
    find_planes();
    find_corners();
    find_rims();
    for (std::uint32_t plane = 0; plane < planes_; ++plane) loops_.push_back(loop_of(plane));
  }
  const std::vector<std::vector<std::uint32_t>>& loops() const { return loops_; }
  std::vector<std::uint32_t> corners() const {
    std::vector<std::uint32_t> corners;
    for (std::uint32_t p = 0; p < is_corner_.size(); ++p) {
      if (is_corner_[p]) corners.push_back(p);
    }
    return corners;
  }

 private:
  /// Triangles of one plane are neighbours of each other: the hull is convex.
  void find_planes() {
    plane_.assign(triangles_.size(), kNone);
    std::vector<std::uint32_t> open;
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      if (plane_[t] != kNone) continue;
      plane_[t] = planes_;
      open.assign(1, t);
      while (!open.empty()) {
        const HullTriangle& triangle = triangles_[open.back()];
        open.pop_back();
        for (const std::uint32_t neighbour : triangle.neighbours) {
          if (plane_[neighbour] != kNone || !coplanar(triangle, triangles_[neighbour])) continue;
          plane_[neighbour] = planes_;
          open.push_back(neighbour);
        }
      }
      ++planes_;
    }
  }
  /// Returns true if two neighbours lie in one plane.
  bool coplanar(const HullTriangle& a, const HullTriangle& b) const {
    const GridPoint at = points_[a.vertices[0]];
    const GridVector normal = cross(points_[a.vertices[1]] - at, points_[a.vertices[2]] - at);
    for (const std::uint32_t p : b.vertices) {
      if (dot(normal, points_[p] - at) != 0) return false;
    }
    return true;
  }
  /// Finds the points where three planes or more meet. Two meet in the middle of an edge, one in the middle of a face.
  void find_corners() {
    std::vector<std::uint32_t> seen[2];
    for (std::vector<std::uint32_t>& plane : seen) plane.assign(points_.size(), kNone);
    is_corner_.assign(points_.size(), 0);
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      for (const std::uint32_t p : triangles_[t].vertices) {
        std::uint32_t kept = 0;
        while (kept < 2 && seen[kept][p] != kNone && seen[kept][p] != plane_[t]) ++kept;
        if (kept == 2) is_corner_[p] = 1;
        else seen[kept][p] = plane_[t];
      }
    }
  }
  void find_rims() {
    first_triangle_.assign(planes_, kNone);
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      if (first_triangle_[plane_[t]] == kNone && has_rim(t)) first_triangle_[plane_[t]] = t;
    }
  }
  bool has_rim(std::uint32_t t) const {
    for (const std::uint32_t neighbour : triangles_[t].neighbours) {
      if (plane_[neighbour] != plane_[t]) return true;
    }
    return false;
  }
  /// The loop of points along the rim of the plane's triangles.
  std::vector<std::uint32_t> loop_of(std::uint32_t plane) const {
    std::uint32_t t = first_triangle_[plane];
    int edge = 0;
    while (plane_[triangles_[t].neighbours[edge]] == plane) ++edge;
    const std::uint32_t start_triangle = t;
    const int start_edge = edge;
    std::vector<std::uint32_t> loop;
    do {
      const std::uint32_t from = triangles_[t].vertices[edge], to = triangles_[t].vertices[(edge + 1) % 3];
      if (is_corner_[from]) loop.push_back(from);
      edge = (edge + 1) % 3;  // turns about `to` until the rim goes on
      while (plane_[triangles_[t].neighbours[edge]] == plane) {
        t = triangles_[t].neighbours[edge];
        edge = 0;
        while (triangles_[t].vertices[edge] != to) ++edge;
      }
    } while (t != start_triangle || edge != start_edge);
    return loop;
  }

  std::span<const GridPoint> points_;
  std::span<const HullTriangle> triangles_;
  std::vector<std::uint32_t> plane_;  // by triangle
  std::uint32_t planes_ = 0;
  std::vector<std::uint8_t> is_corner_;        // by point
  std::vector<std::uint32_t> first_triangle_;  // by plane: one at the rim
  std::vector<std::vector<std::uint32_t>> loops_;
};

std::uint64_t pair_of(std::uint64_t from, std::uint64_t to) { return from << 32 | to; }
struct LoopKey {
  std::uint64_t operator()(const std::vector<std::uint32_t>& loop) const { return pair_of(loop[0], loop[1]); }
};

/// Puts the faces in order: they ascend by their first edge, which starts at their lowest vertex.
std::vector<std::vector<std::uint32_t>> in_order(const FaceLoops& faces, std::span<const std::uint32_t> vertex_of) {
  std::vector<std::vector<std::uint32_t>> loops;
  for (const std::vector<std::uint32_t>& loop : faces.loops()) {
    std::size_t lowest = 0;
    for (std::size_t i = 1; i < loop.size(); ++i) {
      if (loop[i] < loop[lowest]) lowest = i;
    }
    std::vector<std::uint32_t> turned;
    for (std::size_t i = 0; i < loop.size(); ++i) turned.push_back(vertex_of[loop[(lowest + i) % loop.size()]]);
    loops.push_back(std::move(turned));
  }
  sort(loops, LoopKey{});
  return loops;
}

void link(ConvexHull& hull, std::span<const std::vector<std::uint32_t>> loops, std::span<const std::uint64_t> edges) {
  const auto half_edge = [&](std::uint32_t from, std::uint32_t to) {
    const std::uint64_t edge = from < to ? pair_of(from, to) : pair_of(to, from);
    const std::size_t at = lower_bound(edges.size(), [&](std::size_t k) { return edges[k] < edge; });
    return static_cast<std::uint8_t>(2 * at + (from < to ? 0 : 1));
  };
  hull.half_edges.resize(2 * edges.size());
  for (std::size_t f = 0; f < loops.size(); ++f) {
    const std::vector<std::uint32_t>& loop = loops[f];
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const std::uint32_t from = loop[i], to = loop[(i + 1) % loop.size()], after = loop[(i + 2) % loop.size()];
      hull.half_edges[half_edge(from, to)] = {static_cast<std::uint8_t>(from), half_edge(to, after),
                                              static_cast<std::uint8_t>(f)};
    }
    hull.faces.push_back(half_edge(loop[0], loop[1]));
  }
}

/// [steps] The longest side of the box around the points.
std::int64_t width_of(std::span<const GridPoint> points) {
  GridPoint low = points[0], high = points[0];
  for (const GridPoint p : points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  const GridVector size = high - low;
  return std::max(size.x, std::max(size.y, size.z));
}

/// Returns true if every face is thick enough: the vertex furthest below it is `least` [steps] deep or more.
bool is_thick(const ConvexHull& hull) {
  const std::int64_t least = std::max(ConvexHull::kLeastThickness, width_of(hull.vertices) / ConvexHull::kMostSlender);
  for (std::uint32_t f = 0; f < hull.faces.size(); ++f) {
    const GridVector normal = hull.normal(static_cast<std::uint8_t>(f));
    const GridPoint at = hull.vertices[hull.half_edges[hull.faces[f]].origin];
    std::int64_t deepest = 0;
    for (const GridPoint vertex : hull.vertices) deepest = std::max(deepest, dot(normal, at - vertex));
    if (Int128(deepest) * deepest < Int128(least * least) * squared_length(normal)) return false;
  }
  return true;
}

}  // namespace

GridVector ConvexHull::normal(std::uint8_t face) const {
  const HalfEdge& first = half_edges[faces[face]];
  const HalfEdge& second = half_edges[first.next];
  const GridPoint at = vertices[second.origin];
  return cross(at - vertices[first.origin], vertices[half_edges[second.next].origin] - at);
}

Result<std::vector<GridPoint>> simplified(std::span<const GridPoint> points, std::uint32_t count) {
  return pin_floats([&]() -> Result<std::vector<GridPoint>> {
    if (count < 4) return error(ErrorCode::invalid, "fewer than 4 points are asked for");
    std::vector<GridPoint> distinct;
    if (!take_distinct(points, distinct)) return out_of_grid();
    const std::vector<HullTriangle> triangles = Quickhull(distinct).run(count);
    if (triangles.empty()) return no_volume();
    std::vector<std::uint8_t> is_vertex(distinct.size(), 0);
    for (const HullTriangle& triangle : triangles) {
      for (const std::uint32_t p : triangle.vertices) is_vertex[p] = 1;
    }
    std::vector<GridPoint> kept;
    for (std::size_t p = 0; p < distinct.size(); ++p) {
      if (is_vertex[p]) kept.push_back(distinct[p]);
    }
    return kept;
  });
}

Result<ConvexHull> convex_hull(std::span<const GridPoint> points) {
  return pin_floats([&]() -> Result<ConvexHull> {
    std::vector<GridPoint> distinct;
    if (!take_distinct(points, distinct)) return out_of_grid();
    const std::vector<HullTriangle> triangles = Quickhull(distinct).run();
    if (triangles.empty()) return no_volume();
    const FaceLoops faces(distinct, triangles);
    const std::vector<std::uint32_t> corners = faces.corners();
    if (corners.size() > ConvexHull::kMaxVertices)
      return too_many(corners.size(), "vertices", ConvexHull::kMaxVertices);
    if (faces.loops().size() > ConvexHull::kMaxFaces)
      return too_many(faces.loops().size(), "faces", ConvexHull::kMaxFaces);

    ConvexHull hull;
    std::vector<std::uint32_t> vertex_of(distinct.size(), kNone);
    for (const std::uint32_t corner : corners) {
      vertex_of[corner] = static_cast<std::uint32_t>(hull.vertices.size());
      hull.vertices.push_back(distinct[corner]);
    }
    const std::vector<std::vector<std::uint32_t>> loops = in_order(faces, vertex_of);
    std::vector<std::uint64_t> edges;
    for (const std::vector<std::uint32_t>& loop : loops) {
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const std::uint32_t from = loop[i], to = loop[(i + 1) % loop.size()];
        if (from < to) edges.push_back(pair_of(from, to));
      }
    }
    if (edges.size() > ConvexHull::kMaxEdges) return too_many(edges.size(), "edges", ConvexHull::kMaxEdges);
    sort(edges, NumberKey{});
    link(hull, loops, edges);
    if (!is_thick(hull))
      return error(ErrorCode::invalid,
                   "the points are flat: thinner than 4 steps of the grid or 1/1024 of their width");
    return hull;
  });
}

}  // namespace isostep
