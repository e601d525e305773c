// Bodies of mesh_topology.hpp.
// SPDX-License-Identifier: MIT
#include "mesh_topology.hpp"

#include <utility>

#include "isostep/core/stable_sort.hpp"

namespace isostep {
namespace {

constexpr std::uint32_t kUnplaced = 0xffffffffu;

// ---- points

struct IndexedPoint {
  MeshPoint point;
  std::uint32_t index;
};
std::uint64_t digits(std::int32_t v) { return static_cast<std::uint64_t>(v + MeshPoint::kLimit); }
struct KeyZ {
  std::uint64_t operator()(const IndexedPoint& p) const { return digits(p.point.z); }
};
struct KeyXY {
  std::uint64_t operator()(const IndexedPoint& p) const { return digits(p.point.x) << 24 | digits(p.point.y); }
};

template <class Record, class Key>
void sort(std::vector<Record>& records, std::vector<Record>& scratch, const Key& key) {
  stable_sort(records.data(), scratch.data(), static_cast<std::uint32_t>(records.size()), key);
}

/// Returns for each point the first one with its coordinates.
std::vector<std::uint32_t> first_equals(std::span<const MeshPoint> points) {
  std::vector<IndexedPoint> sorted(points.size()), scratch(points.size());
  for (std::uint32_t i = 0; i < points.size(); ++i) sorted[i] = {points[i], i};
  sort(sorted, scratch, KeyZ{});
  sort(sorted, scratch, KeyXY{});
  std::vector<std::uint32_t> first(points.size());
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    const bool is_first = i == 0 || !(sorted[i].point == sorted[i - 1].point);
    first[sorted[i].index] = is_first ? sorted[i].index : first[sorted[i - 1].index];
  }
  return first;
}

// ---- edges

/// Edge k of triangle t is half-edge 3 t + k.
struct HalfEdgeRecord {
  std::uint64_t ends;  // the lower vertex, the higher vertex
  std::uint32_t half_edge;
};
struct EndsKey {
  std::uint64_t operator()(const HalfEdgeRecord& record) const { return record.ends; }
};

class EdgeFinder {
 public:
  explicit EdgeFinder(const WeldedMesh& mesh) : mesh_(mesh), edges_(mesh.triangles.size()) {}

  /// Groups half-edges with the same ends, and makes each group an edge.
  Result<std::vector<MeshEdges>> run() {
    const std::vector<HalfEdgeRecord> sorted = sorted_half_edges();
    std::size_t end = 0;
    for (std::size_t begin = 0; begin < sorted.size(); begin = end) {
      end = begin + 1;
      while (end < sorted.size() && sorted[end].ends == sorted[begin].ends) ++end;
      const std::span<const HalfEdgeRecord> group(sorted.data() + begin, end - begin);
      if (group.size() == 1) continue;
      if (group.size() > 2 || from(group[0].half_edge) == from(group[1].half_edge)) return fault_of(group);
      link(group[0].half_edge, group[1].half_edge);
    }
    return std::move(edges_);
  }

 private:
  std::vector<HalfEdgeRecord> sorted_half_edges() const {
    std::vector<HalfEdgeRecord> sorted(3 * mesh_.triangles.size()), scratch(sorted.size());
    for (std::uint32_t h = 0; h < sorted.size(); ++h) {
      const std::uint64_t a = from(h), b = to(h);
      sorted[h] = {a < b ? a << 32 | b : b << 32 | a, h};
    }
    sort(sorted, scratch, EndsKey{});
    return sorted;
  }

  std::uint32_t vertex(std::uint32_t half_edge, std::uint32_t beyond) const {
    return mesh_.triangles[half_edge / 3].vertices[(half_edge + beyond) % 3];  // 3 t + k + beyond: t falls out
  }
  std::uint32_t from(std::uint32_t half_edge) const { return vertex(half_edge, 0); }
  std::uint32_t to(std::uint32_t half_edge) const { return vertex(half_edge, 1); }
  std::uint32_t off(std::uint32_t half_edge) const { return vertex(half_edge, 2); }

  void link(std::uint32_t one, std::uint32_t other) {
    const auto point = [&](std::uint32_t v) { return mesh_.points[v]; };
    const EdgeKind kind = edge_kind(point(from(one)), point(to(one)), point(off(one)), point(off(other)));
    edges_[one / 3].edges[one % 3] = MeshEdge(other / 3, other % 3, kind);
    edges_[other / 3].edges[other % 3] = MeshEdge(one / 3, one % 3, kind);
  }

  /// The error of a group that is no border and no pair of neighbours. Half-edges of a group ascend.
  Error fault_of(std::span<const HalfEdgeRecord> group) const {
    for (std::size_t j = 1; j < group.size() && j < 64; ++j) {  // enough to name one
      for (std::size_t i = 0; i < j; ++i) {
        const std::uint32_t a = group[i].half_edge, b = group[j].half_edge;
        if (from(a) == from(b) && off(a) == off(b)) return error("is there already, as triangle ", a, b);
      }
    }
    if (group.size() == 2) return error("runs along an edge in the same direction as triangle ", group[0], group[1]);
    Error fault = error("is the third at an edge of triangle ", group[0], group[2]);
    fault.message.append(": ").append_number(group.size()).append(" are there, at most 2 are possible");
    return fault;
  }
  static Error error(const char* what, const HalfEdgeRecord& other, const HalfEdgeRecord& at) {
    return error(what, other.half_edge, at.half_edge);
  }
  static Error error(const char* what, std::uint32_t other, std::uint32_t at) {
    Error error{ErrorCode::invalid, "the triangle ", "triangles["};
    error.message.append(what).append_number(other / 3);
    error.place.append_number(at / 3).append("]");
    return error;
  }

  const WeldedMesh& mesh_;
  std::vector<MeshEdges> edges_;
};

}  // namespace

WeldedMesh weld(std::span<const MeshPoint> points, std::span<const MeshTriangle> triangles) {
  const std::vector<std::uint32_t> first = first_equals(points);
  std::vector<std::uint32_t> place(points.size(), kUnplaced);
  WeldedMesh mesh;
  mesh.triangles.assign(triangles.begin(), triangles.end());
  for (MeshTriangle& triangle : mesh.triangles) {
    for (std::uint32_t& vertex : triangle.vertices) {
      std::uint32_t& to = place[first[vertex]];
      if (to == kUnplaced) {
        to = static_cast<std::uint32_t>(mesh.points.size());
        mesh.points.push_back(points[vertex]);
      }
      vertex = to;
    }
  }
  mesh.points.shrink_to_fit();
  return mesh;
}

Result<std::vector<MeshEdges>> find_edges(const WeldedMesh& mesh) { return EdgeFinder(mesh).run(); }

}  // namespace isostep
