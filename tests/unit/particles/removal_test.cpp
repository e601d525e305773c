// How particles leave: with all that names them, at once or when their lifetimes are over.
// SPDX-License-Identifier: MIT
#include "isostep/particles/removal.hpp"

#include "unit/particles/room.hpp"

namespace isostep {
namespace {

template <class S> class RemovalTest : public testing::Test {
 protected:
  using V = Velocity<S>;
  Room<S> room_;
  ParticleRemoval<S> removal_{room_.state};
  ParticleId a_ = room_.add(kRight, {1, 2, 3}), b_ = room_.add(kUp), c_ = room_.add(kNowhere);

  std::uint32_t springs() const {
    std::uint32_t taken = 0;
    for (std::uint32_t slot = 0; slot < room_.state.springs.all().size(); ++slot)
      taken += room_.state.springs.is_taken(slot) ? 1u : 0u;
    return taken;
  }
};
TYPED_TEST_SUITE(RemovalTest, Scalars);

TYPED_TEST(RemovalTest, WithAParticleGoesWhatNamesIt) {
  using S = TypeParam;
  Room<S>& room = this->room_;
  room.state.springs.add(room.spring(this->a_, this->b_, 1, 1));
  room.state.springs.add(room.spring(this->b_, this->c_, 1, 1));
  const LinkId link = room.add_link(LinkType::rod, this->c_, this->a_, 1);
  room.state.link_impulses[link.slot] = Velocity<S>(3);
  room.state.contacts = {{0, 1, {}, {}}, {1, 2, {}, {}}};
  room.state.pushes = {{0, 0, {}}, {2, 0, {}}};
  room.state.lifetimes = {{9, 0, 0}, {9, 1, 0}};
  this->removal_.remove(this->a_);
  EXPECT_FALSE(room.state.particles.holds(this->a_));
  EXPECT_TRUE(room.state.particles.holds(this->b_));
  EXPECT_EQ(this->springs(), 1u);
  EXPECT_FALSE(room.state.links.holds(link));
  EXPECT_EQ(room.state.link_impulses[link.slot], Velocity<S>(0));
  EXPECT_EQ(room.state.contacts.size(), 1u);
  EXPECT_EQ(room.state.pushes.size(), 1u);
  EXPECT_EQ(room.state.lifetimes.size(), 1u);
  EXPECT_EQ(room.v(this->a_).x, 0) << "a free slot looks the same whatever lay there";
  EXPECT_EQ(to_double(room.state.inverse_mass[this->a_.slot]), 0);
}

TYPED_TEST(RemovalTest, ACrowdExpiresAtOnceAndEventsTellWhatItWas) {
  Room<TypeParam>& room = this->room_;
  room.state.lifetimes = {{4, 0, 0}, {5, 1, 0}, {4, 2, 0}};
  room.state.tick = 3;
  ParticleEvents<TypeParam> events;
  this->removal_.expire(events);
  EXPECT_TRUE(events.expired.empty());
  room.state.tick = 4;
  this->removal_.expire(events);
  ASSERT_EQ(events.expired.size(), 2u);
  EXPECT_EQ(events.expired[0].particle, this->a_);
  EXPECT_EQ(to_double(events.expired[0].position.x), 1);
  EXPECT_EQ(to_double(events.expired[0].velocity.z), 3);
  EXPECT_EQ(events.expired[1].particle, this->c_);
  EXPECT_TRUE(room.state.particles.holds(this->b_));
  EXPECT_EQ(room.state.lifetimes.size(), 1u);
}

TYPED_TEST(RemovalTest, WithAColliderGoItsContacts) {
  Room<TypeParam>& room = this->room_;
  const ColliderId first = room.state.colliders.add({}), second = room.state.colliders.add({});
  const std::uint32_t bit = ParticleContact<TypeParam>::kCollider;
  room.state.contacts = {{0, bit | first.slot, {}, {}}, {0, bit | second.slot, {}, {}}};
  this->removal_.remove_record(first);
  ASSERT_EQ(room.state.contacts.size(), 1u);
  EXPECT_EQ(room.state.contacts[0].b, bit | second.slot);
}

}  // namespace
}  // namespace isostep
