// Bodies on which forces are tried.
// SPDX-License-Identifier: MIT
#pragma once

#include "unit/world/worlds.hpp"

namespace isostep::test {

template <class S> class Forces : public ::testing::Test {
 protected:
  using U = Unit<S>;
  explicit Forces() : world_(settings<S>()) {}

  /// A ball of radius 0.5 that weighs `mass`.
  BodyId ball(D3 at, double mass = 2, D3 velocity = {0, 0, 0}) {
    BodyDefinition<S> d = moving<S>(add_ball(world_, 0.5), at, velocity);
    d.mass = num<S>(mass);
    d.allow_sleep = sleeps_;
    return world_.create(d);
  }
  BodyId box(D3 at, D3 half, double mass) {
    BodyDefinition<S> d = moving<S>(add_box(world_, half.x, half.y, half.z), at);
    d.mass = num<S>(mass);
    d.allow_sleep = sleeps_;
    return world_.create(d);
  }
  void weightless() { world_.set_gravity(Vec3<S>::zero()); }
  D3 velocity(BodyId id) const { return real(world_.velocity(id)); }
  D3 centre(BodyId id) const { return real(world_.center_of_mass(id)); }
  D3 spin(BodyId id) const { return real(world_.angular_velocity(id)); }
  template <class Id> Id added(Id id) {
    EXPECT_TRUE(id) << describe(world_.fault());
    return id;
  }
  static std::string describe(const FaultReport& report) { return std::string(report.field) + " " + report.expected; }

  World<S> world_;
  bool sleeps_ = false;
};

}  // namespace isostep::test
