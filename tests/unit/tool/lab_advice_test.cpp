// The laboratory's tolerances, fronts and advice, by results made by hand.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "lab_results.hpp"
#include "tool/common/tool.hpp"
#include "tool/lab/advice.hpp"
#include "tool/lab/tolerance.hpp"

namespace isostep::tool::lab {
namespace lab_advice_test {

/// The words of the tolerance's reader; empty when it accepts.
std::string refusal(const std::string& text) {
  try {
    parse_tolerance(text);
    return "";
  } catch (const ToolError& error) {
    EXPECT_EQ(error.status(), exit_status::kUsage);
    return error.what();
  }
}

// ---- tolerances

TEST(LabTolerance, OneLengthIsForOverlapAndJointsOfWhatStands) {
  const Tolerance t = parse_tolerance("5mm");
  ASSERT_EQ(t.bounds.size(), 2u);
  EXPECT_TRUE(t.stands);
  EXPECT_DOUBLE_EQ(t.bounds[0].most, 0.005);
  EXPECT_DOUBLE_EQ(excess_of(result("float", "pgs", 1, 1, 0.001, 0.010), t), 2);
  EXPECT_DOUBLE_EQ(excess_of(result("float", "pgs", 1, 1, 0.0025, 0.001), t), 0.5);
  EXPECT_EQ(excess_of(result("float", "pgs", 1, 1, 0, 0), t), 0);
}

TEST(LabTolerance, AListHasUnitsOfItsOwn) {
  const Tolerance t = parse_tolerance("penetration=2mm,joint=100um,deviation=5cm,energy=0.1,unrest=2J/kg,figure=3");
  EXPECT_FALSE(t.stands);
  ASSERT_EQ(t.bounds.size(), 6u);
  const double values[] = {0.002, 1e-4, 0.05, 0.1, 2, 3};
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(static_cast<std::size_t>(t.bounds[i].quantity), i);
    EXPECT_DOUBLE_EQ(t.bounds[i].most, values[i]);
  }
  EXPECT_DOUBLE_EQ(parse_tolerance("unrest=1e-8").bounds[0].most, 1e-8);
  EXPECT_TRUE(parse_tolerance("joint=1m,stands").stands);
  EXPECT_TRUE(parse_tolerance("stands").stands);
}

TEST(LabTolerance, RefusalsNameThePlace) {
  EXPECT_EQ(refusal("5"), "--tolerance 5: character 2: expected a unit: um, mm, cm or m");
  EXPECT_EQ(refusal(""), "--tolerance : character 1: expected a number");
  EXPECT_EQ(refusal("5 mm"), "--tolerance 5 mm: character 2: expected a unit: um, mm, cm or m");
  EXPECT_EQ(refusal("-5mm"), "--tolerance -5mm: character 1: a tolerance is not negative");
  EXPECT_EQ(refusal("joint=1kg"), "--tolerance joint=1kg: character 8: expected a unit: um, mm, cm or m");
  EXPECT_NE(refusal("joint=1mm,speed=1").find("character 11: expected penetration, joint"), std::string::npos);
  EXPECT_NE(refusal("joint=1mm,").find("character 11"), std::string::npos);
  EXPECT_NE(refusal("joint=1mm,energy").find("character 17: expected ="), std::string::npos);
  EXPECT_NE(refusal("joint=,stands").find("character 7: expected a number"), std::string::npos);
  EXPECT_NE(refusal("energy=1mm").find("character 9: expected J/kg"), std::string::npos);
  EXPECT_NE(refusal("figure=1mm").find("character 9"), std::string::npos);
  EXPECT_NE(refusal("stands=1").find("character 7: stands has no value"), std::string::npos);
  EXPECT_NE(refusal("joint=1mm,joint=2mm").find("character 11: joint comes twice"), std::string::npos);
  EXPECT_NE(refusal("joint=1e999mm").find("character 7: expected a number"), std::string::npos);
  EXPECT_NE(refusal("joint=infmm").find("character 7: expected a number"), std::string::npos);
  EXPECT_NE(refusal("joint=nanmm").find("character 7: expected a number"), std::string::npos);
}

TEST(LabTolerance, WhatIsNotDoneOrFellOrHasNoNumbersHoldsNothing) {
  const Tolerance t = parse_tolerance("5mm");
  const LabResult good = result("float", "pgs", 1, 1, 0.001);
  EXPECT_LE(excess_of(good, t), 1);
  LabResult r = good;
  r.state = kLeftOut;
  EXPECT_TRUE(std::isinf(excess_of(r, t)));
  r = good;
  r.faults = 1;
  EXPECT_TRUE(std::isinf(excess_of(r, t)));
  r = good;
  r.penetration = std::nan("");
  EXPECT_TRUE(std::isinf(excess_of(r, t)));
  r = good;
  r.stood = false;
  EXPECT_TRUE(std::isinf(excess_of(r, t)));
  r = good;
  r.judged = true;
  EXPECT_TRUE(std::isinf(excess_of(r, t)));
  r.survived = true;
  EXPECT_LE(excess_of(r, t), 1);
  r = good;
  r.deviation = -1;
  EXPECT_TRUE(std::isinf(excess_of(r, parse_tolerance("deviation=1m"))));
}

// ---- the front

TEST(LabFront, HoldsWhatNothingElseBeatsInBoth) {
  const std::vector<LabResult> results = {
      result("float", "pgs", 8, 4, 0.001),        // the most exact
      result("float", "pgs", 4, 3, 0.004),        // beaten by the next
      result("float", "direct", 1, 2, 0.004),     // on it
      result("float", "soft_step", 1, 1, 0.020),  // the cheapest
      result("double", "pgs", 2, 2, 0.004),       // the same again
      result("float", "pgs", 1, 0.5, 0.001),      // would beat all, but fell
  };
  std::vector<LabResult> fallen = results;
  fallen[5].stood = false;
  const Tolerance t = parse_tolerance("5mm");
  EXPECT_EQ(front_of(fallen, t), (std::vector<std::size_t>{3, 2, 0}));
  EXPECT_EQ(front_of(results, t), (std::vector<std::size_t>{5}));
  EXPECT_TRUE(front_of({}, t).empty());
}

// ---- advice

class LabAdvice : public testing::Test {
 protected:
  std::vector<LabResult> results_ = {
      result("float", "soft_step", 8, 0.10, 0, 0.0030), result("float", "direct", 2, 0.05, 0, 0.0008),
      result("float", "direct", 1, 0.02, 0, 0.0020),    result("q32.32", "soft_step", 8, 0.18, 0, 0.0040),
      result("q32.32", "direct", 2, 0.11, 0, 0.0009),   result("q32.32", "pgs", 1, 0.04, 0, 0.0500),
  };
  LabPoint own_ = point("", "soft_step", 8);
};

TEST_F(LabAdvice, IsTheCheapestThatHoldsAndWhatItCostsAgainstTheDefault) {
  const Advice all = advise(results_, parse_tolerance("joint=1mm"), own_);
  EXPECT_TRUE(all.holds);
  EXPECT_EQ(all.best, 1u);
  const Advice advice = advise(results_, parse_tolerance("joint=1mm"), own_, "q32.32");
  EXPECT_EQ(advice.best, 4u);
  EXPECT_EQ(advice.own, 3u);
  EXPECT_EQ(
      advice.text,
      "q32.32, direct, 2 sub-steps at 60 Hz: 0.11 ms; the default (q32.32, soft_step, 8 sub-steps at 60 Hz) takes "
      "0.18 ms and misses joint = 1 mm by 3 mm");
}

TEST_F(LabAdvice, SaysWhenTheDefaultHoldsTooOrIsTheBest) {
  EXPECT_NE(advise(results_, parse_tolerance("joint=5mm"), own_, "float").text.find("takes 0.1 ms and holds it too"),
            std::string::npos);
  own_ = point("", "direct", 1);
  EXPECT_EQ(advise(results_, parse_tolerance("joint=5mm"), own_, "float").text,
            "float, direct, 1 sub-step at 60 Hz: 0.02 ms; that is the default");
}

TEST_F(LabAdvice, SaysWhatComesClosestWhenNothingHolds) {
  const Advice advice = advise(results_, parse_tolerance("joint=0.1mm"), own_, "q32.32");
  EXPECT_FALSE(advice.holds);
  EXPECT_EQ(advice.best, 4u);
  EXPECT_EQ(
      advice.text.find("no run holds joint=0.1mm. Closest is q32.32, direct, 2 sub-steps at 60 Hz: 0.11 ms, misses "
                       "joint = 0.1 mm by 0.8 mm; the default"),
      0u)
      << advice.text;
}

TEST_F(LabAdvice, SaysWhenNothingComesNear) {
  for (LabResult& r : results_) r.stood = false;
  const Advice advice = advise(results_, parse_tolerance("5mm"), own_);
  EXPECT_FALSE(advice.holds || advice.best);
  EXPECT_EQ(advice.text, "no run holds 5mm, and none comes near it");
}

TEST_F(LabAdvice, SaysWhatAModelIsOffBy) {
  results_[2].point.model = "particles";
  results_[2].deviation = 0.25;
  EXPECT_EQ(advise(results_, parse_tolerance("joint=5mm"), own_, "float")
                .text.find("float, direct, 1 sub-step at 60 Hz, as particles: 0.02 ms, 250 mm from the bodies after 1 "
                           "s; the default"),
            0u);
}

TEST_F(LabAdvice, CallsPassesPassesAndNamesTheModel) {
  LabPoint p = point("float", "pgs", 1);
  EXPECT_EQ(setting_text(p), "float, pgs, 1 pass at 60 Hz");
  p.substeps = 4;
  EXPECT_EQ(setting_text(p), "float, pgs, 4 passes at 60 Hz");
  p = point("float", "soft_step", 4);
  p.model = "particles";
  EXPECT_EQ(setting_text(p), "float, soft_step, 4 sub-steps at 60 Hz, as particles");
}

}  // namespace lab_advice_test
}  // namespace isostep::tool::lab
