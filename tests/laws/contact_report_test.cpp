// Laws of ContactReport: every step tells where a body is touched, and by how much it is pressed there.
// SPDX-License-Identifier: MIT

#include "unit/world/worlds.hpp"

namespace isostep::test {
namespace contact_report_test {

template <class S> class ContactReports : public ::testing::Test {
 protected:
  std::vector<ContactPoint<S>> of(BodyId body) const {
    std::vector<ContactPoint<S>> points;
    w.contacts_of(body, points);
    return points;
  }
  static double impulse(const std::vector<ContactPoint<S>>& points) {
    double sum = 0;
    for (const ContactPoint<S>& p : points) sum += to_double(p.impulse);
    return sum;
  }
  BodyId box(D3 at, D3 half, double mass) {
    BodyDefinition<S> d = moving<S>(add_box(w, half.x, half.y, half.z), at);
    d.mass = num<S>(mass);
    d.allow_sleep = false;
    return w.create(d);
  }

  World<S> w{settings<S>()};
};
TYPED_TEST_SUITE(ContactReports, AllScalars);

/// m g h each step: of the lower one that of both.
TYPED_TEST(ContactReports, what_lies_on_others_presses_them_by_its_weight) {
  using S = TypeParam;
  const BodyId ground = add_ground(this->w);
  const BodyId low = this->box({0, 0.5, 0}, {0.5, 0.5, 0.5}, 4), high = this->box({0, 1.25, 0}, {0.25, 0.25, 0.25}, 2);
  ASSERT_TRUE(this->w.add(ContactReport<S>{low}));
  run(this->w, 120);
  double below = 0, above = 0;
  for (int i = 0; i < 60; ++i) {
    run(this->w, 1);
    below += this->impulse(this->of(ground));
    above += this->impulse(this->of(high));
  }
  EXPECT_NEAR(below, 60, 1);
  EXPECT_NEAR(above, 20, 0.5);
  const std::vector<ContactPoint<S>> points = this->of(low);
  EXPECT_EQ(points.size(), 8u);
  for (const ContactPoint<S>& p : points) {
    const bool on_ground = p.a == ground;
    EXPECT_NEAR(to_double(p.normal.y), 1, 1e-3);
    EXPECT_NEAR(to_double(p.point.y), on_ground ? 0 : 1, 0.02);
    EXPECT_NEAR(std::abs(to_double(p.point.x)), on_ground ? 0.5 : 0.25, 0.02);
    EXPECT_LT(std::abs(to_double(p.separation)), 0.02);
    EXPECT_NEAR(to_double(p.impulse), (on_ground ? 60 : 20) / 60.0 / 4, 0.05);
  }
}

/// The points of an impact share all that the event of its beginning tells.
TYPED_TEST(ContactReports, the_points_of_a_blow_give_what_the_event_tells) {
  using S = TypeParam;
  add_ground(this->w);
  const BodyId body = this->box({0, 1, 0}, {0.5, 0.5, 0.5}, 3);
  this->w.add(ContactReport<S>{body});
  for (int i = 0; i < 60; ++i) {
    run(this->w, 1);
    if (this->w.events().contact_begin.empty()) continue;
    const double told = to_double(this->w.events().contact_begin[0].impulse);
    EXPECT_NEAR(this->impulse(this->of(body)), told, 1e-3 * told + 8 * grain<S>());
    EXPECT_GT(told, 3 * 2.5);
    return;
  }
  FAIL() << "it never landed";
}

TYPED_TEST(ContactReports, a_record_changes_nothing_that_moves_and_is_one_a_body) {
  using S = TypeParam;
  World<S> other(settings<S>());
  for (World<S>* world : {&this->w, &other}) {
    add_ground(*world);
    const ShapeId cube = add_box(*world, 0.5, 0.5, 0.5);
    for (int i = 0; i < 3; ++i) world->create(moving<S>(cube, {0.125 * i, 0.5 + i, 0}));
  }
  const BodyId body = this->w.bodies()[1];
  const ContactReportId id = this->w.add(ContactReport<S>{body});
  ASSERT_TRUE(id);
  EXPECT_FALSE(this->w.add(ContactReport<S>{body}));
  EXPECT_STREQ(this->w.fault().field, "body");
  for (int i = 0; i < 60; ++i) {
    this->w.step();
    other.step();
    ASSERT_EQ(this->w.pose(body).position, other.pose(body).position) << i;
  }
  EXPECT_TRUE(other.events().contacts.empty());
  this->w.remove(id);
  this->w.step();
  EXPECT_TRUE(this->of(body).empty());
}

}  // namespace contact_report_test
}  // namespace isostep::test
