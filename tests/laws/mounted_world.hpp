// A world with a sensor that goes with a body, for the laws of SensorMount.
// SPDX-License-Identifier: MIT
#pragma once

#include "laws/exact_rollback.hpp"

namespace isostep::test {

template <class S> class MountedWorld : public ::testing::Test {
 protected:
  /// 64 steps a second: what moves by whole metres a second is exact in every scalar.
  void begin(double gravity) { w = World<S>(settings<S>(gravity, 64)); }
  /// Mounts a ball of half a metre that was elsewhere.
  void feel(BodyId on, D3 at) {
    sensor = add_feeler({0, -40, 0});
    mount = w.add(SensorMount<S>{sensor, on, {vec<S>(at), Quat<Unit<S>>::identity()}});
    ASSERT_TRUE(mount) << describe(w.fault());
  }
  BodyId add_feeler(D3 at, BodyType type = BodyType::kinematic, bool is_sensor = true) {
    BodyDefinition<S> d = still<S>(add_ball(w, 0.5), at);
    d.type = type;
    d.sensor = is_sensor;
    return w.create(d);
  }
  /// Bit for bit.
  void expect_in_place(BodyId on) const {
    const Pose<S> place = compose(w.pose(on), w.find(mount)->frame), is = w.pose(sensor);
    EXPECT_EQ(is.position, place.position);
    EXPECT_EQ(is.orientation, place.orientation);
  }
  std::size_t begun() const { return w.events().sensor_begin.size(); }
  std::size_t ended() const { return w.events().sensor_end.size(); }

  World<S> w{settings<S>()};
  BodyId sensor;        // the last one
  SensorMountId mount;  // its record
};

}  // namespace isostep::test
