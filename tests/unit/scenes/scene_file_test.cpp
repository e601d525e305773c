// Scene files and named scenes are one thing: what is written reads back, and builds the same world in every scalar.
// SPDX-License-Identifier: MIT
#include "scenes/scene_file.hpp"

#include <gtest/gtest.h>

#include "isostep/store/state.hpp"
#include "isostep/world/world.hpp"
#include "scenes/build.hpp"
#include "scenes/named.hpp"
#include "scenes/script.hpp"

namespace isostep::scenes {
namespace scene_file_test {

template <class S> class SceneFiles : public testing::Test {};
using Scalars = testing::Types<float, double, Q16_16, Q32_32>;
TYPED_TEST_SUITE(SceneFiles, Scalars);

template <class S> std::uint64_t hash_after(const Scene& scene, int frames) {
  World<S> world(settings_of<S>(scene));
  build(scene, world);
  for (int i = 0; i < frames; ++i) {
    before_step(scene.script, world);
    world.step();
  }
  return world.hash();
}

TYPED_TEST(SceneFiles, OfNamedScenesRunAsTheScenesDo) {
  for (const char* name : {"S1x5", "S4s", "S6", "S7", "S9", "mixed"}) {
    const Scene scene = *find_scene(name);
    const Scene file = read_scene(write_scene(scene));
    EXPECT_EQ(hash_after<TypeParam>(file, 5), hash_after<TypeParam>(scene, 5)) << name;
  }
}

TEST(SceneFile, ReadsBackWhatWasWritten) {
  for (const NamedScene& entry : named_scenes()) {
    if (entry.left_out != nullptr) continue;
    const std::string text = write_scene(*find_scene(entry.name));
    EXPECT_EQ(write_scene(read_scene(text)), text) << entry.name;
  }
}

TEST(SceneFile, NumbersKeepTheirText) {
  const Scene scene = read_scene(R"({"gravity": [-0, 1E-3, 0.10000000000000000000000001], "bodies": []})");
  EXPECT_EQ(scene.gravity[0].text(), "-0");
  EXPECT_EQ(scene.gravity[1].text(), "1E-3");
  EXPECT_EQ(scene.gravity[2].text(), "0.10000000000000000000000001");
}

TEST(SceneFile, SaysWhatTheMaterialsOfTrianglesAre) {
  const std::string text = R"({"bodies": [{"type": "static", "shapes": [{"type": "height_field",
    "columns": 3, "rows": 2, "pitch": 1, "heights": [0, 0, 0, 0, 0, 0], "materials": [1, 254],
    "surfaces": [{"friction": 0.25}, {"friction": 0.75, "restitution": 0.5}]}]}]})";
  const auto field_of = [](const Scene& scene) {
    World<double> world(settings_of<double>(scene));
    build(scene, world);
    return *world.height_field(ShapeId{0, 1});
  };
  const BakedHeightField field = field_of(read_scene(text));
  ASSERT_EQ(field.table().size(), 2u);
  EXPECT_EQ(field.table()[0].friction, 256);
  EXPECT_EQ(field.table()[1].restitution, 512);
  EXPECT_FALSE(field.has_triangle(2)) << "a ghost";
  EXPECT_EQ(field_of(read_scene(write_scene(read_scene(text)))).bytes(), field.bytes());
  EXPECT_THROW(field_of(read_scene(std::string(text).replace(text.find("0.75"), 4, "77  "))), SceneError);
}

TEST(SceneFile, NamesTheRateAndTheSolver) {
  const std::string text = R"({"hz": 120, "substeps": 3, "solver": "pgs", "projection": "relaxed", "bodies": []})";
  const Settings<float> settings = settings_of<float>(read_scene(text));
  EXPECT_EQ(settings.hz, 120);
  EXPECT_EQ(settings.substeps, 3);
  EXPECT_EQ(settings.solver, SolverName::pgs);
  EXPECT_EQ(settings.projection, Projection::relaxed) << "taken, though pgs uses none";
  const Scene again = read_scene(write_scene(read_scene(text)));
  EXPECT_EQ(again.hz, 120);
  EXPECT_EQ(again.substeps, 3);
  EXPECT_EQ(again.solver, SolverName::pgs);
  EXPECT_EQ(again.projection, Projection::relaxed);
}

