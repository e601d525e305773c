// Laws of couplings that nothing drives: whatever their joints, ratios and bodies, nothing gains.
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <string>
#include <vector>

#include "built.hpp"
#include "laws/awake.hpp"
#include "random/dice.hpp"
#include "sample.hpp"
#include "scenes/measure.hpp"

namespace isostep::test {
namespace passive_couplings_test {

template <class S> class PassiveCouplings : public ::testing::Test {};
TYPED_TEST_SUITE(PassiveCouplings, AllScalars);

/// Up to four couplings over two or three wheels and sliders: loops, rows that are nearly the same, more rows than
/// joints, ranges. Whatever their ratios, nothing gains.
TYPED_TEST(PassiveCouplings, that_hold_each_other_gain_nothing) {
  using S = TypeParam;
  for (const SolverName solver : kBuiltSolvers) {
    for (std::uint64_t seed = 0; seed < sampled<std::uint64_t>(300, 60); ++seed) {
      SCOPED_TRACE(named(solver, "seed " + std::to_string(seed)));
      Dice dice(seed * 23 + 9);
      World<S> w(awake<S>(solver));
      w.set_gravity(Vec3<S>::zero());
      std::vector<JointId> joints;
      const int bodies = 2 + static_cast<int>(dice.below(2));
      for (int i = 0; i < bodies; ++i) {
        const double speed = dice.in(-4, 4);
        const bool slides = dice.one_in(2);
        BodyDefinition<S> d = moving<S>(add_box(w, 0.25, 0.25, 0.25), {3.0 * i, 0, 0}, {0, 0, slides ? speed : 0});
        if (!slides) d.angular_velocity = vec<S>(0, 0, speed);
        d.mass = num<S>(dice.magnitude(1, 20));
        joints.push_back(w.create(w.joint_at(slides ? JointType::slider : JointType::hinge, {}, w.create(d),
                                             {vec<S>(3.0 * i, 0, 0), Quat<Unit<S>>::identity()})));
      }
      const double given = scenes::measure_energy(w).total();
      const auto ratio = [&] { return S(static_cast<int>(1 + dice.below(3)) * (dice.one_in(2) ? 1 : -1)); };
      const std::uint32_t couplings = 1 + dice.below(4);
      for (std::uint32_t i = 0; i < couplings; ++i) {
        const std::uint32_t first = dice.below(static_cast<std::uint32_t>(bodies));
        Coupling<S> c;
        c.joint_a = joints[first];
        c.joint_b = joints[(first + 1) % joints.size()];
        if (bodies == 3 && dice.one_in(2)) c.joint_c = joints[(first + 2) % joints.size()];
        c.ratio_a = ratio();
        c.ratio_b = ratio();
        if (c.joint_c) c.ratio_c = ratio();
        if (dice.one_in(3)) c.upper = num<S>(dice.in(0, 1));
        ASSERT_TRUE(w.add(c)) << describe(w.fault());
      }
      double most = 0;
      for (int frame = 0; frame < 120; ++frame) {
        w.step();
        most = std::max(most, scenes::measure_energy(w).total());
      }
      EXPECT_LT(most, given * pick<S>(1.01, 1.01, 1.05, 1.01) + 0.01);
    }
  }
}

/// A slider on a slider, at a right angle, one coupled to the other: the second moves the first one's body as the joint
/// of that does not let it. By avbd it gains, at a ratio of 10: joints and couplings play each other off.
TYPED_TEST(PassiveCouplings, of_a_chain_of_joints_gain_nothing) {
  using S = TypeParam;
  for (const SolverName solver : all_but({SolverName::avbd})) {
    for (const double ratio : {0.1, 1.0, 4.0, 10.0}) {
      SCOPED_TRACE(named(solver, "ratio " + std::to_string(ratio)));
      World<S> w(awake<S>(solver));
      w.set_gravity(Vec3<S>::zero());
      BodyDefinition<S> d = moving<S>(add_box(w, 0.25, 0.25, 0.25), {0, 0, 0}, {1, 0, 0});
      d.mass = S(5);
      const BodyId first = w.create(d);
      d = moving<S>(add_box(w, 0.25, 0.25, 0.25), {0, 1, 0}, {1, 0, 0});
      d.mass = num<S>(5 * ratio);
      const BodyId second = w.create(d);
      const Pose<S> along = {vec<S>(0, 0, 0), turn<S>({0, 1, 0}, kPi / 2)},
                    across = {vec<S>(0, 1, 0), turn<S>({1, 0, 0}, kPi / 2)};
      const JointId a = w.create(w.joint_at(JointType::slider, {}, first, along));
      const JointId b = w.create(w.joint_at(JointType::slider, first, second, across));
      Coupling<S> c;
      c.joint_a = a;
      c.joint_b = b;
      c.ratio_a = c.ratio_b = S(1);
      ASSERT_TRUE(w.add(c)) << describe(w.fault());
      const double given = scenes::measure_energy(w).total();
      double most = 0;
      for (int frame = 0; frame < 300; ++frame) {
        w.step();
        most = std::max(most, scenes::measure_energy(w).total());
      }
      EXPECT_LT(most, given * pick<S>(1.01, 1.01, 1.05, 1.01));
    }
  }
}

/// Pendulums on long arms, geared to a heavy wheel or to each other.
TYPED_TEST(PassiveCouplings, of_bodies_far_from_their_axes_gain_nothing) {
  using S = TypeParam;
  for (const SolverName solver : kBuiltSolvers) {
    for (const double arm : {0.125, 0.25, 0.5, 1.0, 2.0}) {
      for (const bool geared_to_wheel : {true, false}) {
        SCOPED_TRACE(named(solver, "arm " + std::to_string(arm)));
        World<S> w(awake<S>(solver));
        JointId joints[2];
        for (int i = 0; i < 2; ++i) {
          const bool wheel = geared_to_wheel && i == 1;
          const double at = 6.0 * i;
          BodyDefinition<S> d = moving<S>(add_ball(w, wheel ? 0.5 : 0.25), {at + (wheel ? 0 : arm), 0, 0});
          d.mass = wheel ? S(500) : S(10);
          d.angular_damping = S(0);
          joints[i] =
              w.create(w.joint_at(JointType::hinge, {}, w.create(d), {vec<S>(at, 0, 0), Quat<Unit<S>>::identity()}));
          ASSERT_TRUE(joints[i]) << describe(w.fault());
        }
        ASSERT_TRUE(w.add(gears<S>(joints[0], 1, joints[1], 1))) << describe(w.fault());
        const double start = scenes::measure_energy(w).total(), depth = 2 * 10 * 10 * arm;
        double most = start;
        for (int frame = 0; frame < 300; ++frame) {
          w.step();
          most = std::max(most, scenes::measure_energy(w).total());
        }
        EXPECT_LT(most - start, 0.02 * depth);
      }
    }
  }
}

}  // namespace passive_couplings_test
}  // namespace isostep::test
