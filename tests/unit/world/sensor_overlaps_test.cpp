// SensorOverlaps alone: what begins, what stays, what ends.
// SPDX-License-Identifier: MIT

#include "isostep/systems/events/sensor_overlaps.hpp"

#include "unit/world/systems.hpp"

namespace isostep::test {
namespace sensor_overlaps_test {

/// Slot 0 is a static sensor, the others are awake balls.
template <class S> class Overlaps : public ::testing::Test {
 protected:
  Overlaps() : systems(made()) { systems.state.untold.sensors.clear(); }  // none was placed since the last step
  World<S>& made() {
    const ShapeId ball = add_ball(world, 0.5);
    for (int i = 0; i < 4; ++i) {
      BodyDefinition<S> d = moving<S>(ball, {0, 0, 0});
      if (i == 0) d.type = BodyType::static_;
      d.sensor = i == 0;
      bodies[i] = world.create(d);
    }
    return world;
  }
  std::vector<SensorOverlap> with(std::initializer_list<std::uint32_t> others) {
    std::vector<SensorOverlap> list;
    for (const std::uint32_t other : others) list.push_back({bodies[0].slot, other, 0, 0});
    return list;
  }

  World<S> world{settings<S>(0)};
  BodyId bodies[4];
  Systems<S> systems;
  SensorOverlaps<S> sensors{systems.state, systems.map, systems.proxies};
  Events<S> events;
};
TYPED_TEST_SUITE(Overlaps, SystemScalars);

TYPED_TEST(Overlaps, new_ones_begin_and_missing_ones_end) {
  this->systems.state.overlaps = this->with({1, 2});
  std::vector<SensorOverlap> found = this->with({3, 2});
  this->sensors.update(found, this->events);
  EXPECT_EQ(this->systems.state.overlaps, this->with({2, 3}));
  ASSERT_EQ(this->events.sensor_begin.size(), 1u);
  EXPECT_EQ(this->events.sensor_begin[0].other, this->bodies[3]);
  ASSERT_EQ(this->events.sensor_end.size(), 1u);
  EXPECT_EQ(this->events.sensor_end[0].other, this->bodies[1]);
}

TYPED_TEST(Overlaps, those_of_bodies_that_nobody_looked_at_stay) {
  this->systems.map.place(1, {0, 0});  // asleep
  this->systems.state.overlaps = this->with({1});
  std::vector<SensorOverlap> found;
  this->sensors.update(found, this->events);
  EXPECT_EQ(this->systems.state.overlaps, this->with({1}));
  EXPECT_TRUE(this->events.sensor_end.empty());
}

TYPED_TEST(Overlaps, ends_are_in_order_with_those_that_commands_made) {
  this->systems.state.overlaps = this->with({1});
  this->events.sensor_end.push_back({this->bodies[0], this->bodies[2], 0, 0});
  std::vector<SensorOverlap> found;
  this->sensors.update(found, this->events);
  ASSERT_EQ(this->events.sensor_end.size(), 2u);
  EXPECT_EQ(this->events.sensor_end[0].other, this->bodies[1]);
  EXPECT_EQ(this->events.sensor_end[1].other, this->bodies[2]);
}

}  // namespace sensor_overlaps_test
}  // namespace isostep::test
