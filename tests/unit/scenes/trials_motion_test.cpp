// Judges of motion, friction, springs, loops, bounces and numbers, fed with sights whose right answer is known.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "isostep/world/world.hpp"
#include "scenes/build.hpp"
#include "scenes/shapes.hpp"
#include "scenes/trials/families.hpp"

namespace isostep::scenes {
namespace trials_motion_test {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kTight = 1e-9;

/// A trial's judge and the sight that it sees first, to be changed and shown again.
struct Bench {
  const Trial& trial;
  Scene scene;
  std::unique_ptr<Judge> judge;
  Sight sight;

  explicit Bench(const char* name) : Bench(*find_trial(name)) {}
  explicit Bench(const Trial& t) : trial(t), scene(t.make()), judge(t.judge(scene)) {
    World<double> world(settings_of<double>(scene));
    build(scene, world);
    sight = sight_of(world, 0);
  }
  double show(double time) {
    sight.time = time;
    judge->see(sight);
    return judge->figure();
  }
  double end() const { return static_cast<double>(scene.frames) / scene.hz; }
  BodySight& body(std::size_t i) { return sight.bodies[i]; }
};

std::vector<Trial> all_of_these() {
  std::vector<Trial> list;
  for (const auto& family : {motion_trials(), friction_trials(), contact_law_trials(), recovery_trials(),
                             spring_trials(), loop_trials(), bounce_trials(), fixed_point_trials()}) {
    list.insert(list.end(), family.begin(), family.end());
  }
  return list;
}

TEST(MotionTrials, AreFailedByWhateverExplodes) {
  for (const Trial& trial : all_of_these()) {
    Bench bench(trial);
    bench.show(0);
    for (double time = 1; time <= bench.end(); time += 1) {
      for (BodySight& body : bench.sight.bodies) {
        if (!body.dynamic) continue;
        body.centre += {3e3, -5e3, 4e3};
        body.velocity += {2e4, -7e4, 1e4};
        body.angular_velocity += {900, 700, -800};
        body.awake = true;
      }
      bench.sight.joint_error += 10;
      bench.sight.energy.kinetic += 1e9;
      bench.show(time);
    }
    bench.show(bench.end());
    const Verdict verdict = verdict_of(trial, *bench.judge, bench.sight);
    EXPECT_FALSE(verdict.survived) << trial.name;
    EXPECT_GT(verdict.figure, trial.bar) << trial.name;
  }
}

TEST(MotionTrials, AreFailedByNumbersThatAreNone) {
  for (const Trial& trial : all_of_these()) {
    Bench bench(trial);
    bench.show(0);
    const Sight start = bench.sight;
    for (BodySight& body : bench.sight.bodies) {
      body.centre = body.velocity = body.angular_velocity = {kNan, kNan, kNan};
      body.orientation = {kNan, kNan, kNan, kNan};
    }
    bench.sight.joint_error = kNan;
    bench.sight.energy.kinetic = kNan;
    bench.show(bench.end());
    EXPECT_FALSE(verdict_of(trial, *bench.judge, bench.sight).survived) << trial.name;
  }
}

/// By hand: 40 kg of 1 x 0.2 x 0.2 m at the top, 16 kg of 0.2 x 0.4 x 0.2 m 0.3 m below; centre 4.8/56 m down.
TEST(MotionTrials, FreeTurningIsJudgedByAngularMomentum) {
  const double centre = 4.8 / 56, below = 0.3 - centre;
  const double ix = 40 / 12.0 * 0.08 + 40 * centre * centre + 16 / 12.0 * (0.16 + 0.04) + 16 * below * below;
  const double iy = 40 / 12.0 * 1.04 + 16 / 12.0 * 0.08;
  Bench bench("t_handle");
  bench.body(0).angular_velocity = {0, 10, 0};
  EXPECT_EQ(bench.show(0), 0.0);
  bench.body(0).orientation = {0, std::sin(1.2), 0, std::cos(1.2)};  // about its axis of rotation
  EXPECT_NEAR(bench.show(1), 0, kTight);
  bench.body(0).angular_velocity = {0, 9.9, 0};
  EXPECT_NEAR(bench.show(2), 1, kTight);
  bench.body(0).angular_velocity = {0, 10.1, 0};
  EXPECT_NEAR(bench.show(3), 2.01, kTight);
  bench.body(0).orientation = {0, 0, 0, 1};
  bench.body(0).angular_velocity = {10 * iy / ix, 0, 0};  // as much, another way, and more energy
  EXPECT_NEAR(bench.show(4), 100 * std::max(std::sqrt(2.0), iy / ix - 1), 1e-6);
}

TEST(MotionTrials, RodsAreJudgedByTheirLowestPoint) {
  Bench bench("whirling_rods");
  bench.sight.energy = {100, 0, 1};
  EXPECT_EQ(bench.show(0), 0.0);
  bench.body(2).centre.y = 0.98;  // upright: its end reaches 1.00 down
  EXPECT_NEAR(bench.show(1), 1, kTight);
  bench.body(2).orientation = {0, 0, std::sin(kTurn / 12), std::cos(kTurn / 12)};  // 60 degrees from upright
  bench.body(2).centre.y = 0.45;                                                   // 0.49 + 0.02 - 0.45
  EXPECT_NEAR(bench.show(2), 3, kTight);
  bench.sight.energy.kinetic = 104;
  EXPECT_NEAR(bench.show(3), 4, kTight);
}

TEST(MotionTrials, CreepCountsAfterTheFirstSecond) {
  Bench bench("resting_slope");
  bench.show(0);
  bench.body(1).centre.x += 0.5;
  EXPECT_EQ(bench.show(1), 0.0);
  bench.body(1).centre.x += 0.003;
  bench.body(3).centre.y += 0.002;
  EXPECT_NEAR(bench.show(2), 3, 1e-9);
}

/// tan = 0.55: sin - cos / 2 = 0.05 / sqrt(1 + 0.3025).
TEST(MotionTrials, SlidingIsJudgedByAcceleration) {
  const double cosine = 1 / std::sqrt(1.3025), acceleration = 10 * 0.05 * cosine;
  Bench bench("sliding_slope");
  bench.show(1);
  const auto run = [&](double share) {
    for (std::size_t i = 1; i < 4; ++i) {
      bench.body(i).velocity = {2 * share * acceleration * cosine, -2 * share * acceleration * 0.55 * cosine, 0};
    }
    return bench.show(3);
  };
  EXPECT_NEAR(run(1), 0, kTight);
  EXPECT_NEAR(run(1.03), 3, kTight);
  bench.body(3).velocity = {0, 0, 0};
  EXPECT_NEAR(bench.show(3), 100, kTight);
}

struct Journey {
  const char* name;
  double way, speed, off;  // [m], [m/s], [m/s] that are a tenth
};
/// A belt of 2 m/s and friction 0.5 slips for 0.4 s, over 0.4 m of the belt's 0.8. A ball of 5 m/s and friction 0.2
/// slides for 5/7 s at 30/7 m/s in the mean. A lever of 0.05 m slows a ball of 0.5 m by 5/7 m/s^2.
TEST(MotionTrials, TravelIsJudgedByWayAndSpeed) {
  for (const Journey& journey : {Journey{"conveyor", 0.4 + 2 * 4.6, 2, 0.2},
                                 Journey{"billiard", 150 / 49.0 + 25 / 7.0 * (3 - 5 / 7.0), 25 / 7.0, 2.5 / 7},
                                 Journey{"rolling_stop", 2.8, 0, 0.2}}) {
    Bench bench(journey.name);
    bench.show(0);
    bench.body(1).centre.x += journey.way;
    bench.body(1).velocity = {journey.speed, 0, 0};
    EXPECT_NEAR(bench.show(bench.end()), 0, kTight) << journey.name;
    bench.body(1).velocity.z = journey.off;
    EXPECT_NEAR(bench.show(bench.end()), 10, kTight) << journey.name;
    bench.body(1).centre.x -= 0.3 * journey.way;
    EXPECT_NEAR(bench.show(bench.end()), 30, kTight) << journey.name;
  }
}

TEST(MotionTrials, PairsMustComeApartSlowly) {
  for (const char* name : {"overlapped_pairs", "coincident_pairs"}) {
    Bench bench(name);
    EXPECT_GT(bench.show(0), 1) << name;
    for (std::size_t i = 1; i < bench.sight.bodies.size(); i += 2) bench.body(i).centre.x += 2;
    EXPECT_EQ(bench.show(1), 0.0) << name;
    bench.body(3).velocity = {0, 1.2, 0};
    EXPECT_NEAR(bench.show(2), 0.4, kTight) << name;
  }
  Bench bench("overlapped_pairs");  // unit boxes first: 0.9 apart, a tenth is missing
  for (std::size_t i = 1; i < bench.sight.bodies.size(); i += 2) bench.body(i).centre.x += 2;
  bench.body(1).centre = bench.body(0).centre + Vec3<double>{0.9, 0, 0};
  EXPECT_NEAR(bench.show(1), 2, kTight);
}

TEST(MotionTrials, FallingIsNoExit) {
  for (const char* name : {"overlapped_wall", "overlapped_pile"}) {
    Bench bench(name);
    bench.show(0);
    bench.body(1).centre.y = 2.25;
    bench.show(1);
    bench.body(1).centre.y = 1;
    bench.body(1).velocity = {0, -5, 0};
    EXPECT_NEAR(bench.show(2), 0, 1e-6) << name;
    bench.body(1).velocity = {4, -5, 0};
    EXPECT_NEAR(bench.show(3), 4, kTight) << name;
    bench.body(1).centre.y = -100;  // no floor stops it
    bench.body(1).velocity = {0, -45, 0};
    EXPECT_NEAR(bench.show(4), std::sqrt(45.0 * 45 - 45), kTight) << name;
  }
}

TEST(MotionTrials, SmallThingsMustStayAndSleep) {
  Bench wall("tiny_wall");
  wall.show(0);
  wall.body(7).centre.z += 0.01;
  EXPECT_NEAR(wall.show(1), 20, kTight);
  Bench dice("tiny_dice");
  dice.show(0);
  EXPECT_EQ(dice.show(1.5), 1.5);
  for (BodySight& body : dice.sight.bodies) body.awake = false;
  EXPECT_EQ(dice.show(9), 1.5);
  dice.body(8).centre.x = 0.07;
  EXPECT_EQ(dice.show(9), 10.0);
}

/// The first row's ball trades 5 cm of a spring of 100 Hz for speed; then every spring is stretched twice as far.
TEST(MotionTrials, SpringsAreJudgedByTheirWholeEnergy) {
  Bench bench("stiff_springs");
  bench.show(0);
  bench.body(0).centre.x = 1;
  bench.body(0).velocity = {0, 0.05 * kTurn * 100, 0};
  EXPECT_NEAR(bench.show(1), 0, kTight);
  bench.body(0).velocity = {0, 0, 0};
  for (BodySight& body : bench.sight.bodies) body.centre.x = std::round(body.centre.x) * 1.1;
  EXPECT_NEAR(bench.show(2), 300, kTight);
  Bench dampers("strong_dampers");
  dampers.show(0);
  for (BodySight& body : dampers.sight.bodies) body.velocity = {4, 0, 0};
  EXPECT_EQ(dampers.show(1), 0.0);
}

TEST(MotionTrials, LoopsMustHaveClosedInTheLastSecond) {
  for (const char* name : {"four_bar", "braced_frame", "ring"}) {
    Bench bench(name);
    bench.sight.joint_error = 0.5;
    EXPECT_EQ(bench.show(3.9), 0.0) << name;
    bench.sight.joint_error = 0.004;
    EXPECT_NEAR(bench.show(4.5), 4, kTight) << name;
    bench.sight.joint_error = 0.001;
    EXPECT_NEAR(bench.show(5), 4, kTight) << name;
  }
}

/// Half of m v^2 against m g h, and energy that passes from ball to ball.
TEST(MotionTrials, BouncesMustKeepEnergy) {
  Bench bench("bouncing_balls");
  bench.show(0);
  bench.body(1).centre.y = 0.5;
  bench.body(1).velocity = {0, std::sqrt(20.0), 0};
  EXPECT_NEAR(bench.show(1), 0, kTight);
  bench.body(1).velocity = {0, std::sqrt(18.0), 0};
  EXPECT_NEAR(bench.show(2), 10, kTight);
  Bench rallies("rallies");
  rallies.show(0);
  rallies.body(4).velocity = {-50, 0, 0};
  EXPECT_NEAR(rallies.show(1), 0, kTight);
  rallies.body(4).velocity = {-45, 0, 0};
  EXPECT_NEAR(rallies.show(2), 19, kTight);
  Bench cradle("newtons_cradle");
  cradle.show(0);
  cradle.body(0).centre = {-1, 1.75, 0};
  cradle.body(4).velocity = {std::sqrt(2 * 10 * 0.625), 0, 0};
  EXPECT_NEAR(cradle.show(1), 0, kTight);
  for (int i = 0; i < 5; ++i) cradle.body(i).velocity = cradle.body(4).velocity * (i < 4 ? 0.2 : 1.0);  // shared
  cradle.body(4).velocity = cradle.body(0).velocity;
  EXPECT_NEAR(cradle.show(2), 80, kTight);
}

/// What the judge expects keeps momentum, angular momentum and energy: the three equations of the hit.
TEST(MotionTrials, TheLeverIsJudgedByWhatAHitWithoutLossDoes) {
  const double m = 10, v = 8000, arm = 45, mass = 100, inertia = 100 * (50 * 50 + 0.25) / 3;
  const double beam = 2 * m * v / (m + mass + m * mass * arm * arm / inertia);  // from the three, by elimination
  const double after = v - mass / m * beam, angular_velocity = mass * beam * arm / inertia;
  ASSERT_NEAR(m * v * v / (m * after * after + mass * beam * beam + inertia * angular_velocity * angular_velocity), 1,
              1e-12);
  Bench bench("long_lever");
  EXPECT_GT(bench.show(0), 50);
  bench.body(0).velocity = {0, beam, 0};
  bench.body(0).angular_velocity = {0, 0, angular_velocity};
  bench.body(1).velocity = {0, after, 0};
  EXPECT_NEAR(bench.show(1), 0, kTight);
  bench.body(0).angular_velocity.z *= 1.05;
  EXPECT_NEAR(bench.show(1), 5, kTight);
}

TEST(MotionTrials, AnHourOfSpinIsJudgedInMillionths) {
  Bench bench("spin_hour");
  const auto turn = [&](double angle, double norm) {
    bench.body(0).orientation = {0, norm * std::sin(angle / 2), 0, norm * std::cos(angle / 2)};
  };
  bench.show(0);
  for (int i = 1; i <= 60; ++i) {
    turn(5 * i / 6.0, 1);
    EXPECT_NEAR(bench.show(i / 6.0), 0, 1e-6);
  }
  EXPECT_NEAR(bench.show(10.01), 999.000999, 1e-6);  // 0.01 s late
  turn(50, 1.002);
  EXPECT_NEAR(bench.show(10), 2000, 1e-6);
}

TEST(MotionTrials, DriftIsJudgedAgainstTheFirstVelocity) {
  Bench bench("slow_drift");
  bench.show(0);
  bench.body(3).centre += {0.1, -0.1, 0.1};
  EXPECT_NEAR(bench.show(100), 0, 1e-6);
  bench.body(0).centre.z += 0.002;
  EXPECT_NEAR(bench.show(100), 2, 1e-6);
  Bench soak("soak");
  soak.show(100);
  soak.body(9).centre.y += 1;
  soak.show(120);
  soak.body(9).centre.y += 0.005;
  EXPECT_NEAR(soak.show(180), 5, kTight);
  Bench sizes("sizes_apart");
  sizes.show(0);
  sizes.body(3).centre.y -= 0.002;
  EXPECT_NEAR(sizes.show(1), 2, kTight);
}

}  // namespace trials_motion_test
}  // namespace isostep::scenes
