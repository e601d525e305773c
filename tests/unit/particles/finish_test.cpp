// The end of a step of particles: limits of speed and position, and numbers that are none.
// SPDX-License-Identifier: MIT
#include "isostep/particles/step/finish.hpp"

#include <limits>

#include "unit/particles/step_scene.hpp"

namespace isostep {
namespace finish_test {

template <class S> class FinishTest : public testing::Test {
 protected:
  using V = Velocity<S>;
  StepScene<S> scene_;
  FreeFlight<S> flight_{scene_.state, scene_.step};
  ParticleFinish<S> finish_{scene_.state, scene_.step, flight_};

  void begin() {
    scene_.begin();
    flight_.prepare();
  }
  D3 position(ParticleId particle) const { return StepScene<S>::real(scene_.state.position[particle.slot]); }
};
TYPED_TEST_SUITE(FinishTest, Scalars);

TYPED_TEST(FinishTest, PositionsTakeTheDisplacements) {
  StepScene<TypeParam>& scene = this->scene_;
  for (int i = 0; i < 37; ++i) scene.add({static_cast<double>(i), 0, 0});
  this->begin();
  for (std::uint32_t i = 0; i < 37; ++i) scene.step.displacement.y[i] = from_double<Velocity<TypeParam>>(0.25 * i);
  this->finish_.finalise();
  for (std::uint32_t i = 0; i < 37; ++i) EXPECT_EQ(to_double(scene.state.position.y[i]), 0.25 * i);
  EXPECT_TRUE(scene.step.report.clean());
}

TYPED_TEST(FinishTest, SpeedsAndPlacesBeyondTheLimitsAreHeldThere) {
  using S = TypeParam;
  const double edge = to_double(ParticleLimits<S>::position()), speed = to_double(ParticleLimits<S>::speed());
  StepScene<S>& scene = this->scene_;
  const ParticleId far = scene.add({edge, 0, 0}, {1, 2, 0}), fast = scene.add(kNowhere, {0, 1.25 * speed, 0});
  this->begin();
  scene.step.displacement.x[far.slot] = from_double<Velocity<S>>(edge / 1024);
  this->finish_.finalise();
  EXPECT_EQ(this->position(far).x, edge);
  EXPECT_EQ(scene.v(far).x, 0);
  EXPECT_EQ(scene.v(far).y, 2);
  EXPECT_LE(scene.v(fast).y, speed);
  EXPECT_GT(scene.v(fast).y, 0.99 * speed);
  EXPECT_EQ(scene.step.report.clamped_position, 1u);
  EXPECT_EQ(scene.step.report.clamped_speed, 1u);
}

TYPED_TEST(FinishTest, WhatIsNoNumberIsPutBackAndStoppedAndItsImpulsesForgotten) {
  using S = TypeParam;
  if constexpr (kIsFixed<S>) {
    GTEST_SKIP() << "every pattern of bits is a number";
  } else {
    StepScene<S>& scene = this->scene_;
    const ParticleId a = scene.add({1, 2, 3}), b = scene.add(kNowhere);
    scene.add_link(LinkType::rod, a, b, 1);
    this->begin();
    const S none = std::numeric_limits<S>::quiet_NaN();
    scene.step.displacement.x[a.slot] = scene.state.velocity.x[a.slot] = scene.state.link_impulses[0] = none;
    scene.state.contacts.push_back({a.slot, b.slot, none, Vec3<S>::zero()});
    this->finish_.finalise();
    EXPECT_EQ(this->position(a).x, 1);
    EXPECT_EQ(scene.v(a).x, 0);
    EXPECT_EQ(scene.step.report.stopped, 1u);
    EXPECT_EQ(scene.state.link_impulses[0], S(0));
    EXPECT_TRUE(scene.state.contacts.empty());
  }
}

}  // namespace finish_test
}  // namespace isostep
