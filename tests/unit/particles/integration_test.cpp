// The integrators alone, over the sub-steps of one step: free fall by each, and a spring.
// SPDX-License-Identifier: MIT
#include "isostep/particles/step/integration.hpp"

#include <iterator>

#include "unit/particles/room.hpp"

namespace isostep {
namespace {

template <class S> class IntegrationTest : public testing::Test {
 protected:
  Room<S> room_;
  FreeFlight<S> flight_{room_.state, room_.step};
  ParticleSprings<S> springs_{room_.state, room_.step};
  StiffSprings<S> stiff_springs_{room_.state, room_.step};
  ParticleForces<S> forces_{room_.state, room_.step, flight_, springs_};
  ParticleIntegration<S> integration_{room_.state, room_.step, flight_, forces_, stiff_springs_};

  void begin(Integrator integrator) {
    room_.state.settings.integrator = integrator;
    room_.begin();
    flight_.prepare();
    springs_.prepare();
    stiff_springs_.prepare({});
  }
  void fly(Integrator integrator) {
    begin(integrator);
    for (int i = 0; i < room_.state.settings.substeps; ++i) {
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
    Room<TypeParam>& room = this->room_;
    room.state.settings.gravity = Room<TypeParam>::vec({0, -10, 0});
    const ParticleId a = room.add(kNowhere);
    this->fly(each.integrator);
    const double slack = 64 * grain<TypeParam>(1);
    EXPECT_NEAR(room.v(a).y, -10.0 / 60, slack) << static_cast<std::uint32_t>(each.integrator);
    EXPECT_NEAR(room.d(a).y, -10 * each.way * room.h() * room.h(), slack)
        << static_cast<std::uint32_t>(each.integrator);
  }
}

/// k h^2 / m = 0.01: four sub-steps are a turn of 0.4.
TYPED_TEST(IntegrationTest, HigherOrdersFollowASpring) {
  Room<TypeParam>& room = this->room_;
  const double k = 0.01 / (room.h() * room.h());
  const ParticleId a = room.add(kRight);
  room.state.springs.add(room.spring(a, {}, k, 0));
  const double way = std::cos(0.4) - 1;
  const ParticleState<TypeParam> start = room.state;
  const auto error_of = [&](Integrator integrator) {
    room.state = start;
    this->fly(integrator);
    return std::abs(room.d(a).x - way);
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
  Room<TypeParam>& room = this->room_;
  room.state.settings.gravity = Room<TypeParam>::vec({0, -10, 0});
  const ParticleId a = room.add(kNowhere);
  const ParticleState<TypeParam> start = room.state;
  const double gained = -10 * room.h(), slack = 64 * grain<TypeParam>(1);
  for (const Case& each : cases) {
    SCOPED_TRACE(kIntegratorNames[static_cast<std::uint32_t>(each.integrator)]);
    room.state = start;
    this->begin(each.integrator);
    EXPECT_EQ(this->integration_.arrives(), each.arrives);
    this->integration_.integrate(false);
    EXPECT_NEAR(room.v(a).y, each.way * gained, slack);
    room.state = start;
    this->begin(each.integrator);
    this->integration_.fly();
    EXPECT_NEAR(room.v(a).y, gained, slack) << "of the sub-step's end";
  }
}

}  // namespace
}  // namespace isostep
