// Laws of coupled joints that come to their ends: whatever drives them, they stop there with all that is coupled to
// them, and nothing gains.
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "built.hpp"
#include "laws/awake.hpp"
#include "random/dice.hpp"
#include "sample.hpp"
#include "scenes/measure.hpp"

namespace isostep::test {
namespace coupling_ends_test {

template <class S> class CouplingEnds : public ::testing::Test {
 protected:
  static Pose<S> at(D3 place) { return {vec<S>(place), Quat<Unit<S>>::identity()}; }
};
TYPED_TEST_SUITE(CouplingEnds, AllScalars);

/// A wheel or slider between ends, coupled to a wheel or slider of up to 256 times its mass.
struct Train {
  std::array<bool, 2> slides;
  std::array<double, 2> mass;   // [kg]
  std::array<double, 2> ratio;  // [1]
  double room;                  // [rad] or [m] between the coupling's bounds; 0 where it has none
  double speed;                 // [rad/s] or [m/s] of the second
  double end;                   // [rad] or [m]: the first goes that far either way

  static Train draw(std::uint64_t seed, double most_ratio) {
    Dice dice(seed * 31 + 17);
    Train t;
    t.slides = {dice.one_in(2), dice.one_in(2)};
    t.mass[0] = dice.magnitude(1, 4);
    t.mass[1] = t.mass[0] * dice.magnitude(1, most_ratio);
    t.ratio[1] = static_cast<double>(1 + dice.below(4)) * (dice.one_in(2) ? 1 : -1);
    t.ratio[0] = static_cast<double>(1 + dice.below(4));
    t.room = dice.one_in(3) ? dice.in(0.02, 0.2) : 0;
    t.speed = dice.in(1, 4) * (dice.one_in(2) ? 1 : -1);
    t.end = dice.in(0.25, 1.5);
    return t;
  }
};

/// Without gravity, so that all they have is what they came with.
TYPED_TEST(CouplingEnds, that_are_met_at_speed_stop_the_whole_train) {
  using S = TypeParam;
  for (const SolverName solver : kBuiltSolvers) {
    for (std::uint64_t seed = 0; seed < sampled<std::uint64_t>(400, 60); ++seed) {
      SCOPED_TRACE(named(solver, "seed " + std::to_string(seed)));
      const Train train = Train::draw(seed, pick<S>(256, 256, 16, 256));
      World<S> w(awake<S>(solver));
      w.set_gravity(Vec3<S>::zero());
      std::array<JointId, 2> joints;
      const std::array<double, 2> speeds = {-train.ratio[1] / train.ratio[0] * train.speed, train.speed};
      for (std::size_t i = 0; i < 2; ++i) {
        const D3 place = {3.0 * static_cast<double>(i), 0, 0}, motion = {0, 0, speeds[i]};
        BodyDefinition<S> d = moving<S>(add_box(w, 0.25, 0.25, 0.25), place);
        (train.slides[i] ? d.velocity : d.angular_velocity) = vec<S>(motion);
        d.mass = num<S>(train.mass[i]);
        JointProperties<S> p = w.joint_at(train.slides[i] ? JointType::slider : JointType::hinge, {}, w.create(d),
                                          this->at(place));
        if (i == 0) {
          p.flags = joint_flag::kLimit;
          p.lower = num<S>(-train.end);
          p.upper = num<S>(train.end);
        }
        joints[i] = w.create(p);
      }
      Coupling<S> c;
      c.joint_a = joints[0];
      c.joint_b = joints[1];
      c.ratio_a = num<S>(train.ratio[0]);
      c.ratio_b = num<S>(train.ratio[1]);
      c.lower = num<S>(-train.room / 2);
      c.upper = num<S>(train.room / 2);
      ASSERT_TRUE(w.add(c)) << describe(w.fault());
      const double given = scenes::measure_energy(w).total();
      double most = 0, farthest = 0;
      for (int frame = 0; frame < 240; ++frame) {
        w.step();
        most = std::max(most, scenes::measure_energy(w).total());
        farthest = std::max(farthest, std::abs(to_double(w.joint_position(joints[0]))));
      }
      EXPECT_LT(most, given * pick<S>(1.01, 1.01, 1.05, 1.01) + 0.01);
      EXPECT_LT(farthest, train.end + 0.02);
    }
  }
}

/// A heavy weight draws a light one up to its wheel, and no farther: the rope is no longer, and what falls stops.
TYPED_TEST(CouplingEnds, of_a_rope_are_its_wheels) {
  using S = TypeParam;
  for (const SolverName solver : kBuiltSolvers) {
    for (std::uint64_t seed = 0; seed < sampled<std::uint64_t>(100, 16); ++seed) {
      SCOPED_TRACE(named(solver, "seed " + std::to_string(seed)));
      Dice dice(seed * 37 + 5);
      const std::array<double, 2> masses = {dice.magnitude(1, 10), 20};
      const std::array<double, 2> lengths = {dice.in(0.5, 2), dice.in(0.5, 2)};
      World<S> w(awake<S>(solver));
      std::array<JointId, 2> joints;
      for (std::size_t i = 0; i < 2; ++i) {
        const double x = 4.0 * static_cast<double>(i);
        BodyDefinition<S> d = moving<S>(add_box(w, 0.25, 0.25, 0.25), {x, -lengths[i], 0});
        d.mass = num<S>(masses[i]);
        JointProperties<S> p =
            w.joint_between(JointType::distance, {}, this->at({x, 0, 0}), w.create(d), this->at({x, -lengths[i], 0}));
        p.flags = joint_flag::kLimit;
        p.upper = S(40);
        joints[i] = w.create(p);
      }
      const double rope = lengths[0] + lengths[1];
      ASSERT_TRUE(w.add(pulley<S>(joints[0], joints[1], S(1), num<S>(rope)))) << describe(w.fault());
      const double given = scenes::measure_energy(w).total();
      double most = -1e9, longest = 0;
      for (int frame = 0; frame < 600; ++frame) {
        w.step();
        most = std::max(most, scenes::measure_energy(w).total());
        longest = std::max(longest, to_double(w.joint_position(joints[0])) + to_double(w.joint_position(joints[1])));
      }
      EXPECT_LT(most, given + 0.01 * std::abs(given));
      // In pgs what falls for a whole step between two passes is farther.
      const bool by_steps = solver == SolverName::pgs;
      EXPECT_LT(longest, rope + (by_steps ? pick<S>(0.125, 0.125, 1, 0.125) : pick<S>(0.05, 0.05, 0.08, 0.05)));
      EXPECT_NEAR(to_double(w.joint_position(joints[1])), rope, 0.05);
    }
  }
}

}  // namespace coupling_ends_test
}  // namespace isostep::test
