// IslandSleep alone: which bodies fall asleep together, and when.
// SPDX-License-Identifier: MIT

#include "isostep/world/island_sleep.hpp"

#include "unit/world/rooms.hpp"

namespace isostep::test {
namespace {

/// Three balls: a contact ties the first two together.
template <class S> class IslandSleeps : public ::testing::Test {
 protected:
  IslandSleeps() : rooms(made()) {
    Contact<S> contact = {};
    contact.key = {balls[0].slot, balls[1].slot, 0, 0};
    contact.count = 1;
    rooms.state.contacts.push_back(contact);
  }
  World<S>& made() {
    const ShapeId ball = add_ball(world, 0.5);
    for (int i = 0; i < 3; ++i) balls[i] = world.create(moving<S>(ball, {2.0 * i, 0, 0}));
    return world;
  }
  std::vector<BodyId> after(int steps) {
    std::vector<BodyId> fell_asleep;
    for (int i = 0; i < steps; ++i) sleep.update(fell_asleep);
    return fell_asleep;
  }

  World<S> world{settings<S>(0)};
  BodyId balls[3];
  Rooms<S> rooms;
  IslandSleep<S> sleep{rooms.state, rooms.map, rooms.proxies};
};
TYPED_TEST_SUITE(IslandSleeps, RoomScalars);

TYPED_TEST(IslandSleeps, bodies_at_rest_fall_asleep_after_half_a_second_in_islands_of_their_own) {
  EXPECT_TRUE(this->after(29).empty());
  EXPECT_EQ(this->after(1).size(), 3u);
  const WorldState<TypeParam>& state = this->rooms.state;
  EXPECT_TRUE(state.awake.states.empty());
  EXPECT_TRUE(state.contacts.empty());
  ASSERT_EQ(state.sleeping.size(), 2u);
  EXPECT_EQ(state.sleeping[0]->bodies.states.size(), 2u);
  EXPECT_EQ(state.sleeping[0]->contacts.size(), 1u);
  EXPECT_EQ(state.sleeping[1]->bodies.states.size(), 1u);
  EXPECT_EQ(this->rooms.map.names(this->balls[0].slot), 1u);
}

TYPED_TEST(IslandSleeps, one_that_moves_keeps_its_island_awake) {
  this->rooms.awake(this->balls[0]).velocity = vec<Velocity<TypeParam>>(1, 0, 0);
  const std::vector<BodyId> fell_asleep = this->after(60);
  ASSERT_EQ(fell_asleep.size(), 1u);
  EXPECT_EQ(fell_asleep[0], this->balls[2]);
  EXPECT_FALSE(this->rooms.is_asleep(this->balls[1]));
  EXPECT_TRUE(this->rooms.is_asleep(this->balls[2]));
}

TYPED_TEST(IslandSleeps, what_lies_on_a_conveyor_does_not_rest) {
  auto& belt = this->rooms.map.change_properties(this->balls[0].slot);
  belt.material.surface_velocity = vec<TypeParam>(1, 0, 0);
  this->after(60);
  EXPECT_FALSE(this->rooms.is_asleep(this->balls[1]));
  EXPECT_TRUE(this->rooms.is_asleep(this->balls[2]));
}

TYPED_TEST(IslandSleeps, nothing_happens_where_the_settings_forbid_it) {
  this->rooms.state.settings.allow_sleep = false;
  EXPECT_TRUE(this->after(60).empty());
  EXPECT_EQ(this->rooms.awake(this->balls[0]).sleep_clock, 0u);
}

}  // namespace
}  // namespace isostep::test
