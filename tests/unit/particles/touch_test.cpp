// Touches: contacts that somebody outside found. What they do to a particle, and what they say they gave.
// SPDX-License-Identifier: MIT
#include "isostep/particles/touch.hpp"

#include <limits>

#include "isostep/particles/limits.hpp"
#include "isostep/particles/particle_state.hpp"
#include "isostep/particles/particle_world.hpp"
#include "unit/world/worlds.hpp"

namespace isostep::test {
namespace touch_test {

template <class S> class TouchOf : public ::testing::Test {
 protected:
  ParticleWorld<S> world_{ParticleSettings<S>{.gravity = vec<S>(0, 0, 0)}};

  ParticleId add(D3 velocity, double mass) {
    ParticleDefinition<S> d;
    d.velocity = vec<S>(velocity);
    d.mass = num<S>(mass);
    return world_.create(d);
  }
  /// A touch of something above.
  static ParticleTouch<S> above(ParticleId particle, double gap, double speed, double inverse_mass) {
    ParticleTouch<S> touch = {};
    touch.particle = particle;
    touch.normal = {Unit<S>(0), Unit<S>(1), Unit<S>(0)};
    touch.separation = num<S>(gap);
    touch.surface_velocity.y = num<Velocity<S>>(speed);
    touch.inverse_mass = num<InverseMass<S>>(inverse_mass);
    return touch;
  }
};
TYPED_TEST_SUITE(TouchOf, AllScalars);

TYPED_TEST(TouchOf, both_sides_get_opposite_impulses_however_heavy_the_other_is) {
  using S = TypeParam;
  for (const double inverse_mass : {4.0, 0.0625, 0.0009765625, 0.0}) {
    const ParticleId p = this->add({0, 3, 0}, 0.5);
    ASSERT_TRUE(this->world_.touch(this->above(p, 0, 0, inverse_mass)));
    this->world_.step();
    const double impulse = 3 / (2 + inverse_mass);
    ASSERT_EQ(this->world_.events().touch_impulses.size(), 1u);
    const D3 told = real(this->world_.events().touch_impulses[0]);
    expect_near(told, {0, impulse, 0}, 8 * grain<S>(3));
    EXPECT_NEAR(told.y, (3 - to_double(this->world_.velocity(p).y)) * 0.5, 8 * grain<S>(3)) << inverse_mass;
    EXPECT_TRUE(this->world_.state().touches.empty());
    this->world_.destroy(p);
  }
}

TYPED_TEST(TouchOf, a_pinned_particle_gives_all_the_other_brings) {
  using S = TypeParam;
  ParticleDefinition<S> d;
  d.pinned = true;
  const ParticleId p = this->world_.create(d);
  ASSERT_TRUE(this->world_.touch(this->above(p, 0.01, -2, 0.25)));
  this->world_.step();
  expect_near(real(this->world_.events().touch_impulses[0]), {0, 8, 0}, 64 * grain<S>());
  expect_near(real(this->world_.velocity(p)), {0, 0, 0}, 0);
}

TYPED_TEST(TouchOf, what_moves_pushes_and_what_leaves_does_not) {
  using S = TypeParam;
  const ParticleId pushed = this->add({0, 0, 0}, 1), left = this->add({0, 0, 0}, 1), far = this->add({0, 0, 0}, 1);
  this->world_.touch(this->above(pushed, 0, -3, 0));
  this->world_.touch(this->above(left, 0, 3, 0));
  this->world_.touch(this->above(far, 0.1, -3, 0));  // comes as near as 0.05
  this->world_.step();
  EXPECT_NEAR(to_double(this->world_.velocity(pushed).y), -3, 8 * grain<S>(3));
  EXPECT_NEAR(to_double(this->world_.position(pushed).y), -0.05, 0.001);  // as far as the surface went
  EXPECT_EQ(to_double(this->world_.position(left).y), 0);
  EXPECT_EQ(to_double(this->world_.position(far).y), 0);
}

TYPED_TEST(TouchOf, a_surface_that_speeds_up_by_itself_gives_that_over_the_step) {
  using S = TypeParam;
  const ParticleId p = this->add({0, 0, 0}, 2);
  ParticleTouch<S> touch = this->above(p, 0, 0, 0);
  touch.surface_acceleration.y = num<S>(-12);
  this->world_.touch(touch);
  this->world_.step();
  EXPECT_NEAR(to_double(this->world_.velocity(p).y), -0.2, 1e-4);
  EXPECT_NEAR(to_double(this->world_.events().touch_impulses[0].y), 0.4, 2e-4);
}

TYPED_TEST(TouchOf, numbers_that_are_none_or_too_large_are_refused) {
  using S = TypeParam;
  const ParticleId p = this->add({0, 0, 0}, 1);
  const ParticleTouch<S> good = this->above(p, 0, 0, 1);
  const auto refused = [&](const ParticleTouch<S>& touch, Fault fault) {
    EXPECT_FALSE(this->world_.touch(touch));
    EXPECT_EQ(this->world_.fault(), fault);
  };
  ParticleTouch<S> touch = good;
  touch.normal.x = Unit<S>(0.25);
  refused(touch, Fault::bad_argument);
  touch = good;
  touch.inverse_mass = -touch.inverse_mass;
  refused(touch, Fault::bad_argument);
  touch = good;
  touch.restitution = S(2);
  refused(touch, Fault::bad_argument);
  touch = good;
  touch.friction = S(17);
  refused(touch, Fault::out_of_range);
  touch = good;
  touch.particle = {};
  refused(touch, Fault::bad_argument);
  if constexpr (!kIsFixed<S>) {
    touch = good;
    touch.surface_acceleration.z = std::numeric_limits<S>::infinity();
    refused(touch, Fault::not_finite);
    touch = good;
    touch.surface_acceleration.z = ParticleLimits<S>::acceleration() * S(2);
    refused(touch, Fault::out_of_range);
  }
  EXPECT_TRUE(this->world_.state().touches.empty());
  EXPECT_TRUE(this->world_.touch(good));
  this->world_.destroy(p);
  EXPECT_TRUE(this->world_.state().touches.empty());
}

}  // namespace touch_test
}  // namespace isostep::test
