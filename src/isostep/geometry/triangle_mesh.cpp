// Triangle meshes: what is refused, and their canonical bytes.
// SPDX-License-Identifier: MIT
#include "isostep/geometry/baked/triangle_mesh.hpp"

#include <algorithm>
#include <utility>

#include "isostep/state/archive.hpp"
#include "material_table.hpp"
#include "mesh_topology.hpp"

namespace isostep {
namespace {

static_assert(kHasNoPadding<MeshPoint> && kHasNoPadding<MeshTriangle>);

Error fault_at(const char* list, std::uint64_t index, ShortText<112> message) {
  Error fault{ErrorCode::invalid, message, list};
  fault.place.append("[").append_number(index).append("]");
  return fault;
}
Error too_many(const char* list, std::uint64_t count, std::uint32_t limit) {
  ShortText<112> message;
  message.append_number(count).append(" ").append(list).append(", at most ").append_number(limit);
  return {ErrorCode::limit, message.append(" are possible"), list};
}

Result<void> check_counts(std::uint64_t points, std::uint64_t triangles, std::uint64_t materials, int exponent) {
  if (exponent < 0 || exponent > TriangleMesh::kMaxExponent)
    return Error{ErrorCode::invalid, "the exponent of a step is 0 to 16", "exponent"};
  if (triangles == 0) return Error{ErrorCode::invalid, "there are no triangles", "triangles"};
  if (triangles > TriangleMesh::kMaxTriangles) return too_many("triangles", triangles, TriangleMesh::kMaxTriangles);
  if (points > TriangleMesh::kMaxPoints) return too_many("points", points, TriangleMesh::kMaxPoints);
  if (materials == 0 || materials == triangles) return {};
  ShortText<112> message;
  message.append_number(materials).append(" materials for ").append_number(triangles).append(" triangles");
  return Error{ErrorCode::invalid, message, "materials"};
}

Result<void> check_materials(const SurfaceMaterials& materials) {
  const auto is_ghost = [](std::uint8_t number) { return number == kGhostMaterial; };
  if (!materials.numbers.empty() && std::all_of(materials.numbers.begin(), materials.numbers.end(), is_ghost))
    return Error{ErrorCode::invalid, "every triangle is a ghost", "materials"};
  return check_table(materials.table);
}

Result<void> check_points(std::span<const MeshPoint> points) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].in_range()) return fault_at("points", i, "a coordinate has more than 23 bits and a sign");
  }
  return {};
}

Result<void> check_triangles(std::span<const MeshPoint> points, std::span<const MeshTriangle> triangles) {
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (const std::uint32_t vertex : triangles[i].vertices) {
      if (vertex < points.size()) continue;
      ShortText<112> message = "vertex ";
      message.append_number(vertex).append(" of ").append_number(points.size()).append(" points");
      return fault_at("triangles", i, message);
    }
    const std::uint32_t(&v)[3] = triangles[i].vertices;
    const GridVector normal = cross(points[v[1]] - points[v[0]], points[v[2]] - points[v[0]]);
    if (normal == GridVector{0, 0, 0})
      return fault_at("triangles", i, "the triangle has no area: its points lie on a line");
  }
  return {};
}

/// The tree over the triangles that are no ghosts, one or more.
MeshTree tree_of(const WeldedMesh& mesh, std::span<const std::uint8_t> materials) {
  std::vector<MeshBox> boxes;
  std::vector<std::uint32_t> ids;
  boxes.reserve(mesh.triangles.size());
  ids.reserve(mesh.triangles.size());
  for (std::uint32_t id = 0; id < mesh.triangles.size(); ++id) {
    if (materials[id] == kGhostMaterial) continue;
    MeshBox box = MeshBox::empty();
    for (const std::uint32_t vertex : mesh.triangles[id].vertices) box.add(mesh.points[vertex]);
    boxes.push_back(box);
    ids.push_back(id);
  }
  MeshTree tree = MeshTree::build(boxes);
  tree.rename(ids);
  return tree;
}

}  // namespace

