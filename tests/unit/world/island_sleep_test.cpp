// IslandSleep alone: which bodies fall asleep together, and when.
// SPDX-License-Identifier: MIT

#include "isostep/systems/sleep/island_sleep.hpp"

#include "unit/world/systems.hpp"

namespace isostep::test {
namespace island_sleep_test {

/// Three balls: a contact ties the first two together.
template <class S> class IslandSleeps : public ::testing::Test {
 protected:
  IslandSleeps() : systems(made()) { add_contact(0, 1); }
  World<S>& made() {
    const ShapeId ball = add_ball(world, 0.5);
    for (int i = 0; i < 3; ++i) balls[i] = world.create(moving<S>(ball, {2.0 * i, 0, 0}));
    return world;
  }
  void reset() {
    systems.loader.load(world.state());
    add_contact(0, 1);
  }
  void add_contact(int a, int b) {
    Contact<S> contact = {};
    contact.key = {balls[a].slot, balls[b].slot, 0, 0};
    contact.count = 1;
    systems.state.contacts.push_back(contact);
  }
  JointId tie(std::uint32_t a, std::uint32_t b) {
    const JointId id = systems.state.joint_slots.template take<JointId>();
    JointState<S> joint = {};
    joint.slot = id.slot;
    JointProperties<S> properties;
    properties.body_a = a;
    properties.body_b = b;
    systems.map.joints.insert(joint, properties);
    return id;
  }
  std::vector<BodyId> after(int steps) {
    std::vector<BodyId> fell_asleep;
    for (int i = 0; i < steps; ++i) {
      std::vector<Pose<S>> start;  // nothing corrects where they are
      for (const BodyState<S>& state : systems.state.awake.states) start.push_back({state.centre, state.orientation});
      sleep.update(fell_asleep, start);
    }
    return fell_asleep;
  }

  World<S> world{settings<S>(0)};
  BodyId balls[3];
  Systems<S> systems;
  IslandSleep<S> sleep{systems.state, systems.map, systems.proxies};
};
TYPED_TEST_SUITE(IslandSleeps, SystemScalars);

TYPED_TEST(IslandSleeps, bodies_at_rest_fall_asleep_after_half_a_second_in_islands_of_their_own) {
  EXPECT_TRUE(this->after(29).empty());
  EXPECT_EQ(this->after(1).size(), 3u);
  const WorldState<TypeParam>& state = this->systems.state;
  EXPECT_TRUE(state.awake.states.empty());
  EXPECT_TRUE(state.contacts.empty());
  ASSERT_EQ(state.sleeping.size(), 2u);
  EXPECT_EQ(state.sleeping[0]->bodies.states.size(), 2u);
  EXPECT_EQ(state.sleeping[0]->contacts.size(), 1u);
  EXPECT_EQ(state.sleeping[1]->bodies.states.size(), 1u);
  EXPECT_EQ(this->systems.map.names(this->balls[0].slot), 1u);
}

TYPED_TEST(IslandSleeps, one_that_moves_keeps_its_island_awake) {
  this->systems.awake(this->balls[0]).velocity = vec<Velocity<TypeParam>>(1, 0, 0);
  const std::vector<BodyId> fell_asleep = this->after(60);
  ASSERT_EQ(fell_asleep.size(), 1u);
  EXPECT_EQ(fell_asleep[0], this->balls[2]);
  EXPECT_FALSE(this->systems.is_asleep(this->balls[1]));
  EXPECT_TRUE(this->systems.is_asleep(this->balls[2]));
}

TYPED_TEST(IslandSleeps, what_lies_on_a_conveyor_does_not_rest) {
  auto& belt = this->systems.map.change_properties(this->balls[0].slot);
  belt.material.surface_velocity = vec<TypeParam>(1, 0, 0);
  this->after(60);
  EXPECT_FALSE(this->systems.is_asleep(this->balls[1]));
  EXPECT_TRUE(this->systems.is_asleep(this->balls[2]));
}

TYPED_TEST(IslandSleeps, bodies_that_a_joint_ties_fall_asleep_together_and_the_joint_with_them) {
  using S = TypeParam;
  const JointId joint = this->tie(this->balls[1].slot, this->balls[2].slot);
  this->systems.awake(this->balls[0]).velocity = vec<Velocity<S>>(1, 0, 0);
  EXPECT_TRUE(this->after(60).empty()) << "by the contact and the joint the first keeps all of them awake";
  this->systems.awake(this->balls[0]).velocity = vec<Velocity<S>>(0, 0, 0);
  EXPECT_EQ(this->after(30).size(), 3u);
  const WorldState<S>& state = this->systems.state;
  ASSERT_EQ(state.sleeping.size(), 1u);
  EXPECT_EQ(state.sleeping[0]->joints.states.size(), 1u);
  EXPECT_EQ(state.sleeping[0]->joints.properties.size(), 1u);
  EXPECT_TRUE(state.joints.states.empty());
  EXPECT_TRUE(state.joints.properties.empty());
  EXPECT_EQ(this->systems.map.joints.location(joint.slot).set, 0u);
  EXPECT_EQ(this->systems.map.names(this->balls[1].slot), 2u);
}

TYPED_TEST(IslandSleeps, a_joint_to_the_world_sleeps_with_its_body) {
  const JointId joint = this->tie(kNoBody, this->balls[2].slot);
  EXPECT_EQ(this->after(30).size(), 3u);
  EXPECT_TRUE(this->systems.map.joints.location(joint.slot).is_asleep());
  EXPECT_EQ(this->systems.state.sleeping[1]->joints.states.size(), 1u);
}

/// However slowly: what is told to move does not rest.
TYPED_TEST(IslandSleeps, what_a_driven_body_touches_or_holds_stays_awake_while_it_moves) {
  using S = TypeParam;
  for (const bool by_joint : {false, true}) {
    this->reset();
    this->systems.map.change_properties(this->balls[0].slot).type = BodyType::kinematic;
    this->systems.awake(this->balls[0]).velocity = vec<Velocity<S>>(0.015625, 0, 0);
    if (by_joint) {
      this->systems.state.contacts.clear();
      this->tie(this->balls[0].slot, this->balls[1].slot);
    }
    const std::vector<BodyId> fell_asleep = this->after(60);
    ASSERT_EQ(fell_asleep.size(), 1u) << by_joint;
    EXPECT_EQ(fell_asleep[0], this->balls[2]);
    this->systems.awake(this->balls[0]).velocity = vec<Velocity<S>>(0, 0, 0);
    this->after(30);
    EXPECT_TRUE(this->systems.is_asleep(this->balls[1])) << by_joint;
    EXPECT_FALSE(this->systems.is_asleep(this->balls[0])) << "what can be driven is always awake";
    EXPECT_EQ(this->systems.state.joints.states.size(), 0u);
  }
}

/// A driven body is no bridge: what rests on it on either side are islands of their own.
TYPED_TEST(IslandSleeps, a_driven_body_at_rest_ties_nothing_together) {
  using S = TypeParam;
  this->systems.map.change_properties(this->balls[1].slot).type = BodyType::kinematic;
  this->add_contact(1, 2);
  this->systems.awake(this->balls[2]).velocity = vec<Velocity<S>>(1, 0, 0);
  const std::vector<BodyId> fell_asleep = this->after(60);
  ASSERT_EQ(fell_asleep.size(), 1u);
  EXPECT_EQ(fell_asleep[0], this->balls[0]);
}

TYPED_TEST(IslandSleeps, a_sensor_ties_nothing_together) {
  using S = TypeParam;
  this->systems.map.change_properties(this->balls[0].slot).flags |= body_flag::kSensor;
  this->systems.awake(this->balls[0]).velocity = vec<Velocity<S>>(1, 0, 0);
  EXPECT_EQ(this->after(60).size(), 2u);
  EXPECT_FALSE(this->systems.is_asleep(this->balls[0]));
  EXPECT_TRUE(this->systems.is_asleep(this->balls[1]));
}

TYPED_TEST(IslandSleeps, a_body_that_may_not_sleep_keeps_its_island_awake) {
  this->systems.map.change_properties(this->balls[0].slot).flags &= ~body_flag::kAllowSleep;
  this->after(60);
  EXPECT_FALSE(this->systems.is_asleep(this->balls[1]));
  EXPECT_TRUE(this->systems.is_asleep(this->balls[2]));
}

TYPED_TEST(IslandSleeps, nothing_happens_where_the_settings_forbid_it) {
  this->systems.state.settings.allow_sleep = false;
  EXPECT_TRUE(this->after(60).empty());
  EXPECT_EQ(this->systems.awake(this->balls[0]).sleep_clock, 0u);
}

}  // namespace island_sleep_test
}  // namespace isostep::test
