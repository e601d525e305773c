// Pages of runs: what is recorded of a world, how it is packed, where two recordings part, what a page is made of.
// SPDX-License-Identifier: MIT
#include "tool/page/page.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <string>

#include "isostep/geometry/baked/hull_blob.hpp"
#include "isostep/world/world.hpp"
#include "tool/page/recorder.hpp"

namespace isostep::tool::page {
namespace page_test {

constexpr double kMillimetre = 1e-3;

/// Bodies of a recording as a page has them: by actor, up to some frame.
struct Stage {
  std::vector<Change> state;
  std::vector<std::array<double, 3>> at;
};
Stage stage_of(const Recording& recording, std::size_t frame) {
  Stage stage = {std::vector<Change>(recording.actors.size(), Change::gone), {}};
  stage.at.resize(recording.actors.size());
  for (std::size_t f = 0; f <= frame; ++f) {
    for (const Changed& changed : recording.frames[f].changed) stage.state[changed.actor] = changed.to;
    for (const Moved& moved : recording.frames[f].moved) {
      for (std::size_t i = 0; i < 3; ++i) stage.at[moved.actor][i] = kGrid * moved.pose.at[i];
    }
  }
  return stage;
}

/// A floor and balls of radius 0.5 above it.
struct Balls {
  explicit Balls(std::initializer_list<double> heights) {
    const ShapeId ground = world.add_shape(HalfSpace<double>{{0, 1, 0}, 0});
    world.create({.shape = ground});
    ball = world.add_shape(Sphere{0.5});
    for (const double height : heights) bodies.push_back(drop(height));
  }
  BodyId drop(double height) {
    return world.create({.type = BodyType::dynamic, .shape = ball, .position = {2, height, 3}});
  }
  World<double> world;
  ShapeId ball;
  std::vector<BodyId> bodies;
};

/// Bodies of hulls: two wedges of one blob, a pyramid between them; and a ball.
struct Wedges {
  Wedges() {
    const GridPoint wedge[] = {{0, 0, 0}, {64, 0, 0}, {0, 64, 0}, {0, 0, 64}, {64, 0, 64}, {0, 64, 64}};
    const GridPoint pyramid[] = {{0, 0, 0}, {64, 0, 0}, {0, 64, 0}, {0, 0, 64}};
    for (const BlobRef& blob : {hull(wedge), hull(pyramid), hull(wedge)}) {
      const Child<double> part = {Hull<double>{1}.primitive(), isostep::Pose<double>::identity()};
      drop(world.add_shape(std::span<const Child<double>>(&part, 1), std::span<const BlobRef>(&blob, 1)));
    }
    drop(world.add_shape(Sphere{0.5}));
  }
  static BlobRef hull(std::span<const GridPoint> points) { return hull_blob(points, 6).value(); }
  void drop(ShapeId shape) { world.create({.type = BodyType::dynamic, .shape = shape, .position = {0, at++, 0}}); }
  World<double> world;
  double at = 0;  // [m] height of the next
};

/// The part of a page between its element of surfaces and the next.
std::string surfaces_in(const std::string& page) {
  const std::string open = "id=\"surfaces\">";
  const std::size_t from = page.find(open) + open.size();
  return page.substr(from, page.find('<', from) - from);
}

/// Little-endian.
class Reader {
 public:
  explicit Reader(const std::vector<std::uint8_t>& bytes) : bytes_(bytes) {}
  std::uint64_t take(int bytes) {
    std::uint64_t x = 0;
    for (int i = 0; i < bytes; ++i) x |= std::uint64_t{bytes_.at(at_++)} << 8 * i;
    return x;
  }
  std::uint32_t u32() { return static_cast<std::uint32_t>(take(4)); }
  float f32() {
    const std::uint32_t bits = u32();
    float x;
    std::memcpy(&x, &bits, 4);
    return x;
  }
  bool at_end() const { return at_ == bytes_.size(); }

