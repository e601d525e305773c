// Who ran, and which settings a game is advised to take, by results made by hand.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "lab_reports.hpp"
#include "tool/common/tool.hpp"
#include "tool/lab/report/engines.hpp"
#include "tool/lab/report/genres.hpp"
#include "tool/lab/rigid_run.hpp"

namespace isostep::tool::lab {
namespace lab_genres_test {

using namespace lab_reports;

TEST(Engines, NamesAreExplainedOnceAndOnlyThoseThatRan) {
  const std::vector<std::vector<std::string>> cells = who_is_who({"isostep", "jolt", "jolt-best"});
  const auto lines = [&](const std::string& name) {
    return std::count_if(cells.begin(), cells.end(), [&](const auto& line) { return line[0] == name; });
  };
  EXPECT_EQ(lines("jolt"), 1);
  EXPECT_EQ(lines("ode"), 0);
  for (const std::string& solver : rigid_solvers()) EXPECT_EQ(lines(solver), 1) << solver;
  for (const std::string& scalar : scalar_names()) EXPECT_EQ(lines(scalar), 1) << scalar;
}

TEST(Genres, TheCheapestSolverThatHoldsAllIsAdvised) {
  ReportData data = hand_made();
  data.plan.scenes = {};
  data.plan.trials = {"card_house", "tall_stack"};
  data.plan.scalars = {"double"};
  const auto add = [&](const char* name, const char* solver, int substeps, double ms, bool survived) {
    LabResult r = trial("double", solver, substeps, ms, 0, survived);
    r.point.scene = name;
    data.results.push_back(r);
  };
  data.results.clear();
  add("card_house", "soft_step", 4, 0.1, true);
  add("tall_stack", "soft_step", 4, 0.1, false);
  add("tall_stack", "soft_step", 8, 0.2, true);
  add("card_house", "direct", 4, 0.01, true);
  add("tall_stack", "direct", 4, 0.5, true);
  const auto advised = [&] { return genre_cells(data).at(1).at(3); };
  EXPECT_EQ(genre_cells(data).at(1).at(0), "physics sandbox");
  EXPECT_EQ(advised(), "soft_step, 8 sub-steps: 0.2 ms");
  data.results[2].survived = false;
  EXPECT_EQ(advised(), "direct, 4 sub-steps: 0.5 ms");
  data.results[4].survived = false;
  EXPECT_EQ(advised(), "soft_step, 4 sub-steps: 0.1 ms; but not tall_stack");
  for (LabResult& r : data.results) r.survived = false;
  EXPECT_EQ(advised(), "none");
}

TEST(Genres, TheSentenceCountsWhatAWorldsOwnSettingsHold) {
  const std::string text = advice_sentence(hand_made());
  EXPECT_TRUE(holds(text, "Begin with soft_step and 8 sub-steps")) << text;
  EXPECT_TRUE(holds(text, "In double they hold the bars of 1 of 1 scenes; of 1 trials they survive 0 and fail 0."))
      << "16 it takes";
  EXPECT_TRUE(holds(text, "In q32.32 they hold the bars of 0 of 1 scenes; of 1 trials they survive 1 and fail 0."));
  EXPECT_FALSE(holds(text, "In float")) << "it is not in the plan";
}

TEST(Genres, TheSentenceSaysWhatNeverRan) {
  ReportData data = hand_made();
  data.plan.trials = {"tall_stack", "card_house"};
  const auto add = [&](const char* name, const char* state) {
    data.results.push_back(trial("q32.32", "soft_step", 4, 0, 0, false));  // 8 were not tried
    data.results.back().point.scene = name;
    data.results.back().state = state;
  };
  add("card_house", kRefused);
  EXPECT_TRUE(holds(advice_sentence(data), "of 2 trials they survive 1 and fail 0 (beyond its range: 1)"));
  data.results.back().state = kLeftOut;
  EXPECT_TRUE(holds(advice_sentence(data), "of 2 trials they survive 1 and fail 0 (too long: 1)"));
}

TEST(Genres, TheSentenceSaysWhatIsMissingOfOtherEngines) {
  ReportData data = hand_made();
  data.results.push_back(trial("", "", 0, 0.1, 0, true));
  data.results.back().point.engine = "jolt";
  data.matrix = matrix_of(data.plan.trials, data.plan.scalars, data.plan.solvers, data.results);
  EXPECT_TRUE(holds(advice_sentence(data), "survives most: 1 of the 1 trials that it ended"));
  EXPECT_FALSE(holds(advice_sentence(data), "incomplete"));
  data.plan.trials.push_back("card_house");
  data.matrix = matrix_of(data.plan.trials, data.plan.scalars, data.plan.solvers, data.results);
  EXPECT_TRUE(holds(advice_sentence(data), "incomplete: 2 of 4 are not there."));  // jolt's and ode's
}

TEST(Genres, NothingSlowerThanAFrameIsAdvised) {
  ReportData data = hand_made();
  data.plan.scenes = {};
  data.plan.trials = {"tall_stack"};
  data.plan.scalars = {"double"};
  data.results = {trial("double", "soft_step", 8, 17, 0, true)};
  EXPECT_EQ(genre_cells(data).at(1).at(3), "none");
  data.results[0].ms = 16;
  EXPECT_EQ(genre_cells(data).at(1).at(3), "soft_step, 8 sub-steps: 16 ms");
}

}  // namespace lab_genres_test
}  // namespace isostep::tool::lab
