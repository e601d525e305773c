// A world in full swing, on which commands are tried.
// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <vector>

#include "unit/world/worlds.hpp"

namespace isostep::test {

/// A world in full swing: things awake, asleep, joined, pressed together and watched, so that what a refused command
/// touched would show in the hash.
template <class S> class CommandedWorld : public ::testing::Test {
 protected:
  CommandedWorld() : world(settings<S>()) {
    ground = add_ground(world);
    box = add_box(world, 0.5, 0.5, 0.5);
    ball = add_ball(world, 0.5);
    spare = add_ball(world, 0.25);
    sleeper = world.create(moving<S>(box, {0, 0.5, 0}));
    BodyDefinition<S> platform = still<S>(box, {6, 3, 0});
    platform.type = BodyType::kinematic;
    kinematic = world.create(platform);
    BodyDefinition<S> sensor = still<S>(box, {3, 0.5, 0});
    sensor.sensor = true;
    watcher = world.create(sensor);
    for (int i = 0; i < 80; ++i) world.step();
    flier = world.create(moving<S>(ball, {3, 1, 0}));
    other = world.create(moving<S>(ball, {-8, 3, 0}));
    joint = world.create(world.joint_at(JointType::distance, {}, other, {vec<S>(-8, 5, 0), Quat<Unit<S>>::identity()}));
    gone = world.create(moving<S>(box, {0, 20, 0}));
    gone_shape = add_box(world, 1, 1, 1);
    gone_joint = world.create(world.joint_at(JointType::ball, {}, gone, {vec<S>(0, 20, 0), Quat<Unit<S>>::identity()}));
    world.destroy(gone_joint);
    world.destroy(gone);
    world.remove_shape(gone_shape);
    for (int i = 0; i < 3; ++i) world.step();
    EXPECT_FALSE(world.is_awake(sleeper));
    EXPECT_TRUE(world.is_awake(flier));
  }

  template <class Command> void expect_refused(Fault fault, Command&& command, int line = __builtin_LINE()) {
    SCOPED_TRACE(line);
    const std::uint64_t before = world.hash();
    std::vector<std::uint8_t> log;
    world.record_to(&log);
    EXPECT_FALSE(static_cast<bool>(command()));
    world.record_to(nullptr);
    EXPECT_EQ(world.fault(), fault) << describe(world.fault());
    EXPECT_EQ(world.hash(), before) << "a refused command changed something: " << fault_text(fault);
    EXPECT_TRUE(log.empty());
  }
  template <class Change> void expect_bad_definition(Fault fault, Change&& change, int line = __builtin_LINE()) {
    SCOPED_TRACE(line);
    BodyDefinition<S> d = moving<S>(ball, {2, 9, 0});
    change(d);
    expect_refused(fault, [&] { return world.create(d); });
  }

  World<S> world;
  ShapeId box, ball, spare, gone_shape;
  BodyId ground, sleeper, kinematic, watcher, flier, other, gone;
  JointId joint, gone_joint;
};

template <class S> S not_a_number() {
  if constexpr (!kIsFixed<S>) return std::numeric_limits<S>::quiet_NaN();
  return S(0);
}
template <class S> S endless() {
  if constexpr (!kIsFixed<S>) return -std::numeric_limits<S>::infinity();
  return S(0);
}

}  // namespace isostep::test
