// The published comparisons by results made by hand: order, places, and what counts as a comparison.
// SPDX-License-Identifier: MIT
#include "tool/lab/published/published_page.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "lab_reports.hpp"
#include "scenes/published/published.hpp"
#include "tool/lab/published/standing.hpp"

namespace isostep::tool::lab {
namespace published_page_test {

constexpr int kSubsteps = 8;  // of a world that asks for none

LabResult ours(const char* scene, const char* scalar, double figure, int hz = 100, int substeps = kSubsteps) {
  LabResult r;
  r.point = {scene, kOwnEngine, scalar, "soft_step", "rigid", hz, substeps};
  r.figure = figure;
  return r;
}
LabResult peer(const char* scene, const char* engine, double figure, int hz = 100) {
  LabResult r;
  r.point = {scene, engine, "", "", "rigid", hz, 0};
  r.figure = figure;
  return r;
}
std::vector<Standing> standings(const char* scene, int hz, const std::vector<LabResult>& results) {
  return standings_of(*scenes::find_published_test(scene), hz, results);
}
bool is_double(const Standing& s) { return s.is_default && s.scalar == "double"; }
using lab_reports::holds;

TEST(Standings, TheLeastErrorComesFirstAndWhoDidNotEndLast) {
  LabResult fell = peer("simbenchmark_bouncing", "ode", 0);
  fell.faults = 1;
  const std::vector<Standing> all =
      standings("simbenchmark_bouncing", 100, {fell, ours("simbenchmark_bouncing", "double", 1000)});
  ASSERT_EQ(all.size(), 6u);  // four published beside two that ran
  EXPECT_EQ(all.front().engine, "RaiSim (2018)");
  EXPECT_TRUE(all[1].ours);
  EXPECT_EQ(all.back().engine, "ode");
  EXPECT_FALSE(all.back().ended);
  EXPECT_TRUE(
      std::is_sorted(all.begin(), all.end() - 1, [](const auto& a, const auto& b) { return a.figure < b.figure; }));
}

TEST(Standings, EqualFiguresShareAPlaceAndOurOtherSettingsTakeNone) {
  const std::vector<Standing> all =
      standings("predictable_edge", 100,
                {peer("predictable_edge", "jolt", 1), peer("predictable_edge", "ode", 1),
                 ours("predictable_edge", "double", 1.5, 100, 16), ours("predictable_edge", "double", 2)});
  EXPECT_EQ(place_of(all, is_double), 2);
}

TEST(Standings, TheRunInTheShortestStepsIsWhatOthersAreComparedWith) {
  std::vector<LabResult> results = {ours("erez_chain", "double", 0, 100), ours("erez_chain", "double", 0, 500)};
  results[0].outcome = {0, 0, 0.25};
  results[1].outcome = {0, 0, 0};
  EXPECT_TRUE(standings("erez_chain", 500, results).empty());
  ASSERT_EQ(standings("erez_chain", 100, results).size(), 1u);
  EXPECT_DOUBLE_EQ(standings("erez_chain", 100, results)[0].figure, 0.25);
}

TEST(PublishedPage, WhereNoOtherEngineEndedThereIsNoPlaceToWin) {
  std::vector<LabResult> results = {ours("predictable_edge", "double", 1), ours("predictable_edge", "q32.32", 3)};
  EXPECT_TRUE(holds(published_page(results), "No comparison: "));
  EXPECT_TRUE(holds(published_summary(results), "| -, -"));
  results.push_back(peer("predictable_edge", "jolt", 2));
  EXPECT_TRUE(holds(published_page(results), "isostep ran 1 comparisons"));
  EXPECT_TRUE(holds(published_page(results), "in 1 of them in double and in 0 in fixed point"));
  EXPECT_TRUE(holds(published_summary(results), "| jolt 2"));
  EXPECT_TRUE(holds(published_summary(results), "| 1, 2"));
}

TEST(PublishedPage, WhatTheDefaultDidNotEndIsNoComparison) {
  LabResult refused = ours("predictable_edge", "double", 0);
  refused.state = kRefused;
  const std::vector<LabResult> results = {refused, peer("predictable_edge", "jolt", 2)};
  EXPECT_TRUE(holds(published_page(results), "No comparison: "));
}

TEST(PublishedPage, ItsContentsNameEveryTest) {
  const std::string page = published_page({ours("predictable_edge", "double", 1)});
  for (const scenes::PublishedTest& test : scenes::published_tests()) {
    EXPECT_TRUE(holds(page, std::string("<a href=\"#") + test.trial.name + "\">")) << test.trial.name;
  }
}

TEST(PublishedPage, AFigureThatDidNotEndSaysWhyAndIsEscaped) {
  LabResult refused = peer("predictable_edge", "dart", 0);
  refused.state = kRefused;
  refused.reason = "<no such servo>";
  const std::string page = published_page({ours("predictable_edge", "double", 1), refused});
  EXPECT_TRUE(holds(page, "refused: &lt;no such servo&gt;"));
  EXPECT_TRUE(holds(page, "No comparison: "));
}

}  // namespace published_page_test
}  // namespace isostep::tool::lab
