// Laws of bodies that may not turn about every axis: locks take and never drive.
// SPDX-License-Identifier: MIT
#include "unit/world/worlds.hpp"

namespace isostep::test {
namespace {

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
  /// [kg m^2] of that box about the world's y.
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
  for (const SolverName solver :
       {SolverName::soft_step, SolverName::pgs, SolverName::worst_first, SolverName::direct}) {
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

}  // namespace
}  // namespace isostep::test
