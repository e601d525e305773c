// Laws of KindGhost: two kinds of bodies pass each other, for as long as the record is there.
// SPDX-License-Identifier: MIT

#include "laws/exact_rollback.hpp"

namespace isostep::test {
namespace kind_ghosts_test {

template <class S> class KindGhosts : public ::testing::Test {
 protected:
  BodyId body(BodyDefinition<S> d, std::uint32_t kind) {
    d.material.kind = kind;
    return w.create(d);
  }
  BodyId platform(D3 at, std::uint32_t kind) { return body(still<S>(add_box(w, 4, 0.125, 4), at), kind); }
  BodyId ball(D3 at, std::uint32_t kind) { return body(moving<S>(add_ball(w, 0.25), at), kind); }
  double height(BodyId id) const { return to_double(w.center_of_mass(id).y); }

  World<S> w{settings<S>()};
};
TYPED_TEST_SUITE(KindGhosts, AllScalars);

TYPED_TEST(KindGhosts, bodies_of_two_kinds_pass_and_others_do_not) {
  using S = TypeParam;
  this->platform({0, 0, 0}, 1);
  const BodyId passes = this->ball({0, 1, 0}, 2), stays = this->ball({2, 1, 0}, 3), plain = this->ball({-2, 1, 0}, 0);
  ASSERT_TRUE(this->w.add(KindGhost<S>{2, 1}));
  run(this->w, 60);
  EXPECT_LT(this->height(passes), -1);
  EXPECT_NEAR(this->height(stays), 0.375, 0.01);
  EXPECT_NEAR(this->height(plain), 0.375, 0.01);
}

TYPED_TEST(KindGhosts, the_record_ends_contacts_as_it_comes_and_lets_them_begin_as_it_goes) {
  using S = TypeParam;
  this->platform({0, 0, 0}, 1);
  this->platform({0, -2, 0}, 4);
  const BodyId ball = this->ball({0, 0.375, 0}, 2);
  ASSERT_TRUE(settle(this->w));
  const KindGhostId id = this->w.add(KindGhost<S>{1, 2});
  this->w.step();
  EXPECT_EQ(this->w.events().contact_end.size(), 1u);
  EXPECT_TRUE(settle(this->w));
  EXPECT_NEAR(this->height(ball), -1.625, 0.01);
  ASSERT_TRUE(this->w.set(id, KindGhost<S>{2, 4}));
  EXPECT_TRUE(this->w.is_awake(ball));
  ASSERT_TRUE(this->w.remove(id));
  run(this->w, 5);
  EXPECT_NEAR(this->height(ball), -1.625, 0.01);
}

TYPED_TEST(KindGhosts, a_kind_may_pass_its_own) {
  using S = TypeParam;
  this->platform({0, 0, 0}, 0);
  const BodyId low = this->ball({0, 0.375, 0}, 5), high = this->ball({0, 1, 0}, 5);
  ASSERT_TRUE(this->w.add(KindGhost<S>{5, 5}));
  run(this->w, 60);
  EXPECT_NEAR(this->height(low), 0.375, 0.01);
  EXPECT_NEAR(this->height(high), 0.375, 0.01);
}

TYPED_TEST(KindGhosts, bullets_sensors_and_characters_ask_it_too) {
  using S = TypeParam;
  this->w.set_gravity(Vec3<S>::zero());
  ASSERT_TRUE(this->w.add(KindGhost<S>{1, 2}));
  const BodyId wall = this->body(still<S>(add_box(this->w, 0.0625, 2, 2), {4, 0, 0}), 1);
  BodyDefinition<S> fast = moving<S>(add_ball(this->w, 0.125), {0, 0, 0}, {60, 0, 0});
  const BodyId bullet = this->body(fast, 2);
  BodyDefinition<S> zone = still<S>(add_box(this->w, 1, 1, 1), {0, 8, 0});
  zone.sensor = true;
  this->body(zone, 1);
  this->ball({0, 8, 0}, 2);
  BodyDefinition<S> d = still<S>(this->w.add_shape(Capsule<S>{num<S>(0.25), num<S>(0.5)}), {3.5, 0, 1});
  d.type = BodyType::kinematic;
  CharacterSettings<S> character;
  character.body = this->body(d, 2);
  character.air_acceleration = S(10);
  const CharacterId walker = this->w.add(character);
  ASSERT_TRUE(walker) << describe(this->w.fault());
  ASSERT_TRUE(this->w.set_input(walker, {vec<S>(2, 0, 0)}));
  for (int i = 0; i < 60; ++i) {
    this->w.step();
    EXPECT_TRUE(this->w.events().sensor_begin.empty());
  }
  EXPECT_GT(to_double(this->w.center_of_mass(bullet).x), 10);
  EXPECT_GT(to_double(this->w.center_of_mass(character.body).x), 4.5);
  EXPECT_TRUE(this->w.contains(wall));
}

TYPED_TEST(KindGhosts, bad_kinds_and_second_records_are_refused) {
  using S = TypeParam;
  ASSERT_TRUE(this->w.add(KindGhost<S>{1, 2}));
  EXPECT_FALSE(this->w.add(KindGhost<S>{2, 1}));
  EXPECT_STREQ(this->w.fault().field, "kind_b");
  EXPECT_FALSE(this->w.add(KindGhost<S>{0, 1}));
  EXPECT_STREQ(this->w.fault().field, "kind_a");
}

TYPED_TEST(KindGhosts, it_is_state) {
  using S = TypeParam;
  this->platform({0, 0, 0}, 1);
  for (std::uint32_t i = 0; i < 8; ++i) this->ball({i * 0.25, 0.5 + i * 0.5, 0}, 1 + i % 3);
  const KindGhostId id = this->w.add(KindGhost<S>{1, 2});
  expect_exact_rollback(this->w, 120, [&](World<S>& world, int i) {
    if (i % 15 == 7) world.set(id, KindGhost<S>{1 + static_cast<std::uint32_t>(i) % 3, 2});
  });
}

/// Their boxes are far apart as the step begins in which it meets the wall.
TYPED_TEST(KindGhosts, what_is_fast_keeps_all_its_way) {
  using S = TypeParam;
  this->w.set_gravity(Vec3<S>::zero());
  ASSERT_TRUE(this->w.add(KindGhost<S>{1, 2}));
  const double speed = 50;
  BodyDefinition<S> d = moving<S>(add_ball(this->w, 0.125), {0, 0, 0}, {speed, 0, 0});
  const BodyId passes = this->body(d, 2);
  d.position = vec<S>(0, 4, 0);
  const BodyId is_stopped = this->body(d, 3);
  for (const double y : {0.0, 4.0}) this->body(still<S>(add_box(this->w, 0.0625, 1, 1), {4, y, 0}), 1);
  run(this->w, 10);
  EXPECT_NEAR(to_double(this->w.center_of_mass(passes).x), speed / 6, 1e-2);
  EXPECT_LT(to_double(this->w.center_of_mass(is_stopped).x), 4);
}

TYPED_TEST(KindGhosts, what_passes_a_sleeper_does_not_wake_it) {
  using S = TypeParam;
  this->platform({0, 0, 0}, 0);
  const BodyId sleeper = this->ball({0, 0.375, 0}, 2), other = this->ball({0, 0.375, 2}, 3);
  const BodyId ghost = this->ball({0, 0.375, -2}, 4);
  ASSERT_TRUE(settle(this->w));
  ASSERT_TRUE(this->w.add(KindGhost<S>{1, 2}));
  ASSERT_TRUE(settle(this->w));
  BodyDefinition<S> d = moving<S>(add_box(this->w, 0.25, 0.25, 4), {-2, 0.5, 0}, {2, 0, 0});
  d.type = BodyType::kinematic;
  const BodyId sweeps = this->body(d, 1);
  ASSERT_TRUE(this->w.set_pose(sweeps, {vec<S>(-0.5, 0.5, 0), Quat<Unit<S>>::identity()}));  // a Ghost ends apart
  ASSERT_TRUE(this->w.add(Ghost<S>{sweeps, ghost})) << describe(this->w.fault());
  ASSERT_TRUE(this->w.sleep(ghost) || !this->w.is_awake(ghost));
  run(this->w, 90);
  EXPECT_GT(to_double(this->w.center_of_mass(sweeps).x), 0.5);
  EXPECT_FALSE(this->w.is_awake(sleeper));
  EXPECT_FALSE(this->w.is_awake(ghost));
  EXPECT_GT(to_double(this->w.center_of_mass(other).x), 0.5);
}

}  // namespace kind_ghosts_test
}  // namespace isostep::test