Result<TriangleMesh> triangle_mesh(std::span<const MeshPoint> points, std::span<const MeshTriangle> triangles,
                                   const SurfaceMaterials& materials, int exponent) {
  const Result<void> counts = check_counts(points.size(), triangles.size(), materials.numbers.size(), exponent);
  if (!counts) return counts.error();
  const Result<void> named = check_materials(materials);
  if (!named) return named.error();
  const Result<void> in_range = check_points(points);
  if (!in_range) return in_range.error();
  const Result<void> sound = check_triangles(points, triangles);
  if (!sound) return sound.error();
  WeldedMesh welded = weld(points, triangles);
  Result<std::vector<MeshEdges>> edges = find_edges(welded);
  if (!edges) return edges.error();

  TriangleMesh mesh;
  mesh.exponent_ = exponent;
  mesh.materials_.assign(materials.numbers.begin(), materials.numbers.end());
  mesh.materials_.resize(triangles.size(), 0);
  mesh.table_.assign(materials.table.begin(), materials.table.end());
  mesh.tree_ = tree_of(welded, mesh.materials_);
  mesh.points_ = std::move(welded.points);
  mesh.triangles_ = std::move(welded.triangles);
  mesh.edges_ = std::move(edges.value());
  return mesh;
}

BakedTriangle TriangleMesh::triangle(std::uint32_t id) const {
  BakedTriangle baked = {corners(id), {}, {}, materials_[id]};
  for (int k = 0; k < 3; ++k) {
    const MeshEdge across = edges_[id].edges[k];
    baked.edges[k] = across.kind();
    if (baked.edges[k] == EdgeKind::border) continue;
    baked.opposite[k] = points_[triangles_[across.triangle()].vertices[(across.edge() + 2) % 3]];
  }
  return baked;
}

std::size_t TriangleMesh::memory() const {
  return sizeof(*this) - sizeof(tree_) + tree_.memory() + points_.size() * sizeof(MeshPoint) +
         triangles_.size() * (sizeof(MeshTriangle) + sizeof(MeshEdges) + sizeof(std::uint8_t)) +
         table_.size() * sizeof(SurfaceMaterial);
}

std::vector<std::uint8_t> TriangleMesh::bytes() const {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(12 + points_.size() * sizeof(MeshPoint) + triangles_.size() * (sizeof(MeshTriangle) + 1));
  Writer writer(bytes);
  writer.write(static_cast<std::uint32_t>(exponent_));
  writer.write_array(points_);
  writer.write_array(triangles_);
  writer.write_raw(materials_);
  write_table(writer, table_);
  return bytes;
}

Result<TriangleMesh> read_triangle_mesh(Bytes bytes) {
  Reader reader(bytes);
  std::uint32_t exponent = 0;
  std::vector<MeshPoint> points;
  std::vector<MeshTriangle> triangles;
  reader("exponent", exponent);
  if (exponent > std::uint32_t{TriangleMesh::kMaxExponent}) reader.fail(ErrorCode::invalid, "an exponent above 16");
  reader.read_array(points, TriangleMesh::kMaxPoints);
  reader.read_array(triangles, TriangleMesh::kMaxTriangles);
  const Bytes materials = reader.read_view(triangles.size());
  const std::vector<SurfaceMaterial> table = read_table(reader);
  reader.expect_end();
  const Result<void> whole = reader.result("triangle mesh");
  if (!whole) return whole.error();
  Result<TriangleMesh> mesh = triangle_mesh(points, triangles, {materials, table}, static_cast<int>(exponent));
  if (!mesh) return mesh;
  const std::span<const MeshPoint> kept = mesh.value().points();
  bool is_canonical = kept.size() == points.size();
  for (std::size_t i = 0; is_canonical && i < kept.size(); ++i) is_canonical = kept[i] == points[i];
  if (is_canonical) return mesh;
  return Error{ErrorCode::corrupt, "points are not each used, once, in the order of the triangles", "points"};
}

}  // namespace isostep
