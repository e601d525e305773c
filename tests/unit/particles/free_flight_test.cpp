// Free flight: materials' gravity, drag and damping, and what pinned particles do.
// SPDX-License-Identifier: MIT
#include "isostep/particles/step/free_flight.hpp"

#include "unit/particles/step_scene.hpp"

namespace isostep {
namespace free_flight_test {

template <class S> class FreeFlightTest : public testing::Test {
 protected:
  StepScene<S> scene_;
  FreeFlight<S> flight_{scene_.state, scene_.step};

  FreeFlightTest() { scene_.state.settings.gravity = StepScene<S>::vec({0, -10, 0}); }
  void begin() {
    scene_.begin();
    flight_.prepare();
  }
};
TYPED_TEST_SUITE(FreeFlightTest, Scalars);

TYPED_TEST(FreeFlightTest, AllSubstepsAtOnceAreSubstepsOneByOne) {
  StepScene<TypeParam>& scene = this->scene_;
  const ParticleId a = scene.add(kNowhere, {3, 1, -2});
  const ParticleState<TypeParam> start = scene.state;
  this->begin();
  this->flight_.fly();
  const D3 v = scene.v(a), d = scene.d(a);
  scene.state = start;
  this->begin();
  for (int i = 0; i < scene.state.settings.substeps; ++i) {
    this->flight_.accelerate();
    this->flight_.advance();
  }
  EXPECT_EQ(scene.v(a).y, v.y);
  EXPECT_EQ(scene.d(a).x, d.x);
  EXPECT_EQ(scene.d(a).y, d.y);
  EXPECT_NEAR(v.y, 1 - 10.0 / 60, 64 * grain<TypeParam>(1));
  EXPECT_NEAR(d.y, 1.0 / 60 - 10 * 10 * scene.h() * scene.h(), 64 * grain<TypeParam>(1));  // 1 + 2 + 3 + 4 sub-steps
}

TYPED_TEST(FreeFlightTest, AMaterialScalesGravityDragsAndDamps) {
  using S = TypeParam;
  StepScene<S>& scene = this->scene_;
  ParticleMaterial<S>& material = scene.state.materials.change_all()[0];
  material.gravity_scale = S(0.5);
  material.linear_drag = S(2);
  material.damping = S(0.25);
  const ParticleId a = scene.add(kNowhere, {4, 0, 0}, 2);
  this->begin();
  this->flight_.accelerate();
  EXPECT_NEAR(scene.a(a).x, -4, 64 * grain<S>(4));
  EXPECT_NEAR(scene.a(a).y, -5, 64 * grain<S>(5));
  this->flight_.keep_velocity(a.slot, scene.state.velocity[a.slot]);
  EXPECT_NEAR(scene.v(a).x, 4 * std::pow(0.25, scene.h()), 64 * grain<S>(4));
}

TYPED_TEST(FreeFlightTest, PinnedParticlesGoOnAtTheirVelocity) {
  StepScene<TypeParam>& scene = this->scene_;
  const ParticleId a = scene.add(kNowhere, {2, 0, 0}, kPinned);
  this->begin();
  this->flight_.fly();
  this->flight_.place();
  EXPECT_EQ(scene.v(a).x, 2);
  EXPECT_EQ(scene.v(a).y, 0);
  EXPECT_NEAR(to_double(scene.step.now[a.slot].x), 2.0 / 60, 64 * grain<TypeParam>(1));
}

}  // namespace free_flight_test
}  // namespace isostep