TEST(SceneFile, MembersReachTheWorld) {
  const Scene scene = read_scene(R"({"name": "n", "allow_sleep": false, "gravity": [0, 0, 0], "bodies": [
    {"type": "kinematic", "position": [1, 2, 3], "angular_velocity": [0, 0.5, 0],
     "shapes": [{"type": "capsule", "radius": 0.25, "half_height": 1, "position": [0, 0, 0.5]}]},
    {"type": "dynamic", "position": [4, 5, 6], "velocity": [1, 0, -1], "mass": 2,
     "shapes": [{"type": "box", "half_extents": [1, 2, 3]}]}],
    "joints": [{"type": "distance", "a": 0, "b": 1, "anchor": [1, 2, 3], "anchor_b": [4, 6, 6], "limit": true,
                "lower": 0, "upper": 8}]})");
  World<double> world(settings_of<double>(scene));
  const Built<double> built = build(scene, world);
  ASSERT_EQ(built.bodies.size(), 2u);
  EXPECT_FALSE(world.settings().allow_sleep);
  EXPECT_EQ(world.type(built.bodies[0]), BodyType::kinematic);
  EXPECT_EQ(world.pose(built.bodies[0]).position, (Vec3<double>{1, 2, 3}));
  EXPECT_EQ(world.center_of_mass(built.bodies[0]), (Vec3<double>{1, 2, 3.5}));
  EXPECT_EQ(world.angular_velocity(built.bodies[0]), (Vec3<double>{0, 0.5, 0}));
  EXPECT_EQ(world.mass(built.bodies[1]), 2.0);
  EXPECT_EQ(world.velocity(built.bodies[1]), (Vec3<double>{1, 0, -1}));
  EXPECT_EQ(world.user_data(built.bodies[1]), 2u);
  const JointProperties<double>* joint = world.joint(built.joints[0]);
  ASSERT_NE(joint, nullptr);
  EXPECT_EQ(joint->type, JointType::distance);
  EXPECT_EQ(joint->flags, joint_flag::kLimit);
  EXPECT_EQ(joint->frame_a.position, (Vec3<double>{0, 0, -0.5}));
  EXPECT_EQ(joint->frame_b.position, (Vec3<double>{0, 1, 0}));
  EXPECT_EQ(joint->upper, 8.0);
}

TEST(SceneFile, SurfacesAndLocksReachTheWorldAndReturnToTheFile) {
  const std::string text = R"({"restitution_threshold": 0.125, "records": [
    {"type": "material_pair", "kind_a": 7, "kind_b": 4294967295, "friction": 0.75, "static_friction": 1,
     "restitution": 0.5, "rolling_resistance": 0.0625}],
    "bodies": [{"type": "static", "friction": 0.25, "rolling_resistance": 0.125,
    "surface_velocity": [2, 0, -1], "static_friction": 0.5, "anisotropy": [0.25, 1, 0.5], "kind": 7,
    "shapes": [{"type": "sphere", "radius": 1}]},
    {"type": "dynamic", "lock_y": true, "lock_angular_z": true, "shapes": [{"type": "sphere", "radius": 1}]}]})";
  for (const Scene& scene : {read_scene(text), read_scene(write_scene(read_scene(text)))}) {
    World<double> world(settings_of<double>(scene));
    const Built<double> built = build(scene, world);
    const Material<double>& belt = world.view(built.bodies[0]).properties->material;
    EXPECT_EQ(belt.friction, 0.25);
    EXPECT_EQ(belt.rolling_resistance, 0.125);
    EXPECT_EQ(belt.surface_velocity, (Vec3<double>{2, 0, -1}));
    EXPECT_EQ(belt.static_friction, 0.5);
    EXPECT_EQ(belt.anisotropy, (Vec3<double>{0.25, 1, 0.5}));
    EXPECT_EQ(belt.kind, 7u);
    EXPECT_EQ(world.settings().restitution_threshold, 0.125);
    const auto& pairs = world.state().records->material_pairs;
    ASSERT_EQ(pairs.all().size(), 1u);
    EXPECT_EQ(pairs.all()[0].kind_a, 7u);
    EXPECT_EQ(pairs.all()[0].kind_b, 4294967295u);
    EXPECT_EQ(pairs.all()[0].friction, 0.75);
    EXPECT_EQ(pairs.all()[0].static_friction, 1.0);
    EXPECT_EQ(pairs.all()[0].restitution, 0.5);
    EXPECT_EQ(pairs.all()[0].rolling_resistance, 0.0625);
    EXPECT_EQ(world.view(built.bodies[0]).properties->flags & body_flag::kAllLocks, 0u);
    EXPECT_EQ(world.view(built.bodies[1]).properties->flags & body_flag::kAllLocks,
              body_flag::kLockX << 1 | body_flag::kLockAngularX << 2);
  }
}

