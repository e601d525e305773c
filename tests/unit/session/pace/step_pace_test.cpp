// StepPace: a machine that cannot step faster is known by its turns; one whose loop alone is slow is not one.
// SPDX-License-Identifier: MIT
#include "isostep/session/pace/step_pace.hpp"

#include <gtest/gtest.h>

namespace isostep {
namespace step_pace_test {

constexpr Time kPeriod = 16666;  // [us]

/// A loop whose turns take `loop`, and `step` more for every frame; how a session calls it.
struct Loop {
  explicit Loop(Time its_loop, Time its_step) : loop(its_loop), step(its_step) {}

  Time loop, step;  // [us]
  StepPace pace{kPeriod};
  Time now = 1000, due = 1000;
  Time longest = 0;  // [us] turn

  void turn() {
    pace.begin(now, now >= due, false);
    int steps = 0;
    while (steps < pace.most_steps(2) && (now >= due || (steps == 1 && pace.probes()))) {
      ++steps;
      due += kPeriod * static_cast<Time>(256 + pace.stretch()) / 256;
    }
    pace.end(steps);
    const Time took = loop + static_cast<Time>(steps) * step;
    if (took > longest) longest = took;
    now += took;
  }
  /// The time until it calls itself slow, or `limit`.
  Time until_slow(Time limit) {
    const Time began = now;
    while (pace.stretch() == 0 && now - began < limit) turn();
    return now - began;
  }
  void pass(Time time) {
    for (const Time end = now + time; now < end;) turn();
  }
};

TEST(StepPace, AMachineThatKeepsUpIsNotSlow) {
  for (const Time step : {0, 1000, 8000, 15000}) {
    Loop machine(1000, step);
    EXPECT_GE(machine.until_slow(60 * kSecond), 60 * kSecond) << step;
  }
}

TEST(StepPace, OneThatDoesNotIsKnownInHalfASecondByHowSlowItIs) {
  for (const int rate : {59, 55, 45, 35}) {
    Loop machine(1, kSecond / static_cast<Time>(rate));
    EXPECT_LE(machine.until_slow(2 * kSecond), kSecond / 2) << rate;
    EXPECT_NEAR(machine.pace.stretch(), 256.0 * 60 / rate - 256, 2) << rate;
  }
}

TEST(StepPace, WhereTurnsThatDoNothingAreAsLongTwoStepsInOneAreTriedFirst) {
  // A display of 59 Hz: every turn takes as long, and steps cost nothing.
  Loop display(kSecond / 59, 0);
  EXPECT_GE(display.until_slow(60 * kSecond), 60 * kSecond);
  // The same with steps that cost as long as a turn: no turn was ever short.
  Loop slow(0, kSecond / 59);
  EXPECT_LE(slow.until_slow(2 * kSecond), kSecond);
  EXPECT_LE(slow.longest, 2 * kSecond / 59 + 1);
}

TEST(StepPace, ALoopOfThirtyTurnsASecondTakesTwoStepsInEach) {
  Loop loop(33000, 0);
  EXPECT_GE(loop.until_slow(60 * kSecond), 60 * kSecond);
  EXPECT_EQ(loop.pace.most_steps(2), 2);
}

TEST(StepPace, WhoIsSlowTakesOneStepATurn) {
  Loop machine(1, kSecond / 45);
  machine.until_slow(2 * kSecond);
  machine.longest = 0;
  machine.pass(20 * kSecond);
  EXPECT_GT(machine.pace.stretch(), 0);
  EXPECT_LE(machine.longest, kSecond / 45 + 1);
}

TEST(StepPace, StaysNearWhatTheMachineCanDo) {
  Loop machine(1, kSecond / 45);
  machine.until_slow(2 * kSecond);
  const int first = machine.pace.stretch();
  for (int n = 0; n < 60; ++n) {
    machine.pass(kSecond);
    EXPECT_NEAR(machine.pace.stretch(), first, 3);
  }
}

TEST(StepPace, AMachineThatRecoversIsAtFullSpeedAgainInTenSeconds) {
  Loop machine(1, kSecond / 45);
  machine.until_slow(2 * kSecond);
  machine.step = 2000;
  machine.pass(kSecond);
  EXPECT_EQ(machine.pace.stretch(), 0) << "where turns are short that is seen at once";
  Loop display(0, kSecond / 45);
  display.until_slow(2 * kSecond);
  display.loop = kPeriod;
  display.step = 0;
  display.pass(10 * kSecond);
  EXPECT_EQ(display.pace.stretch(), 0);
}

TEST(StepPace, APauseOrAWaitForOthersIsNotSlowness) {
  StepPace pace(kPeriod);
  Time now = 1000;
  for (int n = 0; n < 1000; ++n) {
    pace.begin(now, true, n % 10 == 0);
    pace.end(1);
    now += 20000;
  }
  EXPECT_EQ(pace.stretch(), 0);
}

}  // namespace step_pace_test
}  // namespace isostep
