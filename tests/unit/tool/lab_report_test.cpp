// The laboratory's report by results made by hand: what it recommends, what it does about gaps, what it writes.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "lab_reports.hpp"
#include "tool/common/tool.hpp"
#include "tool/lab/report/advice_table.hpp"
#include "tool/lab/report/charts.hpp"
#include "tool/lab/report/html.hpp"
#include "tool/lab/report/page.hpp"
#include "tool/lab/rigid_run.hpp"

namespace isostep::tool::lab {
namespace lab_report_test {

using namespace lab_reports;

// ---- the matrix

TEST(Matrix, ACellShowsTheCheapestSettingThatSurvived) {
  const Matrix matrix =
      small_matrix({trial("double", "soft_step", 4, 0.1, 3, false), trial("double", "soft_step", 16, 0.4, 0.1, true),
                    trial("double", "soft_step", 8, 0.2, 0.5, true)});
  EXPECT_EQ(matrix.rows[0].cells[0].fate, Fate::survived);
  EXPECT_EQ(matrix.rows[0].cells[0].result.point.substeps, 8);
}

TEST(Matrix, ACellWhereNothingSurvivedShowsWhatCameNearest) {
  LabResult mended = trial("double", "soft_step", 8, 0.2, 1.5, false);
  mended.faults = 1;
  const Matrix matrix = small_matrix({trial("double", "soft_step", 4, 0.1, kNoNumber, false),
                                      trial("double", "soft_step", 16, 0.4, 2, false), mended,
                                      trial("double", "soft_step", 32, 0.8, 3, false)});
  EXPECT_EQ(matrix.rows[0].cells[0].fate, Fate::failed);
  EXPECT_EQ(matrix.rows[0].cells[0].result.figure, 2);
}

TEST(Matrix, ARunThatFailedTellsMoreThanOneThatWasLeftOut) {
  LabResult long_one = trial("double", "direct", 16, 9, 0, false);
  long_one.state = kLeftOut;
  LabResult refused = trial("double", "direct", 32, 0, 0, false);
  refused.state = kRefused;
  EXPECT_EQ(small_matrix({long_one, refused}).rows[0].cells[1].fate, Fate::open);
  EXPECT_EQ(small_matrix({refused, long_one}).rows[0].cells[1].fate, Fate::open);
  EXPECT_EQ(small_matrix({long_one, trial("double", "direct", 4, 1, 7, false)}).rows[0].cells[1].fate, Fate::failed);
}

TEST(Matrix, WhatWasNotRunIsAGap) {
  const Matrix matrix = small_matrix({trial("double", "soft_step", 4, 0.1, 0, true)});
  ASSERT_EQ(matrix.columns.size(), 4u);
  EXPECT_EQ(matrix.rows[0].cells[3].fate, Fate::untried);
  EXPECT_EQ(matrix.recommended(0, "q32.32"), nullptr);
  EXPECT_TRUE(small_matrix({}).rows[0].cells.size() == 4 && small_matrix({}).recommended(0, "") == nullptr);
}

TEST(Matrix, RecommendsTheCheapestSurvivorOfAScalarWhateverItsSolver) {
  const Matrix matrix =
      small_matrix({trial("double", "soft_step", 16, 0.4, 0.1, true), trial("double", "direct", 8, 0.3, 0.2, true),
                    trial("q32.32", "soft_step", 4, 0.2, 0.9, true), trial("q32.32", "direct", 4, 0.1, 5, false)});
  ASSERT_NE(matrix.recommended(0, "double"), nullptr);
  EXPECT_EQ(matrix.recommended(0, "double")->point.solver, "direct");
  EXPECT_EQ(matrix.recommended(0, "q32.32")->point.solver, "soft_step");
  EXPECT_EQ(matrix.recommended(0, "")->point.scalar, "q32.32");
}

TEST(Matrix, OfTimesThatAreTheSameButForNoiseTheFirstColumnIsRecommended) {
  const auto solver = [](double direct_ms) {
    const Matrix matrix = small_matrix(
        {trial("double", "soft_step", 8, 0.109, 0.1, true), trial("double", "direct", 8, direct_ms, 0.1, true)});
    return matrix.recommended(0, "double")->point.solver;
  };
  EXPECT_EQ(solver(0.1), "soft_step");
  EXPECT_EQ(solver(0.09), "direct");
}

TEST(Matrix, PeersAreColumnsAndNeverRecommended) {
  LabResult quick = peer("tall_stack", "ode", 0.001);
  quick.judged = quick.survived = true;
  const Matrix matrix = small_matrix({quick, peer("S1", "bullet", 1), trial("double", "direct", 8, 0.3, 0.2, true)});
  ASSERT_EQ(matrix.columns.size(), 6u);
  EXPECT_EQ(matrix.columns[4].engine, "bullet");
  EXPECT_EQ(matrix.rows[0].cells[4].fate, Fate::untried);
  EXPECT_EQ(matrix.rows[0].cells[5].fate, Fate::survived);
  EXPECT_EQ(matrix.recommended(0, "")->point.engine, kOwnEngine);
}

TEST(Matrix, APeersBestSettingsCountWhereItsDefaultsFail) {
  LabResult plain = peer("tall_stack", "jolt", 1), best = peer("tall_stack", "jolt-best", 0.5);
  plain.judged = best.judged = best.survived = true;
  MatrixCell cell = small_matrix({plain, best}).rows[0].cells[4];
  EXPECT_EQ(cell.fate, Fate::survived);
  EXPECT_EQ(sign_of(cell), "+");
  plain.survived = true;
  for (const auto& both : {std::vector<LabResult>{plain, best}, std::vector<LabResult>{best, plain}}) {
    const Matrix matrix = small_matrix(both);
    ASSERT_EQ(matrix.columns.size(), 5u) << "an engine is a column";
    EXPECT_EQ(matrix.columns[4].engine, "jolt");
    EXPECT_EQ(sign_of(matrix.rows[0].cells[4]), "✓");
  }
}

// ---- the plan

TEST(Plan, MoreSubstepsAreForMethodsThatFailedWithFewer) {
  Plan plan = {
      {}, {"tall_stack"}, {}, {}, {{1, 4}, {1, 8}, {4, 8}}, {"double"}, {"soft_step", "pgs", "worst_first", "direct"}};
  LabResult long_one = trial("double", "worst_first", 4, 9, 0, false);
  long_one.state = kLeftOut;
  LabResult refused = trial("double", "direct", 4, 0, 0, false);
  refused.state = kRefused;
  EXPECT_EQ(trial_points(plan, 0, {}).size(), 4u);
  const std::vector<LabPoint> points = trial_points(
      plan, 1,
      {trial("double", "soft_step", 4, 1, 0, true), trial("double", "pgs", 4, 1, 9, false), long_one, refused});
  ASSERT_EQ(points.size(), 1u);
  EXPECT_EQ(points[0].solver, "pgs");
  EXPECT_EQ(points[0].substeps, 8);
  EXPECT_EQ(points[0].hz, 60);
  const std::vector<LabPoint> faster =
      trial_points(plan, 2, {trial("double", "pgs", 8, 1, 9, false), long_one, refused});
  ASSERT_EQ(faster.size(), 2u);
  EXPECT_EQ(faster[0].hz, 240);
  EXPECT_EQ(faster[0].substeps, 8);
  EXPECT_EQ(effort_of(faster[0]), "240");
  EXPECT_EQ(effort_of(points[0]), "8");
}

TEST(Plan, TheWholePlanHasEveryTrialAndTheShortOneAFew) {
  const Plan whole = whole_plan(), few = short_plan();
  EXPECT_EQ(whole.trials.size(), scenes::trials().size());
  EXPECT_EQ(whole.scenes.size(), scene_views().size());
  EXPECT_LT(few.trials.size(), whole.trials.size());
}

// ---- bars and advice

TEST(Advice, IsTheCheapestSettingThatHoldsTheBars) {
  LabResult sagging = run("S1x10", "double", "soft_step", 2, 0.1), good = run("S1x10", "double", "soft_step", 8, 0.3),
            best = run("S1x10", "double", "soft_step", 16, 0.6), fallen = run("S1x10", "double", "pgs", 8, 0.01);
  sagging.figure = 0.031;  // [m] the bar is 30 mm, the aim 10 mm
  good.figure = 0.029;
  best.figure = 0.009;
  fallen.stood = false;
  const std::vector<LabResult> results = {best, sagging, fallen, good, peer("S1x10", "ode", 0.001)};
  EXPECT_EQ(cheapest_that(results, "S1x10", "double", scenes::Reach::must)->point.substeps, 8);
  EXPECT_EQ(cheapest_that(results, "S1x10", "double", scenes::Reach::aim)->point.substeps, 16);
  EXPECT_EQ(cheapest_that(results, "S1x10", "float", scenes::Reach::must), nullptr);
}

TEST(Advice, ASceneThatIsLostHoldsNoBar) {
  LabResult r = run("S6", "double", "soft_step", 8, 0.1);
  r.joint_error = 0.01;
  EXPECT_EQ(reach_of(r), scenes::Reach::aim);
  r.faults = 1;
  EXPECT_EQ(reach_of(r), scenes::Reach::misses);
  r.faults = 0;
  r.state = kLeftOut;
  EXPECT_EQ(reach_of(r), scenes::Reach::misses);
  LabResult outside = run("S4", "double", "soft_step", 8, 0.1);
  EXPECT_FALSE(is_lost(outside));
  outside.figure = 1;
  EXPECT_TRUE(is_lost(outside));
}

// ---- text

TEST(Html, EscapesWhatWouldBeMarkup) {
  EXPECT_EQ(escaped("<a href=\"x\">'&'\n</a>"), "&lt;a href=&quot;x&quot;&gt;&#39;&amp;&#39; &lt;/a&gt;");
  EXPECT_EQ(escaped("µs, 1 m²"), "µs, 1 m²");
}

TEST(Html, NumbersHaveThreeDigits) {
  EXPECT_EQ(short_number(0), "0");
  EXPECT_EQ(short_number(0.0123456), "0.0123");
  EXPECT_EQ(short_number(12.345), "12.3");
  EXPECT_EQ(short_number(1239.6), "1240");
  EXPECT_EQ(short_number(-1.26e-9), "-1.3e-09");
  EXPECT_EQ(short_number(kNoNumber), "-");
}

TEST(Html, PicturesInOnePageShareNoId) {
  const std::string file =
      "<?xml version=\"1.0\"?>\n<svg><g id='p'/><use xlink:href='#p'/><g id=\"q\" clip-path=\"url(#q)\"/></svg>\n<!-- "
      "-->";
  EXPECT_EQ(inlined_svg(file, "a-"),
            "<svg><g id='a-p'/><use xlink:href='#a-p'/><g id=\"a-q\" clip-path=\"url(#a-q)\"/></svg>");
  EXPECT_EQ(inlined_svg("", "a-"), "");
}

TEST(Html, TablesOfMarkdownLineUpAndEscapeBars) {
  EXPECT_EQ(markdown_table({{"a", "µ"}, {"long", "x|y"}}), "| a    | µ    |\n|------|------|\n| long | x\\|y |\n");
}

// ---- charts

TEST(Charts, TheTableHasALineARunThatCameToItsEnd) {
  LabResult done = run("S6v", "double", "direct", 4, 0.25), long_one = done, spheres = done, lost = done;
  done.figure = 0;  // less than the axis shows
  long_one.state = kLeftOut;
  spheres.point.model = "spheres";
  lost.joint_error = 0.6;  // [m] a link is half a metre long
  lost.figure = 7;
  const std::string tsv = accuracy_tsv({done, long_one, spheres, lost, run("tall_stack", "double", "direct", 4, 1)});
  EXPECT_EQ(count_of(tsv, "\n"), 3u);
  EXPECT_TRUE(holds(tsv, "\tisostep\tdouble\tdirect\t4\t0.25\t1e-06\t0\n"));
  EXPECT_TRUE(holds(tsv, "\tisostep\tdouble\tdirect\t4\t0.25\t7000\t1\n"));
}

TEST(Charts, TheTableOfStagesReadsBackAsItWasWritten) {
  const std::vector<StageCost> stages = stages_of(stages_tsv({{"S3", "float", "prepare", 12.5}}));
  ASSERT_EQ(stages.size(), 1u);
  EXPECT_EQ(stages[0].us, 12.5);
  EXPECT_TRUE(stages_of("no table").empty());
  EXPECT_TRUE(stages_of("head\nof\tanother\n").empty());
}

TEST(Charts, TheMatrixAsAPictureHasASignForEveryFate) {
  const std::string svg = survival_svg(
      small_matrix({trial("double", "soft_step", 16, 0.4, 0.1, true), trial("double", "direct", 8, 0.3, 0.2, false)}));
  EXPECT_TRUE(holds(svg, ">16</text>"));
  EXPECT_EQ(count_of(svg, ">×</text>"), 2u);  // and the legend's
  EXPECT_TRUE(holds(svg, ">tall_stack</text>"));
}

TEST(Growth, DistanceCountsWaysAndTurns) {
  scenes::Sight a, b;
  a.bodies.resize(2);
  b.bodies.resize(2);
  a.bodies[0].dynamic = b.bodies[0].dynamic = true;
  b.bodies[0].centre = {3, 0, 4};
  b.bodies[1].centre = {100, 0, 0};  // moves for nobody
  EXPECT_DOUBLE_EQ(distance_between(a, b), 5);
  b.bodies[0].centre = {0, 0, 0};
  b.bodies[0].orientation = {0, 1, 0, 0};  // half a turn: four of six points go by a metre
  EXPECT_DOUBLE_EQ(distance_between(a, b), std::sqrt(4.0 / 6));
  b.bodies.pop_back();
  EXPECT_TRUE(std::isnan(distance_between(a, b)));
}

// ---- the page

TEST(Page, HasEverySectionAndEscapesWhatResultsSay) {
  const std::string page = page_of(hand_made());
  for (const char* id : {"games", "names", "advice", "accuracy", "survival", "growth", "springs", "stages"}) {
    EXPECT_EQ(count_of(page, "<section id=\"" + std::string(id) + "\">"), 1u) << id;
  }
  EXPECT_FALSE(holds(page, "<script"));
  EXPECT_TRUE(holds(page, "&lt;script&gt;"));
  EXPECT_EQ(count_of(page, "gnuplot was not there"), 3u);
  EXPECT_TRUE(holds(page, "<g id='a-p'/>"));
  EXPECT_TRUE(holds(page, "<td>soft_step, 16 sub-steps: 0.1 %, 0.4 ms</td>"));
}

TEST(Page, IsTheSameForTheSameResults) { EXPECT_EQ(page_of(hand_made()), page_of(hand_made())); }

TEST(Page, TheSummaryCountsWhatBothScalarsSurvive) {
  EXPECT_TRUE(holds(summary_of(hand_made()), "Survived in double and q32.32: 1 of 1."));
  EXPECT_TRUE(holds(summary_of(hand_made()), "| failed: ode "));
}

TEST(Page, TheSummaryNamesWhatTheDefaultFails) {
  const std::string begin = "The default fails in double or q32.32: ";
  ReportData data = hand_made();
  EXPECT_TRUE(holds(summary_of(data), begin + "none."));  // double ran with 16 sub-steps alone
  data.results.push_back(trial("double", "soft_step", 8, 0.4, 0.3, false));
  EXPECT_TRUE(holds(summary_of(data), begin + "tall_stack."));
  data.results.push_back(trial("double", "soft_step", 4, 0.4, 0.1, true));  // fewer sub-steps are enough
  EXPECT_TRUE(holds(summary_of(data), begin + "none."));
}

TEST(Page, WhatTheLimitLeftOutIsNoFailureOfTheDefault) {
  ReportData data = hand_made();
  data.results.push_back(trial("double", "soft_step", 8, 0, 0, false));
  data.results.back().state = kLeftOut;
  EXPECT_TRUE(holds(summary_of(data), "The default fails in double or q32.32: none."));
}

}  // namespace lab_report_test
}  // namespace isostep::tool::lab
