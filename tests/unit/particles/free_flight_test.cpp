// Free flight: materials' gravity, drag and damping, and what pinned particles do.
// SPDX-License-Identifier: MIT
#include "isostep/particles/step/free_flight.hpp"

#include "unit/particles/room.hpp"

namespace isostep {
namespace {

template <class S> class FreeFlightTest : public testing::Test {
 protected:
  Room<S> room_;
  FreeFlight<S> flight_{room_.state, room_.step};

  FreeFlightTest() { room_.state.settings.gravity = Room<S>::vec({0, -10, 0}); }
  void begin() {
    room_.begin();
    flight_.prepare();
  }
};
TYPED_TEST_SUITE(FreeFlightTest, Scalars);

TYPED_TEST(FreeFlightTest, AllSubstepsAtOnceAreSubstepsOneByOne) {
  Room<TypeParam>& room = this->room_;
  const ParticleId a = room.add(kNowhere, {3, 1, -2});
  const ParticleState<TypeParam> start = room.state;
  this->begin();
  this->flight_.fly();
  const D3 v = room.v(a), d = room.d(a);
  room.state = start;
  this->begin();
  for (int i = 0; i < room.state.settings.substeps; ++i) {
    this->flight_.accelerate();
    this->flight_.advance();
  }
  EXPECT_EQ(room.v(a).y, v.y);
  EXPECT_EQ(room.d(a).x, d.x);
  EXPECT_EQ(room.d(a).y, d.y);
  EXPECT_NEAR(v.y, 1 - 10.0 / 60, 64 * grain<TypeParam>(1));
  EXPECT_NEAR(d.y, 1.0 / 60 - 10 * 10 * room.h() * room.h(), 64 * grain<TypeParam>(1));  // 1 + 2 + 3 + 4 sub-steps
}

TYPED_TEST(FreeFlightTest, AMaterialScalesGravityDragsAndDamps) {
  using S = TypeParam;
  Room<S>& room = this->room_;
  ParticleMaterial<S>& material = room.state.materials.change_all()[0];
  material.gravity_scale = S(0.5);
  material.linear_drag = S(2);
  material.damping = S(0.25);
  const ParticleId a = room.add(kNowhere, {4, 0, 0}, 2);
  this->begin();
  this->flight_.accelerate();
  EXPECT_NEAR(room.a(a).x, -4, 64 * grain<S>(4));
  EXPECT_NEAR(room.a(a).y, -5, 64 * grain<S>(5));
  this->flight_.keep_velocity(a.slot, room.state.velocity[a.slot]);
  EXPECT_NEAR(room.v(a).x, 4 * std::pow(0.25, room.h()), 64 * grain<S>(4));
}

TYPED_TEST(FreeFlightTest, PinnedParticlesGoOnAtTheirVelocity) {
  Room<TypeParam>& room = this->room_;
  const ParticleId a = room.add(kNowhere, {2, 0, 0}, kPinned);
  this->begin();
  this->flight_.fly();
  this->flight_.place();
  EXPECT_EQ(room.v(a).x, 2);
  EXPECT_EQ(room.v(a).y, 0);
  EXPECT_NEAR(to_double(room.step.now[a.slot].x), 2.0 / 60, 64 * grain<TypeParam>(1));
}

}  // namespace
}  // namespace isostep
