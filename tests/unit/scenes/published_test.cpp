// The published comparisons: what we promise to show in each, by a world's own settings. The tower's ten minutes and
// the shorter steps are tried with ISOSTEP_WHOLE=1.
// SPDX-License-Identifier: MIT
#include "scenes/published/published.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "isostep/world/world.hpp"
#include "sample.hpp"
#include "scenes/build.hpp"
#include "scenes/named.hpp"
#include "scenes/trials/trial_run.hpp"
#include "tool/lab/subject.hpp"

namespace isostep::scenes {
namespace published_test {

/// The figure of a run at that rate; not a number where the world had to mend one.
template <class S> double figure_of(const PublishedTest& test, int hz, int substeps) {
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
  return clean ? run.verdict().figure : std::numeric_limits<double>::quiet_NaN();
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

/// A judge that accepts anything would show 0: half the balls' restitution is seen, and a pull that is not there.
TEST(PublishedTests, measure_what_is_wrong) {
  PublishedTest bouncing = *find_published_test("simbenchmark_bouncing");
  bouncing.trial.make = [] {
    Scene scene = find_published_test("simbenchmark_bouncing")->trial.make();
    for (SceneBody& body : scene.bodies) body.restitution = 0.5;
    return scene;
  };
  EXPECT_GT(figure_of<double>(bouncing, 100, 8), 1e6);
  PublishedTest rolling = *find_published_test("simbenchmark_rolling");
  rolling.trial.make = [] {
    Scene scene = find_published_test("simbenchmark_rolling")->trial.make();
    scene.records.clear();
    return scene;
  };
  EXPECT_GT(figure_of<double>(rolling, 1000, 8), 0.1);
}

/// Returns the test with another scene.
PublishedTest with_scene(const char* name, Scene (*make)()) {
  PublishedTest test = *find_published_test(name);
  test.trial.make = make;
  return test;
}
Scene scene_named(const char* name) { return find_published_test(name)->trial.make(); }

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
