// Laws of HitReport: how fast bodies met, told once for each time that they meet.
// SPDX-License-Identifier: MIT

#include "laws/exact_rollback.hpp"

namespace isostep::test {
namespace hit_report_test {

template <class S> class HitReports : public ::testing::Test {
 protected:
  HitReports() { ground = add_ground(w); }

  BodyId ball(D3 at, D3 velocity = {0, 0, 0}, double restitution = 0) {
    BodyDefinition<S> d = moving<S>(add_ball(w, 0.25), at, velocity);
    d.material.restitution = num<S>(restitution);
    return w.create(d);
  }
  HitReportId listen(BodyId body, double speed) {
    const HitReportId id = w.add(HitReport<S>{body, num<S>(speed)});
    EXPECT_TRUE(id) << describe(w.fault());
    return id;
  }
  std::vector<ContactHit<S>> hits_of(int steps) {
    std::vector<ContactHit<S>> all;
    for (int i = 0; i < steps; ++i) {
      w.step();
      for (const ContactHit<S>& hit : w.events().hits) all.push_back(hit);
    }
    return all;
  }

  World<S> w{settings<S>()};
  BodyId ground;
};
TYPED_TEST_SUITE(HitReports, AllScalars);

// From 5 m: 10 m/s; a step of gravity less at most, 1/6 m/s, for it is measured as the step begins.
TYPED_TEST(HitReports, a_fall_is_told_with_its_speed_place_and_normal) {
  using S = TypeParam;
  const BodyId body = this->ball({1, 5.25, 2});
  this->listen(body, 3);
  const std::vector<ContactHit<S>> hits = this->hits_of(180);
  ASSERT_EQ(hits.size(), 1u);
  EXPECT_EQ(hits[0].a, this->ground);
  EXPECT_EQ(hits[0].b, body);
  EXPECT_NEAR(to_double(hits[0].speed), 10, 0.35);
  expect_near(real(hits[0].point), {1, 0, 2}, 0.05);
  expect_near(real(hits[0].normal), {0, 1, 0}, 1e-3);
}

TYPED_TEST(HitReports, slow_meetings_and_bodies_without_a_record_are_not_told) {
  const BodyId slow = this->ball({0, 0.5, 0});  // 2.2 m/s
  this->ball({4, 5, 0});
  this->listen(slow, 3);
  EXPECT_TRUE(this->hits_of(120).empty());
}

TYPED_TEST(HitReports, each_bounce_is_one_of_its_own_until_it_is_too_slow) {
  using S = TypeParam;
  const BodyId body = this->ball({0, 5.25, 0}, {0, 0, 0}, 0.5);  // 10, 5, 2.5, 1.25 m/s
  this->listen(body, 2);
  const std::vector<ContactHit<S>> hits = this->hits_of(300);
  ASSERT_EQ(hits.size(), 3u);
  EXPECT_GT(hits[0].speed, hits[1].speed);
  EXPECT_GT(hits[1].speed, hits[2].speed);
}

TYPED_TEST(HitReports, of_two_records_the_lower_speed_counts) {
  using S = TypeParam;
  this->w.set_gravity(Vec3<S>::zero());
  const BodyId a = this->ball({0, 2, 0}), b = this->ball({2, 2, 0}, {-4, 0, 0});
  const HitReportId high = this->listen(a, 8);
  EXPECT_TRUE(this->hits_of(1).empty());
  this->listen(b, 3);
  const std::vector<ContactHit<S>> hits = this->hits_of(60);
  ASSERT_EQ(hits.size(), 1u);
  EXPECT_NEAR(to_double(hits[0].speed), 4, 0.01);
  expect_near(real(hits[0].normal), {1, 0, 0}, 1e-3);
  EXPECT_TRUE(this->w.remove(high));
}

TYPED_TEST(HitReports, wake_nobody_and_are_refused_with_bad_numbers) {
  using S = TypeParam;
  const BodyId body = this->ball({0, 0.25, 0});
  ASSERT_TRUE(settle(this->w));
  const HitReportId id = this->listen(body, 1);
  EXPECT_EQ(this->w.counts().awake, 0u);
  const std::uint64_t before = this->w.hash();
  const auto refused = [&](HitReport<S> record, Fault fault, const char* field) {
    EXPECT_FALSE(this->w.add(record));
    EXPECT_EQ(this->w.fault(), fault) << field;
    EXPECT_STREQ(this->w.fault().field, field);
    EXPECT_EQ(this->w.hash(), before) << field;
  };
  refused({body, S(1)}, Fault::bad_argument, "body");
  refused({{}, S(1)}, Fault::null_id, "body");
  refused({this->ground, S(-1)}, Fault::bad_argument, "speed");
  refused({this->ground, Limits<S>::speed() + S(1)}, Fault::out_of_range, "speed");
  if constexpr (!kIsFixed<S>) refused({this->ground, num<S>(NAN)}, Fault::not_finite, "speed");
  ASSERT_TRUE(this->w.destroy(body));
  EXPECT_EQ(this->w.find(id), nullptr);
}

TYPED_TEST(HitReports, tell_the_same_after_a_load) {
  using S = TypeParam;
  for (int i = 0; i < 6; ++i) this->listen(this->ball({0.6 * i, 1 + 0.3 * i, 0}, {0, 0, 0}, 0.5), 1);
  std::vector<std::size_t> first, again;
  int plays = 0;
  expect_exact_rollback(this->w, 120, [&](World<S>& world, int frame) {
    if (frame == 60) ++plays;
    if (frame > 60) (plays == 1 ? first : again).push_back(world.events().hits.size());
  });
  std::size_t told = 0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    told += first[i];
    EXPECT_EQ(again[i], first[i]) << i;
    EXPECT_EQ(again[first.size() + i], first[i]) << i;
  }
  EXPECT_GT(told, 0u);
}

}  // namespace hit_report_test
}  // namespace isostep::test
