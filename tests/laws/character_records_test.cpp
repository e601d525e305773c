// Laws of characters' records: what is refused, what a body's filter says, what a step leaves, and what a game sets.
// SPDX-License-Identifier: MIT

#include <algorithm>

#include "laws/characters.hpp"

namespace isostep::test {
namespace character_records_test {

template <class S> class CharacterRecords : public Characters<S> {};
TYPED_TEST_SUITE(CharacterRecords, AllScalars);

TYPED_TEST(CharacterRecords, are_told_where_to_go_and_nobody_else_wakes) {
  add_ground(this->w);
  const BodyId crate = this->box({0.5, 0.5, 0.5}, {20, 0.5, 0}, BodyType::dynamic, 10);
  const CharacterId id = this->walker({0, 0, 0});
  this->walk(id, {1, 0, 0}, 120);
  EXPECT_EQ(this->w.counts().asleep, 1u);
  EXPECT_TRUE(this->w.set(id, *this->w.find(id)));
  EXPECT_TRUE(this->w.set_input(id, *this->w.input(id)));
  EXPECT_EQ(this->w.counts().asleep, 1u);
  this->walk(id, {10, 0, 0}, 150);  // and into it
  EXPECT_EQ(this->w.counts().asleep, 0u);
  EXPECT_GT(real(this->w.center_of_mass(crate)).x, 20.1);
}

TYPED_TEST(CharacterRecords, records_refuse_what_they_cannot_use) {
  using S = TypeParam;
  World<S>& world = this->w;
  const BodyId crate = this->box({1, 1, 1}, {0, 5, 0}, BodyType::dynamic, 10);
  CharacterSettings<S> c;
  EXPECT_FALSE(world.add(c));
  c.body = crate;
  EXPECT_FALSE(world.add(c));
  EXPECT_STREQ(world.fault().field, "body");
  const CharacterId id = this->walker({5, 0, 0});
  c = *world.find(id);
  EXPECT_FALSE(world.add(c)) << "one a body";
  const auto refused = [&](const char* field, const auto& change) {
    CharacterSettings<S> bad = *world.find(id);
    change(bad);
    EXPECT_FALSE(world.set(id, bad)) << field;
    EXPECT_STREQ(world.fault().field, field);
  };
  refused("step_height", [](auto& b) { b.step_height = S(-1); });
  refused("least_up", [](auto& b) { b.least_up = S(0); });
  refused("skin", [](auto& b) { b.skin = S(0); });
  refused("mass", [](auto& b) { b.mass = S(-1); });
  refused("push_force", [](auto& b) { b.push_force = S(-1); });
  refused("air_acceleration", [](auto& b) { b.air_acceleration = S(-1); });
  refused("gravity_scale", [](auto& b) { b.gravity_scale = S(17); });
  const std::uint64_t before = world.hash();
  const auto refused_input = [&](const char* field, const CharacterInput<S>& bad) {
    EXPECT_FALSE(world.set_input(id, bad)) << field;
    EXPECT_STREQ(world.fault().field, field);
    EXPECT_EQ(world.hash(), before);
  };
  refused_input("move", {.move = {Limits<S>::speed(), S(0), S(0)}});
  refused_input("jump", {.jump = S(-1)});
  ASSERT_TRUE(world.remove(id));
  EXPECT_FALSE(world.set_input(id, {}));
  EXPECT_EQ(world.fault(), Fault::stale_id);
  EXPECT_EQ(world.input(id), nullptr);
  EXPECT_EQ(world.state(id), nullptr);
}

/// What a step writes is no field of the settings: who sets them from a copy of the first frame takes nothing back.
TYPED_TEST(CharacterRecords, fall_and_walk_alike_whether_a_game_sets_their_settings_too) {
  using S = TypeParam;
  add_ground(this->w);
  this->box({0.5, 0.15, 2}, {4, 0.15, 0});
  const CharacterId id = this->walker({0, 2, 0});
  const CharacterSettings<S> copy = *this->w.find(id);
  typename World<S>::Snapshot start;
  this->w.save(start);
  World<S> other(settings<S>());
  ASSERT_TRUE(other.load(start));
  double lowest = 2, highest = 0;
  for (int i = 0; i < 180; ++i) {
    const CharacterInput<S> input = {vec<S>(2, 0, i % 40 < 20 ? 0.5 : -0.5), num<S>(i == 90 ? 4 : 0)};
    ASSERT_TRUE(this->w.set_input(id, input));
    ASSERT_TRUE(other.set(id, copy));
    ASSERT_TRUE(other.set_input(id, input));
    this->w.step(), other.step();
    ASSERT_EQ(this->w.hash(), other.hash()) << i;
    const double height = this->foot(id).y;
    if (i < 90) lowest = std::min(lowest, height);
    else highest = std::max(highest, height);
  }
  EXPECT_NEAR(lowest, 0, 0.01);  // it fell
  EXPECT_GT(highest, 0.5);       // and jumped
  EXPECT_GT(this->foot(id).x, 4);
}

TYPED_TEST(CharacterRecords, keep_an_input_until_another_but_a_jump_once) {
  using S = TypeParam;
  add_ground(this->w);
  const CharacterId id = this->walker({0, 0, 0});
  run(this->w, 2);
  this->ask(id, {1, 0, 0}, 3);
  run(this->w, 1);
  EXPECT_EQ(this->footing(id), Footing::airborne);
  EXPECT_EQ(this->w.input(id)->jump, S(0));
  run(this->w, 119);
  EXPECT_EQ(this->footing(id), Footing::floor);
  EXPECT_EQ(this->w.input(id)->move, vec<S>(1, 0, 0));
  EXPECT_GT(this->foot(id).x, 1);
}

/// Ground that a command puts elsewhere carries at any speed; what a character keeps of that is within the limits, so
/// that every state that a step leaves can be read.
TYPED_TEST(CharacterRecords, is_thrown_no_faster_than_the_limit_by_ground_that_jumps_away) {
  using S = TypeParam;
  for (const double jump : {0.0, 5.0}) {
    this->w = World<S>(settings<S>());
    this->capsule_ = {};
    const BodyId plate = this->box({2, 0.25, 2}, {0, -0.25, 0}, BodyType::kinematic);
    const CharacterId id = this->walker({0, 0, 0});
    run(this->w, 2);
    ASSERT_EQ(this->footing(id), Footing::floor);
    const double far = 0.9 * to_double(Limits<S>::position());
    ASSERT_TRUE(this->w.set_pose(plate, {vec<S>(-far, 0, far), Quat<Unit<S>>::identity()}));
    this->ask(id, {1, 0, 0}, jump);
    for (int i = 0; i < 5; ++i) {
      this->w.step();
      const D3 v = real(this->w.state(id)->velocity);
      EXPECT_LE(std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}), to_double(Limits<S>::speed())) << i;
      const std::vector<std::uint8_t> bytes = bytes_of(this->w);
      World<S> other(settings<S>());
      Reader reader(bytes);
      ASSERT_TRUE(other.read_portable(reader).ok()) << i;
      EXPECT_EQ(other.hash(), this->w.hash());
    }
  }
}

