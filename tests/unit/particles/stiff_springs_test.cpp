// Stiff springs over one sub-step: exact where they are alone, backward Euler beside a constraint.
// SPDX-License-Identifier: MIT
#include "isostep/particles/step/stiff_springs.hpp"

#include "unit/particles/step_scene.hpp"

namespace isostep {
namespace stiff_springs_test {

template <class S> class StiffSpringsTest : public testing::Test {
 protected:
  StepScene<S> scene_;
  StiffSprings<S> springs_{scene_.state, scene_.step};
  ParticleId a_ = scene_.add(kRight);

  /// [N/m] of 1 kg: k h^2 = 1/4.
  double stiffness() const { return 0.25 / (scene_.h() * scene_.h()); }
  void swing(const std::vector<ParticleConstraint<S>>& rows = {}) {
    Spring<S> spring = scene_.spring(a_, {}, stiffness(), 0);
    spring.type = SpringType::stiff;
    scene_.state.springs.add(spring);
    scene_.begin();
    springs_.prepare(rows);
    springs_.swing();
  }
};
TYPED_TEST_SUITE(StiffSpringsTest, Scalars);

TYPED_TEST(StiffSpringsTest, AloneItSwingsExactly) {
  this->swing();
  EXPECT_NEAR(this->scene_.d(this->a_).x, std::cos(0.5) - 1, 64 * grain<TypeParam>(1));
  EXPECT_NEAR(this->scene_.v(this->a_).x, -0.5 * std::sin(0.5) / this->scene_.h(), 64 * grain<TypeParam>(64) + 0.01);
}

TYPED_TEST(StiffSpringsTest, BesideAConstraintItIsTakenByBackwardEuler) {
  ParticleConstraint<TypeParam> row = {};
  row.a = this->a_.slot;
  row.b = kNoParticle;
  this->swing({row});
  EXPECT_NEAR(this->scene_.d(this->a_).x, -0.2, 64 * grain<TypeParam>(1));  // -k h^2 / (1 + k h^2)
  EXPECT_NEAR(this->scene_.v(this->a_).x, -0.2 / this->scene_.h(), 64 * grain<TypeParam>(64) + 0.01);
}

TYPED_TEST(StiffSpringsTest, AsAForceItPullsByItsStiffness) {
  this->swing();
  this->springs_.pull();
  EXPECT_NEAR(this->scene_.a(this->a_).x, -this->stiffness(), 1e-3 * this->stiffness());
}

}  // namespace stiff_springs_test
}  // namespace isostep
