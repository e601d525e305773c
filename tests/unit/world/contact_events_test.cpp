// ContactEvents alone: the begin and the end of touches, and their impulses.
// SPDX-License-Identifier: MIT

#include "isostep/systems/events/contact_events.hpp"

#include "unit/world/systems.hpp"

namespace isostep::test {
namespace contact_events_test {

/// Slot 0 is static; slots 1 and 2 have rows 1 and 2 and 2 kg each.
template <class S> class ContactEventsOf : public ::testing::Test {
 protected:
  ContactEventsOf() : systems(made()) {}
  World<S>& made() {
    const ShapeId ball = add_ball(world, 0.5);
    for (int i = 0; i < 3; ++i) {
      BodyDefinition<S> d = moving<S>(ball, {2.0 * i, 0, 0});
      if (i == 0) d.type = BodyType::static_;
      d.mass = S(2);
      bodies[i] = world.create(d);
    }
    return world;
  }
  static std::vector<Contact<S>> contact(std::uint32_t a, std::uint32_t b, bool touching, std::uint32_t child = 0) {
    Contact<S> c = {};
    c.key = {a, b, 0, child};
    c.count = 1;
    c.flags = contact_flag::kReported | (touching ? contact_flag::kTouching : 0u);
    return {c};
  }
  static ContactGeometry<S> rows(std::uint32_t a, std::uint32_t b) {
    ContactGeometry<S> g = {};
    g.row_a = a;
    g.row_b = b;
    g.normal.y = Unit<S>(1);
    return g;
  }

  World<S> world{settings<S>(0)};
  BodyId bodies[3];
  Systems<S> systems;
  ContactEvents<S> contact_events{systems.state, systems.map};
  Events<S> events;
};
TYPED_TEST_SUITE(ContactEventsOf, SystemScalars);

TYPED_TEST(ContactEventsOf, a_touch_begins_once_with_the_impulse_of_all_parts_together) {
  using S = TypeParam;
  std::vector<Contact<S>> now = this->contact(0, 1, true), more = this->contact(0, 1, false, 1);
  now.push_back(more[0]);
  const std::vector<ContactGeometry<S>> geometry(2, this->rows(0, 1));
  const std::vector<Velocity<S>> impulses = {Velocity<S>(3), Velocity<S>(1)};
  this->contact_events.collect({{}, now, geometry, impulses}, this->events);
  ASSERT_EQ(this->events.contact_begin.size(), 1u);
  EXPECT_EQ(this->events.contact_begin[0].a, this->bodies[0]);
  EXPECT_EQ(this->events.contact_begin[0].b, this->bodies[1]);
  EXPECT_NEAR(to_double(this->events.contact_begin[0].impulse), 8, 1e-5) << "2 kg by 4 m/s";
  this->events.clear();
  this->contact_events.collect({now, now, geometry, impulses}, this->events);
  EXPECT_TRUE(this->events.contact_begin.empty());
  EXPECT_TRUE(this->events.contact_end.empty());
}

TYPED_TEST(ContactEventsOf, two_bodies_that_move_press_with_the_mass_of_the_pair) {
  using S = TypeParam;
  const std::vector<ContactGeometry<S>> geometry = {this->rows(1, 2)};
  const std::vector<Velocity<S>> impulses = {Velocity<S>(3)};
  const std::vector<Contact<S>> now = this->contact(1, 2, true);
  this->contact_events.collect({{}, now, geometry, impulses}, this->events);
  ASSERT_EQ(this->events.contact_begin.size(), 1u);
  EXPECT_NEAR(to_double(this->events.contact_begin[0].impulse), 3, 1e-5) << "2 * 2 / (2 + 2) kg by 3 m/s";
}

TYPED_TEST(ContactEventsOf, a_touch_ends_with_its_contact_or_with_its_impulse_in_the_order_of_slots) {
  using S = TypeParam;
  std::vector<Contact<S>> old = this->contact(0, 1, true);
  old.push_back(this->contact(0, 2, true)[0]);
  const std::vector<Contact<S>> now = this->contact(0, 2, false);
  const std::vector<ContactGeometry<S>> geometry = {this->rows(0, 2)};
  const std::vector<Velocity<S>> impulses = {Velocity<S>(0)};
  this->events.contact_end.push_back({this->bodies[1], this->bodies[2], 0, 0});  // that a command made
  this->contact_events.collect({old, now, geometry, impulses}, this->events);
  ASSERT_EQ(this->events.contact_end.size(), 3u);
  EXPECT_EQ(this->events.contact_end[0].b, this->bodies[1]);
  EXPECT_EQ(this->events.contact_end[1].b, this->bodies[2]);
  EXPECT_EQ(this->events.contact_end[2].a, this->bodies[1]);
}

}  // namespace contact_events_test
}  // namespace isostep::test
