// Published comparisons of engines: their scenes, their measures, and the figures that their authors found.
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "scenes/trials/trial.hpp"

namespace isostep::scenes {

/// An engine of that year showed this figure at that rate.
struct PublishedFigure {
  const char* engine;
  int hz;         // [1/s]
  double figure;  // in the trial's unit
};
/// isostep promises the first figure at that rate, and aims at the second.
struct PublishedBar {
  int hz;  // [1/s]
  double must, aim;
};

struct PublishedTest {
  Trial trial;               // its bar is the first must
  const char* source;        // the publication
  int year;                  // of it, and of its figures
  const char* differs = "";  // where theirs is another scene, or was run otherwise than ours
  /// The figure is the distance of the run's outcome from that of the same engine in the shortest steps that it ran.
  bool compares_steps = false;
  double starts_differ_by = 0;                    // [m] a scalar that cannot hold it does not run
  std::span<const int> rates;                     // [1/s] of the steps, the longest first
  std::span<const PublishedFigure> figures = {};  // none: theirs are of other scenes
  std::span<const PublishedBar> bars;
};
/// Its trial's bar becomes the first must.
inline PublishedTest with_first_bar(PublishedTest test) {
  test.trial.bar = test.bars.front().must;
  return test;
}

/// Every published test, source after source.
const std::vector<PublishedTest>& published_tests();
/// Returns null for a name that none has.
const PublishedTest* find_published_test(std::string_view name);

std::span<const PublishedTest> sim_benchmark_tests();
std::span<const PublishedTest> sim_benchmark_robot_tests();
std::span<const PublishedTest> erez_tests();
std::span<const PublishedTest> chung_pollard_tests();

}  // namespace isostep::scenes
