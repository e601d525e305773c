// Springs as forces, and springs that yield.
// SPDX-License-Identifier: MIT
#include "isostep/particles/step/springs.hpp"

#include "isostep/particles/step/free_flight.hpp"
#include "unit/particles/step_scene.hpp"

namespace isostep {
namespace springs_test {

template <class S> class SpringsTest : public testing::Test {
 protected:
  StepScene<S> scene_;
  FreeFlight<S> flight_{scene_.state, scene_.step};
  ParticleSprings<S> springs_{scene_.state, scene_.step};

  void pull() {
    scene_.begin();
    springs_.prepare();
    springs_.pull(flight_.kernels());
  }
};
TYPED_TEST_SUITE(SpringsTest, Scalars);

TYPED_TEST(SpringsTest, EachEndIsPulledByItsMass) {
  StepScene<TypeParam>& scene = this->scene_;
  const ParticleId a = scene.add(kNowhere, kNowhere, 2), b = scene.add({3, 0, 0}, kNowhere, 4);
  scene.state.springs.add(scene.spring(a, b, 8, 1));
  this->pull();
  EXPECT_NEAR(scene.a(a).x, 8, 64 * grain<TypeParam>(8));
  EXPECT_NEAR(scene.a(b).x, -4, 64 * grain<TypeParam>(8));
}

TYPED_TEST(SpringsTest, ABungeePullsAndNeverPushesAndAStiffSpringIsNoForce) {
  StepScene<TypeParam>& scene = this->scene_;
  const ParticleId a = scene.add(kNowhere), b = scene.add(kRight);
  Spring<TypeParam> spring = scene.spring(a, b, 8, 2);
  spring.type = SpringType::bungee;
  scene.state.springs.add(spring);
  spring.type = SpringType::stiff;
  spring.rest_length = TypeParam(0);
  scene.state.springs.add(spring);
  this->pull();
  EXPECT_EQ(scene.a(a).x, 0);
  EXPECT_EQ(scene.a(b).x, 0);
}

TYPED_TEST(SpringsTest, BeyondItsLimitTheRestLengthFollows) {
  StepScene<TypeParam>& scene = this->scene_;
  const ParticleId a = scene.add(kNowhere), b = scene.add({3, 0, 0});
  Spring<TypeParam> spring = scene.spring(a, b, 1, 1);
  spring.elastic_limit = TypeParam(4);
  scene.state.springs.add(spring);
  spring.elastic_limit = TypeParam(0.5);
  const SpringId weak = scene.state.springs.add(spring);
  this->pull();
  this->springs_.yield();
  EXPECT_EQ(scene.step.events.yielded, std::vector<SpringId>{weak});
  EXPECT_NEAR(to_double(scene.state.springs.find(weak)->rest_length), 2.5, 8 * grain<TypeParam>(3));
  EXPECT_EQ(to_double(scene.state.springs.all()[0].rest_length), 1);
}

}  // namespace springs_test
}  // namespace isostep
