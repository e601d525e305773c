// Destruction alone: nothing is left that names what is gone.
// SPDX-License-Identifier: MIT

#include "isostep/commands/destruction.hpp"

#include "unit/world/systems.hpp"

namespace isostep::test {
namespace destruction_test {

/// Four balls in a row; neighbours touch, and a joint ties the first to the last.
template <class S> class Destructions : public ::testing::Test {
 protected:
  Destructions() : systems(made()) {
    for (std::uint32_t i = 0; i < 3; ++i) {
      Contact<S> contact = {};
      contact.key = {balls[i].slot, balls[i + 1].slot, 0, 0};
      contact.count = 1;
      contact.flags = contact_flag::kTouching | contact_flag::kReported;
      systems.state.contacts.push_back(contact);
    }
    systems.state.overlaps = {{balls[2].slot, balls[0].slot, 0, 0}};
    systems.state.forces = {{balls[2].slot, 0, vec<S>(1, 0, 0), vec<S>(0, 0, 0)}};
  }
  World<S>& made() {
    const ShapeId ball = add_ball(world, 0.5);
    for (int i = 0; i < 4; ++i) balls[i] = world.create(moving<S>(ball, {0.9375 * i, 0, 0}));
    joint = world.create(world.joint_at(JointType::ball, balls[0], balls[3], Pose<S>::identity()));
    return world;
  }

  World<S> world{settings<S>(0)};
  BodyId balls[4];
  JointId joint;
  Systems<S> systems;
  Destruction<S> destruction{systems.state, systems.map, systems.proxies, systems.wake};
};
TYPED_TEST_SUITE(Destructions, SystemScalars);

TYPED_TEST(Destructions, a_marked_body_keeps_its_records_until_they_are_erased) {
  this->destruction.mark(this->balls[2].slot);
  EXPECT_TRUE(this->destruction.is_marked(this->balls[2].slot));
  EXPECT_EQ(this->destruction.marked(), 1u);
  EXPECT_EQ(this->systems.state.awake.states.size(), 4u);
  EXPECT_FALSE(this->systems.proxies.present(this->balls[2].slot));
  this->destruction.erase_marked();
  EXPECT_EQ(this->destruction.marked(), 0u);
  EXPECT_FALSE(this->systems.state.body_slots.holds(this->balls[2]));
}

TYPED_TEST(Destructions, contacts_overlaps_and_forces_go_and_their_ends_are_told) {
  this->destruction.mark(this->balls[2].slot);
  this->destruction.erase_marked();
  const WorldState<TypeParam>& state = this->systems.state;
  ASSERT_EQ(state.contacts.size(), 1u);
  EXPECT_EQ(state.contacts[0].key.body_b, this->balls[1].slot);
  EXPECT_TRUE(state.overlaps.empty());
  EXPECT_TRUE(state.forces.empty());
  ASSERT_EQ(state.untold.contact_end.size(), 2u);
  EXPECT_EQ(state.untold.contact_end[0].a, this->balls[1]);
  EXPECT_EQ(state.untold.contact_end[1].b, this->balls[3]);
  ASSERT_EQ(state.untold.sensor_end.size(), 1u);
  ASSERT_EQ(state.awake.states.size(), 3u);
  EXPECT_EQ(this->systems.map.location(this->balls[3].slot).index, 2u);
}

TYPED_TEST(Destructions, the_joints_of_a_body_go_with_it) {
  ASSERT_TRUE(this->systems.state.joint_slots.holds(this->joint));
  this->destruction.mark(this->balls[0].slot);
  this->destruction.erase_marked();
  EXPECT_FALSE(this->systems.state.joint_slots.holds(this->joint));
  EXPECT_TRUE(this->systems.state.joints.states.empty());
}

}  // namespace destruction_test
}  // namespace isostep::test
