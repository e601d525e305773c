// Laws of what parts have of their own: materials, filters, sensors, reports and names, in every system that meets
// them, over drawn sizes, places and speeds.
// SPDX-License-Identifier: MIT
#include "laws/part_worlds.hpp"
#include "random/dice.hpp"

namespace isostep::test {
namespace part_traits_test {

template <class S> class PartTraitsLaws : public PartWorlds<S> {};
TYPED_TEST_SUITE(PartTraitsLaws, AllScalars);

TYPED_TEST(PartTraitsLaws, a_box_slides_as_far_as_the_part_below_it_lets_it) {
  Dice dice(1);
  for (int i = 0; i < 4; ++i) {
    using S = TypeParam;
    this->w = World<S>(settings<S>());
    const double speed = dice.in(1, 2.5), rough = dice.in(0.4, 0.8);
    this->fixed(this->floors(this->slippery(0), this->slippery(rough * rough / 0.6)));  // mixed with 0.6
    const BodyId on_ice = this->loose({this->box({0.25, 0.25, 0.25}, {0, 0, 0})}, {-12, 0.25, 0}, {speed, 0, 0});
    const BodyId on_rubber = this->loose({this->box({0.25, 0.25, 0.25}, {0, 0, 0})}, {6, 0.25, 0}, {speed, 0, 0});
    run(this->w, 60);
    EXPECT_NEAR(this->at(on_ice).x, -12 + speed, 0.03) << i;
    EXPECT_NEAR(this->at(on_rubber).x, 6 + speed * speed / (2 * 10 * rough), 0.06) << i;
  }
}

TYPED_TEST(PartTraitsLaws, the_part_that_touches_bounces_and_not_its_body) {
  using S = TypeParam;
  Material<S> rubber;
  rubber.restitution = num<S>(0.75);
  this->fixed(this->floors({}, PartTraits<S>{}.with(rubber)));
  const BodyId dull = this->loose({this->box({0.25, 0.25, 0.25}, {0, 0, 0})}, {-4, 1.5, 0});
  const BodyId lively = this->loose({this->box({0.25, 0.25, 0.25}, {0, 0, 0})}, {4, 1.5, 0});
  double highest_dull = 0, highest_lively = 0;
  for (int i = 0; i < 60; ++i) {
    this->w.step();
    if (i < 36) continue;
    highest_dull = std::max(highest_dull, this->at(dull).y);
    highest_lively = std::max(highest_lively, this->at(lively).y);
  }
  EXPECT_LT(highest_dull, 0.3);
  EXPECT_NEAR(highest_lively, 0.25 + 1.25 * 0.75 * 0.75, 0.12);
}

TYPED_TEST(PartTraitsLaws, a_part_holds_what_its_filter_meets_though_its_body_does_not_and_the_other_way) {
  Dice dice(2);
  for (int i = 0; i < 4; ++i) {
    using S = TypeParam;
    this->w = World<S>(settings<S>());
    const double size = dice.in(0.2, 0.5);
    this->fixed(this->floors(this->only(kOther), {}));
    BodyDefinition<S> d = this->quiet(moving<S>(add_box(this->w, size, size, size), {-4, size + 0.1, 0}));
    const BodyId falls = this->w.create(d);
    d.position = vec<S>(4, size + 0.1, 0);
    const BodyId lies = this->w.create(d);
    d.filter = {kOther, kOther, 0};
    d.position = vec<S>(-6, size + 0.1, 0);
    const BodyId other_lies = this->w.create(d);
    d.position = vec<S>(6, size + 0.1, 0);
    const BodyId other_falls = this->w.create(d);
    run(this->w, 90);
    EXPECT_LT(this->at(falls).y, -2) << i;
    EXPECT_NEAR(this->at(lies).y, size, 0.02) << i;
    EXPECT_NEAR(this->at(other_lies).y, size, 0.02) << i;
    EXPECT_LT(this->at(other_falls).y, -2) << i;
  }
}

TYPED_TEST(PartTraitsLaws, a_fast_ball_passes_the_part_that_its_filter_does_not_meet_and_is_stopped_by_the_next) {
  Dice dice(3);
  for (int i = 0; i < 6; ++i) {
    using S = TypeParam;
    this->w = World<S>(settings<S>(0));
    const double most = pick<S>(110, 110, 62, 110);  // [m/s]
    const double speed = dice.in(0.6 * most, most), gap = dice.in(1, 3);
    this->fixed({this->box({0.0625, 2, 2}, {3, 0, 0}, this->only(kOther)),
                 this->box({0.0625, 2, 2}, {3 + gap, 0, 0}, this->flagged(part_flag::kSensor)),
                 this->box({0.0625, 2, 2}, {3 + 2 * gap, 0, 0})});
    const BodyId ball = this->w.create(this->quiet(moving<S>(add_ball(this->w, 0.125), {0, 0, 0}, {speed, 0, 0})));
    run(this->w, 30);
    EXPECT_GT(this->at(ball).x, 3 + gap) << i;
    EXPECT_LT(this->at(ball).x, 3 + 2 * gap) << i;
  }
}

TYPED_TEST(PartTraitsLaws, queries_see_a_part_by_its_own_filter_and_name_it) {
  Dice dice(4);
  for (int i = 0; i < 8; ++i) {
    using S = TypeParam;
    this->w = World<S>(settings<S>());
    const double x = dice.in(2, 6), half = dice.in(0.25, 0.75);
    const BodyId body = this->fixed({this->box({half, 1, 1}, {x, 0, 0}, this->only(kOther)),
                                     this->box({half, 1, 1}, {x + 3, 0, 0}, this->flagged(part_flag::kSensor)),
                                     this->box({half, 1, 1}, {x + 6, 0, 0})});
    const auto child_of = [&](const QueryFilter& filter) {
      const auto hit = this->w.cast_ray(vec<S>(0, 0, 0), vec<S>(20, 0, 0), filter);
      EXPECT_TRUE(hit && hit->body == body) << i;
      const auto swept = this->w.cast_shape(primitive_of(Sphere<S>{num<S>(0.125)}),
                                            {vec<S>(0, 0, 0), Quat<Unit<S>>::identity()}, vec<S>(20, 0, 0), filter);
      EXPECT_TRUE(swept && swept->child == hit->child) << i;
      const auto closest = this->w.closest_point(vec<S>(0, 0, 0), num<S>(30), filter);
      EXPECT_TRUE(closest && closest->child == hit->child) << i;
      return hit ? hit->child : 9u;
    };
    EXPECT_EQ(child_of({}), 0u);
    EXPECT_EQ(child_of({.mask = kOther}), 0u);
    EXPECT_EQ(child_of({.mask = 1}), 2u);
    EXPECT_EQ(child_of({.mask = 1, .sensors = true}), 1u);
    std::vector<OverlapHit> overlaps;
    this->w.overlap_shape(primitive_of(Box<S>{vec<S>(12, 1, 1)}), {vec<S>(x + 3, 0, 0), Quat<Unit<S>>::identity()},
                          overlaps, {.mask = 1, .per = HitPer::child});
    ASSERT_EQ(overlaps.size(), 1u);
    EXPECT_EQ(overlaps[0].child, 2u);
    std::vector<BodyId> seen;
    this->w.overlap_shape(primitive_of(Box<S>{vec<S>(0.5, 1, 1)}), {vec<S>(x, 0, 0), Quat<Unit<S>>::identity()}, seen,
                          {.mask = 1});
    EXPECT_TRUE(seen.empty());
  }
}

TYPED_TEST(PartTraitsLaws, contacts_begin_and_end_for_who_asks_and_name_the_parts) {
  using S = TypeParam;
  const BodyId ground = this->fixed(this->floors({}, this->flagged(part_flag::kReportContacts)));
  const BodyId quiet = this->loose({this->box({0.25, 0.25, 0.25}, {0, 0, 0})}, {-4, 0.5, 0});
  const BodyId told =
      this->loose({this->box({0.25, 0.25, 0.25}, {0, 1, 0}), this->box({0.5, 0.25, 0.5}, {0, 0, 0})}, {4, 0.5, 0});
  std::vector<ContactBegin<S>> begins;
  std::vector<ContactEnd> ends;
  for (int i = 0; i < 90; ++i) {
    if (i == 60) {
      this->w.set_pose(quiet, {vec<S>(-4, 3, 0), Quat<Unit<S>>::identity()});
      this->w.set_pose(told, {vec<S>(4, 3, 0), Quat<Unit<S>>::identity()});
    }
    this->w.step();
    for (const auto& begin : this->w.events().contact_begin) begins.push_back(begin);
    for (const auto& end : this->w.events().contact_end) ends.push_back(end);
  }
  ASSERT_GE(begins.size(), 1u);
  ASSERT_GE(ends.size(), 1u);
  for (const auto& begin : begins) {
    EXPECT_EQ(begin.a, ground);
    EXPECT_EQ(begin.b, told);
    EXPECT_EQ(begin.child_a, 1u);
    EXPECT_EQ(begin.child_b, 1u);
    EXPECT_GT(to_double(begin.impulse), 0);
  }
  for (const auto& end : ends) {
    EXPECT_EQ(end.b, told);
    EXPECT_EQ(end.child_a, 1u);
    EXPECT_EQ(end.child_b, 1u);
  }
}

TYPED_TEST(PartTraitsLaws, a_destroyed_body_ends_the_contacts_that_were_reported_alone) {
  this->fixed(this->floors({}, this->flagged(part_flag::kReportContacts)));
  const BodyId quiet = this->loose({this->box({0.25, 0.25, 0.25}, {0, 0, 0})}, {-4, 0.25, 0});
  const BodyId told = this->loose({this->box({0.25, 0.25, 0.25}, {0, 0, 0})}, {4, 0.25, 0});
  run(this->w, 10);
  this->w.destroy(quiet);
  this->w.destroy(told);
  this->w.step();
  ASSERT_EQ(this->w.events().contact_end.size(), 1u);
  EXPECT_EQ(this->w.events().contact_end[0].b, told);
  EXPECT_EQ(this->w.events().contact_end[0].child_a, 1u);
}

TYPED_TEST(PartTraitsLaws, a_part_that_senses_has_no_contacts_and_tells_what_is_in_it_by_part) {
  Dice dice(5);
  for (int i = 0; i < 6; ++i) {
    using S = TypeParam;
    this->w = World<S>(settings<S>(0));
    const double speed = dice.in(1, 3), size = dice.in(0.25, 0.5);
    // A post that looks to its left and, further up, to nowhere.
    const BodyId post = this->fixed({this->box({0.25, 1, 1}, {8, 0, 0}),
                                     this->box({2, 0.5, 0.5}, {0, 0, 0}, this->flagged(part_flag::kSensor)),
                                     this->box({2, 0.5, 0.5}, {0, 6, 0}, this->flagged(part_flag::kSensor))});
    const BodyId ball =
        this->loose({part_at(primitive_of(Sphere<S>{num<S>(size)}), {0, 0, 0})}, {-4, 0, 0}, {speed, 0, 0});
    int begins = 0, ends = 0;
    for (int f = 0; f < 420; ++f) {
      this->w.step();
      for (const SensorEvent& e : this->w.events().sensor_begin) {
        EXPECT_EQ(e.sensor, post);
        EXPECT_EQ(e.other, ball);
        EXPECT_EQ(e.sensor_child, 1u);
        EXPECT_EQ(e.other_child, 0u);
        EXPECT_NEAR(this->at(ball).x, -2 - size, speed / 30 + 0.01) << i;
        ++begins;
      }
      for (const SensorEvent& e : this->w.events().sensor_end) {
        EXPECT_EQ(e.sensor_child, 1u);
        EXPECT_NEAR(this->at(ball).x, 2 + size, speed / 30 + 0.01) << i;
        ++ends;
      }
      if (this->at(ball).x > 4) break;
      EXPECT_NEAR(to_double(this->w.velocity(ball).x), speed, 1e-3) << "nothing slows it";
    }
    EXPECT_EQ(begins, 1) << i;
    EXPECT_EQ(ends, 1) << i;
  }
}

TYPED_TEST(PartTraitsLaws, a_moving_body_with_a_part_that_senses_sees_what_lies_still_and_weighs_what_it_did_without) {
  using S = TypeParam;
  this->w = World<S>(settings<S>(0));
  const BodyId still_box = this->fixed({this->box({0.5, 0.5, 0.5}, {0, 0, 0})}, {4, 0, 0});
  const BodyId plain = this->loose({this->box({0.25, 0.25, 0.25}, {0, 0, 0})}, {-8, 8, 0});
  const BodyId seer = this->loose({this->box({0.25, 0.25, 0.25}, {0, 0, 0}),
                                   this->box({0.5, 0.25, 0.25}, {1, 0, 0}, this->flagged(part_flag::kSensor))},
                                  {0, 0, 0}, {1, 0, 0});
  EXPECT_EQ(this->w.mass(seer), this->w.mass(plain));
  EXPECT_EQ(this->w.center_of_mass(seer), vec<S>(0, 0, 0));
  bool seen = false;
  for (int f = 0; f < 180; ++f) {
    this->w.step();
    for (const SensorEvent& e : this->w.events().sensor_begin) {
      EXPECT_EQ(e.sensor, seer);
      EXPECT_EQ(e.sensor_child, 1u);
      EXPECT_EQ(e.other, still_box);
      EXPECT_NEAR(this->at(seer).x, 2, 0.05);
      seen = true;
    }
  }
  EXPECT_TRUE(seen);
  EXPECT_NEAR(this->at(seer).x, 3, 0.05);
}

TYPED_TEST(PartTraitsLaws, a_sleeper_wakes_by_what_touches_it_and_not_by_what_passes_its_parts) {
  for (const bool touches : {false, true}) {
    using S = TypeParam;
    this->w = World<S>(settings<S>());
    add_ground(this->w);
    BodyDefinition<S> d = moving<S>(
        this->shape({this->box({3, 0.25, 3}, {0, 0, 0}),
                     this->box({0.5, 0.5, 0.5}, {0, 0.75, 0}, touches ? PartTraits<S>{} : this->only(kOther))}),
        {0, 0.25, 0});
    const BodyId sleeper = this->w.create(d);
    ASSERT_TRUE(settle(this->w));
    BodyDefinition<S> lift = moving<S>(add_ball(this->w, 0.25), {0, 4, 0}, {0, -2, 0});
    lift.type = BodyType::kinematic;
    this->w.create(lift);
    run(this->w, 75);
    EXPECT_EQ(this->w.is_awake(sleeper), touches);
  }
}

TYPED_TEST(PartTraitsLaws, a_character_stands_on_the_part_that_it_meets) {
  using S = TypeParam;
  for (const bool meets : {false, true}) {
    this->w = World<S>(settings<S>());
    this->fixed({this->box({8, 0.5, 8}, {0, -4.5, 0}),
                 this->box({8, 0.5, 8}, {0, -0.5, 0}, meets ? PartTraits<S>{} : this->only(kOther)),
                 this->box({8, 0.5, 8}, {0, -0.5, 0}, this->flagged(part_flag::kSensor))});
    BodyDefinition<S> d = still<S>(this->w.add_shape(Capsule<S>{num<S>(0.25), num<S>(0.5)}), {0, 1, 0});
    d.type = BodyType::kinematic;
    CharacterSettings<S> character;
    character.body = this->w.create(d);
    const CharacterId id = this->w.add(character);
    ASSERT_TRUE(id);
    run(this->w, 120);
    EXPECT_NEAR(this->at(character.body).y, meets ? 0.75 : -3.25, 0.1);
  }
}

TYPED_TEST(PartTraitsLaws, a_belt_carries_a_character_through_the_parts_that_it_does_not_meet) {
  using S = TypeParam;
  for (const PartTraits<S>& over : {this->flagged(part_flag::kSensor), this->only(kOther)}) {
    this->w = World<S>(settings<S>());
    // Both parts are as near to the foot; the first is no ground.
    const BodyId ground =
        this->fixed({this->box({8, 0.5, 8}, {0, -0.5, 0}, over), this->box({8, 0.5, 8}, {0, -0.5, 0})});
    ASSERT_TRUE(this->w.add(SurfaceVelocity<S>{ground, vec<S>(1, 0, 0), Vec3<S>::zero(), 1}));
    BodyDefinition<S> d = still<S>(this->w.add_shape(Capsule<S>{num<S>(0.25), num<S>(0.5)}), {0, 0.8125, 0});
    d.type = BodyType::kinematic;
    CharacterSettings<S> character;
    character.body = this->w.create(d);
    ASSERT_TRUE(this->w.add(character));
    run(this->w, 30);
    const double from = this->at(character.body).x;
    run(this->w, 60);
    EXPECT_NEAR(this->at(character.body).x - from, 1, 0.02);
  }
}

TYPED_TEST(PartTraitsLaws, a_wheel_finds_the_ground_that_a_part_of_the_same_body_hides) {
  using S = TypeParam;
  this->w = World<S>(settings<S>());
  this->fixed({this->box({8, 0.25, 8}, {0, 0.25, 0}, this->only(kOther)), this->box({8, 0.5, 8}, {0, -0.5, 0})});
  BodyDefinition<S> d = this->quiet(moving<S>(add_box(this->w, 1, 0.125, 1), {0, 1, 0}));
  d.mass = num<S>(4);
  const BodyId chassis = this->w.create(d);
  for (int i = 0; i < 4; ++i) {
    WheelSettings<S> wheel;
    wheel.body = chassis;
    wheel.hard_point = vec<S>(i % 2 == 0 ? 1 : -1, 0, i < 2 ? 1 : -1);
    wheel.radius = num<S>(0.25);
    wheel.free_length = num<S>(0.5);
    wheel.travel = num<S>(0.375);
    wheel.stiffness = S(400);
    wheel.damping = S(60);
    ASSERT_TRUE(this->w.add(wheel)) << describe(this->w.fault());
  }
  run(this->w, 120);
  EXPECT_GT(this->at(chassis).y, 0.3);
  EXPECT_LT(this->at(chassis).y, 0.8) << "the wheels stand on the lower part";
}

TYPED_TEST(PartTraitsLaws, what_is_wrong_with_a_part_is_told_with_its_number) {
  using S = TypeParam;
  const auto refused = [&](const PartTraits<S>& traits, Fault fault, const char* field) {
    const Child<S> parts[] = {this->box({1, 1, 1}, {0, 0, 0}), this->box({1, 1, 1}, {2, 0, 0}, traits)};
    EXPECT_FALSE(this->w.add_shape(std::span<const Child<S>>(parts)));
    EXPECT_EQ(this->w.fault().fault, fault);
    EXPECT_STREQ(this->w.fault().field, field);
    EXPECT_EQ(this->w.fault().child, 1u);
  };
  refused(this->slippery(-1), Fault::bad_argument, "material.friction");
  refused(this->flagged(16), Fault::bad_argument, "traits.flags");
  PartTraits<S> unflagged = this->slippery(0.25);
  unflagged.flags = 0;
  refused(unflagged, Fault::bad_argument, "traits.material");
  unflagged = this->only(kOther);
  unflagged.flags = 0;
  refused(unflagged, Fault::bad_argument, "traits.filter");
}

TYPED_TEST(PartTraitsLaws, worlds_that_are_saved_and_written_go_on_alike) {
  using S = TypeParam;
  this->w = World<S>(settings<S>());
  this->fixed(this->floors(this->slippery(0.1), this->flagged(part_flag::kReportContacts)));
  Dice dice(6);
  for (int i = 0; i < 12; ++i) {
    const double z = dice.in(-1, 1), friction = dice.in(0, 1);
    this->loose({this->box({0.25, 0.25, 0.25}, {0, 0, 0}, this->slippery(friction)),
                 this->box({0.5, 0.125, 0.5}, {0, -0.5, 0}, this->flagged(part_flag::kSensor))},
                {3.0 * (i % 4) - 5, 2.0 + 2 * (i / 4), z});
  }
  run(this->w, 60);
  typename World<S>::Snapshot saved;
  this->w.save(saved);
  World<S> read(settings<S>());
  const std::vector<std::uint8_t> bytes = bytes_of(this->w);
  Reader reader(bytes);
  ASSERT_TRUE(read.read_portable(reader).ok());
  run(this->w, 60);
  run(read, 60);
  EXPECT_EQ(read.hash(), this->w.hash());
  this->w.load(saved);
  run(this->w, 60);
  EXPECT_EQ(read.hash(), this->w.hash());
}

}  // namespace part_traits_test
}  // namespace isostep::test
