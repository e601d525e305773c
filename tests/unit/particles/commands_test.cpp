// The execution of commands on a state alone: what they change, and what they refuse without a change.
// SPDX-License-Identifier: MIT
#include "isostep/particles/commands.hpp"

#include "unit/particles/step_scene.hpp"

namespace isostep {
namespace commands_test {

template <class S> class CommandsTest : public testing::Test {
 protected:
  StepScene<S> scene_;
  FaultLog faults_;
  ParticleRemoval<S> removal_{scene_.state};
  ParticleCommands<S> commands_{scene_.state, faults_, removal_};

  ParticleId create(double mass = 1, std::uint32_t lifetime = 0) {
    ParticleDefinition<S> definition;
    definition.mass = from_double<S>(mass);
    definition.lifetime = lifetime;
    return commands_.execute(CreateParticle<S>{definition});
  }
};
TYPED_TEST_SUITE(CommandsTest, Scalars);

TYPED_TEST(CommandsTest, CreatedParticlesTakeFreeSlotsAndLifetimesStayAscending) {
  StepScene<TypeParam>& scene = this->scene_;
  const ParticleId first = this->create(4, 7), second = this->create(1, 5);
  EXPECT_EQ(to_double(scene.state.inverse_mass[first.slot]), 0.25);
  EXPECT_TRUE(this->commands_.execute(DestroyParticle{first}));
  const ParticleId third = this->create(1, 2);
  EXPECT_EQ(third.slot, first.slot);
  EXPECT_FALSE(third == first);
  ASSERT_EQ(scene.state.lifetimes.size(), 2u);
  EXPECT_EQ(scene.state.lifetimes[0].slot, third.slot);
  EXPECT_EQ(scene.state.lifetimes[1].slot, second.slot);
}

TYPED_TEST(CommandsTest, WhatIsRefusedChangesNothingAndLeavesItsFault) {
  StepScene<TypeParam>& scene = this->scene_;
  EXPECT_FALSE(this->create(0));
  EXPECT_TRUE(this->faults_.last() == Fault::bad_mass);
  EXPECT_TRUE(scene.state.material.empty());
  EXPECT_FALSE(this->commands_.execute(DestroyParticle{{3, 1}}));
  EXPECT_TRUE(this->faults_.last() == Fault::stale_id);
  EXPECT_FALSE(this->commands_.execute(RemoveRecord<ParticleMaterialId>{scene.state.first_material()}));
  EXPECT_TRUE(this->faults_.last() == Fault::shape_in_use);
}

TYPED_TEST(CommandsTest, ForcesOfOneParticleAddUpUntilTheStep) {
  using S = TypeParam;
  StepScene<S>& scene = this->scene_;
  const ParticleId a = this->create(2), b = this->create(2);
  EXPECT_TRUE(this->commands_.execute(PushParticle<S>{b, StepScene<S>::vec({6, 0, 0})}));
  EXPECT_TRUE(this->commands_.execute(PushParticle<S>{a, StepScene<S>::vec({2, 0, 0})}));
  EXPECT_TRUE(this->commands_.execute(PushParticle<S>{b, StepScene<S>::vec({0, 4, 0})}));
  ASSERT_EQ(scene.state.pushes.size(), 2u);
  EXPECT_EQ(scene.state.pushes[0].slot, a.slot);
  EXPECT_EQ(to_double(scene.state.pushes[1].acceleration.x), 3);
  EXPECT_EQ(to_double(scene.state.pushes[1].acceleration.y), 2);
  EXPECT_TRUE(this->commands_.execute(KickParticle<S>{a, StepScene<S>::vec({2, 0, 0})}));
  EXPECT_EQ(scene.v(a).x, 1);
}

TYPED_TEST(CommandsTest, ALinkThatBecomesAnotherForgetsWhatItBore) {
  using S = TypeParam;
  using V = Velocity<S>;
  StepScene<S>& scene = this->scene_;
  Link<S> link;
  link.a = this->create();
  link.b = this->create();
  const LinkId id = this->commands_.execute(AddRecord<Link<S>>{link});
  ASSERT_TRUE(static_cast<bool>(id));
  scene.state.link_impulses[id.slot] = V(2);
  link.length = S(3);
  EXPECT_TRUE((this->commands_.execute(SetRecord<Link<S>, LinkId>{id, link})));
  EXPECT_EQ(scene.state.link_impulses[id.slot], V(2));
  link.type = LinkType::rod;
  EXPECT_TRUE((this->commands_.execute(SetRecord<Link<S>, LinkId>{id, link})));
  EXPECT_EQ(scene.state.link_impulses[id.slot], V(0));
  EXPECT_TRUE(this->commands_.execute(RemoveRecord<LinkId>{id}));
  EXPECT_FALSE(scene.state.links.holds(id));
}

}  // namespace commands_test
}  // namespace isostep
