// Surfaces in the air, against their tensors.
// SPDX-License-Identifier: MIT

#include "isostep/math/frames.hpp"
#include "unit/world/forces.hpp"

namespace isostep::test {
namespace aero_surfaces_test {

template <class S> class AeroSurfaces : public Forces<S> {};
TYPED_TEST_SUITE(AeroSurfaces, AllScalars);

TYPED_TEST(AeroSurfaces, surfaces_feel_the_air_at_their_point) {  // defect 35
  using S = TypeParam;
  this->weightless();
  const BodyId spinning = this->box({0, 0, 0}, {1, 0.25, 0.25}, 2), still = this->ball({0, 8, 0});
  this->world_.set_velocity(spinning, Vec3<S>::zero(), vec<S>(0, 0, 2));
  AeroSurface<S> surface;
  surface.body = spinning;
  surface.point = vec<S>(1, 0, 0);
  surface.tensor = Mat3<S>::diagonal(vec<S>(0, -1, 0));
  this->added(this->world_.add(surface));
  surface.body = still;
  surface.point = Vec3<S>::zero();
  surface.tensor = Mat3<S>::diagonal(vec<S>(-1, -1, -1));
  this->added(this->world_.add(surface));
  ForceZone<S> wind;
  wind.wind = vec<S>(0, 0, 4);
  wind.shape = ZoneShape::sphere;
  wind.pose.position = vec<S>(0, 8, 0);
  wind.half = vec<S>(3, 0, 0);
  this->added(this->world_.add(wind));
  run(this->world_, 30);
  EXPECT_LT(this->spin(spinning).z, 1.6);
  EXPECT_LT(this->velocity(spinning).y, -0.1);
  EXPECT_NEAR(this->velocity(still).z, 4 * (1 - std::exp(-0.25)), 0.01);
}

TYPED_TEST(AeroSurfaces, control_surfaces_lead_from_one_tensor_to_another) {
  using S = TypeParam;
  this->weightless();
  const BodyId id = this->ball({0, 0, 0}, 1, {0, 0, 4});
  AeroSurface<S> surface;
  surface.body = id;
  const auto lift = [](double per_speed) {
    Mat3<S> m = Mat3<S>::diagonal(Vec3<S>::zero());
    m.rows[1].z = num<S>(per_speed);
    return m;
  };
  surface.tensor = lift(0.25), surface.low = lift(0), surface.high = lift(1);
  const AeroSurfaceId wing = this->added(this->world_.add(surface));
  double before = 0;
  for (const auto& [control, expected] : {std::pair{0.0, 0.25}, {-1.0, 0.0}, {-0.5, 0.125}, {0.5, 0.625}, {1.0, 1.0}}) {
    surface.control = num<S>(control);
    EXPECT_TRUE(this->world_.set(wing, surface));
    run(this->world_, 6);
    EXPECT_NEAR(this->velocity(id).y - before, 4 * expected * 0.1, 0.002) << control;
    before = this->velocity(id).y;
  }
}

TYPED_TEST(AeroSurfaces, angled_surfaces_are_tensors_that_are_turned) {
  using S = TypeParam;
  this->weightless();
  const BodyId turned = this->ball({0, 0, 0}, 1, {3, 1, -2}), plain = this->ball({0, 4, 0}, 1, {3, 1, -2});
  AeroSurface<S> surface;
  surface.body = turned;
  surface.orientation = turn<S>({0.6, 0, 0.8}, 0.75);
  surface.tensor = {{vec<S>(-1, 0.25, 0), vec<S>(0, -0.5, 0), vec<S>(0, 0.25, -2)}};
  this->added(this->world_.add(surface));
  const Mat3<Unit<S>> r = to_matrix(surface.orientation);
  surface.tensor = change_of_basis(r, surface.tensor);
  surface.orientation = Quat<Unit<S>>::identity();
  surface.body = plain;
  this->added(this->world_.add(surface));
  run(this->world_, 60);
  expect_near(this->velocity(turned), this->velocity(plain), 400 * grain<S>() + 1e-12);
  EXPECT_LT(length(this->velocity(turned)), 3);
}

TYPED_TEST(AeroSurfaces, large_tensors_are_stable) {
  using S = TypeParam;
  for (const bool quadratic : {false, true}) {
    const BodyId id = this->box({0, 0, 0}, {0.5, 0.25, 0.25}, 0.5);
    this->weightless();
    this->world_.set_velocity(id, vec<S>(4, -3, 2), vec<S>(1, 2, 3));
    AeroSurface<S> surface;
    surface.body = id;
    surface.point = vec<S>(0.5, 0.125, 0);
    surface.tensor = Mat3<S>::diagonal(vec<S>(-8000, -4000, -8000));
    surface.is_quadratic = quadratic;
    this->added(this->world_.add(surface));
    double energy = 1e9;
    for (int i = 0; i < 60; ++i) {
      this->world_.step();
      const double now = length(this->velocity(id)) + length(this->spin(id));
      EXPECT_LT(now, 12);
      energy = std::min(energy, now);
    }
    EXPECT_LT(length(this->velocity(id)), 4);
    this->world_.destroy(id);
  }
}

}  // namespace aero_surfaces_test
}  // namespace isostep::test
