// StateLoader alone: after a load the caches are those of the new state.
// SPDX-License-Identifier: MIT

#include "unit/world/systems.hpp"

namespace isostep::test {
namespace state_loader_test {

template <class S> class StateLoaders : public ::testing::Test {
 protected:
  /// A box that sleeps, one that is awake, and the ground.
  StateLoaders() {
    ground = add_ground(world);
    box = add_box(world, 0.5, 0.5, 0.5);
    asleep = world.create(moving<S>(box, {0, 0.5, 0}));
    EXPECT_TRUE(settle(world));
    awake = world.create(moving<S>(box, {5, 0.5, 0}));
  }

  World<S> world{settings<S>()};
  ShapeId box;
  BodyId ground, asleep, awake;
};
TYPED_TEST_SUITE(StateLoaders, SystemScalars);

TYPED_TEST(StateLoaders, every_body_is_found_where_it_lies) {
  using S = TypeParam;
  Systems<S> systems(this->world);
  EXPECT_EQ(systems.map.location(this->ground.slot).set, Location::kStatic);
  EXPECT_EQ(systems.map.location(this->asleep.slot).set, 0u);
  EXPECT_EQ(systems.map.location(this->awake.slot).set, Location::kAwake);
  EXPECT_EQ(systems.map.names(this->ground.slot), 1u) << "by the sleeper's contact";
  systems.find_pairs();
  ASSERT_EQ(systems.proxies.pairs().size(), 1u) << "of the awake box and the ground";
}

TYPED_TEST(StateLoaders, what_another_state_lacks_is_forgotten_and_what_it_has_is_found) {
  using S = TypeParam;
  Systems<S> systems(this->world);
  const WorldState<S> before = systems.state;
  ASSERT_TRUE(this->world.destroy(this->awake));
  ASSERT_TRUE(this->world.wake(this->asleep));
  systems.loader.load(this->world.state());
  EXPECT_EQ(systems.map.location(this->awake.slot).set, Location::kNone);
  EXPECT_FALSE(systems.proxies.present(this->awake.slot));
  EXPECT_EQ(systems.map.location(this->asleep.slot).set, Location::kAwake);
  EXPECT_EQ(systems.map.names(this->ground.slot), 0u);
  systems.loader.load(before);
  EXPECT_EQ(systems.map.location(this->asleep.slot).set, 0u);
  EXPECT_EQ(systems.map.location(this->awake.slot).set, Location::kAwake);
  EXPECT_TRUE(systems.proxies.present(this->awake.slot));
  EXPECT_EQ(systems.map.names(this->ground.slot), 1u);
}

}  // namespace state_loader_test
}  // namespace isostep::test
