// The published comparisons: what we promise to show in each, by a world's own settings. The tower's ten minutes and
// the shorter steps are tried with ISOSTEP_WHOLE=1.
// SPDX-License-Identifier: MIT
#include "scenes/published/published.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "isostep/world/world.hpp"
#include "sample.hpp"
#include "scenes/build.hpp"
#include "scenes/named.hpp"
#include "scenes/trials/trial_run.hpp"
#include "tool/lab/subject.hpp"

namespace isostep::scenes {
namespace published_test {

/// Figure and outcome of a run; the figure is not a number where the world had to mend one.
struct End {
  double figure;
  std::vector<double> outcome;
};
template <class S> End end_of(const PublishedTest& test, int hz, int substeps) {
  Scene scene = test.trial.make();
  const int frames = tool::lab::frames_at(scene, -1, hz);
  scene.hz = hz;
  scene.substeps = substeps;
  World<S> world(settings_of<S>(scene));
  build(scene, world);
  TrialRun run(test.trial, scene);
  run.see(world);
  bool clean = true;
  for (int i = 0; i < frames; ++i) {
    const StepReport report = world.step();
    clean = clean && report.clean();
    run.see(world, report);
  }
  return {clean ? run.verdict().figure : std::numeric_limits<double>::quiet_NaN(), run.outcome()};
}
/// The figure of a run at that rate, or its distance from that in the shortest steps.
template <class S> double figure_of(const PublishedTest& test, int hz, int substeps) {
  const End end = end_of<S>(test, hz, substeps);
  if (!test.compares_steps || std::isnan(end.figure)) return end.figure;
  return distance_of(end.outcome, end_of<S>(test, test.rates.back(), substeps).outcome);
}

TEST(PublishedTests, are_as_good_as_promised) {
  for (const PublishedTest& published : published_tests()) {
    const bool is_long = published.trial.make().frames > 10000;
    if (is_long && !test::wants_whole()) continue;
    const int substeps = is_long ? 4 : Scene().substeps;
    for (const PublishedBar& bar : published.bars.first(test::sampled(published.bars.size(), std::size_t{1}))) {
      EXPECT_LE(figure_of<double>(published, bar.hz, substeps), bar.must) << published.trial.name << " " << bar.hz;
      EXPECT_LE(figure_of<Q32_32>(published, bar.hz, substeps), bar.must) << published.trial.name << " " << bar.hz;
    }
  }
}

/// Returns the test with another scene.
PublishedTest with_scene(const char* name, Scene (*make)()) {
  PublishedTest test = *find_published_test(name);
  test.trial.make = make;
  return test;
}
Scene scene_named(const char* name) { return find_published_test(name)->trial.make(); }

/// A judge that accepts anything would show 0: half the balls' restitution is seen, and a pull that is not there.
TEST(PublishedTests, measure_what_is_wrong) {
  const PublishedTest bouncing = with_scene("simbenchmark_bouncing", [] {
    Scene scene = scene_named("simbenchmark_bouncing");
    for (SceneBody& body : scene.bodies) body.restitution = 0.5;
    return scene;
  });
  EXPECT_GT(figure_of<double>(bouncing, 100, 8), 1e6);
  const PublishedTest rolling = with_scene("simbenchmark_rolling", [] {
    Scene scene = scene_named("simbenchmark_rolling");
    scene.records.clear();
    return scene;
  });
  EXPECT_GT(figure_of<double>(rolling, 1000, 8), 0.1);
}

TEST(PublishedTests, measure_robots_that_fail) {
  const PublishedTest limp = with_scene("simbenchmark_anymal_pd", [] {
    Scene scene = scene_named("simbenchmark_anymal_pd");
    for (SceneJoint& joint : scene.joints) joint.flags = 0;
    return scene;
  });
  EXPECT_GE(figure_of<double>(limp, 200, 8), 1);
  const PublishedTest pulled = with_scene("simbenchmark_anymal_momentum", [] {
    Scene scene = scene_named("simbenchmark_anymal_momentum");
    scene.gravity = {0, 0, 0.01};
    return scene;
  });
  EXPECT_GT(figure_of<double>(pulled, 100, 8), 1);
  const PublishedTest damped = with_scene("simbenchmark_anymal_energy", [] {
    Scene scene = scene_named("simbenchmark_anymal_energy");
    for (SceneBody& body : scene.bodies) body.linear_damping = 0.1;
    return scene;
  });
  EXPECT_GT(figure_of<double>(damped, 100, 8), 20);
}

TEST(PublishedTests, measure_mechanisms_that_fail) {
  const PublishedTest slack = with_scene("erez_grasp", [] {
    Scene scene = scene_named("erez_grasp");
    for (SceneJoint& joint : scene.joints) joint.flags = 0;
    return scene;
  });
  EXPECT_GT(figure_of<double>(slack, 100, 8), 1000);
  const PublishedTest held = with_scene("erez_humanoid_momentum", [] {
    Scene scene = scene_named("erez_humanoid_momentum");
    scene.bodies.front().type = BodyType::static_;
    return scene;
  });
  EXPECT_GT(figure_of<double>(held, 100, 8), 0.1);
  const PublishedTest damped = with_scene("erez_chain_energy", [] {
    Scene scene = scene_named("erez_chain_energy");
    for (SceneBody& body : scene.bodies) body.linear_damping = 0.1;
    return scene;
  });
  EXPECT_GT(figure_of<double>(damped, 100, 8), 20);
}

/// Starts that lie apart end apart; equal ones end together.
TEST(PublishedTests, measure_the_spread_of_ends) {
  const PublishedTest apart = with_scene("predictable_brick", [] {
    Scene scene = scene_named("predictable_brick");
    for (std::size_t i = 1; i < scene.bodies.size(); ++i) scene.bodies[i].position[2] = 0.1 * static_cast<double>(i);
    return scene;
  });
  EXPECT_GT(figure_of<double>(apart, 100, 8), 1);
  EXPECT_EQ(figure_of<Q16_16>(*find_published_test("predictable_stack"), 100, 8), 0);
}

TEST(PublishedTests, compare_outcomes_by_the_distance_of_bodies) {
  EXPECT_EQ(distance_of({0, 0, 0, 1, 1, 1}, {3, 0, 4, 1, 1, 1}), std::sqrt(12.5));
  EXPECT_TRUE(std::isnan(distance_of({}, {})));
  EXPECT_TRUE(std::isnan(distance_of({1, 2, 3}, {1, 2, 3, 4, 5, 6})));
}

TEST(PublishedTests, are_named_scenes_with_figures_at_their_rates) {
  for (const PublishedTest& test : published_tests()) {
    ASSERT_TRUE(find_scene(test.trial.name)) << test.trial.name;
    EXPECT_EQ(find_trial(test.trial.name), &find_published_test(test.trial.name)->trial);
    for (const PublishedFigure& figure : test.figures) {
      EXPECT_NE(std::find(test.rates.begin(), test.rates.end(), figure.hz), test.rates.end()) << test.trial.name;
      EXPECT_GE(figure.figure, 0);
    }
    for (const PublishedBar& bar : test.bars) EXPECT_LE(bar.aim, bar.must);
  }
}

}  // namespace published_test
}  // namespace isostep::scenes
