// The removal of particles: with all that names them, at once or when their lifetimes are over.
// SPDX-License-Identifier: MIT
#include "isostep/particles/removal.hpp"

#include "unit/particles/step_scene.hpp"

namespace isostep {
namespace removal_test {

template <class S> class RemovalTest : public testing::Test {
 protected:
  using V = Velocity<S>;
  StepScene<S> scene_;
  ParticleRemoval<S> removal_{scene_.state};
  ParticleId a_ = scene_.add(kRight, {1, 2, 3}), b_ = scene_.add(kUp), c_ = scene_.add(kNowhere);

  std::uint32_t springs() const {
    std::uint32_t taken = 0;
    for (std::uint32_t slot = 0; slot < scene_.state.springs.all().size(); ++slot)
      taken += scene_.state.springs.is_taken(slot) ? 1u : 0u;
    return taken;
  }
};
TYPED_TEST_SUITE(RemovalTest, Scalars);

TYPED_TEST(RemovalTest, WithAParticleGoesWhatNamesIt) {
  using S = TypeParam;
  StepScene<S>& scene = this->scene_;
  scene.state.springs.add(scene.spring(this->a_, this->b_, 1, 1));
  scene.state.springs.add(scene.spring(this->b_, this->c_, 1, 1));
  const LinkId link = scene.add_link(LinkType::rod, this->c_, this->a_, 1);
  scene.state.link_impulses[link.slot] = Velocity<S>(3);
  scene.state.contacts = {{0, 1, {}, {}}, {1, 2, {}, {}}};
  scene.state.pushes = {{0, 0, {}}, {2, 0, {}}};
  scene.state.lifetimes = {{9, 0, 0}, {9, 1, 0}};
  this->removal_.remove(this->a_);
  EXPECT_FALSE(scene.state.particles.holds(this->a_));
  EXPECT_TRUE(scene.state.particles.holds(this->b_));
  EXPECT_EQ(this->springs(), 1u);
  EXPECT_FALSE(scene.state.links.holds(link));
  EXPECT_EQ(scene.state.link_impulses[link.slot], Velocity<S>(0));
  EXPECT_EQ(scene.state.contacts.size(), 1u);
  EXPECT_EQ(scene.state.pushes.size(), 1u);
  EXPECT_EQ(scene.state.lifetimes.size(), 1u);
  EXPECT_EQ(scene.v(this->a_).x, 0) << "a free slot looks the same whatever lay there";
  EXPECT_EQ(to_double(scene.state.inverse_mass[this->a_.slot]), 0);
}

TYPED_TEST(RemovalTest, ACrowdExpiresAtOnceAndEventsTellWhatItWas) {
  StepScene<TypeParam>& scene = this->scene_;
  scene.state.lifetimes = {{4, 0, 0}, {5, 1, 0}, {4, 2, 0}};
  scene.state.tick = 3;
  ParticleEvents<TypeParam> events;
  this->removal_.expire(events);
  EXPECT_TRUE(events.expired.empty());
  scene.state.tick = 4;
  this->removal_.expire(events);
  ASSERT_EQ(events.expired.size(), 2u);
  EXPECT_EQ(events.expired[0].particle, this->a_);
  EXPECT_EQ(to_double(events.expired[0].position.x), 1);
  EXPECT_EQ(to_double(events.expired[0].velocity.z), 3);
  EXPECT_EQ(events.expired[1].particle, this->c_);
  EXPECT_TRUE(scene.state.particles.holds(this->b_));
  EXPECT_EQ(scene.state.lifetimes.size(), 1u);
}

TYPED_TEST(RemovalTest, WithAColliderGoItsContacts) {
  StepScene<TypeParam>& scene = this->scene_;
  const ColliderId first = scene.state.colliders.add({}), second = scene.state.colliders.add({});
  const std::uint32_t bit = ParticleContact<TypeParam>::kCollider;
  scene.state.contacts = {{0, bit | first.slot, {}, {}}, {0, bit | second.slot, {}, {}}};
  this->removal_.remove_record(first);
  ASSERT_EQ(scene.state.contacts.size(), 1u);
  EXPECT_EQ(scene.state.contacts[0].b, bit | second.slot);
}

}  // namespace removal_test
}  // namespace isostep
