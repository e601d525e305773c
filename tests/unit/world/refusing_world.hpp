// A world of two balls on the ground whose refusals are looked at.
// SPDX-License-Identifier: MIT
#pragma once

#include "unit/world/worlds.hpp"

namespace isostep::test {

template <class S> class RefusingWorld : public ::testing::Test {
 protected:
  RefusingWorld() : world(settings<S>()) {
    ground = add_ground(world);
    ball = add_ball(world, 0.5);
    a = world.create(moving<S>(ball, {0, 2, 0}));
    b = world.create(moving<S>(ball, {3, 2, 0}));
  }
  void expect_fault(Fault fault, const char* command, const char* field, const char* expected = nullptr) {
    const FaultReport& report = world.fault();
    EXPECT_STREQ(fault_text(report.fault), fault_text(fault));
    EXPECT_STREQ(report.command, command);
    EXPECT_STREQ(report.field, field);
    if (expected != nullptr) {
      EXPECT_STREQ(report.expected, expected);
    }
  }

  World<S> world;
  ShapeId ball;
  BodyId ground, a, b;
};

}  // namespace isostep::test
