// Bars of the benchmark scenes, and their own figures by sights made by hand.
// SPDX-License-Identifier: MIT
#include "scenes/bars.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>

#include "scenes/named.hpp"

namespace isostep::scenes {
namespace bars_test {

Reach reach(const char* scene, bool small, const std::map<Measure, double>& values) {
  return reach_of(bars_of(scene, small), [&](Measure measure) -> std::optional<double> {
    const auto found = values.find(measure);
    return found == values.end() ? std::nullopt : std::optional<double>(found->second);
  });
}
BodySight body_at(double x, double y, double z) {
  BodySight body;
  body.centre = {x, y, z};
  body.dynamic = true;
  return body;
}
double figure_of(const char* scene, const Sight& start, const Sight& end) {
  const std::unique_ptr<Judge> judge = benchmark_judge(*find_scene(scene));
  judge->see(start);
  judge->see(end);
  return judge->figure();
}

TEST(Bars, EveryBarOfASceneIsToBeHeld) {
  EXPECT_EQ(reach("S1", false, {{Measure::top, -0.019}, {Measure::drift, 0.004}}), Reach::aim);
  EXPECT_EQ(reach("S1", false, {{Measure::top, -0.021}, {Measure::drift, 0.004}}), Reach::must);
  EXPECT_EQ(reach("S1", false, {{Measure::top, -0.019}, {Measure::drift, 0.011}}), Reach::misses);
  EXPECT_EQ(
      reach("S4", false, {{Measure::penetration, 0.01}, {Measure::penetration_mean, 0.001}, {Measure::unrest, 1}}),
      Reach::must);
}

TEST(Bars, TheMixersOverlapIsBelow30MillimetresASecondAfterTheLastBirth) {
  EXPECT_EQ(reach("S9", false, {{Measure::penetration, 0.014}}), Reach::aim);
  EXPECT_EQ(reach("S9", false, {{Measure::penetration, 0.029}}), Reach::must);
  EXPECT_EQ(reach("S9", false, {{Measure::penetration, 0.031}}), Reach::misses);
}

TEST(Bars, WhatIsNoNumberMissesAndWhatNobodyMeasuredHoldsNothingUp) {
  EXPECT_EQ(reach("S1", false, {{Measure::top, std::numeric_limits<double>::quiet_NaN()}}), Reach::misses);
  EXPECT_EQ(reach("S1", false, {{Measure::top, 0.001}}), Reach::aim);
}

TEST(Bars, SmallScalarsHaveBarsOfTheirOwn) {
  EXPECT_EQ(reach("S1", true, {}), Reach::no_bar);
  EXPECT_EQ(reach("S1x10", false, {{Measure::top, 0.04}}), Reach::misses);
  EXPECT_EQ(reach("S1x10", true, {{Measure::top, 0.04}}), Reach::must);
  EXPECT_EQ(reach("S9", true, {}), Reach::no_bar);
  EXPECT_EQ(reach("S99", false, {}), Reach::no_bar);
}

TEST(Bars, AStacksFigureIsHowFarItsTopSank) {
  Sight start, end;
  start.bodies = {body_at(0, 0.5, 0), body_at(0, 1.5, 0)};
  end.bodies = {body_at(1, 0.4, 0), body_at(0, 1.25, 0)};
  EXPECT_DOUBLE_EQ(figure_of("S1", start, end), 0.25);
}

TEST(Bars, AWallsFigureIsTheFurthestWayOfABrick) {
  Sight start, end;
  start.bodies = {body_at(0, 0.5, 0), body_at(0, 1.5, 0)};
  end.bodies = {body_at(0.3, 0.5, 0.4), body_at(0, 1.5, 0.1)};
  EXPECT_DOUBLE_EQ(figure_of("S2", start, end), 0.5);
}

TEST(Bars, AChainsFigureIsHowMuchLongerItIs) {
  Sight start, end;  // it hangs from (0, 30, 0)
  start.bodies = {body_at(25, 30, 0)};
  end.bodies = {body_at(0, 4, 0)};
  EXPECT_DOUBLE_EQ(figure_of("S6", start, end), 1);
}

TEST(Bars, APilesFigureIsHowManyBodiesLeftThePit) {
  Sight start, end;
  start.bodies = end.bodies = {body_at(0, 1, 0), body_at(5.1, 1, 0), body_at(0, -0.1, 0)};
  end.bodies[2].dynamic = false;
  EXPECT_EQ(figure_of("S4", start, end), 1);
  EXPECT_EQ(count_outside("S9", {body_at(0, 6, 0), body_at(0, 1, 0), body_at(0, 6, 4.1)}), 2);
}

TEST(Bars, TheFigureOfLimitedRagdollsIsHowFarAJointWasPastItsLimit) {
  Sight start, end;
  start.bodies.resize(find_scene("S20")->bodies.size());
  end = start;
  end.bodies[5 + 5].orientation = {0, std::sin(0.1), 0, std::cos(0.1)};  // an elbow bends back
  EXPECT_NEAR(figure_of("S20", start, end), 0.2, 0.002);                 // it leans a little
}

TEST(Bars, NoOtherSceneHasAJudgeOfTheSet) { EXPECT_EQ(benchmark_judge(*find_scene("mixed")), nullptr); }

}  // namespace bars_test
}  // namespace isostep::scenes
