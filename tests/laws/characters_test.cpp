// Laws of characters: the cases that character controllers are known to fail.
// SPDX-License-Identifier: MIT

#include "laws/characters.hpp"

#include <algorithm>

#include "random/dice.hpp"
#include "unit/world/edited_state.hpp"

namespace isostep::test {
namespace characters_test {

TYPED_TEST_SUITE(Characters, AllScalars);

TYPED_TEST(Characters, walks_over_tiles_as_over_one_floor) {  // case 1
  for (int i = 0; i < 12; ++i) this->box({1, 0.5, 2}, {2.0 * i, -0.5, 0});
  const CharacterId id = this->walker({0, 0, 0});
  run(this->w, 2);
  double lowest = 1, highest = -1;
  for (int i = 0; i < 240; ++i) {
    EXPECT_TRUE(this->walk(id, {5, 0, 0.25}, 1)) << i;
    lowest = std::min(lowest, this->foot(id).y);
    highest = std::max(highest, this->foot(id).y);
  }
  EXPECT_NEAR(this->foot(id).x, 20, 0.1);
  EXPECT_LT(highest - lowest, 1e-3);
  EXPECT_NEAR(highest, 0, 2e-3);
}

TYPED_TEST(Characters, climbs_stairs_and_comes_down_without_leaving_them) {  // case 2
  using S = TypeParam;
  for (const int hz : {30, 60, 240}) {
    for (const double speed : {1.0, 5.0}) {
      this->w = World<S>(settings<S>(-10, hz));
      this->capsule_ = {};
      add_ground(this->w);
      for (int i = 0; i < 8; ++i) this->box({0.15 * (8 - i), 0.15, 2}, {4 + 0.15 * i, 0.15 + 0.3 * i, 0});
      const CharacterId id = this->walker({0, 0, 0});
      run(this->w, 2);
      int up = 0, down = 0;
      const int ideal = static_cast<int>(5.05 / speed * hz);
      while (this->foot(id).x < 5.05 && ++up < 2 * ideal) this->walk(id, {speed, 0, 0}, 1);
      EXPECT_NEAR(this->foot(id).y, 2.4, 0.01) << speed << " " << hz;
      EXPECT_LT(up, 1.2 * ideal) << speed << " " << hz;  // the stairs are as steep as walls that are no stairs
      bool grounded = true;
      while (this->foot(id).x > 0.05 && ++down < 2 * ideal) grounded = this->walk(id, {-speed, 0, 0}, 1) && grounded;
      EXPECT_TRUE(grounded) << speed << " " << hz;
      EXPECT_LT(down, ideal + hz / 10 + 2) << speed << " " << hz;
      EXPECT_NEAR(this->foot(id).y, 0, 0.01) << speed << " " << hz;
    }
  }
}

TYPED_TEST(Characters, climbs_what_is_lower_than_a_step_and_nothing_higher) {  // case 3
  const double high[] = {0.39, 0.41};
  for (int k = 0; k < 2; ++k) {
    for (const double angle : {0.0, 0.5, 1.0}) {
      this->w = World<TypeParam>(settings<TypeParam>());
      this->capsule_ = {};
      add_ground(this->w);
      this->box({2, high[k] / 2, 6}, {3, high[k] / 2, 0});
      const CharacterId id = this->walker({0.25, 0, 0});
      run(this->w, 2);
      this->walk(id, {3 * std::cos(angle), 0, 3 * std::sin(angle)}, 60);
      EXPECT_NEAR(this->foot(id).y, k == 0 ? high[k] : 0.0, 5e-3) << high[k] << " " << angle;
    }
  }
}

TYPED_TEST(Characters, walks_up_slopes_to_its_limit_and_gains_nothing_by_jumping_at_steeper_ones) {  // case 4
  for (const double degrees : {43.0, 47.0}) {
    this->w = World<TypeParam>(settings<TypeParam>());
    this->capsule_ = {};
    add_ground(this->w);
    const double angle = degrees * kPi / 180;
    this->ramp(angle, {3.5, 0.5, 0});
    const CharacterId id = this->walker({-1.5, 0, 0});
    run(this->w, 2);
    this->walk(id, {2, 0, 0}, 180);
    if (degrees < 45) {
      EXPECT_GT(this->foot(id).y, 0.5);
      continue;
    }
    const double before = this->foot(id).y;
    EXPECT_LT(before, 0.2);
    for (int i = 0; i < 300; ++i) {
      this->ask(id, {2, 0, 0}, i % 75 == 0 ? 3 : 0);
      this->w.step();
    }
    EXPECT_LT(this->foot(id).y, before + 0.005);
  }
}

TYPED_TEST(Characters, stands_still_in_corners) {  // case 5
  for (const double opening : {0.6, 1.2, 2.0}) {
    this->w = World<TypeParam>(settings<TypeParam>());
    this->capsule_ = {};
    add_ground(this->w);
    for (const double side : {-1.0, 1.0}) {
      BodyDefinition<TypeParam> d = still<TypeParam>(add_box(this->w, 4, 2, 0.25));
      const double lean = side * opening / 2;
      // Walls from the corner at x = 3 back to the character.
      d.position = vec<TypeParam>(3 - 4 * std::cos(lean), 1, 4 * std::sin(lean));
      d.orientation = turn<TypeParam>({0, 1, 0}, lean);
      this->w.create(d);
    }
    const CharacterId id = this->walker({0, 0, 0});
    run(this->w, 2);
    this->walk(id, {5, 0, 0.5}, 90);
    for (int i = 0; i < 30; ++i) {
      const D3 before = this->foot(id);
      this->walk(id, {5, 0, 0.5}, 1);
      EXPECT_LT(length(this->foot(id) - before), pick<TypeParam>(1e-4, 1e-4, 1e-3, 1e-4)) << opening << " " << i;
    }
    EXPECT_EQ(this->w.state(id)->stuck, 0u);
  }
}

TYPED_TEST(Characters, stops_where_a_ramp_meets_the_ceiling) {  // case 6
  this->ramp(0.5, {3, 0.5, 0});
  this->box({6, 0.5, 2}, {3, 4.0, 0});
  add_ground(this->w);
  const CharacterId id = this->walker({-1.5, 0, 0});
  run(this->w, 2);
  this->walk(id, {3, 0, 0}, 180);
  EXPECT_LE(this->foot(id).y + 2 * (kRadius + kHalf), 3.5);
  EXPECT_GT(this->foot(id).y, 0.5);
  EXPECT_EQ(this->w.state(id)->stuck, 0u);
}

TYPED_TEST(Characters, rides_platforms_that_move_and_turn) {  // case 7
  using S = TypeParam;
  const D3 speeds[] = {{0, 3, 0}, {0, -3, 0}, {5, 0, 0}, {3, -3, 0}};
  for (const D3 speed : speeds) {
    this->w = World<S>(settings<S>());
    this->capsule_ = {};
    const BodyId deck = this->box({2, 0.25, 2}, {0, 4.75, 0}, BodyType::kinematic);
    const CharacterId id = this->walker({0, 5, 0});
    run(this->w, 2);
    this->w.set_velocity(deck, vec<S>(speed), Vec3<S>::zero());
    const D3 apart = this->foot(id) - real(this->w.center_of_mass(deck));
    run(this->w, 60);
    const D3 slip = this->foot(id) - real(this->w.center_of_mass(deck)) - apart;
    EXPECT_LT(length(slip), pick<S>(2e-3, 1e-3, 5e-3, 1e-3)) << speed.x << " " << speed.y;
    EXPECT_EQ(this->footing(id), Footing::floor);
    this->ask(id, {0, 0, 0}, 4);
    this->w.step();
    EXPECT_NEAR(to_double(this->w.state(id)->velocity.x), speed.x, 0.3);
    EXPECT_EQ(this->footing(id), Footing::airborne);
  }
}

TYPED_TEST(Characters, turns_with_a_turning_floor) {  // case 7
  using S = TypeParam;
  const BodyId deck = this->box({3, 0.25, 3}, {0, -0.25, 0}, BodyType::kinematic);
  this->w.set_velocity(deck, Vec3<S>::zero(), vec<S>(0, kPi / 2, 0));
  const CharacterId id = this->walker({2, 0, 0});
  run(this->w, 61);
  expect_near(this->foot(id), {0, 0, -2}, pick<S>(0.04, 0.04, 0.05, 0.04));
}

TYPED_TEST(Characters, pushes_crates_with_its_force) {  // case 8
  using S = TypeParam;
  for (const double mass : {10.0, 100.0, 1000.0}) {
    this->w = World<S>(settings<S>());
    this->capsule_ = {};
    add_ground(this->w, 0);
    BodyDefinition<S> d = moving<S>(add_box(this->w, 0.5, 0.5, 0.5), {1.5, 0.5, 0});
    d.mass = num<S>(mass);
    d.material.friction = S(0);
    d.locks = body_flag::kAngularLocks;
    const BodyId crate = this->w.create(d);
    const CharacterId id = this->walker({0.65, 0, 0});
    this->walk(id, {4, 0, 0}, 3);
    const double before = to_double(this->w.velocity(crate).x);
    this->walk(id, {4, 0, 0}, 6);
    const double gained = (to_double(this->w.velocity(crate).x) - before) * 10;
    if (mass >= 100) {
      EXPECT_NEAR(gained, 500 / mass, 0.06 * 500 / mass) << mass;
    }
    this->walk(id, {4, 0, 0}, 120);
    EXPECT_LT(to_double(this->w.velocity(crate).x), 4.1) << mass;
  }
}

TYPED_TEST(Characters, has_its_weight_on_what_it_stands_on) {  // case 8
  using S = TypeParam;
  add_ground(this->w);
  const BodyId scale = this->box({1, 0.25, 1}, {0, 2, 0}, BodyType::dynamic, 20);
  JointProperties<S> spring =
      this->w.joint_at(JointType::slider, {}, scale, {vec<S>(0, 2, 0), turn<S>({1, 0, 0}, -kPi / 2)});
  spring.flags = joint_flag::kSpring;
  spring.spring_frequency = S(2);
  spring.spring_damping = S(1);
  ASSERT_TRUE(this->w.create(spring));
  run(this->w, 180);
  const double empty = to_double(this->w.center_of_mass(scale).y);
  const CharacterId id = this->walker({0, empty + 0.26, 0});
  run(this->w, 300);
  const double k = 20 * std::pow(2 * kPi * 2, 2);
  EXPECT_NEAR((empty - to_double(this->w.center_of_mass(scale).y)) * k, 800, 0.03 * 800);
  EXPECT_EQ(this->footing(id), Footing::floor);
}

TYPED_TEST(Characters, is_stuck_between_a_lift_and_the_ceiling_and_passes_neither) {  // case 9
  using S = TypeParam;
  const BodyId lift = this->box({1, 0.25, 1}, {0, -0.25, 0}, BodyType::kinematic);
  this->box({2, 0.25, 2}, {0, 3.25, 0});
  const CharacterId id = this->walker({0, 0, 0});
  this->w.set_velocity(lift, vec<S>(0, 1, 0), Vec3<S>::zero());
  std::uint32_t stuck = 0;
  for (int i = 0; i < 120; ++i) {
    this->w.step();
    stuck = std::max(stuck, this->w.state(id)->stuck);
  }
  EXPECT_GT(stuck, 10u);
  EXPECT_LT(this->foot(id).y, 3.0);
}

TYPED_TEST(Characters, leaves_what_it_starts_in) {  // case 10
  add_ground(this->w);
  this->box({1, 2, 4}, {1.1, 2, 0});  // 0.2 m of it are inside
  const CharacterId id = this->walker({0, 0, 0});
  run(this->w, 10);
  EXPECT_LT(this->foot(id).x + kRadius, 0.1);
  EXPECT_EQ(this->w.state(id)->stuck, 0u);
}

TYPED_TEST(Characters, passes_no_wall_however_fast) {  // case 11
  using S = TypeParam;
  add_ground(this->w);
  this->box({0.025, 3, 60}, {4, 3, 0});
  Dice dice(5);
  std::vector<CharacterId> all;
  for (int i = 0; i < 40; ++i) all.push_back(this->walker({dice.in(0, 3), dice.in(0, 4), 1.5 * i - 30}));
  for (int i = 0; i < 60; ++i) {
    for (const CharacterId id : all) this->ask(id, {pick<S>(50, 50, 30, 50), 0, 0});
    if (i == 0) {
      edit_parts(this->w, [](RecordParts<S>& parts) {
        for (CharacterState<S>& c : parts.character_states) c.velocity = vec<S>(pick<S>(50, 50, 30, 50), 0, 0);
      });
    }
    this->w.step();
  }
  for (const CharacterId id : all) {
    EXPECT_LT(this->foot(id).x + kRadius, 3.99);
    EXPECT_GT(this->foot(id).y, -0.01);
  }
}

/// Crates of 400 kg fall into a shaft of 1.5 x 1.5 m, with somebody at its bottom.
TYPED_TEST(Characters, stays_in_a_shaft_that_is_filled_over_it) {  // case 9
  constexpr double kInner = 0.75, kRoom = kInner - kRadius;
  add_ground(this->w);
  for (const double side : {-1.0, 1.0}) {
    this->box({0.25, 6, 1.25}, {side * (kInner + 0.25), 6, 0});
    this->box({1.25, 6, 0.25}, {0, 6, side * (kInner + 0.25)});
  }
  const CharacterId id = this->walker({0, 0, 0});
  for (int i = 0; i < 12; ++i) {
    const double x = i % 2 * 0.75 - 0.375, z = 0.37 - i / 2 % 2 * 0.74;
    this->box({0.35, 0.3, 0.35}, {x, 2.5 + 0.35 * i, z}, BodyType::dynamic, 400);
  }
  double farthest = 0, lowest = 1;
  std::uint32_t stuck = 0;
  for (int i = 0; i < 240; ++i) {
    this->ask(id, {i % 60 < 30 ? 3.0 : -3.0, 0, i % 40 < 20 ? 3.0 : -3.0});
    this->w.step();
    const D3 foot = this->foot(id);
    farthest = std::max({farthest, std::fabs(foot.x), std::fabs(foot.z)});
    lowest = std::min(lowest, foot.y);
    stuck = std::max(stuck, this->w.state(id)->stuck);
  }
  EXPECT_GT(stuck, 10u);  // they do press
  EXPECT_LT(farthest, kRoom);
  EXPECT_GT(lowest, -this->kSkin);
}

TYPED_TEST(Characters, a_crowd_in_a_corridor_keeps_apart_and_can_be_rolled_back) {  // case 12
  using S = TypeParam;
  add_ground(this->w);
  for (const double side : {-1.0, 1.0}) this->box({12, 1, 0.25}, {0, 1, side * 1.75});
  std::vector<CharacterId> all;
  for (int i = 0; i < 24; ++i) all.push_back(this->walker({(i % 12) * 1.5 - 9.0, 0, i < 12 ? -0.7 : 0.7}));
  const auto drive = [&](World<S>& world, int i) {
    for (std::size_t k = 0; k < all.size(); ++k) {
      const Vec3<S> move = vec<S>(k % 2 == 0 ? 3 : -3, 0, (i / 30 + static_cast<int>(k)) % 3 - 1);
      world.set_input(all[k], {move});
    }
    world.step();
  };
  double nearest = 1e9;
  for (int i = 0; i < 90; ++i) {
    drive(this->w, i);
    for (std::size_t a = 0; a < all.size(); ++a) {
      for (std::size_t b = 0; b < a; ++b) nearest = std::min(nearest, length(this->foot(all[a]) - this->foot(all[b])));
    }
  }
  EXPECT_GT(nearest, 2 * kRadius - this->kSkin);
  EXPECT_LT(nearest, 2 * kRadius + 0.2);  // they met
  typename World<S>::Snapshot middle;
  this->w.save(middle);
  World<S> other(settings<S>());
  ASSERT_TRUE(other.load(middle));
  for (int i = 90; i < 120; ++i) {
    drive(this->w, i);
    drive(other, i);
    ASSERT_EQ(this->w.hash(), other.hash()) << i;
  }
}

TYPED_TEST(Characters, is_not_carried_by_what_the_ground_did_before_it_was_put_elsewhere) {
  using S = TypeParam;
  const BodyId train = this->box({40, 0.5, 2}, {0, -0.5, 0}, BodyType::kinematic);
  this->box({2, 0.5, 2}, {0, -0.5, 20});
  ASSERT_TRUE(this->w.set_velocity(train, vec<S>(20, 0, 0), Vec3<S>::zero()));
  const CharacterId id = this->walker({0, 0, 0});
  const BodyId body = this->w.find(id)->body;
  run(this->w, 30);
  EXPECT_NEAR(this->foot(id).x, 10, 0.5);
  Pose<S> there = this->w.pose(body);
  there.position.x = S(0);
  there.position.z = S(20);
  ASSERT_TRUE(this->w.set_pose(body, there));
  EXPECT_TRUE(this->walk(id, {0, 0, 0}, 30));  // it stands there from the first step on
  EXPECT_NEAR(this->foot(id).x, 0, 1e-3);
  EXPECT_NEAR(this->foot(id).y, 0, 2e-3);
}

TYPED_TEST(Characters, that_was_disabled_stands_where_it_was_left_whatever_its_lift_did) {
  using S = TypeParam;
  const BodyId lift = this->box({2, 0.5, 2}, {0, -0.5, 0}, BodyType::kinematic);
  const CharacterId id = this->walker({0, 0, 0});
  const BodyId body = this->w.find(id)->body;
  run(this->w, 10);
  ASSERT_TRUE(this->w.set_enabled(body, false));
  ASSERT_TRUE(this->w.set_velocity(lift, vec<S>(0, 2, 0), Vec3<S>::zero()));
  run(this->w, 60);
  ASSERT_TRUE(this->w.set_velocity(lift, Vec3<S>::zero(), Vec3<S>::zero()));
  Pose<S> there = this->w.pose(body);
  there.position.y += S(2);
  ASSERT_TRUE(this->w.set_pose(body, there));
  ASSERT_TRUE(this->w.set_enabled(body, true));
  EXPECT_TRUE(this->walk(id, {0, 0, 0}, 30));
  EXPECT_NEAR(this->foot(id).y, 2, 0.01);
}

TYPED_TEST(Characters, walks_through_what_does_not_collide) {
  using S = TypeParam;
  add_ground(this->w);
  BodyDefinition<S> d = still<S>(add_box(this->w, 0.2, 2, 2), {2, 2, 0});
  d.collide = false;
  this->w.create(d);
  const CharacterId id = this->walker({0, 0, 0});
  EXPECT_TRUE(this->walk(id, {3, 0, 0}, 80));
  EXPECT_NEAR(this->foot(id).x, 4, 0.1);
}

TYPED_TEST(Characters, that_the_game_turns_every_frame_is_carried_all_the_same) {
  using S = TypeParam;
  const BodyId train = this->box({40, 0.5, 2}, {0, -0.5, 0}, BodyType::kinematic);
  ASSERT_TRUE(this->w.set_velocity(train, vec<S>(5, 0, 0), Vec3<S>::zero()));
  const CharacterId id = this->walker({0, 0, 0});
  run(this->w, 10);
  const double from = this->foot(id).x;
  for (int i = 0; i < 60; ++i) {
    Pose<S> pose = this->w.pose(this->w.find(id)->body);
    pose.orientation = turn<S>({0, 1, 0}, 0.05 * i);
    ASSERT_TRUE(this->w.set_pose(this->w.find(id)->body, pose));
    run(this->w, 1);
  }
  EXPECT_NEAR(this->foot(id).x - from, 5, 0.05);
}

TYPED_TEST(Characters, that_was_disabled_does_not_follow_its_lift_aside) {
  using S = TypeParam;
  const BodyId lift = this->box({4, 0.5, 2}, {0, -0.5, 0}, BodyType::kinematic);
  const CharacterId id = this->walker({0, 0, 0});
  run(this->w, 10);
  ASSERT_TRUE(this->w.set_enabled(this->w.find(id)->body, false));
  ASSERT_TRUE(this->w.set_velocity(lift, vec<S>(2, 0, 0), Vec3<S>::zero()));
  run(this->w, 60);
  ASSERT_TRUE(this->w.set_velocity(lift, Vec3<S>::zero(), Vec3<S>::zero()));
  ASSERT_TRUE(this->w.set_enabled(this->w.find(id)->body, true));
  EXPECT_TRUE(this->walk(id, {0, 0, 0}, 30));
  EXPECT_NEAR(this->foot(id).x, 0, 1e-3);
}

}  // namespace characters_test
}  // namespace isostep::test
