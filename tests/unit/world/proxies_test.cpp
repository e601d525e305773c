// Proxies alone: which bodies might touch, as they come, change and go.
// SPDX-License-Identifier: MIT

#include "isostep/store/proxies.hpp"

#include <algorithm>

#include "unit/world/systems.hpp"

namespace isostep::test {
namespace proxies_test {

using Pairs = std::vector<std::uint64_t>;

/// Bodies are boxes of 2 m around places on the x axis.
template <class S> class ProxiesOf : public ::testing::Test {
 protected:
  void place(std::uint32_t slot, double x, bool awake = true, BodyType type = BodyType::dynamic) {
    BodyState<S> state = {};
    state.slot = slot;
    state.fat = Aabb<S>::around(vec<S>(x, 0, 0), vec<S>(1, 1, 1));
    properties.type = type;
    proxies.place(state, properties, awake);
  }
  const Pairs& pairs(std::size_t budget = 1000) {
    proxies.update(contacts, budget);
    return proxies.pairs();
  }

  BodyProperties<S> properties = [] {
    BodyProperties<S> made = {};
    made.flags = body_flag::kCollide;
    made.filter = Filter{};
    return made;
  }();
  StoredShapes<S> shapes = [] {
    StoredShapes<S> one;
    StoredShape<S> shape = {};
    shape.traits = {.any_solid = true};
    one.push_back(std::make_shared<const StoredShape<S>>(shape));
    return one;
  }();
  std::vector<Contact<S>> contacts;
  Proxies<S> proxies{shapes};
};
TYPED_TEST_SUITE(ProxiesOf, SystemScalars);

TYPED_TEST(ProxiesOf, bodies_pair_whose_boxes_meet_ascending) {
  this->place(7, 0);
  this->place(2, 1.5);
  this->place(4, 3);
  EXPECT_EQ(this->pairs(), (Pairs{pair_key(2, 4), pair_key(2, 7)}));
  EXPECT_TRUE(this->proxies.present(4));
  EXPECT_FALSE(this->proxies.present(3));
  EXPECT_FALSE(this->proxies.present(8));
  EXPECT_EQ(this->proxies.bodies_left_out(), 0u);
}

TYPED_TEST(ProxiesOf, one_that_moves_leaves_some_and_meets_others) {
  for (const std::uint32_t slot : {0u, 1u, 2u}) this->place(slot, 5.0 * slot);
  EXPECT_TRUE(this->pairs().empty());
  this->place(0, 4);
  EXPECT_EQ(this->pairs(), Pairs{pair_key(0, 1)});
  this->place(0, 9);
  EXPECT_EQ(this->pairs(), Pairs{pair_key(0, 2)});
  EXPECT_EQ(this->proxies.boxes().box(0).low, vec<TypeParam>(8, -1, -1));
}

TYPED_TEST(ProxiesOf, one_that_is_removed_has_no_pairs_until_it_comes_back) {
  this->place(0, 0);
  this->place(1, 1);
  EXPECT_EQ(this->pairs().size(), 1u);
  this->proxies.remove(0);
  this->proxies.remove(0);
  this->proxies.remove(9);
  EXPECT_FALSE(this->proxies.present(0));
  EXPECT_TRUE(this->pairs().empty());
  this->place(0, 1);
  EXPECT_EQ(this->pairs().size(), 1u);
}

TYPED_TEST(ProxiesOf, in_its_place_a_body_pairs_by_its_type_its_filter_and_whether_it_is_awake) {
  this->place(0, 0);
  this->place(1, 1, false);
  EXPECT_EQ(this->pairs().size(), 1u) << "one is awake";
  this->place(0, 0, false);
  EXPECT_TRUE(this->pairs().empty()) << "both sleep";
  this->place(0, 0, true, BodyType::kinematic);
  EXPECT_EQ(this->pairs().size(), 1u);
  this->place(1, 1, false, BodyType::static_);
  EXPECT_TRUE(this->pairs().empty()) << "neither can be pushed";
  this->properties.flags |= body_flag::kSensor;
  this->place(0, 0, true, BodyType::kinematic);
  EXPECT_EQ(this->pairs().size(), 1u) << "a sensor sees what it passes";
  this->properties.filter.mask = 2;
  this->place(0, 0, true, BodyType::kinematic);
  EXPECT_TRUE(this->pairs().empty());
}

TYPED_TEST(ProxiesOf, beyond_the_budget_some_pairs_are_left_out_and_the_bodies_that_lack_them_counted) {
  using S = TypeParam;
  for (std::uint32_t slot = 0; slot < 6; ++slot) this->place(slot, 0.125 * slot);
  EXPECT_EQ(this->pairs(15).size(), 15u);
  EXPECT_EQ(this->proxies.bodies_left_out(), 0u);
  Contact<S> contact = {};
  contact.key = {1, 4, 0, 0};
  this->contacts.push_back(contact);
  const Pairs few = this->pairs(5);
  EXPECT_LE(few.size(), 5u);
  EXPECT_TRUE(std::is_sorted(few.begin(), few.end()));
  EXPECT_EQ(std::count(few.begin(), few.end(), pair_key(1, 4)), 1) << "those in contact come first";
  EXPECT_GT(this->proxies.bodies_left_out(), 0u);
  EXPECT_EQ(this->pairs(15).size(), 15u);
  EXPECT_EQ(this->proxies.bodies_left_out(), 0u);
}

}  // namespace proxies_test
}  // namespace isostep::test
