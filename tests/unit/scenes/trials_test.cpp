// Judges read what they are shown: hand-made sights with known figures.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
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
namespace trials_test {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// A trial whose run is made up by hand.
class Staged {
 public:
  explicit Staged(const char* name) : trial_(find_trial(name)) {
    const Scene scene = *find_scene(name);
    judge_ = trial_->judge(scene);
    for (const SceneBody& body : scene.bodies) {
      BodySight seen;
      seen.centre = value(body.position);
      seen.dynamic = body.type == BodyType::dynamic;
      sight.bodies.push_back(seen);
    }
    show(0);
  }

  void show(double time) {
    sight.time = time;
    judge_->see(sight);
  }
  double figure() const { return judge_->figure(); }
  bool survived() const { return verdict_of(*trial_, *judge_, sight).survived; }
  BodySight& last() { return sight.bodies.back(); }

  Sight sight;

 private:
  const Trial* trial_;
  std::unique_ptr<Judge> judge_;
};

TEST(Drift, IsTheLargestWaySidewaysAtAnyTime) {
  Staged run("tall_stack");
  EXPECT_EQ(run.figure(), 0);
  EXPECT_TRUE(run.survived());
  run.sight.bodies[7].centre += {0.03, -0.02, 0.04};
  run.show(1);
  run.sight.bodies[7].centre -= {0.03, -0.02, 0.04};
  run.show(2);
  EXPECT_NEAR(run.figure(), 5, 1e-9);
  EXPECT_FALSE(run.survived());
}

TEST(Drift, DoesNotCountThatATowerSettles) {
  Staged run("tall_stack_50");
  for (std::size_t i = 1; i < run.sight.bodies.size(); ++i) run.sight.bodies[i].centre.y -= 0.02 * double(i);  // 1 m
  run.show(1);
  EXPECT_EQ(run.figure(), 0);
}

TEST(Drift, OfABoxThatFellIsAWholeBoxAndNoMore) {
  for (const Vec3<double> way : {Vec3<double>{0, -0.6, 0}, Vec3<double>{30, -19, 40}, Vec3<double>{3, 0, 0}}) {
    Staged run("tall_stack");
    run.last().centre += way;
    run.show(1);
    EXPECT_EQ(run.figure(), 100);
  }
}

TEST(TimeToSleep, EndsWithTheLastAwakeSight) {
  Staged run("sleeping_stack");
  for (const double time : {1.0, 2.0, 3.0, 4.0}) {
    run.last().awake = time == 1 || time == 3;
    run.show(time);
  }
  EXPECT_EQ(run.figure(), 3);
  EXPECT_TRUE(run.survived());
  run.last().awake = true;
  run.show(6);
  EXPECT_EQ(run.figure(), 6);
  EXPECT_FALSE(run.survived());
}

TEST(TimeToSleep, OfATowerThatFellIsTheWholeRun) {
  Staged run("sleeping_stack");
  run.last().centre = {3, 0.5, 0};
  run.show(1);
  EXPECT_EQ(run.figure(), 10);
}

TEST(Sinking, IsOfTheHeavyBoxAtTheEnd) {
  Staged run("heavy_on_light_400");
  run.last().centre.y -= 0.3;
  run.show(1);
  run.last().centre.y += 0.15;
  run.show(10);
  EXPECT_NEAR(run.figure(), 15, 1e-9);
  EXPECT_TRUE(run.survived());
}

TEST(Sinking, CountsAHeavyBoxThatWasThrownOff) {
  Staged run("heavy_on_light_100");
  run.last().centre += {4, -1, 0};
  run.show(10);
  EXPECT_NEAR(run.figure(), 100 * std::sqrt(17.0), 1e-9);
  EXPECT_FALSE(run.survived());
}

TEST(Displaced, CountsBodiesBeyondTheLimitAtTheirWorst) {
  Staged run("heavy_tips");
  run.sight.bodies[3].centre.x += 0.49;
  run.show(1);
  EXPECT_EQ(run.figure(), 0);
  run.sight.bodies[4].centre.x += 0.51;
  run.sight.bodies[5].centre.z = kNan;
  run.show(2);
  run.sight.bodies[4].centre.x -= 0.51;
  run.sight.bodies[5].centre.z = 0;
  run.show(3);
  EXPECT_EQ(run.figure(), 2);
  EXPECT_FALSE(run.survived());
}

TEST(CardHouse, LacksTheTimeAfterItsFall) {
  Staged run("card_house");
  run.last().centre.y -= 0.09;
  run.show(10);
  EXPECT_EQ(run.figure(), 0);
  run.last().centre.y -= 0.09;
  run.show(20);
  run.show(60);
  EXPECT_EQ(run.figure(), 40);
  EXPECT_FALSE(run.survived());
}

TEST(Arch, IsJudgedByItsKeystone) {
  Staged run("arch");
  const double height = run.sight.bodies[6].centre.y;
  for (const BodySight& body : run.sight.bodies) EXPECT_LE(body.centre.y, height);
  run.sight.bodies[6].centre.y -= 0.02 * height;
  run.sight.bodies[1].centre.x -= 1;
  run.show(1);
  EXPECT_NEAR(run.figure(), 2, 1e-9);
}

TEST(Towers, OfPlanksCountThoseThatMovedByMoreThanAPlank) {
  for (const char* name : {"jenga_tower", "keva_tower"}) {
    Staged run(name);
    run.last().centre.y -= 0.14;
    run.show(1);
    EXPECT_EQ(run.figure(), 0) << name;
    run.last().centre.y -= 0.02;
    run.show(2);
    EXPECT_EQ(run.figure(), 1) << name;
  }
}

TEST(Chains, AreJudgedByTheWorstJointInLinks) {
  Staged run("chain_16_ball_1000");
  run.sight.joint_error = 0.02;
  run.show(1);
  run.sight.joint_error = 0.001;
  run.show(2);
  EXPECT_NEAR(run.figure(), 4, 1e-9);
  EXPECT_TRUE(run.survived());
}

TEST(TopSpeed, IsThatOfAnyBodyAtAnyTime) {
  Staged run("stretched_chain");
  run.sight.bodies[3].velocity = {60, 0, -80};
  run.show(1);
  run.sight.bodies[3].velocity = {0, 0, 0};
  run.show(2);
  EXPECT_EQ(run.figure(), 100);
}

/// 16 links of 1 kg whose middles are 0.25, 0.75 ... 7.75 m from the fixed point: 10 * 64 J in all.
TEST(EnergyRise, IsAboveTheStartOrThePeaksOfTenSecondsBefore) {
  Staged run("limited_chain");
  const struct {
    double time, energy, rise;
  } sights[] = {{1, -50, 0},                   // the start's 0 J is the first window's peak
                {2, -10, 0},                   // within a window it may come back
                {12, -20, 0},  {13, -30, 0},   // peak -20
                {22, -25, 0},  {23, -16, 4},   // 4 above the second's; peak -16
                {32, -100, 4}, {41, -68, 32},  // still against the lowest peak
                {52, -36, 64}, {61, 5, 105}};
  for (const auto& now : sights) {
    run.sight.energy.kinetic = now.energy;
    run.show(now.time);
    EXPECT_NEAR(run.figure(), 100 * now.rise / 640, 1e-9) << now.time;
  }
}

TEST(EnergyRise, OfAStretchedChainBeginsAfterItsFirstSecond) {
  Staged run("stretched_chain_energy");
  run.sight.energy.kinetic = 1e6;
  run.show(0.9);
  run.sight.energy.kinetic = 500;
  run.show(1);
  EXPECT_EQ(run.figure(), 0);
}

class Dominoes : public testing::Test {
 protected:
  /// Falls by 2 rad/s when the front is there.
  static Quat<double> lean(double since) {
    const double angle = std::fmin(std::fmax(2 * since, 0.0), 1.5);
    return {0, 0, -std::sin(angle / 2), std::cos(angle / 2)};
  }
  /// `when(i)` [s] the i-th domino begins to lean.
  template <class When> void play(When when, double seconds) {
    for (int frame = 1; frame <= 60 * seconds; ++frame) {
      for (std::size_t i = 1; i < run.sight.bodies.size(); ++i) {
        run.sight.bodies[i].orientation = lean(frame / 60.0 - when(static_cast<double>(i - 1)));
      }
      run.show(frame / 60.0);
    }
  }
  Staged run{"dominoes"};
};

TEST_F(Dominoes, OfASteadyFrontHaveNoSpread) {
  play([](double i) { return 0.05 * i; }, 12);
  EXPECT_LT(run.figure(), 0.1);
  EXPECT_TRUE(run.survived());
}

/// Tens of the second half take 0.5 s and 0.6 s in turn: mean 0.55 and, five of each less the last, which has no end.
TEST_F(Dominoes, OfAnUnsteadyFrontShowItsStandardDeviation) {
  play([](double i) { return 0.055 * i + (std::fmod(std::floor(i / 10), 2) == 1 ? -0.05 : 0.0); }, 13);
  const double mean = (5 * 0.5 + 4 * 0.6) / 9;
  const double deviation = std::sqrt((5 * std::pow(0.5 - mean, 2) + 4 * std::pow(0.6 - mean, 2)) / 9);
  EXPECT_NEAR(run.figure(), 100 * deviation / mean, 0.2);
  EXPECT_FALSE(run.survived());
}

TEST_F(Dominoes, FailWhereTheLastOneStands) {
  play([](double i) { return i == 199 ? 100 : 0.05 * i; }, 12);
  EXPECT_EQ(run.figure(), 100);
}

/// The elbow of the first ragdoll, which leans by less than 0.1 rad, bends by -2.4 to 0 rad about y.
TEST(Ragdolls, AreJudgedByTheBarThatTheyAreNearestTo) {
  constexpr std::size_t kForearm = 5 + 5;
  Staged run("ragdolls_with_limits");
  EXPECT_LT(run.figure(), 1e-9);
  const auto bend = [&](double angle) {
    run.sight.bodies[kForearm].orientation = {0, std::sin(angle / 2), 0, std::cos(angle / 2)};
  };
  bend(-1);
  run.show(1);
  EXPECT_LT(run.figure(), 1e-9);
  bend(0.03);
  run.show(2);
  EXPECT_NEAR(run.figure(), 150, 1);  // of 0.02 rad at the end
  bend(0);
  run.show(3);
  EXPECT_NEAR(run.figure(), 20, 0.2);  // of 0.15 rad over the run
  run.sight.joint_error = 0.004;
  run.show(4);
  EXPECT_NEAR(run.figure(), 80, 1e-6);
  EXPECT_TRUE(run.survived());
  run.sight.joint_error = 0;
  run.sight.energy.kinetic = 0.64;  // of 50 times 6.4 kg
  run.show(5);
  EXPECT_NEAR(run.figure(), 200, 1);
  EXPECT_FALSE(run.survived());
}

/// 6.4 kg: a torso of 2 kg at 4 m/s has 16 J.
TEST(Ragdolls, GainWhatOneOfThemGains) {
  Staged run("ragdoll_from_every_tilt");
  EXPECT_EQ(run.figure(), 0);
  run.sight.bodies[1 + 1].velocity = {0, 4, 0};
  run.sight.bodies[1 + kRagdollParts].centre.y -= 3;  // another one's
  run.show(1);
  EXPECT_NEAR(run.figure(), 16 / 6.4, 1e-9);
  EXPECT_FALSE(run.survived());
}

/// As many thin discs.
TEST(SceneNumbers, ACapsulesInertiaIsThatOfItsDiscs) {
  constexpr double kRadius = 0.25, kHalf = 0.5;
  constexpr int kDiscs = 20000;
  double volume = 0, along = 0, across = 0;
  for (int i = 0; i < kDiscs; ++i) {
    const double y = ((i + 0.5) / kDiscs * 2 - 1) * (kHalf + kRadius), in = std::fmax(std::fabs(y) - kHalf, 0);
    const double square = kRadius * kRadius - in * in;
    volume += square;
    along += square * square / 2;
    across += square * (square / 4 + y * y);
  }
  SceneBody body = body_of(capsule_part(kRadius, kHalf), {0, 0, 0});
  body.mass = 2;
  const Mat3<double> inertia = inertia_of(body);
  EXPECT_NEAR(inertia.rows[1].y, 2 * along / volume, 1e-6);
  EXPECT_NEAR(inertia.rows[0].x, 2 * across / volume, 1e-6);
  EXPECT_NEAR(inertia.rows[2].z, 2 * across / volume, 1e-6);
}

TEST(Verdicts, FailOfFaultsAndOfNumbersThatAreNone) {
  Staged mended("tall_stack");
  mended.sight.faults = 1;
  mended.show(1);
  EXPECT_FALSE(mended.survived());
  for (const Trial& trial : trials()) {
    Staged broken(trial.name);
    for (BodySight& body : broken.sight.bodies) body.centre = body.velocity = {kNan, kNan, kNan};
    broken.sight.joint_error = broken.sight.energy.kinetic = kNan;
    broken.show(1);
    EXPECT_FALSE(broken.survived()) << trial.name;
  }
}

}  // namespace trials_test
}  // namespace isostep::scenes
