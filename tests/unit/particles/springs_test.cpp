// Springs as forces, and springs that yield.
// SPDX-License-Identifier: MIT
#include "isostep/particles/step/springs.hpp"

#include "isostep/particles/step/free_flight.hpp"
#include "unit/particles/room.hpp"

namespace isostep {
namespace {

template <class S> class SpringsTest : public testing::Test {
 protected:
  Room<S> room_;
  FreeFlight<S> flight_{room_.state, room_.step};
  ParticleSprings<S> springs_{room_.state, room_.step};

  void pull() {
    room_.begin();
    springs_.prepare();
    springs_.pull(flight_.kernels());
  }
};
TYPED_TEST_SUITE(SpringsTest, Scalars);

TYPED_TEST(SpringsTest, EachEndIsPulledByItsMass) {
  Room<TypeParam>& room = this->room_;
  const ParticleId a = room.add(kNowhere, kNowhere, 2), b = room.add({3, 0, 0}, kNowhere, 4);
  room.state.springs.add(room.spring(a, b, 8, 1));
  this->pull();
  EXPECT_NEAR(room.a(a).x, 8, 64 * grain<TypeParam>(8));
  EXPECT_NEAR(room.a(b).x, -4, 64 * grain<TypeParam>(8));
}

TYPED_TEST(SpringsTest, ABungeePullsAndNeverPushesAndAStiffSpringIsNoForce) {
  Room<TypeParam>& room = this->room_;
  const ParticleId a = room.add(kNowhere), b = room.add(kRight);
  Spring<TypeParam> spring = room.spring(a, b, 8, 2);
  spring.type = SpringType::bungee;
  room.state.springs.add(spring);
  spring.type = SpringType::stiff;
  spring.rest_length = TypeParam(0);
  room.state.springs.add(spring);
  this->pull();
  EXPECT_EQ(room.a(a).x, 0);
  EXPECT_EQ(room.a(b).x, 0);
}

TYPED_TEST(SpringsTest, BeyondItsLimitTheRestLengthFollows) {
  Room<TypeParam>& room = this->room_;
  const ParticleId a = room.add(kNowhere), b = room.add({3, 0, 0});
  Spring<TypeParam> spring = room.spring(a, b, 1, 1);
  spring.elastic_limit = TypeParam(4);
  room.state.springs.add(spring);
  spring.elastic_limit = TypeParam(0.5);
  const SpringId weak = room.state.springs.add(spring);
  this->pull();
  this->springs_.yield();
  EXPECT_EQ(room.step.events.yielded, std::vector<SpringId>{weak});
  EXPECT_NEAR(to_double(room.state.springs.find(weak)->rest_length), 2.5, 8 * grain<TypeParam>(3));
  EXPECT_EQ(to_double(room.state.springs.all()[0].rest_length), 1);
}

}  // namespace
}  // namespace isostep
