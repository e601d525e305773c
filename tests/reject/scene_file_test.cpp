// Scene files that are wrong: each is refused with the place and what was expected, and makes no scene.
// SPDX-License-Identifier: MIT
#include "scenes/scene_file.hpp"

#include <gtest/gtest.h>

#include <string>

#include "isostep/world/world.hpp"
#include "scenes/build.hpp"

namespace isostep::scenes {
namespace scene_file_test {

/// The error of reading, then building in S; empty for a scene that is accepted.
template <class S = float> std::string refusal(const std::string& json) {
  try {
    const Scene scene = read_scene(json);
    World<S> world(settings_of<S>(scene));
    build(scene, world);
  } catch (const SceneError& error) {
    return error.what();
  }
  return {};
}
std::string with_body(const std::string& members) {
  return R"({"bodies": [{"type": "dynamic", "shapes": [{"type": "sphere", "radius": 0.5}]}, {)" + members + "}]}";
}
const std::string kSphere = R"("type": "dynamic", "shapes": [{"type": "sphere", "radius": 0.5}])";
std::string with_joint(const std::string& joint) {
  return "{\"bodies\": [{" + kSphere + "}, {" + kSphere + ", \"position\": [0, 3, 0]}], \"joints\": [" + joint + "]}";
}

TEST(SceneFile, IsAcceptedInTheSmallestForm) {
  EXPECT_EQ(refusal(R"({"bodies": []})"), "");
  EXPECT_EQ(refusal(with_body(kSphere)), "");
}

TEST(SceneFile, ThatIsNoJsonIsRefusedWithLineAndColumn) {
  EXPECT_EQ(refusal("").rfind("1:1: ", 0), 0u) << refusal("");
  EXPECT_EQ(refusal("{\"bodies\": []\n  oops}").rfind("2:3: ", 0), 0u) << refusal("{\"bodies\": []\n  oops}");
  EXPECT_NE(refusal("{\"bodies\": []} {}"), "");
  EXPECT_NE(refusal("{\"bodies\": [],}"), "");
  EXPECT_NE(refusal("{\"bodies\": [] /* none */}"), "");
  EXPECT_NE(refusal("{'bodies': []}"), "");
  EXPECT_NE(refusal("{\"bodies\": [], \"name\": \"\xff\"}"), "");
  EXPECT_NE(refusal("{\"bodies\": [], \"gravity\": [0, NaN, 0]}"), "");
  EXPECT_NE(refusal("{\"bodies\": [], \"gravity\": [0, .5, 0]}"), "");
  EXPECT_NE(refusal("{\"bodies\": [], \"gravity\": [0, +5, 0]}"), "");
}

TEST(SceneFile, NestedWithoutEndIsRefused) {
  EXPECT_NE(refusal(std::string(100000, '[')).find("nested too deeply"), std::string::npos);
  std::string objects;
  for (int i = 0; i < 1000; ++i) objects += "{\"a\": ";
  EXPECT_NE(refusal(objects).find("nested too deeply"), std::string::npos);
}

TEST(SceneFile, WithARateOrASolverThatCannotBeIsRefused) {
  EXPECT_EQ(refusal(R"({"hz": 60, "substeps": 64, "solver": "direct", "bodies": []})"), "");
  EXPECT_EQ(refusal(R"({"hz": 9, "bodies": []})").rfind("/hz: ", 0), 0u);
  EXPECT_EQ(refusal(R"({"substeps": 65, "bodies": []})").rfind("/substeps: ", 0), 0u);
  EXPECT_EQ(refusal(R"({"solver": "magic", "bodies": []})").rfind("/solver: ", 0), 0u);
  EXPECT_EQ(refusal(R"({"projection": "magic", "bodies": []})").rfind("/projection: ", 0), 0u);
  EXPECT_NE(refusal(R"({"hz": 1000, "substeps": 17, "bodies": []})").find("16384 sub-steps a second"),
            std::string::npos);
}

TEST(SceneFile, WithAKeyTwiceIsRefused) {
  EXPECT_EQ(refusal(R"({"bodies": [], "bodies": []})"), "the key \"bodies\" comes twice");
  EXPECT_EQ(refusal(with_body(kSphere + R"(, "mass": 1, "mass": 2)")), "/bodies/1: the key \"mass\" comes twice");
}

TEST(SceneFile, WithAnUnknownKeyIsRefused) {
  EXPECT_EQ(refusal(R"({"bodies": [], "gravitiy": [0, 0, 0]})"), "/gravitiy: unknown key");
  EXPECT_EQ(refusal(with_body(kSphere + R"(, "colour": 1)")), "/bodies/1/colour: unknown key");
  EXPECT_EQ(refusal(with_body(R"("type": "dynamic", "shapes": [{"type": "sphere", "radius": 1, "half_height": 1}])")),
            "/bodies/1/shapes/0/half_height: unknown key");
  EXPECT_EQ(refusal(with_joint(R"({"type": "ball", "a": 0, "b": 1, "anchor": [0, 0, 0], "a/b~": 1})")),
            "/joints/0/a~1b~0: unknown key");
}

TEST(SceneFile, WithAWrongTypeIsRefused) {
  EXPECT_EQ(refusal("[]"), "expected an object, found an array");
  EXPECT_EQ(refusal(R"({"bodies": {}})"), "/bodies: expected an array, found an object");
  EXPECT_EQ(refusal(R"({"bodies": [3]})"), "/bodies/0: expected an object, found a number");
  EXPECT_EQ(refusal(R"({"bodies": [], "allow_sleep": 1})"), "/allow_sleep: expected true or false, found a number");
  EXPECT_EQ(refusal(R"({"bodies": [], "gravity": [0, "-10", 0]})"), "/gravity/1: expected a number, found a string");
  EXPECT_EQ(refusal(R"({"bodies": [], "gravity": [0, -10]})"), "/gravity: expected 3 numbers, found 2 items");
  EXPECT_EQ(refusal(with_body(kSphere + R"(, "mass": null)")), "/bodies/1/mass: expected a number, found null");
  EXPECT_EQ(refusal(with_body(kSphere + R"(, "orientation": [0, 0, 1])")),
            "/bodies/1/orientation: expected 4 numbers, found 3 items");
  EXPECT_EQ(refusal(R"({"bodies": [], "name": ""})"), "/name: expected 1 to 128 printable ASCII characters");
}

TEST(SceneFile, WithSomethingMissingIsRefused) {
  EXPECT_EQ(refusal("{}"), "the key \"bodies\" is missing");
  EXPECT_EQ(refusal(with_body(R"("shapes": [])")), "/bodies/1: the key \"type\" is missing");
  EXPECT_EQ(refusal(with_body(R"("type": "static")")), "/bodies/1: a body needs \"shapes\", one or more");
  EXPECT_EQ(refusal(with_body(R"("type": "static", "shapes": [{"type": "box"}])")),
            "/bodies/1/shapes/0: the key \"half_extents\" is missing");
  EXPECT_EQ(refusal(with_joint(R"({"type": "ball", "a": 0, "b": 1})")), "/joints/0: the key \"anchor\" is missing");
}

TEST(SceneFile, WithPointsThatMakeNoHullIsRefused) {
  const auto hull = [](const std::string& points) {
    return with_body(R"("type": "dynamic", "shapes": [{"type": "hull", "points": )" + points + "}]");
  };
  EXPECT_EQ(refusal(hull("3")), "/bodies/1/shapes/0/points: expected an array, found a number");
  EXPECT_EQ(refusal(hull("[[0, 0, 0], [1, 0]]")), "/bodies/1/shapes/0/points/1: expected 3 numbers, found 2 items");
  EXPECT_EQ(refusal(hull("[[0, 0, 0], 7]")), "/bodies/1/shapes/0/points/1: expected an array, found a number");
  EXPECT_EQ(refusal(hull("[[0, 0, \"x\"]]")), "/bodies/1/shapes/0/points/0/2: expected a number, found a string");
  EXPECT_EQ(refusal(hull("[[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]]")),
            "/bodies/1/shapes/0/points: the points span no volume");
  EXPECT_EQ(refusal(hull("[[0, 0, 0], [1e9, 0, 0], [0, 1, 0], [0, 0, 1]]")),
            "/bodies/1/shapes/0/points: point 1 of a hull: expected coordinates below 524287 m");
  EXPECT_EQ(refusal(hull("[[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]")), "");
}

TEST(SceneFile, WithAHullsRadiusThatIsNoneIsRefused) {
  const auto hull = [](const std::string& radius) {
    return with_body(R"("type": "dynamic", "shapes": [{"type": "hull", "radius": )" + radius +
                     R"(, "points": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]}])");
  };
  const std::string place = "/bodies/1/shapes/0/radius: ";
  EXPECT_EQ(refusal(hull("-0.001")), place + "a hull's radius is below 0 or above the scalar's largest extent");
  EXPECT_EQ(refusal(hull("1e7")), place + "a hull's radius is below 0 or above the scalar's largest extent");
  EXPECT_EQ(refusal(hull("[1]")), place + "expected a number, found an array");
  EXPECT_EQ(refusal(hull("\"thick\"")), place + "expected a number, found a string");
  EXPECT_EQ(refusal(hull("0")), "");
  EXPECT_EQ(refusal(hull("0.125")), "");
}

TEST(SceneFile, WithAWordThatIsNoChoiceIsRefused) {
  EXPECT_EQ(refusal(with_body(R"("type": "movable")")),
            "/bodies/1/type: expected static, kinematic or dynamic, found \"movable\"");
  const auto words = [](std::span<const char* const> names) {
    std::string list = names[0];
    for (std::size_t i = 1; i < names.size(); ++i)
      list += (i + 1 < names.size() ? ", " : " or ") + std::string(names[i]);
    return list;
  };
  EXPECT_EQ(refusal(with_body(R"("type": "static", "shapes": [{"type": "torus"}])")),
            "/bodies/1/shapes/0/type: expected " + words(kShapeNames) + ", found \"torus\"");
  EXPECT_EQ(refusal(with_joint(R"({"type": "rope"})")),
            "/joints/0/type: expected " + words(kJointNames) + ", found \"rope\"");
}

TEST(SceneFile, WithABodyThatIsNotThereIsRefused) {
  EXPECT_EQ(refusal(with_joint(R"({"type": "ball", "a": 0, "b": 2, "anchor": [0, 0, 0]})")),
            "/joints/0/b: expected a whole number from -1 to 1, found 2");
  EXPECT_EQ(refusal(with_joint(R"({"type": "ball", "a": -2, "b": 1, "anchor": [0, 0, 0]})")),
            "/joints/0/a: expected a whole number from -1 to 1, found -2");
  EXPECT_EQ(refusal(with_joint(R"({"type": "ball", "a": 0.5, "b": 1, "anchor": [0, 0, 0]})")),
            "/joints/0/a: expected a whole number from -1 to 1, found 0.5");
  EXPECT_EQ(refusal(with_joint(R"({"type": "ball", "a": 1, "b": 1, "anchor": [0, 0, 0]})")),
            "/joints/0: a joint needs two different bodies");
}

TEST(SceneFile, WithANumberOutOfTheScalarsRangeIsRefusedThereAlone) {
  const std::string far = with_body(kSphere + R"(, "position": [0, 40000, 0])");
  EXPECT_EQ(refusal<Q16_16>(far), "/bodies/1/position/1: 40000 is out of range for q16.16");
  EXPECT_EQ(refusal<Q32_32>(far), "");
  EXPECT_EQ(refusal<float>(with_body(kSphere + R"(, "velocity": [1e39, 0, 0])")),
            "/bodies/1/velocity/0: 1e39 is out of range for float");
  EXPECT_NE(refusal<double>(with_body(kSphere + R"(, "velocity": [1e400, 0, 0])")), "");
  EXPECT_NE(refusal<Q16_16>(R"({"bodies": [], "gravity": [0, -1000, 0]})").find("/gravity: "), std::string::npos);
}

TEST(SceneFile, WithASizeOrMassThatNoBodyHasIsRefused) {
  EXPECT_EQ(refusal(with_body(R"("type": "static", "shapes": [{"type": "sphere", "radius": 0}])")),
            "/bodies/1/shapes/0/radius: expected a number above 0, found 0");
  EXPECT_EQ(refusal(with_body(R"("type": "static", "shapes": [{"type": "sphere", "radius": -1}])")),
            "/bodies/1/shapes/0/radius: expected a number above 0, found -1");
  EXPECT_EQ(refusal(with_body(kSphere + R"(, "mass": 0e5)")), "/bodies/1/mass: expected a number above 0, found 0e5");
  EXPECT_EQ(refusal(with_body(R"("type": "static", "shapes": [{"type": "box", "half_extents": [1, 0, 1]}])"))
                .rfind("/bodies/1/shapes/0: ", 0),
            0u);
  EXPECT_EQ(refusal(with_body(kSphere + R"(, "inertia": [1, -1, 1])")).rfind("/bodies/1: ", 0), 0u);
  EXPECT_EQ(refusal(with_body(kSphere + R"(, "orientation": [0, 0, 0, 2])")).rfind("/bodies/1: ", 0), 0u);
  EXPECT_EQ(refusal(with_body(R"("type": "dynamic", "shapes": [{"type": "half_space", "normal": [0, 1, 0]}])")),
            "/bodies/1/shapes/0: a half_space is for static bodies");
}

}  // namespace scene_file_test
}  // namespace isostep::scenes
