// Contacts of particles: found, merged with the last step's, and stored; links and touches beside them.
// SPDX-License-Identifier: MIT
#include "isostep/particles/step/contacts.hpp"

#include "unit/particles/step_scene.hpp"

namespace isostep {
namespace contacts_test {

template <class S> class ContactsTest : public testing::Test {
 protected:
  using V = Velocity<S>;
  StepScene<S> scene_;
  PairSearch<S> search_{scene_.state, scene_.step};
  ParticleRows<S> rows_{scene_.state, scene_.step};
  ParticleContacts<S> contacts_{scene_.state, scene_.step, search_, rows_};

  /// Leaves rows as a solver does: what was met pressed with an impulse.
  void press(double impulse) {
    for (ParticleConstraint<S>& row : rows_.contacts()) {
      row.impulse = row.impulse_seen = from_double<V>(impulse);
      row.approach = V(-3);
    }
  }
  void find() {
    scene_.begin();
    contacts_.find();
  }
};
TYPED_TEST_SUITE(ContactsTest, Scalars);

TYPED_TEST(ContactsTest, LinksComeFirstThenContactsByKeyThenTouches) {
  using S = TypeParam;
  StepScene<S>& scene = this->scene_;
  scene.make_balls(0.5);
  const ParticleId a = scene.add({0, 0.5, 0}), b = scene.add({1, 0.5, 0}), c = scene.add({2, 0.5, 0});
  scene.state.colliders.add(Collider<S>{});
  scene.add_link(LinkType::cable, a, c, 2);
  scene.state.link_impulses[0] = Velocity<S>(5);
  ParticleTouch<S> touch;
  touch.particle = b;
  scene.state.touches.push_back(touch);
  this->find();
  ASSERT_EQ(this->rows_.links().size(), 1u);
  EXPECT_EQ(to_double(this->rows_.links()[0].impulse), 5);
  std::vector<std::uint64_t> keys;
  for (const ParticleContact<S>& contact : scene.state.contacts) keys.push_back(contact.key());
  const std::uint64_t plane = ParticleContact<S>::kCollider, one = std::uint64_t{1} << 32;
  EXPECT_EQ(keys, (std::vector<std::uint64_t>{1, plane, one | 2, one | plane, 2 * one | plane}));
  EXPECT_EQ(this->rows_.contacts().size(), 5u);
  EXPECT_EQ(this->rows_.touches().size(), 1u);
}

TYPED_TEST(ContactsTest, AContactKeepsItsImpulseAndIsToldOnce) {
  StepScene<TypeParam>& scene = this->scene_;
  scene.make_balls(0.5);
  const ParticleId a = scene.add(kNowhere), b = scene.add(kRight);
  this->find();
  this->press(2);
  this->contacts_.store(true);
  ASSERT_EQ(scene.step.events.contact_begin.size(), 1u);
  EXPECT_EQ(scene.step.events.contact_begin[0].a, a);
  EXPECT_EQ(scene.step.events.contact_begin[0].b, b);
  EXPECT_EQ(to_double(scene.step.events.contact_begin[0].speed), 3);
  this->find();
  EXPECT_EQ(to_double(this->rows_.contacts()[0].impulse), 2);
  this->press(1);
  this->contacts_.store(true);
  EXPECT_TRUE(scene.step.events.contact_begin.empty());
  EXPECT_EQ(to_double(scene.state.contacts.at(0).impulse), 1);
}

TYPED_TEST(ContactsTest, WhatBoreNothingIsForgottenAndSoAreImpulsesThatASolverDoesNotKeep) {
  StepScene<TypeParam>& scene = this->scene_;
  scene.make_balls(0.5);
  scene.add(kNowhere);
  scene.add(kRight);
  this->find();
  this->press(2);
  this->contacts_.store(false);
  ASSERT_EQ(scene.state.contacts.size(), 1u);
  EXPECT_EQ(to_double(scene.state.contacts[0].impulse), 0);
  this->find();
  this->contacts_.store(true);
  EXPECT_TRUE(scene.state.contacts.empty());
}

TYPED_TEST(ContactsTest, OfTwoMaterialsTheLesserFrictionAndTheGreaterRestitutionCount) {
  using S = TypeParam;
  StepScene<S>& scene = this->scene_;
  ParticleMaterial<S> other;
  other.radius = S(0.5);
  other.collides = true;
  other.friction = S(0.25);
  other.restitution = S(0.5);
  scene.make_balls(0.5, 0.125);
  scene.state.materials.change_all()[0].friction = S(0.75);
  scene.state.materials.add(other);
  scene.add(kNowhere);
  scene.add(kRight, kNowhere, 3);
  scene.state.material[1] = 1;
  this->find();
  const ParticleConstraint<S>& row = this->rows_.contacts()[0];
  EXPECT_EQ(to_double(row.friction), 0.25);
  EXPECT_EQ(to_double(row.restitution), 0.5);
  EXPECT_NEAR(to_double(row.share_a), 0.75, 1e-4);
  EXPECT_EQ(to_double(row.share_a) + to_double(row.share_b), 1);
}

TYPED_TEST(ContactsTest, TouchesTellWhatTheyGotAndAreUsedUp) {
  using S = TypeParam;
  StepScene<S>& scene = this->scene_;
  ParticleTouch<S> touch;
  touch.particle = scene.add(kNowhere, kNowhere, 0.5);
  touch.inverse_mass = InverseMass<S>(2);
  scene.state.touches.push_back(touch);
  scene.state.pushes.push_back({touch.particle.slot, 0, StepScene<S>::vec(kUp)});
  this->find();
  this->rows_.touches()[0].total.y = Velocity<S>(8);
  this->contacts_.store(true);
  ASSERT_EQ(scene.step.events.touch_impulses.size(), 1u);
  EXPECT_EQ(to_double(scene.step.events.touch_impulses[0].y), 2);  // 8 m/s of a reduced mass of 1/4 kg
  EXPECT_TRUE(scene.state.touches.empty());
  EXPECT_TRUE(scene.state.pushes.empty());
}

}  // namespace contacts_test
}  // namespace isostep
