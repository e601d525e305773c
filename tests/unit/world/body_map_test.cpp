// BodyMap alone: where records lie as they come and go.
// SPDX-License-Identifier: MIT

#include "isostep/store/body_map.hpp"

#include "unit/world/systems.hpp"

namespace isostep::test {
namespace body_map_test {

template <class S> class BodyMaps : public ::testing::Test {
 protected:
  BodyMaps() {
    for (int i = 0; i < 3; ++i) ids[i] = state.body_slots.template take<BodyId>();
  }
  void insert(BodyId id, BodyType type) {
    BodyState<S> body = {};
    body.slot = id.slot;
    BodyProperties<S> properties = {};
    properties.type = type;
    map.insert(body, properties);
  }
  void expect_at(BodyId id, std::uint32_t set, std::uint32_t index) {
    EXPECT_EQ(map.location(id.slot).set, set);
    EXPECT_EQ(map.location(id.slot).index, index);
  }

  WorldState<S> state;
  BodyMap<S> map{state};
  BodyId ids[3];
};
TYPED_TEST_SUITE(BodyMaps, SystemScalars);

TYPED_TEST(BodyMaps, bodies_lie_ascending_by_slot_in_whatever_order_they_come) {
  this->insert(this->ids[2], BodyType::dynamic);
  this->insert(this->ids[1], BodyType::static_);
  this->insert(this->ids[0], BodyType::kinematic);
  this->expect_at(this->ids[0], Location::kAwake, 0);
  this->expect_at(this->ids[1], Location::kStatic, 0);
  this->expect_at(this->ids[2], Location::kAwake, 1);
  EXPECT_EQ(this->map.row_of(2), 2u);
  EXPECT_EQ(this->map.row_of(1), 0u) << "nothing moves it";
  EXPECT_EQ(this->map.row_of(kNoBody), 0u);
}

TYPED_TEST(BodyMaps, an_id_gives_its_record_and_a_stale_one_nothing) {
  this->insert(this->ids[1], BodyType::dynamic);
  ASSERT_NE(this->map.state_of(this->ids[1]), nullptr);
  EXPECT_EQ(this->map.state_of(this->ids[1])->slot, 1u);
  EXPECT_EQ(this->map.properties_of(this->ids[1])->type, BodyType::dynamic);
  this->state.body_slots.give_back(1);
  EXPECT_EQ(this->map.state_of(this->ids[1]), nullptr);
  EXPECT_EQ(this->map.properties_of(BodyId{}), nullptr);
}

TYPED_TEST(BodyMaps, joints_lie_ascending_and_one_can_be_erased) {
  using S = TypeParam;
  JointId joints[3];
  for (JointId& joint : joints) joint = this->state.joint_slots.template take<JointId>();
  for (const std::uint32_t slot : {2u, 0u, 1u}) {
    JointState<S> joint = {};
    joint.slot = slot;
    JointProperties<S> properties;
    properties.lower = S(static_cast<int>(slot));
    this->map.joints.insert(joint, properties);
  }
  this->map.joints.erase(1);
  EXPECT_EQ(this->map.joints.location(0).index, 0u);
  EXPECT_EQ(this->map.joints.location(1).set, Location::kNone);
  EXPECT_EQ(this->map.joints.location(2).index, 1u);
  EXPECT_EQ(this->map.joints.properties_of(joints[2])->lower, S(2));
}

TYPED_TEST(BodyMaps, an_island_counts_the_bodies_that_it_names_as_often_as_it_does) {
  for (const BodyId id : this->ids) this->insert(id, BodyType::dynamic);
  SleepingIsland<TypeParam> island;
  island.contacts.resize(1);
  island.contacts[0].key = {0, 2, 0, 0};
  island.joints.properties.resize(1);
  island.joints.properties[0].body_a = 2;  // b is the world
  this->map.count_names(island, 1);
  EXPECT_EQ(this->map.names(0), 1u);
  EXPECT_EQ(this->map.names(1), 0u);
  EXPECT_EQ(this->map.names(2), 2u);
  this->map.count_names(island, ~0u);
  EXPECT_EQ(this->map.names(2), 0u);
}

TYPED_TEST(BodyMaps, the_origin_of_a_body_is_not_its_centre_of_mass) {
  using S = TypeParam;
  BodyState<S> body = {};
  body.orientation = turn<S>({0, 0, 1}, kPi / 2);
  body.centre = vec<S>(1, 2, 3);
  BodyProperties<S> properties = {};
  properties.local_centre = vec<S>(1, 0, 0);
  expect_near(real(origin_pose(body, properties).position), {1, 1, 3}, 1e-5);
}

}  // namespace body_map_test
}  // namespace isostep::test
