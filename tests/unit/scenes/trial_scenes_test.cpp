// Every trial is a scene that does something, and some do what they are there for.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <set>
#include <string>

#include "isostep/world/world.hpp"
#include "scenes/build.hpp"
#include "scenes/named.hpp"
#include "scenes/script.hpp"
#include "scenes/shapes.hpp"
#include "scenes/trials/scene_numbers.hpp"
#include "scenes/trials/trial.hpp"
#include "scenes/trials/trial_run.hpp"

namespace isostep::scenes {
namespace trial_scenes_test {

TEST(Trials, HaveNamesOfTheirOwn) {
  std::set<std::string> names;
  for (const NamedScene& scene : named_scenes()) names.insert(scene.name);
  for (const Trial& trial : trials()) {
    EXPECT_TRUE(names.insert(trial.name).second) << trial.name;
    EXPECT_EQ(find_trial(trial.name), &trial);
    EXPECT_TRUE(std::string(trial.name).find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_") == std::string::npos)
        << trial.name;
  }
  EXPECT_EQ(find_trial("S1"), nullptr);
}

/// Gravity, a spin or an overlap: ten steps move something, or it bears what would else fall.
TEST(Trials, BuildInDoubleAndDoSomething) {
  for (const Trial& trial : trials()) {
    const Scene scene = *find_scene(trial.name);
    World<double> world(settings_of<double>(scene));
    build(scene, world);
    TrialRun run(trial, scene);
    run.see(world);
    const Sight start = sight_of(world, 0);
    for (int i = 0; i < 10; ++i) {
      before_step(scene.script, world);
      run.see(world, world.step());
    }
    const Sight sight = sight_of(world, 0);
    bool moves = world.counts().points > 0;
    for (std::size_t i = 0; i < sight.bodies.size(); ++i) {
      const BodySight& body = sight.bodies[i];
      const bool is_there = body.centre == start.bodies[i].centre && body.orientation == start.bodies[i].orientation;
      const double speeds = dot(body.velocity, body.velocity) + dot(body.angular_velocity, body.angular_velocity);
      moves = moves || (body.dynamic && (speeds > 0 || !is_there));
    }
    EXPECT_TRUE(moves) << trial.name;
    EXPECT_FALSE(run.over()) << trial.name;
  }
}

/// What floating point cannot do: the same bits wherever it is.
TEST(FarTrials, AreInFixedPointAsTheyAreAtHome) {
  const auto seen_after_a_second = [](const Scene& scene) {
    World<Q32_32> world(settings_of<Q32_32>(scene));
    build(scene, world);
    for (int frame = 0; frame < 60; ++frame) world.step();
    return sight_of(world, 0);
  };
  for (const std::string name : {"far_stack", "far_pyramid", "far_chain"}) {
    const Scene distant = *find_scene(name + "_1000km");
    Scene home = distant;
    for (SceneBody& body : home.bodies) body.position[0] = value(body.position).x - 1e6;
    for (SceneJoint& joint : home.joints) joint.anchor[0] = value(joint.anchor).x - 1e6;
    const Sight here = seen_after_a_second(home), there = seen_after_a_second(distant);
    EXPECT_NE(here.bodies.back().centre, value(home.bodies.back().position)) << name;
    for (std::size_t i = 0; i < here.bodies.size(); ++i) {
      EXPECT_EQ(here.bodies[i].centre + (Vec3<double>{1e6, 0, 0}), there.bodies[i].centre) << name;
      EXPECT_EQ(here.bodies[i].velocity, there.bodies[i].velocity) << name;
      EXPECT_EQ(here.bodies[i].angular_velocity, there.bodies[i].angular_velocity) << name;
    }
  }
}

TEST(WokenCrowd, SleepsUntilItIsHit) {
  const Scene scene = *find_scene("woken_crowd");
  World<float> world(settings_of<float>(scene));
  build(scene, world);
  for (int frame = 0; frame <= 120; ++frame) {
    before_step(scene.script, world);
    if (frame < 120) world.step();
    EXPECT_TRUE(frame != 119 || world.counts().awake == 0);
  }
  EXPECT_GT(world.counts().awake, 0u);
}

}  // namespace trial_scenes_test
}  // namespace isostep::scenes
