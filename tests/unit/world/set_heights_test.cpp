// Height fields that commands change: what rested falls, and saves, replays and files have the same ground.
// SPDX-License-Identifier: MIT
#include <cmath>
#include <vector>

#include "isostep/geometry/baked/surface_blob.hpp"
#include "isostep/replay/recorder.hpp"
#include "isostep/state/verify.hpp"
#include "unit/world/worlds.hpp"

namespace isostep::test {
namespace set_heights_test {

constexpr std::uint32_t kPlaces = 33;  // of half a metre: 16 m
constexpr std::int16_t kDeep = -2048;  // [1/1024 m]

BlobRef plain(BlobHome home = BlobHome::carried) {
  const std::vector<std::int16_t> heights(kPlaces * kPlaces, 0);
  return height_field_blob(height_field({10, 0, kPlaces, kPlaces, 512}, heights, {}).value(), home);
}

/// A pit of 5 x 5 places, 2 m deep, about the world's origin.
struct Pit {
  std::vector<std::int16_t> heights = std::vector<std::int16_t>(25, kDeep);
  HeightPatch patch() const { return {14, 14, 5, 5, heights}; }
};

template <class S> class SetHeightsOf : public testing::Test {
 protected:
  SetHeightsOf() : world(settings<S>(-10)) { build(world); }

  void build(World<S>& w) {
    ground = w.add_shape(plain());
    body = w.create(still<S>(ground, {-8, 0, -8}));
    const ShapeId box = add_box(w, 0.25, 0.25, 0.25);
    over = w.create(moving<S>(box, {0, 0.25, 0}));
    beside = w.create(moving<S>(box, {5, 0.25, 5}));
  }
  bool dig(World<S>& w) const { return w.set_heights(ground, 0, Pit{}.patch()); }
  double height_of(BodyId id) const { return to_double(world.pose(id).position.y); }

  World<S> world;
  ShapeId ground;
  BodyId body, over, beside;
};
TYPED_TEST_SUITE(SetHeightsOf, AllScalars);

TYPED_TEST(SetHeightsOf, what_rests_over_a_pit_wakes_and_falls_in_and_what_is_beside_it_sleeps_on) {
  ASSERT_TRUE(settle(this->world));
  EXPECT_NEAR(this->height_of(this->over), 0.25, 0.01);
  ASSERT_TRUE(this->dig(this->world));
  EXPECT_TRUE(this->world.is_awake(this->over));
  EXPECT_FALSE(this->world.is_awake(this->beside));
  ASSERT_TRUE(settle(this->world));
  EXPECT_NEAR(this->height_of(this->over), -1.75, 0.01);
  EXPECT_NEAR(this->height_of(this->beside), 0.25, 0.01);
  const auto hit = this->world.cast_ray(vec<TypeParam>(0.6, 5, 0.6), vec<TypeParam>(0, -10, 0));
  ASSERT_TRUE(hit);
  EXPECT_NEAR(to_double(hit->point.y), -2, 1e-3);
}

/// Its box hangs between its wheels, out of the ground's reach.
TYPED_TEST(SetHeightsOf, a_car_over_a_pit_wakes_and_one_beside_it_sleeps_on) {
  using S = TypeParam;
  const auto car = [&](D3 at) {
    BodyDefinition<S> d = moving<S>(add_box(this->world, 0.4, 0.1, 0.4), at + D3{0, 0.6, 0});
    d.mass = S(100);
    const BodyId chassis = this->world.create(d);
    for (const double x : {-0.4, 0.4}) {
      for (const double z : {-0.4, 0.4}) {
        WheelSettings<S> wheel;
        wheel.body = chassis;
        wheel.hard_point = vec<S>(x, 0, z);
        wheel.stiffness = S(5000);
        wheel.damping = S(400);
        EXPECT_TRUE(this->world.add(wheel)) << describe(this->world.fault());
      }
    }
    return chassis;
  };
  this->world.destroy(this->over);
  const BodyId on_pit = car({0, 0, 0}), on_ground = car({5, 0, -5});
  ASSERT_TRUE(settle(this->world));
  const double stands = this->height_of(on_pit);
  ASSERT_TRUE(this->dig(this->world));
  EXPECT_TRUE(this->world.is_awake(on_pit));
  EXPECT_FALSE(this->world.is_awake(on_ground));
  ASSERT_TRUE(settle(this->world));
  EXPECT_LT(this->height_of(on_pit), stands - 1);
}

TYPED_TEST(SetHeightsOf, a_hill_lifts_what_lay_on_its_place) {
  ASSERT_TRUE(settle(this->world));
  const std::vector<std::int16_t> low(9, 205);
  ASSERT_TRUE(this->world.set_heights(this->ground, 0, {15, 15, 3, 3, low}));
  ASSERT_TRUE(settle(this->world));
  EXPECT_NEAR(this->height_of(this->over), 0.45, 0.01);
}

TYPED_TEST(SetHeightsOf, a_hill_that_would_bury_what_lay_on_its_place_takes_it_up) {
  ASSERT_TRUE(settle(this->world));
  const std::vector<std::int16_t> high(49, 2253);  // 2.2 m
  ASSERT_TRUE(this->world.set_heights(this->ground, 0, {13, 13, 7, 7, high}));
  EXPECT_NEAR(this->height_of(this->over), 2.45, 0.01);
  EXPECT_NEAR(this->height_of(this->beside), 0.25, 0.01);
  ASSERT_TRUE(settle(this->world));
  EXPECT_NEAR(this->height_of(this->over), 2.45, 0.01);
}

TYPED_TEST(SetHeightsOf, cells_become_holes_and_ground_again) {
  ASSERT_TRUE(settle(this->world));
  const std::vector<std::int16_t> heights(25, 0);
  const std::vector<std::uint8_t> holes(16, BakedHeightField::kHole), none(16, 0);
  ASSERT_TRUE(this->world.set_heights(this->ground, 0, {14, 14, 5, 5, heights, holes}));
  run(this->world, 60);
  EXPECT_LT(this->height_of(this->over), -1);
  ASSERT_TRUE(this->world.set_heights(this->ground, 0, {14, 14, 5, 5, heights, none}));
  EXPECT_EQ(this->world.state().geometry->find(plain()->id()), 0u) << "the field that it was at first";
  EXPECT_EQ(this->world.state().geometry->names().size(), 1u) << "and no other";
}

TYPED_TEST(SetHeightsOf, worlds_that_load_have_the_ground_of_then) {
  using S = TypeParam;
  typename World<S>::Snapshot before, after;
  ASSERT_TRUE(settle(this->world));
  this->world.save(before);
  ASSERT_TRUE(this->dig(this->world));
  std::vector<std::uint64_t> hashes;
  for (int frame = 0; frame < 60; ++frame) {
    if (frame == 20) this->world.save(after);
    this->world.step();
    hashes.push_back(this->world.hash());
  }
  const std::uint64_t ended = this->world.hash();
  ASSERT_TRUE(this->world.load(before));
  EXPECT_EQ(this->world.height_field(this->ground)->heights()[16 * kPlaces + 16], 0);
  run(this->world, 30);
  EXPECT_NEAR(this->height_of(this->over), 0.25, 0.01) << "there is no pit any more";
  ASSERT_TRUE(this->world.load(before));
  ASSERT_TRUE(this->dig(this->world));
  for (int frame = 0; frame < 60; ++frame) {
    this->world.step();
    ASSERT_EQ(this->world.hash(), hashes[static_cast<std::size_t>(frame)]) << frame;
  }
  ASSERT_TRUE(this->world.load(after));
  for (int frame = 20; frame < 60; ++frame) this->world.step();
  EXPECT_EQ(this->world.hash(), ended);
}

TYPED_TEST(SetHeightsOf, who_joins_late_has_the_ground_of_now) {
  using S = TypeParam;
  ASSERT_TRUE(settle(this->world));
  ASSERT_TRUE(this->dig(this->world));
  this->world.step();
  const std::vector<std::uint8_t> bytes = bytes_of(this->world);
  World<S> late(settings<S>(-10));
  Reader reader(bytes);
  ASSERT_TRUE(late.read_portable(reader).ok());
  EXPECT_EQ(late.hash(), this->world.hash());
  const Pit pit;
  for (int frame = 0; frame < 30; ++frame) {
    if (frame == 10) {
      const std::vector<std::int16_t> deeper(25, -4096);
      for (World<S>* w : {&late, &this->world}) ASSERT_TRUE(w->set_heights(this->ground, 0, {14, 14, 5, 5, deeper}));
    }
    late.step();
    this->world.step();
    ASSERT_EQ(late.hash(), this->world.hash()) << frame;
  }
}

TYPED_TEST(SetHeightsOf, command_logs_hold_the_patch) {
  using S = TypeParam;
  World<S> played(settings<S>(-10)), followed(settings<S>(-10));
  std::vector<std::uint8_t> log;
  played.record_to(&log);
  this->build(played);
  for (int frame = 0; frame < 40; ++frame) {
    if (frame == 10) {
      ASSERT_TRUE(this->dig(played));
    }
    played.step();
    ASSERT_TRUE(followed.step_recorded(log).ok()) << frame;
    log.clear();
    ASSERT_EQ(played.hash(), followed.hash()) << frame;
  }
}

TYPED_TEST(SetHeightsOf, a_recording_verifies) {
  using S = TypeParam;
  World<S> w(settings<S>(-10));
  std::vector<std::uint8_t> file;
  WorldRecorder<S> recorder(w, sink_to(file));
  this->build(w);
  ASSERT_TRUE(recorder.begin("a pit is dug").ok());
  for (int frame = 0; frame < 40; ++frame) {
    if (frame % 10 == 5) {
      const Pit pit = {std::vector<std::int16_t>(25, static_cast<std::int16_t>(-50 * frame))};
      ASSERT_TRUE(w.set_heights(this->ground, 0, pit.patch()));
    }
    w.step();
    ASSERT_TRUE(recorder.end_frame().ok()) << frame;
  }
  ASSERT_TRUE(recorder.finish().ok());
  const ReplayReader replay(file);
  World<S> again;
  const VerifyResult result = verify_replay(replay, again, SameHeader{replay.header()});
  EXPECT_EQ(result.outcome, VerifyOutcome::verified) << describe(result);
  EXPECT_EQ(again.hash(), w.hash());
}

TYPED_TEST(SetHeightsOf, other_shapes_of_the_same_field_keep_it) {
  using S = TypeParam;
  World<S>& w = this->world;
  const ShapeId other = w.add_shape(plain());
  EXPECT_EQ(w.state().geometry->names().size(), 1u);
  ASSERT_TRUE(this->dig(w));
  EXPECT_EQ(w.state().geometry->names().size(), 2u);
  EXPECT_EQ(w.height_field(other)->heights()[16 * kPlaces + 16], 0);
  EXPECT_EQ(w.height_field(this->ground)->heights()[16 * kPlaces + 16], kDeep);
  ASSERT_TRUE(w.remove_shape(other));
  EXPECT_EQ(w.state().geometry->find(plain()->id()), GeometryStore::kNone) << "nobody names it any more";
}

TYPED_TEST(SetHeightsOf, an_asset_that_was_changed_is_carried_and_is_one_again_when_it_is_changed_back) {
  using S = TypeParam;
  static const BlobRef asset = plain(BlobHome::asset);
  World<S> w(settings<S>(-10));
  w.use_assets({[](void*, const ContentId& id) { return id == asset->id() ? asset : nullptr; }, nullptr});
  const ShapeId shape = w.add_shape(asset);
  const std::vector<std::int16_t> deep(1, kDeep), level(1, 0);
  ASSERT_TRUE(w.set_heights(shape, 0, {3, 3, 1, 1, deep}));
  EXPECT_EQ(w.state().geometry->content(1)->home(), BlobHome::carried);
  ASSERT_TRUE(w.set_heights(shape, 0, {3, 3, 1, 1, level}));
  EXPECT_EQ(w.state().geometry->content(0), asset);
}

TYPED_TEST(SetHeightsOf, what_is_no_patch_is_refused_and_changes_nothing) {
  using S = TypeParam;
  World<S>& w = this->world;
  const std::vector<std::int16_t> four(4, 5), all(kPlaces * kPlaces, 0);
  const std::vector<std::uint8_t> one(1, 0), two(2, 0), holes((kPlaces - 1) * (kPlaces - 1), BakedHeightField::kHole);
  const std::uint64_t hash = w.hash();
  const auto refused = [&](const HeightPatch& patch, const char* field, std::uint32_t child = 0) {
    EXPECT_FALSE(w.set_heights(this->ground, child, patch));
    EXPECT_STREQ(w.fault().field, field);
    EXPECT_STREQ(w.fault().command, "set_heights");
    EXPECT_EQ(w.hash(), hash);
  };
  refused({0, 0, 2, 2, four}, "child", 1);
  refused({0, 0, 2, 1, four}, "heights");
  refused({32, 0, 2, 2, four}, "heights");
  refused({0, 0, 0, 2, {}}, "heights");
  refused({0, 0, 0xffffffffu, 1, {}}, "heights");
  refused({0, 0, 2, 2, four, two}, "materials");
  refused({0, 0, kPlaces, kPlaces, all, holes}, "materials");
  EXPECT_TRUE(w.set_heights(this->ground, 0, {0, 0, 2, 2, four, one}));
  EXPECT_FALSE(w.set_heights(ShapeId{77, 1}, 0, {0, 0, 2, 2, four}));
  EXPECT_EQ(w.fault(), Fault::stale_id);
  EXPECT_FALSE(w.set_heights(add_ball(w, 1), 0, {0, 0, 2, 2, four}));
  EXPECT_STREQ(w.fault().field, "child");
}

TYPED_TEST(SetHeightsOf, the_box_of_the_body_grows_with_its_field) {
  using S = TypeParam;
  World<S>& w = this->world;
  EXPECT_FALSE(w.cast_ray(vec<S>(-4, 9, 4), vec<S>(0, -4, 0)));
  const std::vector<std::int16_t> tower(1, 8192);
  ASSERT_TRUE(w.set_heights(this->ground, 0, {8, 24, 1, 1, tower}));
  ASSERT_TRUE(w.cast_ray(vec<S>(-4, 9, 4), vec<S>(0.01, -4, 0.01)));
}

}  // namespace set_heights_test
}  // namespace isostep::test
