// glTF, FBX, COLLADA, STL, PLY and more, by assimp.
// SPDX-License-Identifier: MIT
#include "source_mesh.hpp"
#include "tool/common/files.hpp"
#include "tool/common/tool.hpp"

#ifdef ISOSTEP_HAS_ASSIMP

#include <assimp/scene.h>

#include <assimp/Importer.hpp>

namespace isostep::tool::bake {
namespace {

/// [file's units] The transform from a node's frame to the file's.
struct Placement {
  double rows[3][4];

  static Placement of(const aiMatrix4x4& m) {
    return {{{m.a1, m.a2, m.a3, m.a4}, {m.b1, m.b2, m.b3, m.b4}, {m.c1, m.c2, m.c3, m.c4}}};
  }
  Vec3<double> operator()(const aiVector3D& p) const {
    const auto row = [&](int i) { return rows[i][0] * p.x + rows[i][1] * p.y + rows[i][2] * p.z + rows[i][3]; };
    return {row(0), row(1), row(2)};
  }
  Vec3<double> column(int k) const { return {rows[0][k], rows[1][k], rows[2][k]}; }
  bool is_mirror() const { return dot(cross(column(0), column(1)), column(2)) < 0; }
};

class Nodes {
 public:
  Nodes(const aiScene& scene, const std::string& path) : scene_(scene), path_(path) {
    for (unsigned i = 0; i < scene.mNumMaterials; ++i)
      mesh_.materials.push_back(scene.mMaterials[i]->GetName().C_Str());
  }
  SourceMesh run() {
    if (scene_.mRootNode != nullptr) add_node(*scene_.mRootNode, aiMatrix4x4());
    return std::move(mesh_);
  }

 private:
  void add_node(const aiNode& node, const aiMatrix4x4& parent) {
    const aiMatrix4x4 own = parent * node.mTransformation;
    for (unsigned i = 0; i < node.mNumMeshes; ++i) add_mesh(*scene_.mMeshes[node.mMeshes[i]], node, Placement::of(own));
    for (unsigned i = 0; i < node.mNumChildren; ++i) add_node(*node.mChildren[i], own);
  }
  /// A mirror turns faces inside out; their corners are taken backwards.
  void add_mesh(const aiMesh& mesh, const aiNode& node, const Placement& place) {
    const auto first = static_cast<std::uint32_t>(mesh_.points.size());
    const std::uint32_t object = place_of(node.mName.C_Str(), mesh_.objects);
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) mesh_.points.push_back(place(mesh.mVertices[i]));
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const aiFace& face = mesh.mFaces[f];
      if (face.mNumIndices < 3) {
        ++mesh_.bare;
        continue;
      }
      mesh_.faces.push_back({mesh_.corners.size(), face.mNumIndices, mesh.mMaterialIndex, object});
      for (unsigned i = 0; i < face.mNumIndices; ++i) {
        const unsigned corner = face.mIndices[place.is_mirror() ? face.mNumIndices - 1 - i : i];
        if (corner >= mesh.mNumVertices)
          throw ToolError(exit_status::kUsage, path_ + ": a face names vertex " + std::to_string(corner) + " of " +
                                                   std::to_string(mesh.mNumVertices));
        mesh_.corners.push_back(first + corner);
      }
    }
  }

  const aiScene& scene_;
  const std::string& path_;
  SourceMesh mesh_;
};

}  // namespace

SourceMesh read_by_assimp(const std::string& path) {
  read_file(path);  // which names the system's reason
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile(path, 0);
  if (scene == nullptr) throw ToolError(exit_status::kUsage, path + ": " + importer.GetErrorString());
  return Nodes(*scene, path).run();
}

}  // namespace isostep::tool::bake

#else

namespace isostep::tool::bake {

SourceMesh read_by_assimp(const std::string& path) {
  read_file(path);
  throw ToolError(exit_status::kUnavailable,
                  "files other than OBJ are read by assimp, which was not there when this was built: install "
                  "libassimp-dev and configure again");
}

}  // namespace isostep::tool::bake

#endif
