// The integrators alone, over the sub-steps of one step: free fall by each, and a spring.
// SPDX-License-Identifier: MIT
#include "isostep/particles/step/integration.hpp"

#include <iterator>

#include "unit/particles/step_scene.hpp"

namespace isostep {
namespace integration_test {

template <class S> class IntegrationTest : public testing::Test {
 protected:
  StepScene<S> scene_;
  FreeFlight<S> flight_{scene_.state, scene_.step};
  ParticleSprings<S> springs_{scene_.state, scene_.step};
  StiffSprings<S> stiff_springs_{scene_.state, scene_.step};
  ParticleForces<S> forces_{scene_.state, scene_.step, flight_, springs_};
  ParticleIntegration<S> integration_{scene_.state, scene_.step, flight_, forces_, stiff_springs_};

  void begin(Integrator integrator) {
    scene_.state.settings.integrator = integrator;
    scene_.begin();
    flight_.prepare();
    springs_.prepare();
    stiff_springs_.prepare({});
  }
  void fly(Integrator integrator) {
    begin(integrator);
    for (int i = 0; i < scene_.state.settings.substeps; ++i) {
      integration_.fly();
      integration_.place();
    }
  }
};
TYPED_TEST_SUITE(IntegrationTest, Scalars);

TYPED_TEST(IntegrationTest, FreeFallOfFourSubsteps) {
  struct Case {
    Integrator integrator;
    double way;  // [g h^2]
  };
  const Case cases[] = {{Integrator::explicit_euler, 0 + 1 + 2 + 3},
                        {Integrator::semi_implicit_euler, 1 + 2 + 3 + 4},
                        {Integrator::implicit_euler, 1 + 2 + 3 + 4},
                        {Integrator::velocity_verlet, 8},
                        {Integrator::rk4, 8}};
  for (const Case& each : cases) {
    StepScene<TypeParam>& scene = this->scene_;
    scene.state.settings.gravity = StepScene<TypeParam>::vec({0, -10, 0});
    const ParticleId a = scene.add(kNowhere);
    this->fly(each.integrator);
    const double slack = 64 * grain<TypeParam>(1);
    EXPECT_NEAR(scene.v(a).y, -10.0 / 60, slack) << static_cast<std::uint32_t>(each.integrator);
    EXPECT_NEAR(scene.d(a).y, -10 * each.way * scene.h() * scene.h(), slack)
        << static_cast<std::uint32_t>(each.integrator);
  }
}

/// k h^2 / m = 0.01: four sub-steps are a turn of 0.4.
TYPED_TEST(IntegrationTest, HigherOrdersFollowASpring) {
  StepScene<TypeParam>& scene = this->scene_;
  const double k = 0.01 / (scene.h() * scene.h());
  const ParticleId a = scene.add(kRight);
  scene.state.springs.add(scene.spring(a, {}, k, 0));
  const double way = std::cos(0.4) - 1;
  const ParticleState<TypeParam> start = scene.state;
  const auto error_of = [&](Integrator integrator) {
    scene.state = start;
    this->fly(integrator);
    return std::abs(scene.d(a).x - way);
  };
  const double slack = 64 * grain<TypeParam>(1);
  EXPECT_LT(error_of(Integrator::rk4), 1e-5 + slack);
  EXPECT_LT(error_of(Integrator::velocity_verlet), 1e-3);
  EXPECT_GT(error_of(Integrator::semi_implicit_euler), 5e-3);
  EXPECT_GT(error_of(Integrator::explicit_euler), 5e-3);
}

/// Free fall: constraints see the velocity of the way, and arrive() makes it that of the sub-step's end.
TYPED_TEST(IntegrationTest, OnlyMethodsWithALaterVelocityArrive) {
  struct Case {
    Integrator integrator;
    bool arrives;
    double way;  // [g h] the velocity of the way
  };
  const Case cases[] = {{Integrator::explicit_euler, false, 1},
                        {Integrator::semi_implicit_euler, false, 1},
                        {Integrator::velocity_verlet, true, 0.5},
                        {Integrator::rk4, true, 0.5},
                        {Integrator::implicit_euler, false, 1}};
  ASSERT_EQ(std::size(cases), kIntegrators);
  StepScene<TypeParam>& scene = this->scene_;
  scene.state.settings.gravity = StepScene<TypeParam>::vec({0, -10, 0});
  const ParticleId a = scene.add(kNowhere);
  const ParticleState<TypeParam> start = scene.state;
  const double gained = -10 * scene.h(), slack = 64 * grain<TypeParam>(1);
  for (const Case& each : cases) {
    SCOPED_TRACE(kIntegratorNames[static_cast<std::uint32_t>(each.integrator)]);
    scene.state = start;
    this->begin(each.integrator);
    EXPECT_EQ(this->integration_.arrives(), each.arrives);
    this->integration_.integrate(false);
    EXPECT_NEAR(scene.v(a).y, each.way * gained, slack);
    scene.state = start;
    this->begin(each.integrator);
    this->integration_.fly();
    EXPECT_NEAR(scene.v(a).y, gained, slack) << "of the sub-step's end";
  }
}

}  // namespace integration_test
}  // namespace isostep
