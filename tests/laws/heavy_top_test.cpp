// Laws of spinning bodies that others push: a heavy top keeps spin and energy, and falls no lower than theory says.
// SPDX-License-Identifier: MIT

#include <algorithm>

#include "unit/world/worlds.hpp"

namespace isostep::test {
namespace heavy_top_test {

template <class S> class HeavyTop : public ::testing::Test {
 protected:
  struct Seen {
    double spin = 0, energy = 0;  // [1] largest departure, of the start's
    double lowest = 0;            // [m] of the centre
  };
  struct Top {
    double across, about;  // [kg m^2] moments about the centre
    double spin;           // [rad/s]
  };

  /// One kilogram on a ball joint at the origin, a metre from it, let go with its axis level and only spinning.
  static Seen spin_top(const Top& top, const Settings<S>& settings, double seconds) {
    World<S> w(settings);
    BodyDefinition<S> d = moving<S>(add_ball(w, 0.125), {1, 0, 0});
    d.mass = num<S>(1);
    d.inertia = vec<S>(top.about, top.across, top.across);
    d.angular_velocity = vec<S>(top.spin, 0, 0);
    const BodyId body = w.create(d);
    EXPECT_TRUE(w.create(w.joint_at(JointType::ball, {}, body, {vec<S>(0, 0, 0), Quat<Unit<S>>::identity()})));
    const auto about = [&] {
      return dot(real(w.angular_velocity(body)), rotated<S>(w.pose(body).orientation, {1, 0, 0}));
    };
    const auto energy = [&] {
      const D3 v = real(w.velocity(body)), spin = real(w.angular_velocity(body));
      const double axial = about(),
                   turning = top.about * axial * axial + top.across * (dot(spin, spin) - axial * axial);
      return 0.5 * (dot(v, v) + turning) + 10 * to_double(w.center_of_mass(body).y);
    };
    const double spin = about(), start = energy();
    Seen seen;
    for (int i = 0; i < seconds * settings.hz; ++i) {
      w.step();
      seen.spin = std::max(seen.spin, std::fabs(about() / spin - 1));
      seen.energy = std::max(seen.energy, std::fabs(energy() / start - 1));
      seen.lowest = std::min(seen.lowest, to_double(w.center_of_mass(body).y));
    }
    return seen;
  }
  /// The height at which the axis turns back: energy, and momentum about the axis and the vertical, leave a quadratic
  /// in it.
  static double theory(const Top& top) {
    const double momentum = top.about * top.spin, half = momentum * momentum / (4 * (top.across + 1) * 10);
    return half - std::sqrt(half * half + 1);
  }
};
TYPED_TEST_SUITE(HeavyTop, AllScalars);

constexpr double kSeconds = 30;

// O14. Q16.16 has a grain of 1 um/s: in half a minute that adds up.
TYPED_TEST(HeavyTop, keeps_its_spin_and_energy_and_falls_as_low_as_it_must) {
  using S = TypeParam;
  const typename TestFixture::Top top = {0.08, 0.16, 50};
  for (const std::int32_t hz : {60, 240}) {
    for (const std::int32_t substeps : {8, 64}) {
      if (kIsFixed<S> && hz * substeps > 4000) continue;
      const auto seen = this->spin_top(top, settings<S>(-10, hz, substeps), kSeconds);
      EXPECT_LT(seen.spin, 0.01) << hz << " x " << substeps;
      EXPECT_LT(seen.energy, pick<S>(0.02, 0.02, 0.03, 0.02)) << hz << " x " << substeps;
      EXPECT_NEAR(seen.lowest, this->theory(top), 0.03) << hz << " x " << substeps;
    }
  }
}

TYPED_TEST(HeavyTop, does_so_in_the_direct_solver) {
  using S = TypeParam;
  const typename TestFixture::Top top = {0.08, 0.16, 50};
  Settings<S> s = settings<S>(-10, 60, 8);
  s.solver = SolverName::direct;
  const auto seen = this->spin_top(top, s, 10);
  EXPECT_LT(seen.spin, 0.01);
  EXPECT_LT(seen.energy, 0.02);
  EXPECT_NEAR(seen.lowest, this->theory(top), 0.03);
}

}  // namespace heavy_top_test
}  // namespace isostep::test