/// As contacts are made: by the group of both bodies and the masks of both.
TYPED_TEST(CharacterRecords, is_stopped_by_what_its_body_collides_with_alone) {
  struct Case {
    Filter own, wall;
    bool stops;
  };
  const Case cases[] = {{{}, {}, true},
                        {{.group = 3}, {.group = 3}, false},
                        {{.group = 3}, {.group = 4}, true},
                        {{.category = 2}, {.mask = 1}, false},
                        {{.category = 2}, {.mask = 2}, true},
                        {{.mask = 1}, {.category = 2}, false}};
  for (const Case& c : cases) {
    SCOPED_TRACE(testing::Message() << "case " << &c - cases);
    this->w = World<TypeParam>(settings<TypeParam>());
    this->capsule_ = {};
    add_ground(this->w);
    const BodyId wall = this->box({0.5, 2, 4}, {3, 2, 0});
    const CharacterId id = this->walker({0, 0, 0});
    ASSERT_TRUE(this->w.set_filter(wall, c.wall));
    ASSERT_TRUE(this->w.set_filter(this->w.find(id)->body, c.own));
    EXPECT_TRUE(this->walk(id, {4, 0, 0}, 120));
    if (c.stops) EXPECT_NEAR(this->foot(id).x, 2.5 - kRadius - this->kSkin, 0.02);
    else EXPECT_NEAR(this->foot(id).x, 8, 0.1);
  }
}

}  // namespace character_records_test
}  // namespace isostep::test
