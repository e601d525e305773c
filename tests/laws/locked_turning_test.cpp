// Laws of bodies that may not turn about every axis: locks take and never drive.
// SPDX-License-Identifier: MIT
#include "built.hpp"
#include "unit/world/worlds.hpp"

namespace isostep::test {
namespace locked_turning_test {

template <class S> class LockedTurning : public ::testing::Test {
 protected:
  /// A box of three different moments, 1 kg, askew.
  static BodyId add_askew(World<S>& w, D3 angular_velocity, std::uint32_t locks) {
    BodyDefinition<S> d = moving<S>(add_box(w, 2, 0.5, 1), {0, 0, 0});
    d.mass = S(1);
    d.orientation = turn<S>({0.6, 0.48, 0.64}, 1);
    d.angular_velocity = vec<S>(angular_velocity);
    d.locks = locks;
    d.allow_sleep = false;
    return w.create(d);
  }
  /// [kg m^2] The inertia of that box about the world's y.
  static double about_y() {
    const Mat3<double> r = to_matrix(turn<double>({0.6, 0.48, 0.64}, 1));
    const double inertia[3] = {(0.25 + 1) / 3, (4 + 1.0) / 3, (4 + 0.25) / 3};
    double sum = 0;
    for (int k = 0; k < 3; ++k) sum += r.rows[1][k] * r.rows[1][k] * inertia[k];
    return sum;
  }
};
TYPED_TEST_SUITE(LockedTurning, AllScalars);

constexpr std::uint32_t kAboutX = body_flag::kLockAngularX, kAboutZ = body_flag::kLockAngularX << 2;

TYPED_TEST(LockedTurning, an_axis_that_is_no_principal_one_keeps_its_angular_velocity) {
  using S = TypeParam;
  for (const SolverName solver : kBuiltSolvers) {
    for (const std::uint32_t locks : {kAboutX | kAboutZ, kAboutX}) {
      for (const double angular_velocity : {-3.0, 3.0, 12.0}) {
        Settings<S> s = settings<S>(0);
        s.solver = solver;
        World<S> w(s);
        const BodyId body = this->add_askew(w, {0, angular_velocity, 0}, locks);
        for (int i = 0; i < 600; ++i) ASSERT_TRUE(w.step().clean());
        expect_near(real(w.angular_velocity(body)), {0, angular_velocity, 0}, 1e-3);
      }
    }
  }
}

TYPED_TEST(LockedTurning, a_torque_meets_the_inertia_about_the_free_axis) {
  using S = TypeParam;
  World<S> w(settings<S>(0));
  const BodyId by_impulse = this->add_askew(w, {0, 0, 0}, kAboutX | kAboutZ);
  w.apply_impulse(by_impulse, vec<S>(0, 0, 0), vec<S>(0, 2, 0));
  EXPECT_NEAR(to_double(w.angular_velocity(by_impulse).y), 2 / this->about_y(), pick<S>(1e-5, 1e-12, 1e-3, 1e-7));
}

/// The weld asks for what the lock holds already. Along that axis its block moves nothing, and what float and Q16.16
/// round must not come back from there through what hangs on it.
TYPED_TEST(LockedTurning, a_body_that_is_welded_and_locked_holds_what_hangs_on_it) {
  using S = TypeParam;
  for (const JointType weld : {JointType::fixed, JointType::slider, JointType::angular}) {
    for (const SolverName solver : all_but({SolverName::pgs, SolverName::worst_first})) {
      Settings<S> s = settings<S>(-10);
      s.solver = solver;
      World<S> w(s);
      const ShapeId box = add_box(w, 0.2, 0.1, 0.3);
      BodyId last;
      std::vector<JointId> joints;
      const auto add = [&](JointType type, D3 at, double mass, std::uint32_t locks) {
        BodyDefinition<S> d = moving<S>(box, at);
        d.mass = num<S>(mass);
        d.orientation = turn<S>({0.6, 0.48, 0.64}, 1);
        d.locks = locks;
        d.collide = false;
        const BodyId body = w.create(d);
        const D3 anchor = at + D3{-0.2, 0.1, 0.3};
        joints.push_back(w.create(w.joint_at(type, last, body, {vec<S>(anchor), turn<S>({0.48, 0.64, 0.6}, 0.7)})));
        last = body;
      };
      add(weld, {0, 5, 0}, 0.3, kAboutX);
      add(JointType::hinge, {0.5, 5, 0.25}, 0.25, 0);
      add(weld, {0.5, 4.5, 0.5}, 0.7, kAboutX << 1);
      add(JointType::fixed, {0.75, 4, 0.5}, 1, 0);
      for (int i = 0; i < 180; ++i) {
        ASSERT_TRUE(w.step().clean()) << kJointNames[static_cast<int>(weld)] << ", frame " << i;
        for (const JointId joint : joints) ASSERT_LT(to_double(w.joint_error(joint)), 0.02);
      }
    }
  }
}

}  // namespace locked_turning_test
}  // namespace isostep::test
