// IslandWake alone: what wakes which island, and in what order it comes back.
// SPDX-License-Identifier: MIT

#include "isostep/systems/sleep/island_wake.hpp"

#include "unit/world/systems.hpp"

namespace isostep::test {
namespace island_wake_test {

/// Three stacks of two boxes on the ground, asleep. Slots of the stacks alternate. Joints tie the boxes of the first
/// and of the last stack.
template <class S> class IslandWakes : public ::testing::Test {
 protected:
  IslandWakes() : systems(asleep()) {}
  World<S>& asleep() {
    ground = add_ground(world);
    const ShapeId box = add_box(world, 0.5, 0.5, 0.5);
    for (int i = 0; i < 6; ++i) boxes[i] = world.create(moving<S>(box, {5.0 * (i % 3), 0.5 + i / 3, 0}));
    for (const int i : {0, 2}) {
      JointProperties<S> tie =
          world.joint_at(JointType::fixed, boxes[i], boxes[i + 3], {vec<S>(5.0 * i, 1, 0), Quat<Unit<S>>::identity()});
      tie.flags |= joint_flag::kCollideConnected;
      joints[i / 2] = world.create(tie);
    }
    EXPECT_TRUE(settle(world));
    return world;
  }
  void expect_awake(std::initializer_list<int> which) {
    ASSERT_EQ(systems.state.awake.states.size(), which.size());
    std::size_t i = 0;
    for (const int box : which) EXPECT_EQ(systems.state.awake.states[i++].slot, boxes[box].slot);
  }

  World<S> world{settings<S>()};
  BodyId ground, boxes[6];
  JointId joints[2];
  Systems<S> systems;
};
TYPED_TEST_SUITE(IslandWakes, SystemScalars);

TYPED_TEST(IslandWakes, an_island_wakes_whole_and_in_canonical_order) {
  this->systems.wake.wake(this->boxes[5].slot);
  this->expect_awake({2, 5});
  this->systems.wake.wake(this->boxes[0].slot);
  this->expect_awake({0, 2, 3, 5});
  EXPECT_EQ(this->systems.state.sleeping.size(), 1u);
  EXPECT_EQ(this->systems.state.contacts.size(), 4u);
  for (std::size_t i = 1; i < 4; ++i)
    EXPECT_LT(this->systems.state.contacts[i - 1].key, this->systems.state.contacts[i].key);
  EXPECT_EQ(this->systems.state.untold.woke.size(), 4u);
  EXPECT_EQ(this->systems.awake(this->boxes[3]).sleep_clock, 0u);
}

TYPED_TEST(IslandWakes, what_is_awake_already_stays_as_it_is) {
  this->systems.wake.wake(this->boxes[1].slot);
  this->systems.awake(this->boxes[4]).sleep_clock = 7;
  this->systems.wake.wake(this->boxes[1].slot);
  EXPECT_EQ(this->systems.awake(this->boxes[4]).sleep_clock, 7u);
  this->systems.wake.reset_clock(this->boxes[4].slot);
  EXPECT_EQ(this->systems.awake(this->boxes[4]).sleep_clock, 0u);
}

TYPED_TEST(IslandWakes, all_wake_at_once_and_what_was_awake_rests_anew) {
  this->systems.wake.wake(this->boxes[1].slot);
  this->systems.awake(this->boxes[4]).sleep_clock = 7;
  this->systems.wake.wake_all();
  this->expect_awake({0, 1, 2, 3, 4, 5});
  EXPECT_TRUE(this->systems.state.sleeping.empty());
  EXPECT_EQ(this->systems.state.untold.woke.size(), 6u);
  EXPECT_EQ(this->systems.map.names(this->ground.slot), 0u);
  for (const BodyState<TypeParam>& body : this->systems.state.awake.states) EXPECT_EQ(body.sleep_clock, 0u);
  for (std::size_t i = 0; i < 6; ++i)
    EXPECT_EQ(this->systems.map.location(this->boxes[i].slot).index, i) << "as the map has them";
  this->systems.find_pairs();
  EXPECT_EQ(this->systems.proxies.pairs().size(), 6u) << "three with the ground, three in the stacks";
}

TYPED_TEST(IslandWakes, a_joint_wakes_with_its_bodies_and_what_it_ties_rests_anew) {
  EXPECT_TRUE(this->systems.map.joints.location(this->joints[0].slot).is_asleep());
  EXPECT_EQ(this->systems.wake.wake_joint(this->joints[0].slot), 0u);
  this->expect_awake({0, 3});
  EXPECT_TRUE(this->systems.map.joints.location(this->joints[1].slot).is_asleep());
  EXPECT_EQ(this->systems.wake.wake_joint(this->joints[1].slot), 1u) << "its index among the awake ones";
  this->expect_awake({0, 2, 3, 5});
  ASSERT_EQ(this->systems.state.joints.states.size(), 2u);
  EXPECT_EQ(this->systems.state.joints.states[0].slot, this->joints[0].slot);
  EXPECT_EQ(this->systems.state.joints.properties[1].body_b, this->boxes[5].slot);
  for (const int box : {0, 2, 3, 5}) this->systems.awake(this->boxes[box]).sleep_clock = 7;
  EXPECT_EQ(this->systems.wake.wake_joint(this->joints[1].slot), 1u) << "of one that is awake already";
  for (const int box : {0, 3}) EXPECT_EQ(this->systems.awake(this->boxes[box]).sleep_clock, 7u);
  for (const int box : {2, 5}) EXPECT_EQ(this->systems.awake(this->boxes[box]).sleep_clock, 0u);
}

TYPED_TEST(IslandWakes, the_ground_holds_all_of_them) {
  this->systems.wake.wake_held_by(this->ground.slot);
  this->expect_awake({0, 1, 2, 3, 4, 5});
  EXPECT_EQ(this->systems.map.names(this->ground.slot), 0u);
}

TYPED_TEST(IslandWakes, those_that_a_body_touches_wake_and_no_others) {
  this->systems.wake.wake_touching(this->boxes[1].slot);
  this->expect_awake({1, 4});
}

TYPED_TEST(IslandWakes, a_body_that_moves_wakes_what_it_runs_into) {
  using S = TypeParam;
  EXPECT_FALSE(this->systems.wake.wake_touched()) << "nothing is awake";
  BodyState<S>& mover = this->systems.wake.wake_for_change(this->boxes[0].slot);
  const BodyProperties<S>& body = this->systems.state.awake.properties[0];
  const D3 beside = {4.125, 0.5, 0};
  mover.centre = vec<S>(beside);
  mover.velocity = vec<Velocity<S>>(1, 0, 0);
  mover.fat = Aabb<S>::around(mover.centre, vec<S>(0.625, 0.625, 0.625));
  this->systems.proxies.place(mover, body, true);
  this->systems.find_pairs();
  EXPECT_TRUE(this->systems.wake.wake_touched());
  this->expect_awake({0, 1, 3, 4});
  this->systems.find_pairs();
  EXPECT_FALSE(this->systems.wake.wake_touched());
}

}  // namespace island_wake_test
}  // namespace isostep::test
