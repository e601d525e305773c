// Sensors that lie still, and those that are moved by commands: they wake nobody, and see who sleeps in them.
// SPDX-License-Identifier: MIT

#include "unit/world/worlds.hpp"

namespace isostep::test {
namespace still_sensors_test {

template <class S> class StillSensors : public ::testing::Test {
 protected:
  StillSensors() {
    add_ground(w);
    crate = w.create(moving<S>(add_box(w, 0.5, 0.5, 0.5), {0, 0.5, 0}));
    for (int i = 0; i < 240 && w.is_awake(crate); ++i) w.step();
    EXPECT_FALSE(w.is_awake(crate));
  }
  BodyId add_sensor(BodyType type, D3 at) {
    BodyDefinition<S> d = moving<S>(add_ball(w, 0.5), at);
    d.type = type;
    d.sensor = true;
    return w.create(d);
  }
  /// Expects whether the next step tells that the sensor sees the crate from now on, or no longer.
  void expect_step(bool begins, bool ends) {
    w.step();
    EXPECT_EQ(w.events().sensor_begin.size(), begins ? 1u : 0u);
    EXPECT_EQ(w.events().sensor_end.size(), ends ? 1u : 0u);
    EXPECT_TRUE(w.events().woke.empty());
    EXPECT_FALSE(w.is_awake(crate));
  }
  static Pose<S> at(D3 place) { return {vec<S>(place), Quat<Unit<S>>::identity()}; }

  World<S> w{settings<S>()};
  BodyId crate;
};
TYPED_TEST_SUITE(StillSensors, AllScalars);

TYPED_TEST(StillSensors, see_sleepers_where_they_are_put_and_wake_none) {
  const BodyId sensor = this->add_sensor(BodyType::static_, {0, 1, 0});
  this->expect_step(true, false);
  this->expect_step(false, false);
  this->w.set_pose(sensor, this->at({0, 5, 0}));
  this->expect_step(false, true);
  this->w.set_pose(sensor, this->at({0.25, 1, 0}));
  this->expect_step(true, false);
  this->w.set_filter(sensor, {1, 0, 0});
  this->expect_step(false, true);
  this->w.set_filter(sensor, {1, 0xffffffffu, 0});
  this->expect_step(true, false);
  this->w.set_enabled(sensor, false);
  this->expect_step(false, true);
  this->w.set_enabled(sensor, true);
  this->expect_step(true, false);
  this->w.destroy(sensor);
  this->expect_step(false, true);
}
TYPED_TEST(StillSensors, that_are_moved_to_a_pose_wake_none) {
  const BodyId sensor = this->add_sensor(BodyType::kinematic, {0, 2.5, 0});
  this->expect_step(false, false);
  this->w.move_to(sensor, this->at({0, 1, 0}));
  this->w.step();
  this->expect_step(true, false);
  this->w.move_to(sensor, this->at({0, 1.25, 0}));
  this->expect_step(false, false);
}
TYPED_TEST(StillSensors, are_found_by_a_world_that_was_saved_before_the_step) {
  using S = TypeParam;
  this->add_sensor(BodyType::static_, {0, 1, 0});
  typename World<S>::Snapshot frame;
  this->w.save(frame);
  this->expect_step(true, false);
  const std::uint64_t hash = this->w.hash();
  this->w.load(frame);
  this->expect_step(true, false);
  EXPECT_EQ(this->w.hash(), hash);
}

}  // namespace still_sensors_test
}  // namespace isostep::test
