// isostep bake: files of polygons become blobs that scenes load. Where a library is missing, the command names it.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

#include "isostep/geometry/baked/surface_blob.hpp"
#include "isostep/geometry/blob_file.hpp"
#include "tool/common/tool.hpp"
#include "unit/tool/command_line.hpp"

namespace isostep::tool {
namespace bake_test {

class Bake : public CommandLine {
 protected:
  /// A file of that ending cannot be read: then the answer says what to install, and nothing is written.
  bool is_refused_for_lack(const std::string& ending) {
    write("probe." + ending, "");
    const Answer answer = run({"bake", path("probe." + ending), "-o", path("probe.blob")});
    if (answer.status != 69) return false;
    expect_one_line(answer, 69, ending == "obj" ? "libtinyobjloader-dev" : "libassimp-dev");
    EXPECT_EQ(files(), 1u);
    return true;
  }
  Answer bake(const std::string& name, std::vector<std::string> more = {}) {
    std::vector<std::string> words = {"bake", path(name), "-o", path("out.blob")};
    words.insert(words.end(), more.begin(), more.end());
    return run(words);
  }
  /// The output of `--json` for an OBJ file with this text.
  nlohmann::json baked(const std::string& obj, std::vector<std::string> more = {}) {
    write("a.obj", obj);
    more.push_back("--json");
    const Answer answer = bake("a.obj", more);
    EXPECT_EQ(answer.status, 0) << answer.err;
    return answer.status == 0 ? nlohmann::json::parse(answer.out) : nlohmann::json();
  }
  void expect_refused(const std::string& obj, const std::string& part, const std::vector<std::string>& more = {}) {
    write("a.obj", obj);
    expect_one_line(bake("a.obj", more), 64, part);
    EXPECT_FALSE(std::filesystem::exists(path("out.blob")));
  }
  BlobRef blob() const {
    const std::string bytes = read("out.blob");
    return read_blob_file({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}).value();
  }
};

std::string id_of(const BlobRef& blob) { return hex(blob->id().high) + hex(blob->id().low); }
std::string text_of(std::initializer_list<Vec3<double>> points) {
  std::string text;
  for (const Vec3<double>& p : points)
    text += "v " + std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z) + "\n";
  return text;
}

const std::string kTent = "v 0 0 0\nv 2 0 0\nv 1 1.5 .5\nv 0 0 1.\nv 2 0 1e0\n";
const std::vector<Vec3<double>> kTentPoints = {{0, 0, 0}, {2, 0, 0}, {1, 1.5, 0.5}, {0, 0, 1}, {2, 0, 1}};

TEST_F(Bake, MakesTheMeshThatTheLibraryMakesOfTheSameNumbers) {
  if (is_refused_for_lack("obj")) return;
  const auto said = baked(kTent + "usemtl wood\nf 1 3 2\nusemtl tin\r\nf -1/1/1 3//2 -2\nl 1 2\np 4\n");
  const MeshTriangle triangles[] = {{{0, 2, 1}}, {{4, 2, 3}}};
  const std::uint8_t materials[] = {0, 1};
  EXPECT_EQ(said["id"], id_of(mesh_blob(kTentPoints, triangles, materials).value()));
  EXPECT_EQ(said["id"], id_of(blob()));
  EXPECT_EQ(said["shape"], "mesh");
  EXPECT_EQ(said["triangles"], 2);
  EXPECT_EQ(said["vertices"], 5);
  EXPECT_EQ(said["materials"], (std::vector<std::string>{"wood", "tin"}));
  EXPECT_EQ(said["bytes"], read("out.blob").size());
  EXPECT_EQ(said["left_out"]["lines and single points"], 2);
  const Answer table = bake("a.obj");
  EXPECT_NE(table.out.find("2 triangles"), std::string::npos) << table.out;
  EXPECT_NE(table.out.find("1 \"tin\""), std::string::npos) << table.out;
  EXPECT_NE(table.out.find("left out"), std::string::npos) << table.out;
}

TEST_F(Bake, CutsPolygonsIntoTriangles) {
  if (is_refused_for_lack("obj")) return;
  const std::string steps = "v 0 0 0\nv 0 0 1\nv 1 0 1\nv 1 0 2\nv 2 0 2\nv 2 0 0\n";
  EXPECT_EQ(baked(steps + "f 1 2 3 4 5 6\n")["triangles"], 4);
  const auto mesh = read_triangle_mesh(blob()->bytes());
  ASSERT_TRUE(mesh.ok());
  std::int64_t area = 0;
  for (std::uint32_t i = 0; i < 4; ++i) {
    const TriangleCorners t = mesh.value().corners(i);
    const GridVector normal = cross(t.points[1] - t.points[0], t.points[2] - t.points[0]);
    EXPECT_GT(normal.y, 0);
    area += normal.y;
  }
  EXPECT_EQ(area, std::int64_t{6} << 32);  // twice 3 m^2, in steps of 2^-16 m
}

TEST_F(Bake, CountsWhatItLeavesOut) {
  if (is_refused_for_lack("obj")) return;
  const auto said = baked(kTent + "f 1 3 2\nf 1 1 2\nf 1 2 2\nf 3 2 1\nf 4 3\nf 1 3 2\nf 4 5 3\n");
  EXPECT_EQ(said["triangles"], 2);
  EXPECT_EQ(said["left_out"]["triangles without area"], 2);
  EXPECT_EQ(said["left_out"]["triangles that were there already"], 2);
  EXPECT_EQ(said["left_out"]["lines and single points"], 1);
}

TEST_F(Bake, TakesOneObjectUnitsAndAxes) {
  if (is_refused_for_lack("obj")) return;
  const std::string two = kTent + "o tent\nf 1 3 2\no far\nv 900 0 0\nf 4 5 6\n";
  const auto small = baked(two, {"--object", "tent"});
  EXPECT_EQ(small["exponent"], 16);
  EXPECT_EQ(small["id"], baked(kTent + "g other\nf 1 3 2\n")["id"]);
  EXPECT_EQ(baked(two)["exponent"], 13);
  expect_one_line(bake("a.obj", {"--object", "tents"}), 64, "\"tent\", \"far\"");
  EXPECT_EQ(baked("v 0 0 0\nv 200 0 0\nv 100 -50 150\nf 1 3 2\n", {"--scale", "0.01", "--up", "z"})["id"],
            baked(kTent + "f 1 3 2\n")["id"]);
  EXPECT_EQ(baked(kTent + "f 1 3 2\n", {"--exponent", "4"})["exponent"], 4);
}

TEST_F(Bake, RefusesWhatMakesNoMesh) {
  if (is_refused_for_lack("obj")) return;
  expect_refused("", "found none");
  expect_refused(kTent, "found none");
  expect_refused(kTent + "f 1 1 2\n", "none that has an area");
  expect_refused("v 0 0 0\nv 1 nan 0\nv 0 0 1\nf 1 2 3\n", "line 2: expected three numbers after v, found \"nan\"");
  expect_refused("v 0 0 0\rv 1 inf 0\rv 0 0 1\rf 1 2 3\r", "line 2: ");
  expect_refused("v 0 0 0\nv 1 0\nv 0 0 1\nf 1 2 3\n", "line 2: expected three numbers after v, found \"\"");
  expect_refused("v 0 0 0\r\nv 1 0x1 0\r\n", "line 2: ");
  expect_refused("v 0 0 0\nv 1e999 0 0\nv 0 0 1\nf 1 2 3\n", "not finite");
  expect_refused("v 0 0 0\nv 9e6 0 0\nv 0 0 1\nf 1 2 3\n", "expected 8388607 m at most");
  expect_refused("v 0 0 0\nv 200 0 0\nv 0 0 1\nf 1 2 3\n", "at most with this exponent", {"--exponent", "16"});
  for (const char* face : {"f 1 2 6", "f 1 0 2", "f 1 -6 2", "f 1 2 x"})
    expect_refused(kTent + face, "no vertex before");
  expect_refused(kTent + "o fin\nf 1 2 3\nf 2 1 4\nf 1 2 5\n", "is the third at an edge of triangle 0");
  expect_one_line(bake("a.obj"), 64, "in object \"fin\"");
  std::string many = kTent;
  for (int i = 0; i < 257; ++i) many += "usemtl m" + std::to_string(i) + "\nf 1 3 2\n";
  EXPECT_EQ(baked(many)["triangles"], 1);  // the others are the same triangle
  std::filesystem::remove(path("out.blob"));
  expect_refused(many + "f 4 5 3\n", "has material 256, expected 0 to 255");
}

TEST_F(Bake, MakesHullsWithinTheirLimits) {
  if (is_refused_for_lack("obj")) return;
  const auto said = baked(kTent + "f 1 3 2\nf 4 5 3\n", {"--as", "hull"});
  EXPECT_EQ(said["shape"], "hull");
  EXPECT_EQ(said["vertices"], 5);
  EXPECT_EQ(said["edges"], 8);
  EXPECT_EQ(said["faces"], 5);
  EXPECT_EQ(said["outside"], 0.0);
  EXPECT_EQ(blob()->type(), ShapeType::hull);
  std::filesystem::remove(path("out.blob"));
  std::string ball, face = "f";
  for (int i = 0; i < 200; ++i) {
    const double y = 1 - (2 * i + 1) / 200.0, r = std::sqrt(1 - y * y);
    ball += text_of({{r * std::cos(2.4 * i), y, r * std::sin(2.4 * i)}});
    face += " " + std::to_string(i + 1);
  }
  expect_refused(ball + face + "\n", "at most 128", {"--as", "hull"});
  expect_one_line(bake("a.obj", {"--as", "hull"}), 64, "--points N");
  const auto fewer = baked(ball + face + "\n", {"--as", "hull", "--points", "40"});
  EXPECT_EQ(fewer["vertices"], 40);
  EXPECT_GT(fewer["outside"], 0.01);
  EXPECT_LT(fewer["outside"], 0.2);
  std::filesystem::remove(path("out.blob"));
  expect_refused("v 0 0 0\nv 1 0 0\nv 0 0 1\nv 1 0 1\nf 1 2 3\nf 2 3 4\n", "no volume", {"--as", "hull"});
  expect_refused(kTent + "f 1 3 2\n", "--points is for --as hull", {"--points", "40"});
}

/// A glTF text and the binary file that it names.
std::string gltf_of(const std::string& nodes) {
  return R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": )" + nodes + R"(,
 "materials": [{"name": "wood"}, {"name": "tin"}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0},
                            {"attributes": {"POSITION": 0}, "indices": 2, "material": 1}]}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "count": 5, "type": "VEC3",
                "min": [0, 0, 0], "max": [2, 1.5, 1]},
               {"bufferView": 1, "componentType": 5125, "count": 3, "type": "SCALAR"},
               {"bufferView": 1, "byteOffset": 12, "componentType": 5125, "count": 3, "type": "SCALAR"}],
 "bufferViews": [{"buffer": 0, "byteLength": 60}, {"buffer": 0, "byteOffset": 60, "byteLength": 24}],
 "buffers": [{"uri": "a.bin", "byteLength": 84}]})";
}
std::vector<std::uint8_t> gltf_bytes(float first) {
  std::vector<std::uint8_t> bytes;
  const auto add = [&](std::uint32_t word) {
    bytes.resize(bytes.size() + 4);
    store_le(&bytes[bytes.size() - 4], word);
  };
  for (const Vec3<double>& p : kTentPoints) {
    const bool is_first = bytes.empty();
    for (const double x : {p.x, p.y, p.z})
      add(std::bit_cast<std::uint32_t>(is_first && x == p.x ? first : static_cast<float>(x)));
  }
  for (const std::uint32_t corner : {0u, 2u, 1u, 4u, 2u, 3u}) add(corner);
  return bytes;
}

