// IslandWake alone: what wakes which island, and in what order it comes back.
// SPDX-License-Identifier: MIT

#include "isostep/world/island_wake.hpp"

#include "unit/world/rooms.hpp"

namespace isostep::test {
namespace {

/// Three stacks of two boxes on the ground, asleep. Slots of the stacks alternate.
template <class S> class IslandWakes : public ::testing::Test {
 protected:
  IslandWakes() : rooms(asleep()) {}
  World<S>& asleep() {
    ground = add_ground(world);
    const ShapeId box = add_box(world, 0.5, 0.5, 0.5);
    for (int i = 0; i < 6; ++i) boxes[i] = world.create(moving<S>(box, {5.0 * (i % 3), 0.5 + i / 3, 0}));
    EXPECT_TRUE(settle(world));
    return world;
  }
  void expect_awake(std::initializer_list<int> which) {
    ASSERT_EQ(rooms.state.awake.states.size(), which.size());
    std::size_t i = 0;
    for (const int box : which) EXPECT_EQ(rooms.state.awake.states[i++].slot, boxes[box].slot);
  }

  World<S> world{settings<S>()};
  BodyId ground, boxes[6];
  Rooms<S> rooms;
};
TYPED_TEST_SUITE(IslandWakes, RoomScalars);

TYPED_TEST(IslandWakes, an_island_wakes_whole_and_in_canonical_order) {
  this->rooms.wake.wake(this->boxes[5].slot);
  this->expect_awake({2, 5});
  this->rooms.wake.wake(this->boxes[0].slot);
  this->expect_awake({0, 2, 3, 5});
  EXPECT_EQ(this->rooms.state.sleeping.size(), 1u);
  EXPECT_EQ(this->rooms.state.contacts.size(), 4u);
  for (std::size_t i = 1; i < 4; ++i)
    EXPECT_LT(this->rooms.state.contacts[i - 1].key, this->rooms.state.contacts[i].key);
  EXPECT_EQ(this->rooms.state.untold.woke.size(), 4u);
  EXPECT_EQ(this->rooms.awake(this->boxes[3]).sleep_clock, 0u);
}

TYPED_TEST(IslandWakes, what_is_awake_already_stays_as_it_is) {
  this->rooms.wake.wake(this->boxes[1].slot);
  this->rooms.awake(this->boxes[4]).sleep_clock = 7;
  this->rooms.wake.wake(this->boxes[1].slot);
  EXPECT_EQ(this->rooms.awake(this->boxes[4]).sleep_clock, 7u);
  this->rooms.wake.reset_clock(this->boxes[4].slot);
  EXPECT_EQ(this->rooms.awake(this->boxes[4]).sleep_clock, 0u);
}

TYPED_TEST(IslandWakes, the_ground_holds_all_of_them) {
  this->rooms.wake.wake_held_by(this->ground.slot);
  this->expect_awake({0, 1, 2, 3, 4, 5});
  EXPECT_EQ(this->rooms.map.names(this->ground.slot), 0u);
}

TYPED_TEST(IslandWakes, those_that_a_body_touches_wake_and_no_others) {
  this->rooms.wake.wake_touching(this->boxes[1].slot);
  this->expect_awake({1, 4});
}

TYPED_TEST(IslandWakes, a_body_that_moves_wakes_what_it_runs_into) {
  using S = TypeParam;
  EXPECT_FALSE(this->rooms.wake.wake_touched()) << "nothing is awake";
  BodyState<S>& mover = this->rooms.wake.wake_for_change(this->boxes[0].slot);
  const BodyProperties<S>& body = this->rooms.state.awake.properties[0];
  const D3 beside = {4.125, 0.5, 0};
  mover.centre = vec<S>(beside);
  mover.velocity = vec<Velocity<S>>(1, 0, 0);
  mover.fat = Aabb<S>::around(mover.centre, vec<S>(0.625, 0.625, 0.625));
  this->rooms.proxies.place(mover, body, true);
  this->rooms.find_pairs();
  EXPECT_TRUE(this->rooms.wake.wake_touched());
  this->expect_awake({0, 1, 3, 4});
  this->rooms.find_pairs();
  EXPECT_FALSE(this->rooms.wake.wake_touched());
}

}  // namespace
}  // namespace isostep::test
