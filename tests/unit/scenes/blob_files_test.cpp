// Baked files in scenes: they are what the same numbers in the scene are, and what is wrong with one is named.
// SPDX-License-Identifier: MIT
#include "scenes/blob_files.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "isostep/geometry/blob_file.hpp"
#include "isostep/store/state.hpp"
#include "isostep/world/world.hpp"
#include "own_folder.hpp"
#include "scenes/build.hpp"
#include "scenes/scene_file.hpp"

namespace isostep::scenes {
namespace blob_files_test {

const std::string kFloor =
    R"("type": "mesh", "vertices": [[-9, 0, -9], [-9, 0, 9], [9, 0, 9], [9, 0, -9]],
       "triangles": [[0, 1, 2], [0, 2, 3]])";
const std::string kRock = R"("type": "hull", "points": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])";
const std::string kField =
    R"("type": "height_field", "columns": 2, "rows": 2, "pitch": 1, "heights": [0, 0, 0.5, 0.25])";

std::string scene_of(const std::string& still, const std::string& moving) {
  return R"({"bodies": [{"type": "static", "shapes": [{)" + still +
         R"(}]}, {"type": "dynamic", "position": [0, 2, 0], "shapes": [{)" + moving + "}]}]}";
}
std::string baked(const std::string& type, const std::string& file) {
  return "\"type\": \"" + type + "\", \"file\": \"" + file + "\"";
}

class BakedFiles : public OwnFolder {
 protected:
  void SetUp() override {
    OwnFolder::SetUp();
    const Scene scene = read_scene(scene_of(kFloor + "}, {" + kField, kRock));
    World<double> world(settings_of<double>(scene));
    build(scene, world);
    for (const BlobRef& blob : world.state().geometry->contents())
      file(std::string(kShapeNames[static_cast<std::size_t>(blob->type())]) + ".blob", blob_file(*blob));
  }
  Scene read(const std::string& json) const { return read_scene(json, folder_.string()); }
  std::uint64_t hash_of(const Scene& scene) const {
    World<float> world(settings_of<float>(scene));
    build(scene, world);
    for (int i = 0; i < 60; ++i) world.step();
    return world.hash();
  }
  std::string refusal(const std::string& json) const {
    try {
      hash_of(read(json));
    } catch (const SceneError& error) {
      return error.what();
    }
    return {};
  }
};

TEST_F(BakedFiles, AreWhatTheirNumbersAre) {
  const Scene numbers = read(scene_of(kFloor, kRock));
  const Scene files = read(scene_of(baked("mesh", "mesh.blob"), baked("hull", "hull.blob")));
  EXPECT_EQ(hash_of(files), hash_of(numbers));
  EXPECT_NE(hash_of(read(scene_of(baked("height_field", "height_field.blob"), kRock))), hash_of(numbers));
  const Scene again = read(write_scene(files));
  EXPECT_EQ(write_scene(again), write_scene(files));
  EXPECT_EQ(hash_of(again), hash_of(numbers));
}

TEST_F(BakedFiles, MayBeInOtherFolders) {
  std::filesystem::create_directory(folder_ / "a \"b\" \\c");
  std::filesystem::rename(folder_ / "hull.blob", folder_ / "a \"b\" \\c" / "d.blob");
  const Scene scene = read(scene_of(kFloor, baked("hull", R"(a \"b\" \\c/d.blob)")));
  EXPECT_EQ(hash_of(read(write_scene(scene))), hash_of(read(scene_of(kFloor, kRock))));
}

TEST_F(BakedFiles, OfHullsMayHaveARadius) {
  const std::string radius = R"(, "radius": 0.125)";
  const Scene file = read(scene_of(kFloor, baked("hull", "hull.blob") + radius)),
              numbers = read(scene_of(kFloor, kRock + radius));
  EXPECT_EQ(hash_of(file), hash_of(numbers));
  EXPECT_NE(hash_of(file), hash_of(read(scene_of(kFloor, kRock))));
  EXPECT_EQ(hash_of(read(write_scene(file))), hash_of(file));
  EXPECT_EQ(hash_of(read(write_scene(numbers))), hash_of(numbers));
  EXPECT_NE(write_scene(file).find(radius), std::string::npos);
  EXPECT_EQ(write_scene(read(scene_of(kFloor, kRock))).find("radius"), std::string::npos);
  EXPECT_EQ(refusal(scene_of(kFloor, baked("hull", "hull.blob") + R"(, "radius": -1)")),
            "/bodies/1/shapes/0/radius: a hull's radius is below 0 or above the scalar's largest extent");
  EXPECT_EQ(refusal(scene_of(baked("mesh", "mesh.blob") + radius, kRock)), "/bodies/0/shapes/0/radius: unknown key");
}

TEST_F(BakedFiles, OfOneNameAreOneShape) {
  const std::string rock = baked("hull", "hull.blob");
  const Scene scene = read(scene_of(kFloor, rock + "}, {" + rock + R"(, "position": [2, 0, 0])"));
  EXPECT_EQ(scene.bodies[1].parts[0].blob, scene.bodies[1].parts[1].blob);
}

TEST_F(BakedFiles, ThatAreWrongAreNamed) {
  const std::string place = "/bodies/1/shapes/0/file: ";
  const auto said = [&](const std::string& part) { return refusal(scene_of(kFloor, part)); };
  EXPECT_EQ(said(baked("hull", "none.blob")), place + "none.blob: No such file or directory");
  EXPECT_EQ(said(baked("hull", ".")).rfind(place + ".: ", 0), 0u) << said(baked("hull", "."));
  EXPECT_EQ(said(baked("hull", "")), place + "expected the name of a file");
  EXPECT_EQ(said(baked("hull", "mesh.blob")), place + "mesh.blob: expected a baked hull, found a mesh");
  file("text.blob", {'h', 'e', 'l', 'l', 'o', '!', '!', '!', '!'});
  EXPECT_EQ(
      said(baked("hull", "text.blob")),
      place + "text.blob: expected a blob that `isostep bake` wrote: the file does not begin as a baked blob does");
  std::filesystem::resize_file(folder_ / "hull.blob", 60);
  EXPECT_EQ(said(baked("hull", "hull.blob")).rfind(place + "hull.blob: expected a blob that `isostep bake` wrote: ", 0),
            0u);
  file("forged.blob", blob_file(*Blob::make(ShapeType::hull, {1, 2, 3})));
  EXPECT_EQ(said(baked("hull", "forged.blob")), place + "forged.blob: a blob's bytes make no shape of its type");
}

TEST_F(BakedFiles, StandAloneAndForShapesThatHaveBlobs) {
  EXPECT_EQ(refusal(scene_of(kFloor, kRock + R"(, "file": "hull.blob")")),
            "/bodies/1/shapes/0/points: what \"file\" holds has no other sizes");
  EXPECT_EQ(refusal(scene_of(kFloor, R"("type": "sphere", "radius": 1, "file": "hull.blob")")),
            "/bodies/1/shapes/0/file: unknown key");
  EXPECT_EQ(refusal(scene_of(kFloor, R"("type": "hull", "file": 3)")),
            "/bodies/1/shapes/0/file: expected a string, found a number");
}

}  // namespace blob_files_test
}  // namespace isostep::scenes