TEST_F(Bake, ReadsGltfWithItsNodesAndMaterials) {
  if (is_refused_for_lack("gltf")) return;
  file("a.bin", gltf_bytes(0));
  const auto id_and_materials = [&](const std::string& nodes) {
    write("a.gltf", gltf_of(nodes));
    const Answer answer = bake("a.gltf", {"--json"});
    EXPECT_EQ(answer.status, 0) << answer.err;
    const auto said = nlohmann::json::parse(answer.out);
    EXPECT_EQ(said["materials"].at(0), "wood");
    EXPECT_EQ(said["materials"].at(1), "tin");
    return said["id"].get<std::string>();
  };
  const std::uint8_t materials[] = {0, 1};
  std::vector<Vec3<double>> points = kTentPoints;
  const MeshTriangle triangles[] = {{{0, 2, 1}}, {{4, 2, 3}}}, backwards[] = {{{1, 2, 0}}, {{3, 2, 4}}};
  EXPECT_EQ(id_and_materials(R"([{"mesh": 0}])"), id_of(mesh_blob(points, triangles, materials).value()));
  for (Vec3<double>& p : points) p = {2 * p.x + 3, 2 * p.y, 2 * p.z + 8};
  EXPECT_EQ(id_and_materials(R"([{"children": [1], "translation": [3, 0, 0], "scale": [2, 2, 2]},
                                 {"mesh": 0, "translation": [0, 0, 4]}])"),
            id_of(mesh_blob(points, triangles, materials).value()));
  points = kTentPoints;
  for (Vec3<double>& p : points) p.x = -p.x;
  EXPECT_EQ(id_and_materials(R"([{"mesh": 0, "scale": [-1, 1, 1]}])"),
            id_of(mesh_blob(points, backwards, materials).value()));
}

