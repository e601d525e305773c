// The residuals of contacts: nothing at rest, and what is done to a contact on purpose is seen, by closed forms.
// SPDX-License-Identifier: MIT
#include "scenes/residuals.hpp"

#include <cmath>

#include "isostep/store/state.hpp"
#include "unit/world/worlds.hpp"

namespace isostep::test {
namespace residuals_test {

constexpr int kRate = 480;  // [1/s] sub-steps

template <class S> class Residuals : public ::testing::Test {
 protected:
  /// A box at rest on a slope of so many radians, of friction .6.
  explicit Residuals(double angle = 0.3) : world(awake()), angle_(angle) {
    using U = Unit<S>;
    const Quat<U> turn = normalise(Quat<U>{U(0), U(0), num<U>(std::sin(angle / 2)), num<U>(std::cos(angle / 2))});
    BodyDefinition<S> ground = still<S>(add_box(world, 5, 0.5, 5));
    ground.orientation = turn;
    ground.material.friction = num<S>(0.6);
    world.create(ground);
    BodyDefinition<S> d =
        moving<S>(add_box(world, 0.5, 0.25, 0.5), {-0.75 * std::sin(angle), 0.75 * std::cos(angle), 0});
    d.orientation = turn;
    d.material.friction = num<S>(0.6);
    box = world.create(d);
    run(world, 60);
  }
  /// [m/s] Gravity's change of speed in a sub-step.
  double pull() const { return 10.0 / kRate; }
  double load() const { return pull() * std::cos(angle_); }

  World<S> world;
  BodyId box;

 private:
  static Settings<S> awake() {
    Settings<S> s = settings<S>(-10, 60, kRate / 60);
    s.allow_sleep = false;
    return s;
  }
  double angle_;
};
TYPED_TEST_SUITE(Residuals, AllScalars);

template <class S> double small() { return pick<S>(1e-5, 1e-7, 4e-4, 1e-5); }

TYPED_TEST(Residuals, are_nothing_at_rest) {
  const scenes::ContactResiduals r = scenes::measure_residuals(this->world);
  EXPECT_EQ(r.contacts, 1u);
  EXPECT_NEAR(r.signorini, 0, small<TypeParam>());
  EXPECT_NEAR(r.coulomb, 0, small<TypeParam>());
  EXPECT_NEAR(r.dissipation, 0, small<TypeParam>());
}

TYPED_TEST(Residuals, see_what_pushes_while_it_opens) {
  const double c = std::cos(0.3), s = std::sin(0.3);
  this->world.set_velocity(this->box, vec<TypeParam>({-s, c, 0}), vec<TypeParam>({0, 0, 0}));
  // Each of four points pushes by a quarter of the load, which is less than a metre a second.
  const double mean = this->load() / 4;
  EXPECT_GT(scenes::measure_residuals(this->world).signorini, 0.9 * mean);
  EXPECT_LT(scenes::measure_residuals(this->world).signorini, 2 * this->load());
}

TYPED_TEST(Residuals, see_a_speed_into_the_ground) {
  const double c = std::cos(0.3), s = std::sin(0.3);
  this->world.set_velocity(this->box, vec<TypeParam>({0.5 * s, -0.5 * c, 0}), vec<TypeParam>({0, 0, 0}));
  EXPECT_NEAR(scenes::measure_residuals(this->world).signorini, 0.5, 0.01);
}

TYPED_TEST(Residuals, see_friction_beyond_its_cone) {
  Material<TypeParam> smooth = this->world.view(this->box).properties->material;
  smooth.friction = num<TypeParam>(0.6 / 36);  // with .6 of the ground: a root of .1
  this->world.set_material(this->box, smooth);
  const double friction = this->pull() * std::sin(0.3), beyond = friction - 0.1 * this->load();
  EXPECT_NEAR(scenes::measure_residuals(this->world).coulomb, beyond, 0.02 * beyond + small<TypeParam>());
}

TYPED_TEST(Residuals, see_friction_that_does_not_resist_slip) {
  const double c = std::cos(0.3), s = std::sin(0.3);  // it slides down at 1 m/s, and friction is what held it
  this->world.set_velocity(this->box, vec<TypeParam>({-c, -s, 0}), vec<TypeParam>({0, 0, 0}));
  const double friction = this->pull() * std::sin(0.3), most = 0.6 * this->load();
  EXPECT_NEAR(scenes::measure_residuals(this->world).dissipation, most - friction, 0.02 * most + small<TypeParam>());
}

}  // namespace residuals_test
}  // namespace isostep::test