 private:
  const std::vector<std::uint8_t>& bytes_;
  std::size_t at_ = 0;
};

TEST(Pages, KeepTurnsToAFewArcMinutes) {
  for (int k = 0; k < 200; ++k) {
    double q[4] = {std::sin(1.0 + k), std::sin(2.0 + 3 * k), std::sin(0.5 + 7 * k), std::sin(0.1 + 11 * k)};
    const double size = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    const float in[4] = {float(q[0] / size), float(q[1] / size), float(q[2] / size), float(q[3] / size)};
    const std::array<std::uint16_t, 3> packed = pack_turn(in);
    const std::size_t left_out = packed[0] >> 15 | (packed[1] >> 15) << 1;
    double out[4], rest = 1;
    std::size_t place = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      if (i == left_out) continue;
      out[i] = ((packed[place++] & 32767) / 32767.0 * 2 - 1) / std::sqrt(2.0);
      rest -= out[i] * out[i];
    }
    out[left_out] = std::sqrt(rest);
    double dot = 0;
    for (int i = 0; i < 4; ++i) dot += out[i] * in[i];
    EXPECT_NEAR(std::fabs(dot), 1, 1e-7) << k;
  }
}

/// A wheel is an actor of its own that turns and steers; the forces where it meets the ground are points of the frame.
TEST(Pages, RecordWheelsAndWhatTheyBear) {
  Balls balls({});
  World<double>& world = balls.world;
  const BodyId chassis = world.create({.type = BodyType::dynamic,
                                       .shape = world.add_shape(Box{{0.5, 0.25, 1}}),
                                       .position = {0, 1, 0},
                                       .velocity = {0, 0, 4},
                                       .mass = 100});
  std::vector<WheelId> wheels;
  for (const double z : {1.0, -1.0}) {
    for (const double x : {0.5, -0.5}) {
      WheelSettings<double> wheel;
      wheel.body = chassis;
      wheel.hard_point = {x, 0, z};
      wheel.stiffness = 5000;
      wheel.damping = 400;
      wheels.push_back(world.add(wheel));
    }
  }
  Recording recording;
  Recorder recorder(recording);
  recorder.record(world);
  for (int i = 0; i < 240; ++i) world.step();
  recorder.record(world);
  ASSERT_EQ(recording.actors.size(), 6u);  // ground, chassis, wheels
  const Actor& wheel = recording.actors[2];
  EXPECT_TRUE(wheel.wheel);
  EXPECT_EQ(wheel.slot, wheels[0].slot);
  EXPECT_EQ(wheel.parts.at(0).type, ShapeType::cylinder);
  EXPECT_EQ(wheel.parts.at(0).radius, 0.35f);
  EXPECT_FALSE(recording.actors[1].wheel);
  const Stage last = stage_of(recording, 1);
  EXPECT_NEAR(last.at[2][0], 0.5, kMillimetre);
  EXPECT_NEAR(last.at[2][1], 0.35, 5 * kMillimetre);
  EXPECT_NEAR(last.at[2][2] - last.at[1][2], 1, 5 * kMillimetre);
  EXPECT_TRUE(recording.frames[0].points.empty());
  double newtons = 0;
  for (const ContactPoint& point : recording.frames[1].points) {
    EXPECT_NEAR(point.at[1], 0, kMillimetre);
    if (point.normal[1] == 127) newtons += std::pow(2, point.force / 16.0) - 1;
  }
  EXPECT_NEAR(newtons, 1000, 40);
  EXPECT_EQ(compare(recording, recording, 0).frame, Divergence::kNever);
  world.remove(wheels[0]);
  recorder.record(world);
  EXPECT_EQ(stage_of(recording, 2).state[2], Change::gone);
}

TEST(Pages, RecordWhatCharactersStandOn) {
  Balls balls({});
  World<double>& world = balls.world;
  CharacterSettings<double> walker;
  walker.body =
      world.create({.type = BodyType::kinematic, .shape = world.add_shape(Capsule{0.25, 0.5}), .position = {2, 1, 3}});
  world.add(walker);
  Recording recording;
  Recorder recorder(recording);
  recorder.record(world);
  EXPECT_TRUE(recording.frames[0].points.empty());
  for (int i = 0; i < 30; ++i) world.step();
  recorder.record(world);
  ASSERT_EQ(recording.frames[1].points.size(), 1u);
  const ContactPoint& point = recording.frames[1].points[0];
  EXPECT_NEAR(point.at[0], 2, kMillimetre);
  EXPECT_NEAR(point.at[1], 0, kMillimetre);
  EXPECT_EQ(point.normal[1], 127);
  EXPECT_NEAR(std::pow(2, point.force / 16.0) - 1, 80 * -world.settings().gravity.y, 25);
}

TEST(Pages, WriteBase64AsTheStandardDoes) {  // RFC 4648, section 10
  const auto of = [](const std::string& text) { return base64({text.begin(), text.end()}); };
  EXPECT_EQ(of(""), "");
  EXPECT_EQ(of("f"), "Zg==");
  EXPECT_EQ(of("fo"), "Zm8=");
  EXPECT_EQ(of("foo"), "Zm9v");
  EXPECT_EQ(of("foobar"), "Zm9vYmFy");
}

TEST(Pages, RecordWhereBodiesAreAndWhoIsThere) {
  Balls balls({4, 6});
  Recording recording;
  Recorder recorder(recording);
  recorder.record(balls.world);
  balls.world.step();
  recorder.record(balls.world);
  balls.world.destroy(balls.bodies[0]);
  recorder.record(balls.world);
  balls.drop(9);  // its slot again
  recorder.record(balls.world);
  ASSERT_EQ(recording.actors.size(), 4u);
  EXPECT_EQ(recording.actors[0].parts.at(0).type, ShapeType::half_space);
  EXPECT_EQ(recording.actors[1].parts.at(0).radius, 0.5f);
  EXPECT_EQ(recording.actors[3].slot, recording.actors[1].slot);
  EXPECT_NE(recording.actors[3].generation, recording.actors[1].generation);
  const Stage start = stage_of(recording, 0), second = stage_of(recording, 1), third = stage_of(recording, 2),
              last = stage_of(recording, 3);
  EXPECT_EQ(start.at[1], (std::array<double, 3>{2, 4, 3}));
  EXPECT_EQ(start.state[3], Change::gone);
  EXPECT_NEAR(second.at[2][1], to_double(balls.world.pose(balls.bodies[1]).position.y), kGrid);
  EXPECT_EQ(second.state[1], Change::awake);
  EXPECT_EQ(third.state[1], Change::gone);
  EXPECT_EQ(last.state[3], Change::awake);
  EXPECT_EQ(last.at[3], (std::array<double, 3>{2, 9, 3}));
  EXPECT_EQ(recording.frames[3].hash, balls.world.hash());
  EXPECT_EQ(recording.frames[1].moved.size(), 2u);  // not the floor
}

TEST(Pages, RecordSleepAndContacts) {
  Balls balls({0.5});
  Recording recording;
  Recorder recorder(recording);
  for (int i = 0; i < 120 && balls.world.counts().awake > 0; ++i) balls.world.step();
  ASSERT_EQ(balls.world.counts().awake, 0u);
  recorder.record(balls.world);
  EXPECT_EQ(stage_of(recording, 0).state[1], Change::asleep);
  ASSERT_EQ(recording.frames[0].points.size(), 1u);
  const ContactPoint& point = recording.frames[0].points[0];
  EXPECT_NEAR(point.at[0], 2, kMillimetre);
  EXPECT_NEAR(point.at[1], 0, 5 * kMillimetre);
  EXPECT_EQ(point.normal[1], 127);
}

TEST(Pages, RecordTheSurfaceOfBodiesThatShareABlobOnce) {
  const Wedges wedges;
  Recording recording;
  Recorder recorder(recording);
  recorder.record(wedges.world);
  recorder.record(wedges.world);
  ASSERT_EQ(recording.actors.size(), 4u);
  ASSERT_EQ(recording.surfaces.all().size(), 2u);
  const Surface &wedge = recording.surfaces.all()[0], &pyramid = recording.surfaces.all()[1];
  EXPECT_EQ(wedge.vertices.size(), 6u);
  EXPECT_EQ(wedge.triangles.size(), 8u);
  EXPECT_EQ(pyramid.vertices.size(), 4u);
  EXPECT_EQ(pyramid.triangles.size(), 4u);
  const std::uint32_t expected[] = {0, 1, 0, Surfaces::kNone};
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(recording.actors[i].parts.at(0).surface, expected[i]) << i;
}

TEST(Pages, HoldTheSurfacesOfBothRunsOnce) {
  const Wedges wedges;
  Film film;
  Recorder(film.run).record(wedges.world);
  const std::string alone = surfaces_in(page_of(film));
  Recorder(film.beside).record(wedges.world);
  EXPECT_EQ(surfaces_in(page_of(film)), alone);
  EXPECT_EQ(alone, base64(pack(film.run.surfaces)));
}

TEST(Pages, PackSurfacesAsThePlayerReadsThem) {
  Surfaces surfaces;
  surfaces.begin({1, 2});
  const float corners[4][3] = {{-1, 0, 2}, {3, 0, 2}, {-1, 0.5f, 2}, {1, 0.125f, 2}};
  const auto triangle = [&](int a, int b, int c) {
    DrawnTriangle drawn;
    const int all[3] = {a, b, c};
    for (int i = 0; i < 3; ++i) std::memcpy(drawn.corners[i], corners[all[i]], sizeof drawn.corners[i]);
    surfaces.add(drawn);
  };
  triangle(0, 1, 2), triangle(3, 2, 1);
  EXPECT_EQ(surfaces.merge({{1, 2}, {}, {}}), 0u);
  const std::vector<std::uint8_t> bytes = pack(surfaces);
  Reader reader(bytes);
  EXPECT_EQ(reader.u32(), 1u);
  EXPECT_EQ(reader.u32(), 4u);  // vertices
  EXPECT_EQ(reader.u32(), 2u);  // triangles
  for (const float low : {-1.0f, 0.0f, 2.0f}) EXPECT_EQ(reader.f32(), low);
  for (const float size : {4.0f, 0.5f, 0.0f}) EXPECT_FLOAT_EQ(reader.f32() * 65535, size);
  const std::uint32_t fractions[4][3] = {{0, 0, 0}, {65535, 0, 0}, {0, 65535, 0}, {32768, 16384, 0}};
  for (const auto& vertex : fractions) {
    for (const std::uint32_t fraction : vertex) EXPECT_EQ(reader.take(2), fraction);
  }
  for (const std::uint32_t vertex : {0, 1, 2, 3, 2, 1}) EXPECT_EQ(reader.take(1), vertex);
  EXPECT_TRUE(reader.at_end());
}

TEST(Pages, PackVerticesOfLargeSurfacesByTheirNumbersInTwoBytes) {
  Surfaces surfaces;
  surfaces.begin({1, 2});
  for (int i = 0; i < 100; ++i) {
    const float x = static_cast<float>(i);
    surfaces.add({{{x, 0, 0}, {x, 1, 0}, {x, 0, 1}}});
  }
  EXPECT_EQ(pack(surfaces).size(), 4u + 8u + 24u + 300u * 3 * 2 + 100u * 3 * 2);
}

TEST(Pages, FindTheFirstBodyThatParts) {
  Balls here({4, 6}), there({4, 6});
  Recording a, b;
  Recorder of_a(a), of_b(b);
  of_a.record(here.world), of_b.record(there.world);
  for (int i = 1; i <= 10; ++i) {
    if (i == 4) there.world.set_velocity(there.bodies[1], {0.9, there.world.velocity(there.bodies[1]).y, 0}, {0, 0, 0});
    here.world.step(), there.world.step();
    of_a.record(here.world), of_b.record(there.world);
  }
  // 0.9 m/s for a sixtieth of a second: 15 mm a frame.
  const Divergence coarse = compare(a, b, 0.02), fine = compare(a, b, 0.01), blind = compare(a, b, 1);
  EXPECT_EQ(fine.frame, 4);
  EXPECT_EQ(fine.slot, there.bodies[1].slot);
  EXPECT_NEAR(fine.distance, 0.015, 0.0005);
  EXPECT_EQ(coarse.frame, 5);
  EXPECT_EQ(blind.frame, Divergence::kNever);
  ASSERT_EQ(fine.apart.size(), 11u);
  EXPECT_EQ(fine.apart[3], 0);
  EXPECT_NEAR(fine.apart[10], 7 * 0.015, 0.001);
}

TEST(Pages, FindABodyThatIsInOneRunAlone) {
  Balls here({4, 6}), there({4, 6});
  Recording a, b;
  Recorder of_a(a), of_b(b);
  of_a.record(here.world), of_b.record(there.world);
  there.world.destroy(there.bodies[0]);
  of_a.record(here.world), of_b.record(there.world);
  const Divergence found = compare(a, b, 0.01);
  EXPECT_EQ(found.frame, 1);
  EXPECT_EQ(found.slot, here.bodies[0].slot);
  EXPECT_EQ(found.distance, 0);
}

TEST(Pages, PackFramesAsThePlayerReadsThem) {
  Recording recording;
  recording.actors.resize(2);
  recording.frames.push_back(
      {7, 0x0123456789abcdef, 2.5, 0.25, {{1, Change::asleep}}, {{1, {{100, -5, 70000}, {1, 2, 3}}}}, {}});
  recording.frames.push_back(
      {8, 1, 2.5, 0.25, {}, {{1, {{90, -5, 70001}, {4, 5, 6}}}}, {{{1, 2, 3}, {0, 127, -1}, 32}}});
  const Packed packed = pack(recording, 1000);
  Reader reader(packed.bytes);
  EXPECT_EQ(reader.take(8), 7u);
  EXPECT_EQ(reader.take(8), 0x0123456789abcdefu);
  EXPECT_EQ(reader.f32(), 2.5f);
  EXPECT_EQ(reader.f32(), 0.25f);
  EXPECT_EQ(reader.u32(), 1u);
  EXPECT_EQ(reader.u32(), 1u << 2 | 2u);
  EXPECT_EQ(reader.u32(), 1u);  // whole poses
  EXPECT_EQ(reader.u32(), 1u);
  EXPECT_EQ(reader.u32(), 100u);
  EXPECT_EQ(reader.u32(), 0xfffffffbu);
  EXPECT_EQ(reader.u32(), 70000u);
  EXPECT_EQ(reader.take(6), 0x000300020001u);
  EXPECT_EQ(reader.u32(), 0u);  // no differences
  EXPECT_EQ(reader.u32(), 0u);  // no points
  reader.take(8 + 8 + 4 + 4);
  EXPECT_EQ(reader.u32(), 0u);
  EXPECT_EQ(reader.u32(), 0u);
  EXPECT_EQ(reader.u32(), 1u);  // bytes of who has moved
  EXPECT_EQ(reader.take(1), 2u);
  EXPECT_EQ(reader.take(2), 0xfff6u);
  EXPECT_EQ(reader.take(2), 0u);
  EXPECT_EQ(reader.take(2), 1u);
  EXPECT_EQ(reader.take(6), 0x000600050004u);
  EXPECT_EQ(reader.u32(), 1u);
  reader.take(6);  // one point is its own box
  EXPECT_EQ(reader.take(4), 0x20ff7f00u);
  EXPECT_TRUE(reader.at_end());
}

TEST(Pages, KeepContactPointsOfFewerFramesWhereAllTakeTooMuch) {
  Recording recording;
  for (std::uint64_t i = 0; i < 12; ++i)
    recording.frames.push_back({i, 0, 0, 0, {}, {}, std::vector<ContactPoint>(10)});  // 100 bytes each
  EXPECT_EQ(pack(recording, 1200).points_every, 1u);
  EXPECT_EQ(pack(recording, 1199).points_every, 2u);
  EXPECT_EQ(pack(recording, 400).points_every, 3u);
}

TEST(Pages, AreWholeAndOfTheirOwn) {
  Balls balls({4});
  Film film;
  film.scene = "</script><b>odd";
  Recorder(film.run).record(balls.world);
  const std::string page = page_of(film);
  EXPECT_EQ(page.find("{{"), std::string::npos);
  EXPECT_EQ(page.find("<b>odd"), std::string::npos);
  EXPECT_NE(page.find("class=\"stop\""), std::string::npos);
  for (const char* letter : {"&#9654;", "&#9664;", "\\u23f8", "\\u25b6"})  // of a font that a machine may lack
    EXPECT_EQ(page.find(letter), std::string::npos) << letter;
  for (const char* fetched : {" src=", "<link", "@import", "url("})
    EXPECT_EQ(page.find(fetched), std::string::npos) << fetched;
  if (available()) {
    EXPECT_NE(page.find("Permission is hereby granted, free of charge"), std::string::npos);  // three.js, MIT
  } else {
    EXPECT_NE(how_to_get().find("npm"), std::string::npos);
  }
}

}  // namespace page_test
}  // namespace isostep::tool::page