TEST_F(Bake, RefusesAGltfThatIsWrong) {
  if (is_refused_for_lack("gltf")) return;
  write("a.gltf", gltf_of(R"([{"mesh": 0}])"));
  EXPECT_EQ(bake("a.gltf").status, 64);  // there is no a.bin
  for (const float strange : {std::nanf(""), HUGE_VALF}) {
    file("a.bin", gltf_bytes(strange));
    expect_one_line(bake("a.gltf"), 64, "not finite");
  }
  write("a.xyz", "hello");
  expect_one_line(bake("a.xyz"), 64, "a.xyz");
  EXPECT_FALSE(std::filesystem::exists(path("out.blob")));
}

TEST_F(Bake, OfRandomBytesIsRefusedOrAMesh) {
  const std::string words[] = {"v 1 2 3\n", "f 1 2 3\n", "f -1 -2 -3 -4\n", "v ", "f ", "o a\n", "usemtl b\n",
                               "\r",        "9"};
  std::mt19937 random(17);
  for (int i = 0; i < 300; ++i) {
    std::string text;
    for (std::size_t k = random() % 60; k > 0; --k)
      text += random() % 3 == 0 ? std::string(1, static_cast<char>(random())) : words[random() % std::size(words)];
    const std::string name = i % 10 == 0 ? "a.gltf" : i % 10 == 1 ? "a.stl" : "a.obj";
    write(name, text);
    const Answer answer = bake(name, {"--as", i % 4 == 0 ? "hull" : "mesh"});
    EXPECT_TRUE(answer.status == 0 || answer.status == 64 || answer.status == 69) << answer.err << "\n" << text;
  }
}

