// Carriers alone: which contacts turn with a kinematic body.
// SPDX-License-Identifier: MIT

#include "isostep/dynamics/carriers.hpp"

#include <gtest/gtest.h>

namespace isostep {
namespace carriers_test {

/// Three bodies, of rows 1, 2 and 3; the second one is a turntable.
template <class S> class CarriersOf : public ::testing::Test {
 protected:
  CarriersOf() : states(3), properties(3), geometry(2) {
    properties[0].type = properties[2].type = BodyType::dynamic;
    properties[1].type = BodyType::kinematic;
    states[1].angular_velocity.y = Velocity<S>(1);
    for (ContactGeometry<S>& g : geometry) g.points[0].arm_a.x = S(2);
    geometry[0].row_a = 1;
    geometry[0].row_b = 3;
    geometry[1].row_a = 2;
    geometry[1].row_b = 3;
  }
  const std::vector<Carried<S>>& update() {
    carriers.update(states, properties, geometry, 480);
    return carriers.carried();
  }

  std::vector<BodyState<S>> states;
  std::vector<BodyProperties<S>> properties;
  std::vector<ContactGeometry<S>> geometry;
  Carriers<S> carriers;
};
using CarrierScalars = ::testing::Types<float, Q32_32>;
TYPED_TEST_SUITE(CarriersOf, CarrierScalars);

TYPED_TEST(CarriersOf, a_contact_on_a_turning_body_is_carried) {
  using S = TypeParam;
  ASSERT_EQ(this->update().size(), 1u);
  const Carried<S>& carried = this->carriers.carried()[0];
  EXPECT_EQ(carried.contact, 1u);
  EXPECT_EQ(carried.carrier.row, 2u);
  EXPECT_EQ(carried.rider, 3u);
  EXPECT_FALSE(carried.on_b);
  EXPECT_EQ(carried.place.x, S(2));
}

TYPED_TEST(CarriersOf, from_the_other_side_the_place_has_the_other_sign) {
  this->geometry[1].row_a = 3;
  this->geometry[1].row_b = 2;
  ASSERT_EQ(this->update().size(), 1u);
  EXPECT_TRUE(this->carriers.carried()[0].on_b);
  EXPECT_EQ(this->carriers.carried()[0].place.x, TypeParam(-2));
}

TYPED_TEST(CarriersOf, what_is_not_kinematic_does_not_turn_or_may_not_turn_carries_nothing) {
  this->properties[1].flags = body_flag::kAngularLocks;
  EXPECT_TRUE(this->update().empty());
  this->properties[1].flags = 0;
  this->states[1].angular_velocity.y = Velocity<TypeParam>(0);
  EXPECT_TRUE(this->update().empty());
  this->states[1].angular_velocity.y = Velocity<TypeParam>(1);
  this->properties[1].type = BodyType::dynamic;
  EXPECT_TRUE(this->update().empty());
}

}  // namespace carriers_test
}  // namespace isostep