TEST(NamedScenes, HaveTheBodiesOfTheirDescription) {
  const struct {
    const char* name;
    std::size_t fixed, moving, joints;
    int frames;
  } rows[] = {{"S1", 1, 20, 0, 600},   {"S1x5", 1, 5, 0, 600},  {"S1x10", 1, 10, 0, 600}, {"S1s", 1, 20, 0, 600},
              {"S2", 1, 210, 0, 600},  {"S3", 1, 1240, 0, 300}, {"S4", 5, 1000, 0, 600},  {"S4s", 5, 200, 0, 600},
              {"S5", 5, 4000, 0, 300}, {"S6", 0, 51, 51, 600},  {"S6v", 0, 51, 51, 600},  {"S7", 5, 550, 500, 600},
              {"S8", 1, 1240, 0, 900}, {"S9", 0, 601, 0, 660},  {"S20", 5, 550, 500, 600}};
  for (const auto& row : rows) {
    const std::optional<Scene> scene = find_scene(row.name);
    ASSERT_TRUE(scene) << row.name;
    std::size_t fixed = 0;
    for (const SceneBody& body : scene->bodies) fixed += body.type == BodyType::static_ ? 1u : 0u;
    EXPECT_EQ(fixed, row.fixed) << row.name;
    EXPECT_EQ(scene->bodies.size() - fixed, row.moving) << row.name;
    EXPECT_EQ(scene->joints.size(), row.joints) << row.name;
    EXPECT_EQ(scene->frames, row.frames) << row.name;
    const std::string name = row.name;
    EXPECT_EQ(scene->allow_sleep, name == "S8" || name == "S1s") << row.name;
  }
  EXPECT_FALSE(find_scene("S0"));
}

/// x1 = 1664525 * 12345 + 1013904223 mod 2^32 = 87628868, so a = floor(x1 / 256) / 2^24 = 342300 / 2^24.
TEST(NamedScenes, DrawTheSizesOfThePile) {
  const SceneBody first = find_scene("S4")->bodies[5];
  double size = 0;
  TextError error = TextError::none;
  ASSERT_TRUE(first.parts[0].half_extents[0].read(size, error));
  EXPECT_EQ(size, 0.25 + 0.25 * (342300.0 / 16777216.0));
}

/// Two bodies are enough to see who is replaced.
TEST(NamedScenes, TheMixersLastSecondIsWithoutBirths) {
  const Scene scene = *find_scene("S9");
  EXPECT_EQ(scene.frames, 660);
  World<float> world;
  const ShapeId ball = world.add_shape(Sphere{0.5});
  for (int i = 0; i < 2; ++i)
    world.create({.type = BodyType::dynamic, .shape = ball, .position = {3.0f * static_cast<float>(i), 0, 0}});
  for (int frame = 0; frame < scene.frames; ++frame) {
    const std::vector<BodyId> before = world.bodies();
    before_step(scene.script, world);
    EXPECT_EQ(world.bodies() != before, frame >= 4 && frame < 600 && frame % 4 == 0) << frame;
    world.step();
  }
}

TEST(NamedScenes, TheMixerReplacesTheOldestBodyEveryFourthFrame) {
  const Scene scene = *find_scene("S9");
  World<float> world(settings_of<float>(scene));
  const Built<float> built = build(scene, world);
  for (int frame = 0; frame <= 8; ++frame) {
    before_step(scene.script, world);
    EXPECT_EQ(world.contains(built.bodies[1]), frame < 4) << frame;
    EXPECT_EQ(world.contains(built.bodies[2]), frame < 8) << frame;
    EXPECT_EQ(world.counts().bodies, 601u);
    world.step();
  }
}

}  // namespace scene_file_test
}  // namespace isostep::scenes