TEST_F(Bake, SaysWhatItCannotReadOrWrite) {
  expect_one_line(run({"bake", path("none.obj"), "-o", path("a")}), 66, "none.obj");
  expect_one_line(run({"bake", path("none.gltf"), "-o", path("a")}), 66, "none.gltf");
  expect_one_line(run({"bake", path("none.obj")}), 64, "--out");
  expect_one_line(run({"bake", path("none.obj"), "-o", path("a"), "--as", "sphere"}), 64, "sphere");
  expect_one_line(run({"bake", path("none.obj"), "-o", path("a"), "--up", "x"}), 64, "--up");
  if (is_refused_for_lack("obj")) return;
  write("a.obj", kTent + "f 1 3 2\n");
  expect_one_line(run({"bake", path("a.obj"), "-o", path("no/such/folder")}), 74, "no/such/folder");
}

TEST_F(Bake, MakesTheExampleOfThePage) {
  if (is_refused_for_lack("obj")) return;
  const std::string files = ISOSTEP_SOURCE_DIR "/src/scenes/files/";
  ASSERT_EQ(run({"bake", files + "ramp.obj", "-o", path("out.blob")}).status, 0);
  EXPECT_EQ(read("out.blob"), content_of(files + "ramp.blob"));
}

/// Blobs made by the library, so also where nothing can be imported.
TEST_F(Bake, ARecordingOfASceneWithBakedFilesNeedsThemNoLonger) {
  const std::vector<Vec3<double>> floor = {{-9, 0, -9}, {-9, 0, 9}, {9, 0, 9}, {9, 0, -9}};
  const MeshTriangle triangles[] = {{{0, 1, 2}}, {{0, 2, 3}}};
  file("floor.blob", blob_file(*mesh_blob(floor, triangles).value()));
  write("scene.json", R"({"name": "floor", "frames": 50, "bodies": [
    {"type": "static", "shapes": [{"type": "mesh", "file": "floor.blob"}]},
    {"type": "dynamic", "position": [0, 1, 0], "shapes": [{"type": "sphere", "radius": 0.5}]}]})");
  for (const char* scalar : {"float", "q32.32"}) {
    const std::vector<std::string> words = {"run", path("scene.json"), "--scalar", scalar, "--record", path(scalar)};
    const Answer answer = run(words);
    EXPECT_EQ(answer.status, 0) << answer.err;
    EXPECT_NE(answer.out.find("1 of type mesh"), std::string::npos) << answer.out;
  }
  EXPECT_EQ(run({"selftest", path("scene.json"), "--frames", "20"}).status, 0);
  std::filesystem::remove(path("floor.blob"));
  expect_one_line(run({"run", path("scene.json")}), 64, "scene.json:/bodies/0/shapes/0/file: floor.blob: ");
  std::filesystem::remove(path("scene.json"));
  const Answer verified = run({"verify", path("float"), path("q32.32")});
  EXPECT_EQ(verified.status, 0) << verified.out << verified.err;
  EXPECT_NE(verified.out.find("2 of 2 verified"), std::string::npos) << verified.out;
}

}  // namespace bake_test
}  // namespace isostep::tool
