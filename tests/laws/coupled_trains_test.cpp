// Laws of couplings beside motors, brakes and contacts: generated trains of gears, racks and pulleys against closed
// forms, with every solver.
// SPDX-License-Identifier: MIT

#include <cmath>
#include <string>
#include <vector>

#include "built.hpp"
#include "laws/awake.hpp"
#include "random/dice.hpp"

namespace isostep::test {
namespace coupled_trains_test {

constexpr double kTurn = 2 * kPi;
constexpr int kTrains = 6;

/// Wheels in a row, each geared to the next; the last is the heaviest, others are up to a hundred times lighter.
struct Train {
  std::vector<int> teeth;
  std::vector<double> masses;  // [kg] of cubes of a metre: an inertia of a sixth of that

  static Train draw(std::uint64_t seed) {
    Dice dice(seed * 31 + 46);
    Train train;
    const int count = 2 + static_cast<int>(dice.below(3));
    const double heaviest = dice.magnitude(10, 100);
    for (int i = 0; i < count; ++i) {
      train.teeth.push_back(20 + static_cast<int>(dice.below(40)));
      train.masses.push_back(heaviest / dice.magnitude(1, 100));
    }
    train.masses.back() = heaviest;
    return train;
  }
  std::size_t size() const { return teeth.size(); }
  double inertia(std::size_t i) const { return masses[i] / 6; }
  /// [1] Turns of a wheel by one of the first.
  double ratio(std::size_t i) const { return (i % 2 == 0 ? 1.0 : -1.0) * teeth[0] / teeth[i]; }
  /// [kg m^2] Of all of them, as the first feels it.
  double felt() const {
    double sum = 0;
    for (std::size_t i = 0; i < size(); ++i) sum += inertia(i) * ratio(i) * ratio(i);
    return sum;
  }
};

template <class S> class CoupledTrains : public ::testing::Test {
 protected:
  struct Built {
    World<S> w;
    std::vector<BodyId> bodies;
    std::vector<JointId> joints;
    std::vector<CouplingId> couplings;
  };
  static JointProperties<S> motor(double speed, double torque) {
    JointProperties<S> p;
    p.flags = joint_flag::kMotor;
    p.motor_speed = num<S>(speed);
    p.max_force = num<S>(torque);
    return p;
  }
  static JointId wheel(Built& b, double x, double mass, const JointProperties<S>& settings) {
    BodyDefinition<S> d = moving<S>(add_box(b.w, 0.5, 0.5, 0.5), {x, 0, 0});
    d.mass = num<S>(mass);
    d.filter = {0, 0, 0};
    b.bodies.push_back(b.w.create(d));
    EXPECT_TRUE(b.bodies.back()) << describe(b.w.fault());
    JointProperties<S> joint =
        b.w.joint_at(JointType::hinge, {}, b.bodies.back(), {vec<S>(x, 0, 0), Quat<Unit<S>>::identity()});
    joint.take_settings(settings);
    b.joints.push_back(b.w.create(joint));
    EXPECT_TRUE(b.joints.back()) << describe(b.w.fault());
    return b.joints.back();
  }
  /// A motor at the first wheel, and at the last one what `end` says.
  static Built build(const Train& train, SolverName solver, double torque, const JointProperties<S>& end) {
    Built b{World<S>(awake<S>(solver)), {}, {}, {}};
    const std::size_t last = train.size() - 1;
    for (std::size_t i = 0; i <= last; ++i)
      wheel(b, 2.0 * static_cast<double>(i), train.masses[i],
            i == 0      ? motor(20, torque)
            : i == last ? end
                        : JointProperties<S>{});
    for (std::size_t i = 0; i < last; ++i) {
      b.couplings.push_back(b.w.add(gears<S>(b.joints[i], train.teeth[i], b.joints[i + 1], train.teeth[i + 1])));
      EXPECT_TRUE(b.couplings.back()) << describe(b.w.fault());
    }
    return b;
  }
  static double spin(const Built& b, std::size_t i) { return to_double(b.w.angular_velocity(b.bodies[i]).z); }
  /// [rad] By which the second wheel of a pair stands beside its teeth.
  static double off(const Built& b, const Train& train, std::size_t pair) {
    const double a = train.teeth[pair], c = train.teeth[pair + 1];
    const double sum =
        a * to_double(b.w.joint_position(b.joints[pair])) + c * to_double(b.w.joint_position(b.joints[pair + 1]));
    return std::abs(std::remainder(sum, kTurn)) / c;
  }
  /// In one step of a sixtieth a wheel has turned over its gap before Q16.16 has the numbers to hold it: a tooth's turn
  /// and the angle that a step closes are two digits apart in that format.
  static bool drives_through(SolverName solver) { return std::is_same_v<S, Q16_16> && solver == SolverName::pgs; }
};
TYPED_TEST_SUITE(CoupledTrains, AllScalars);

/// Under a load that does not change what gears bear is known from the sub-step before.
TYPED_TEST(CoupledTrains, stand_in_mesh_between_a_motor_and_a_brake) {
  using S = TypeParam;
  for (const SolverName solver : kBuiltSolvers) {
    if (this->drives_through(solver)) continue;
    for (std::uint64_t seed = 0; seed < kTrains; ++seed) {
      SCOPED_TRACE(named(solver, "train " + std::to_string(seed)));
      const Train train = Train::draw(seed);
      const double torque = 400 * train.masses[0] / 100;
      auto b = this->build(train, solver, torque, this->motor(0, 30000));
      // Brakes and teeth are solved one after the other: an error stands, and the speed that would close it is told.
      const double fine = solver == SolverName::pgs ? 2e-3 : 1e-4;  // [rad]
      const double gap = pick<S>(fine, fine, 2e-2, fine), closing = pick<S>(1e-2, 1e-2, 2e-2, 1e-2);
      double worst = 0;
      for (int frame = 0; frame < 300; ++frame) {
        b.w.step();
        for (std::size_t i = 0; frame >= 240 && i + 1 < train.size(); ++i)
          worst = std::max(worst, this->off(b, train, i));
      }
      EXPECT_LT(worst, gap) << "rad out of mesh";
      for (std::size_t i = 0; i + 1 < train.size(); ++i) {
        EXPECT_NEAR(this->spin(b, i), 0, closing);
        const double load = std::abs(to_double(b.w.state(b.couplings[i])->load)), expected = torque / train.teeth[0];
        EXPECT_NEAR(load, expected, pick<S>(0.01, 0.01, 0.05, 0.01) * expected + pick<S>(0, 0, 0.1, 0));
      }
    }
  }
}

TYPED_TEST(CoupledTrains, gain_speed_by_the_motor_over_what_it_feels_of_all_wheels) {
  using S = TypeParam;
  for (const SolverName solver : kBuiltSolvers) {
    if (this->drives_through(solver)) continue;
    for (std::uint64_t seed = 0; seed < kTrains; ++seed) {
      SCOPED_TRACE(named(solver, "train " + std::to_string(seed)));
      const Train train = Train::draw(seed);
      double fastest = 0;
      for (std::size_t i = 0; i < train.size(); ++i) fastest = std::max(fastest, std::abs(train.ratio(i)));
      const double spin = 5 / fastest, torque = spin * train.felt();  // of the first, after a second
      auto b = this->build(train, solver, torque, JointProperties<S>{});
      double worst = 0;
      for (int frame = 0; frame < 60; ++frame) {
        b.w.step();
        for (std::size_t i = 0; i + 1 < train.size(); ++i) worst = std::max(worst, this->off(b, train, i));
      }
      const double tolerance = pick<S>(0.01, 0.01, 0.03, 0.01);
      for (std::size_t i = 0; i < train.size(); ++i) {
        EXPECT_NEAR(this->spin(b, i), spin * train.ratio(i), tolerance * std::abs(spin * train.ratio(i))) << i;
      }
      EXPECT_LT(worst, pick<S>(2e-3, 2e-3, 2e-2, 2e-3)) << "rad out of mesh";
    }
  }
}

/// Inertias of 1 to 1, 10 and 100, either way. A brake on a light wheel takes seconds to bear the motor of a heavy one,
/// and slips until then; teeth do not.
TYPED_TEST(CoupledTrains, hold_a_motor_whatever_the_wheels_weigh) {
  using S = TypeParam;
  for (const SolverName solver : kBuiltSolvers) {
    if (this->drives_through(solver)) continue;
    for (const double ratio : {0.01, 0.1, 1.0, 10.0, 100.0}) {
      if (std::is_same_v<S, Q16_16> && ratio < 0.1) continue;  // 100 g between 40 N m and a brake: 0.08 rad off
      SCOPED_TRACE(named(solver, "train 0") + ", ratio " + std::to_string(ratio));
      const Train train = {{20, 40}, {10, 10 * ratio}};
      auto b = this->build(train, solver, 40, this->motor(0, 30000));
      double worst = 0;
      for (int frame = 0; frame < 480; ++frame) {
        b.w.step();
        worst = std::max(worst, this->off(b, train, 0));
      }
      EXPECT_LT(worst, pick<S>(2e-3, 2e-3, 2e-2, 2e-3)) << "rad out of mesh";
      EXPECT_LT(this->off(b, train, 0), pick<S>(5e-5, 5e-6, 2e-2, 5e-6)) << "rad out of mesh";
      const bool gropes = solver == SolverName::avbd || solver == SolverName::admm;  // in the turns of mechanisms
      EXPECT_NEAR(std::abs(to_double(b.w.state(b.couplings[0])->load)), 2,
                  pick<S>(0.02, 0.02, gropes ? 0.2 : 0.1, 0.02));
    }
  }
}

/// The rack's block stands at a wall, which bears the motor's torque over the pinion's radius.
TYPED_TEST(CoupledTrains, press_a_rack_against_a_wall_and_not_into_it) {
  using S = TypeParam;
  for (const SolverName solver : kBuiltSolvers) {
    for (std::uint64_t seed = 0; seed < kTrains; ++seed) {
      SCOPED_TRACE(named(solver, "train " + std::to_string(seed)));
      Dice dice(seed * 17 + 5);
      const double mass = dice.magnitude(2, 20), radius = dice.in(0.1, 0.5),
                   torque = mass * 10 * dice.in(0.5, 4) * radius;
      typename TestFixture::Built b{World<S>(awake<S>(solver)), {}, {}, {}};
      b.w.set_gravity(Vec3<S>::zero());
      const JointId pinion = this->wheel(b, 0, dice.magnitude(2, 20), this->motor(20, torque));
      BodyDefinition<S> d = moving<S>(add_box(b.w, 0.25, 0.25, 0.25), {4, 0, 0});
      d.mass = num<S>(mass);
      const BodyId block = b.w.create(d);
      const Quat<Unit<S>> along = turn<S>({0, 1, 0}, kPi / 2);  // z to x
      const JointId rack = b.w.create(b.w.joint_at(JointType::slider, {}, block, {vec<S>(4, 0, 0), along}));
      const CouplingId coupling = b.w.add(rack_and_pinion<S>(pinion, num<S>(radius), rack));
      ASSERT_TRUE(coupling) << describe(b.w.fault());
      b.w.create(still<S>(add_box(b.w, 0.5, 2, 2), {4.76, 0, 0}));
      run(b.w, 180);
      const double x = to_double(b.w.center_of_mass(block).x);
      EXPECT_NEAR(x, 4.01, pick<S>(3e-3, 3e-3, 6e-3, 3e-3));
      EXPECT_NEAR(length(real(b.w.velocity(block))), 0, pick<S>(3e-3, 3e-3, 2e-2, 3e-3));
      EXPECT_NEAR(std::abs(to_double(b.w.state(coupling)->load)), torque, pick<S>(0.02, 0.02, 0.05, 0.02) * torque);
      const double turned = to_double(b.w.joint_position(pinion));
      EXPECT_NEAR(std::remainder(turned - (x - 4) / radius, kTurn), 0, pick<S>(2e-3, 2e-3, 2e-2, 2e-3));
    }
  }
}

/// One metre of a's rope for `ratio` of b's: T (1 / m_a + ratio^2 / m_b) = g (1 + ratio).
TYPED_TEST(CoupledTrains, pulleys_of_any_masses_fall_as_atwood_has_it) {
  using S = TypeParam;
  for (const SolverName solver : kBuiltSolvers) {
    for (std::uint64_t seed = 0; seed < kTrains; ++seed) {
      SCOPED_TRACE(named(solver, "train " + std::to_string(seed)));
      Dice dice(seed * 13 + 7);
      const double masses[] = {dice.magnitude(1, 20), dice.magnitude(1, 20)};
      const double ratio = 1 + static_cast<double>(dice.below(3));
      World<S> w(awake<S>(solver));
      BodyId bodies[2];
      JointId ropes[2];
      for (int i = 0; i < 2; ++i) {
        BodyDefinition<S> d = moving<S>(add_ball(w, 0.25), {2.0 * i, -8, 0});
        d.mass = num<S>(masses[i]);
        bodies[i] = w.create(d);
        JointProperties<S> joint =
            w.joint_at(JointType::distance, {}, bodies[i], {vec<S>(2.0 * i, -8, 0), Quat<Unit<S>>::identity()});
        joint.frame_a.position = vec<S>(2.0 * i, 0, 0);
        joint.flags = joint_flag::kLimit;
        joint.upper = S(40);
        ropes[i] = w.create(joint);
      }
      const CouplingId rope = w.add(pulley<S>(ropes[0], ropes[1], num<S>(ratio), num<S>(8 + 8 * ratio)));
      ASSERT_TRUE(rope) << describe(w.fault());
      run(w, 30);
      const double tension = 10 * (1 + ratio) / (1 / masses[0] + ratio * ratio / masses[1]);
      const double speeds[] = {(tension / masses[0] - 10) / 2, (ratio * tension / masses[1] - 10) / 2};
      const double fastest = std::max(std::abs(speeds[0]), std::abs(speeds[1]));
      for (int i = 0; i < 2; ++i)
        EXPECT_NEAR(to_double(w.velocity(bodies[i]).y), speeds[i], pick<S>(0.01, 0.01, 0.03, 0.01) * fastest) << i;
      EXPECT_NEAR(to_double(w.state(rope)->load), -tension, pick<S>(0.02, 0.02, 0.1, 0.02) * tension);
      const double sum = to_double(w.joint_position(ropes[0])) + ratio * to_double(w.joint_position(ropes[1]));
      EXPECT_NEAR(sum, 8 + 8 * ratio, pick<S>(3e-3, 3e-3, 1e-2, 3e-3));
    }
  }
}

/// What it bore is state: a world that is loaded goes on with it.
TYPED_TEST(CoupledTrains, go_on_from_what_they_bore) {
  using S = TypeParam;
  for (const SolverName solver : kBuiltSolvers) {
    const Train train = {{20, 40, 10}, {20, 40, 10}};
    auto b = this->build(train, solver, 200, this->motor(0, 100));
    run(b.w, 30);
    typename World<S>::Snapshot snapshot;
    b.w.save(snapshot);
    World<S> other(awake<S>(solver));
    ASSERT_TRUE(other.load(snapshot));
    EXPECT_FALSE(other.state(b.couplings[0])->load == S(0));
    for (int frame = 0; frame < 30; ++frame) {
      b.w.step(), other.step();
      ASSERT_EQ(b.w.hash(), other.hash()) << named(solver, "train 0") << ", frame " << frame;
    }
  }
}

TYPED_TEST(CoupledTrains, bear_nothing_where_a_joint_holds_nothing) {
  using S = TypeParam;
  const Train train = {{20, 40}, {20, 40}};
  auto b = this->build(train, SolverName::soft_step, 200, this->motor(0, 30000));
  run(b.w, 30);
  EXPECT_FALSE(b.w.state(b.couplings[0])->load == S(0));
  ASSERT_TRUE(b.w.set_enabled(b.bodies[1], false)) << describe(b.w.fault());
  run(b.w, 1);
  EXPECT_TRUE(b.w.state(b.couplings[0])->load == S(0));
}

}  // namespace coupled_trains_test
}  // namespace isostep::test
