// Where particles end a step: limits of speed and position, and numbers that are none.
// SPDX-License-Identifier: MIT
#include "isostep/particles/step/finish.hpp"

#include <limits>

#include "unit/particles/room.hpp"

namespace isostep {
namespace {

template <class S> class FinishTest : public testing::Test {
 protected:
  using V = Velocity<S>;
  Room<S> room_;
  FreeFlight<S> flight_{room_.state, room_.step};
  ParticleFinish<S> finish_{room_.state, room_.step, flight_};

  void begin() {
    room_.begin();
    flight_.prepare();
  }
  D3 position(ParticleId particle) const { return Room<S>::real(room_.state.position[particle.slot]); }
};
TYPED_TEST_SUITE(FinishTest, Scalars);

TYPED_TEST(FinishTest, PositionsTakeTheDisplacements) {
  Room<TypeParam>& room = this->room_;
  for (int i = 0; i < 37; ++i) room.add({static_cast<double>(i), 0, 0});
  this->begin();
  for (std::uint32_t i = 0; i < 37; ++i) room.step.displacement.y[i] = from_double<Velocity<TypeParam>>(0.25 * i);
  this->finish_.finalise();
  for (std::uint32_t i = 0; i < 37; ++i) EXPECT_EQ(to_double(room.state.position.y[i]), 0.25 * i);
  EXPECT_TRUE(room.step.report.clean());
}

TYPED_TEST(FinishTest, SpeedsAndPlacesBeyondTheLimitsAreHeldThere) {
  using S = TypeParam;
  const double edge = to_double(ParticleLimits<S>::position()), speed = to_double(ParticleLimits<S>::speed());
  Room<S>& room = this->room_;
  const ParticleId far = room.add({edge, 0, 0}, {1, 2, 0}), fast = room.add(kNowhere, {0, 1.25 * speed, 0});
  this->begin();
  room.step.displacement.x[far.slot] = from_double<Velocity<S>>(edge / 1024);
  this->finish_.finalise();
  EXPECT_EQ(this->position(far).x, edge);
  EXPECT_EQ(room.v(far).x, 0);
  EXPECT_EQ(room.v(far).y, 2);
  EXPECT_LE(room.v(fast).y, speed);
  EXPECT_GT(room.v(fast).y, 0.99 * speed);
  EXPECT_EQ(room.step.report.clamped_position, 1u);
  EXPECT_EQ(room.step.report.clamped_speed, 1u);
}

TYPED_TEST(FinishTest, WhatIsNoNumberIsPutBackAndStoppedAndItsImpulsesForgotten) {
  using S = TypeParam;
  if constexpr (kIsFixed<S>) {
    GTEST_SKIP() << "every pattern of bits is a number";
  } else {
    Room<S>& room = this->room_;
    const ParticleId a = room.add({1, 2, 3}), b = room.add(kNowhere);
    room.add_link(LinkType::rod, a, b, 1);
    this->begin();
    const S none = std::numeric_limits<S>::quiet_NaN();
    room.step.displacement.x[a.slot] = room.state.velocity.x[a.slot] = room.state.link_impulses[0] = none;
    room.state.contacts.push_back({a.slot, b.slot, none, Vec3<S>::zero()});
    this->finish_.finalise();
    EXPECT_EQ(this->position(a).x, 1);
    EXPECT_EQ(room.v(a).x, 0);
    EXPECT_EQ(room.step.report.stopped, 1u);
    EXPECT_EQ(room.state.link_impulses[0], S(0));
    EXPECT_TRUE(room.state.contacts.empty());
  }
}

}  // namespace
}  // namespace isostep
