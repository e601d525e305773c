// Two particles of the least mass that a scalar takes: their inverse masses fill the format when they are added.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "isostep/particles/limits.hpp"
#include "isostep/particles/particle_world.hpp"

namespace isostep {
namespace least_mass_test {

template <class S> class LeastMass : public testing::Test {
 protected:
  /// Two of them at -x and x, which part with a speed each.
  void make(S x, S speed) {
    ParticleDefinition<S> particle;
    particle.mass = ParticleLimits<S>::least_mass();
    for (const int side : {-1, 1}) {
      particle.position = {S(side) * x, S(0), S(0)};
      particle.velocity = {S(side) * speed, S(0), S(0)};
      ids[side < 0 ? 0 : 1] = world.create(particle);
    }
  }
  static ParticleSettings<S> weightless() {
    ParticleSettings<S> settings;
    settings.gravity = Vec3<S>::zero();
    return settings;
  }
  double apart() const { return to_double(world.position(ids[1]).x) - to_double(world.position(ids[0]).x); }
  double middle() const { return to_double(world.position(ids[1]).x) + to_double(world.position(ids[0]).x); }

  ParticleWorld<S> world{weightless()};
  ParticleId ids[2];
};
using Scalars = testing::Types<float, double, Q16_16, Q32_32>;
TYPED_TEST_SUITE(LeastMass, Scalars);

TYPED_TEST(LeastMass, ARodHolds) {
  using S = TypeParam;
  this->make(S(0.5), S(1));
  Link<S> rod;
  rod.type = LinkType::rod;
  rod.a = this->ids[0];
  rod.b = this->ids[1];
  this->world.add(rod);
  for (int i = 0; i < 60; ++i) this->world.step();
  EXPECT_NEAR(this->apart(), 1, 0.01);
  EXPECT_NEAR(this->middle(), 0, 1e-3);
}

TYPED_TEST(LeastMass, ASpringPulls) {
  using S = TypeParam;
  for (const SpringType type : {SpringType::spring, SpringType::stiff}) {
    this->make(S(0.5), S(0));
    Spring<S> spring;
    spring.type = type;
    spring.a = this->ids[0];
    spring.b = this->ids[1];
    spring.stiffness = ParticleLimits<S>::least_mass();  // so that d'' = -2 d: 1 m shrinks to cos(sqrt 2) in a second
    this->world.add(spring);
    for (int i = 0; i < 60; ++i) this->world.step();
    EXPECT_NEAR(this->apart(), 0.15594, 0.01);
    EXPECT_NEAR(this->middle(), 0, 1e-3);
  }
}

}  // namespace least_mass_test
}  // namespace isostep
