// Effects on pages: the records of a world, what they do frame by frame; and that forces are drawn as they act.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "isostep/world/world.hpp"
#include "tool/page/page.hpp"
#include "tool/page/recorder.hpp"

namespace isostep::tool::page {
namespace page_effects_test {

using Point = Vec3<double>;

/// A box of a tonne, and steps so short that forces hardly change within one.
struct Craft {
  static constexpr double kMass = 1000;  // [kg]
  static constexpr int kRate = 1000;     // [1/s]
  explicit Craft(Point gravity = {0, 0, 0}) : world({.hz = kRate, .gravity = gravity, .allow_sleep = false}) {
    const ShapeId box = world.add_shape(Box{{1, 0.25, 0.5}});
    body = world.create({.type = BodyType::dynamic,
                         .shape = box,
                         .position = {3, 0, 1},
                         .velocity = {3, 1, -2},
                         .angular_velocity = {0, 0.5, 0},
                         .mass = kMass});
  }
  AeroSurface<double> surface() const {
    AeroSurface<double> surface;
    surface.body = body;
    surface.point = {1, -0.5, 2};
    surface.tensor = {{{-2, 0, 1}, {3, -7, 0}, {0, 0, -4}}};
    surface.low = surface.tensor;
    surface.high = {{{-2, 0, 1}, {9, -7, 0}, {0, 0, -4}}};
    surface.control = 0.5;
    return surface;
  }
  World<double> world;
  BodyId body;
};

Recording recorded(const World<double>& world) {
  Recording recording;
  Recorder(recording).record(world);
  return recording;
}
const std::vector<double>& numbers_of(const Effect& effect, std::string_view name) {
  return std::find_if(effect.numbers.begin(), effect.numbers.end(), [&](const auto& one) { return one.first == name; })
      ->second;
}

/// The last push that is drawn, against what the step does with that record and not without it.
void expect_that_it_acts(Craft with, Craft without, double tolerance) {
  const Frame frame = recorded(with.world).frames[0];
  ASSERT_FALSE(frame.pushes.empty());
  with.world.step(), without.world.step();
  const Point change = with.world.velocity(with.body) - without.world.velocity(without.body);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(frame.pushes.back().force[static_cast<std::size_t>(i)], change[i] * Craft::kMass * Craft::kRate,
                tolerance)
        << i;
  }
}

TEST(PageEffects, AreTheRecordsOfAWorld) {
  Craft craft({0, -10, 0});
  craft.world.add(Water<double>{.surface_height = -2, .wave_height = 0.5});
  Explosion<double> explosion;
  explosion.centre = {1, 2, 3};
  explosion.begin = 5;
  explosion.wave_force = 10;
  explosion.wave_duration = 0.5;
  explosion.chimney_duration = 9;  // without a force
  craft.world.add(explosion);
  ForceZone<double> zone;
  zone.wind = {0, 0, 5};
  craft.world.add(zone);
  const Recording recording = recorded(craft.world);
  ASSERT_EQ(recording.effects.size(), 3u);
  EXPECT_STREQ(recording.effects[0].kind, "zone");
  EXPECT_STREQ(recording.effects[1].kind, "explosion");
  EXPECT_EQ(numbers_of(recording.effects[1], "begin"), std::vector<double>{5});
  EXPECT_EQ(numbers_of(recording.effects[1], "wave"), (std::vector<double>{50, 1, 0.5}));
  EXPECT_EQ(numbers_of(recording.effects[1], "chimney"), (std::vector<double>{1, 1, 0}));
  EXPECT_STREQ(recording.effects[2].kind, "water");
  EXPECT_EQ(numbers_of(recording.effects[2], "height"), std::vector<double>{-2});
  EXPECT_EQ(numbers_of(recording.effects[2], "up"), (std::vector<double>{0, 1, 0}));
  EXPECT_EQ(numbers_of(recording.effects[2], "wave"), (std::vector<double>{0.5, 10, 3}));
  EXPECT_TRUE(recording.frames[0].pushes.empty());
}

TEST(PageEffects, AreThereWhileTheirRecordsAreAndOthersWhenThoseChange) {
  Craft craft;
  ForceZone<double> zone;
  const ForceZoneId id = craft.world.add(zone);
  Recording recording;
  Recorder recorder(recording);
  recorder.record(craft.world), recorder.record(craft.world);
  zone.wind = {1, 0, 0};
  craft.world.set(id, zone);
  recorder.record(craft.world);
  craft.world.remove(id);
  recorder.record(craft.world);
  ASSERT_EQ(recording.effects.size(), 2u);
  EXPECT_EQ(recording.effects[0].first, 0u);
  EXPECT_EQ(recording.effects[0].last, 1u);
  EXPECT_EQ(recording.effects[1].first, 2u);
  EXPECT_EQ(recording.effects[1].last, 2u);
}

TEST(PageEffects, OfSurfacesAndThrustersStayWhenTheirControlChanges) {
  Craft craft;
  AeroSurface<double> surface = craft.surface();
  const AeroSurfaceId id = craft.world.add(surface);
  Recording recording;
  Recorder recorder(recording);
  recorder.record(craft.world);
  surface.control = -1;
  craft.world.set(id, surface);
  recorder.record(craft.world);
  ASSERT_EQ(recording.effects.size(), 1u);
  EXPECT_EQ(recording.effects[0].actor, 0);
  EXPECT_EQ(recording.frames[0].pushes.at(0).control, 0.5f);
  EXPECT_EQ(recording.frames[1].pushes.at(0).control, -1.0f);
}

TEST(PageEffects, DrawThePlateThatATensorIsOf) {
  // A plate across (3, 0, 4) / 5.
  const Mat3<double> tensor = {{{-9, 0, -12}, {0, 0, 0}, {-12, 0, -16}}};
  const Point normal = plate_normal(tensor);
  const double sign = normal.x < 0 ? -1 : 1;
  EXPECT_NEAR(sign * normal.x, 0.6, 1e-9);
  EXPECT_NEAR(sign * normal.z, 0.8, 1e-9);
}

TEST(PageEffects, DrawTheForceOfASurfaceInWind) {
  Craft with, without;
  ForceZone<double> zone;
  zone.shape = ZoneShape::box;
  zone.pose.position = {3, 0, 3};
  zone.half = {4, 4, 4};
  zone.wind = {0, 1, 5};
  for (Craft* const craft : {&with, &without}) craft->world.add(zone);
  with.world.add(with.surface());
  expect_that_it_acts(std::move(with), std::move(without), 0.05);
}
TEST(PageEffects, DrawTheForceOfASurfaceThatGrowsWithTheSpeedSquared) {
  Craft with, without;
  AeroSurface<double> surface = with.surface();
  surface.is_quadratic = true;
  with.world.add(surface);
  expect_that_it_acts(std::move(with), std::move(without), 0.2);
}
TEST(PageEffects, DrawTheForceOfAKeelInWaves) {
  Water<double> water;
  water.surface_height = 0.25;
  water.current = {1, 0, 0};
  water.linear_drag = water.angular_drag = 0;
  water.wave_height = 0.5;
  water.wave_direction = {0.6, 0, 0.8};
  for (const double height : {0.25, -3.0}) {
    water.surface_height = height;
    Craft with({0, -10, 0}), without({0, -10, 0});
    for (Craft* const craft : {&with, &without}) craft->world.add(water);
    AeroSurface<double> keel = with.surface();
    keel.is_under_water = true;
    with.world.add(keel);
    expect_that_it_acts(std::move(with), std::move(without), 0.2);
  }
}
TEST(PageEffects, DrawTheForceOfAThruster) {
  Craft with, without;
  with.world.add(Thruster<double>{.body = with.body, .point = {0, 0, 0}, .force = {5, 6, 7}});
  expect_that_it_acts(std::move(with), std::move(without), 0.01);
}

TEST(PageEffects, DrawSpringsBetweenTheirEnds) {
  Craft craft;
  BodySpring<double> spring;
  spring.a = craft.body;
  spring.anchor_a = {1, 0, 0};
  spring.anchor_b = {3, 5, 1};
  spring.stiffness = 10;
  craft.world.add(spring);
  spring.only_pulls = true;
  craft.world.add(spring);
  const Recording recording = recorded(craft.world);
  ASSERT_EQ(recording.bonds.size(), 2u);
  EXPECT_STREQ(recording.bonds[0].kind, "spring");
  EXPECT_STREQ(recording.bonds[1].kind, "bungee");
  EXPECT_EQ(recording.bonds[0].a, 0);
  EXPECT_EQ(recording.bonds[0].b, Bond::kNobody);
  EXPECT_EQ(recording.bonds[0].at_a, (std::array<float, 3>{1, 0, 0}));
  EXPECT_EQ(recording.bonds[0].at_b, (std::array<float, 3>{3, 5, 1}));
}

TEST(PageEffects, TakeRoomInFramesWhereAPushChanges) {
  Recording recording;
  recording.frames.resize(3);
  const std::size_t none = pack(recording, 0).bytes.size();
  recording.effects.push_back({"thruster", {}});
  recording.frames[0].pushes = {{0, {2, -4, 0}, 0.5}};
  recording.frames[1].pushes = recording.frames[0].pushes;
  recording.frames[2].pushes = {{0, {0, 4, 1}, -1}};
  const Packed packed = pack(recording, 0);
  EXPECT_EQ(packed.strongest, 4);
  EXPECT_EQ(packed.bytes.size(), none + 3 * 4 + 2 * (4 + 4 * 2));
  const std::size_t at = 8 + 8 + 4 + 4 + 4 + 4 + 4;  // frame 0: after its poses
  const std::vector<std::uint8_t> expected = {1, 0, 0, 0, 0, 0, 0, 0, 0x00, 0x40, 0x01, 0x80, 0, 0, 0x00, 0x40};
  EXPECT_TRUE(std::equal(expected.begin(), expected.end(), packed.bytes.begin() + at));
}

}  // namespace page_effects_test
}  // namespace isostep::tool::page
