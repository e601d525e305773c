// Surroundings alone: what is gathered once meets what queries of the whole world meet.
// SPDX-License-Identifier: MIT

#include "isostep/query/surroundings.hpp"

#include "isostep/core/fault_log.hpp"
#include "isostep/query/cast_queries.hpp"
#include "unit/world/systems.hpp"

namespace isostep::test {
namespace surroundings_test {

/// Balls, a tilted box and a body of two boxes on a floor.
template <class S> class SurroundingsOf : public ::testing::Test {
 protected:
  SurroundingsOf() : systems(made()) { around.begin_step(); }
  World<S>& made() {
    add_ground(world);
    for (int i = 0; i < 3; ++i) world.create(moving<S>(add_ball(world, 0.5), {2.0 * i, 0.5, 0}));
    BodyDefinition<S> tilted = still<S>(add_box(world, 0.5, 0.25, 1), {1, 1.5, 1});
    tilted.orientation = turn<S>({0, 0, 1}, 0.5);
    world.create(tilted);
    pair = world.create(
        still<S>(add_two_boxes(world, {0.25, 0.5, 0.5}, {-1, 0, 0}, {0.25, 0.5, 0.5}, {1, 0, 0}), {0, 0.5, -1.5}));
    probe = world.add_shape(Capsule<S>{num<S>(0.25), num<S>(0.5)});
    return world;
  }

  World<S> world{settings<S>(0)};
  BodyId pair;
  ShapeId probe;
  Systems<S> systems;
  FaultLog faults;
  CastQueries<S> casts{systems.state, systems.map, systems.proxies, faults};
  Surroundings<S> around{systems.state, systems.map, systems.proxies};
};
TYPED_TEST_SUITE(SurroundingsOf, SystemScalars);

TYPED_TEST(SurroundingsOf, casts_meet_what_casts_among_all_bodies_meet) {
  using S = TypeParam;
  const Pose<S> start = {vec<S>(-0.5, 0.875, 0.75), Quat<Unit<S>>::identity()};
  this->around.begin(this->probe, start, {}, {});
  this->around.gather(vec<S>(2, 1, 2));
  int met = 0;
  for (const double x : {-0.5, 0.25, 1.5, 9.0}) {  // the last leaves what was gathered
    for (const double y : {-1.0, 0.0, 0.5}) {
      for (const double z : {-3.0, -0.5, 0.25, 1.0}) {
        const Vec3<S> way = vec<S>(x, y, z);
        const auto here = this->around.cast(start.position, way);
        const auto anywhere = this->casts.cast_shape({this->probe, start, way, {}});
        ASSERT_EQ(here.has_value(), anywhere.has_value()) << x << " " << y << " " << z;
        if (!here) continue;
        ++met;
        EXPECT_EQ(here->body, anywhere->body) << x << " " << y << " " << z;
        EXPECT_EQ(here->fraction, anywhere->fraction) << x << " " << y << " " << z;
        EXPECT_EQ(here->normal, anywhere->normal) << x << " " << y << " " << z;
      }
    }
  }
  EXPECT_GT(met, 20);
}

TYPED_TEST(SurroundingsOf, what_it_overlaps_is_in_the_way_only_further_in) {
  using S = TypeParam;
  const Pose<S> inside = {vec<S>(-0.5, 1.25, 0), Quat<Unit<S>>::identity()};  // of the first ball, by 0.25 m
  this->around.begin(this->probe, inside, {}, {});
  EXPECT_FALSE(this->around.cast(inside.position, vec<S>(-1, 0, 0)));
  const auto hit = this->around.cast(inside.position, vec<S>(1, 0, 0));
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->fraction, Unit<S>(0));
}

TYPED_TEST(SurroundingsOf, contacts_are_of_every_part_within_the_margin) {
  using S = TypeParam;
  std::vector<NearContact<S>> contacts;
  const Pose<S> between = {vec<S>(0, 0.875, -1.5), Quat<Unit<S>>::identity()};  // the two boxes are 0.5 m to its sides
  this->around.begin(this->probe, between, {}, {});
  this->around.find_contacts(between.position, num<S>(0.0625), contacts);
  ASSERT_EQ(contacts.size(), 0u);
  this->around.find_contacts(between.position, num<S>(0.5625), contacts);
  int of_pair = 0;
  for (const NearContact<S>& contact : contacts) {
    if (contact.body != this->pair) continue;
    ++of_pair;
    EXPECT_NEAR(to_double(contact.separation), 0.5, 1e-3);
    EXPECT_NEAR(std::fabs(to_double(contact.normal.x)), 1, 1e-3);
  }
  EXPECT_EQ(of_pair, 2);
  this->around.find_contacts(between.position + vec<S>(0.4375, 0, 0), num<S>(0.1875), contacts);
  ASSERT_EQ(contacts.size(), 2u);  // the floor, and the nearer of the boxes
  EXPECT_EQ(contacts[1].body, this->pair);
}

TYPED_TEST(SurroundingsOf, rays_tell_the_normal_of_what_they_meet_first) {
  using S = TypeParam;
  const Pose<S> start = {vec<S>(0, 2, 0), Quat<Unit<S>>::identity()};
  this->around.begin(this->probe, start, {}, {});
  const auto normal = this->around.cast_ray(start.position, vec<S>(0, -4, 0));
  ASSERT_TRUE(normal);
  EXPECT_NEAR(to_double(normal->y), 1, 1e-3);
  EXPECT_FALSE(this->around.cast_ray(vec<S>(0, 0.5, 0), vec<S>(0, -4, 0)));  // begins in a ball
  EXPECT_FALSE(this->around.cast_ray(start.position, vec<S>(0, 4, 0)));
}

}  // namespace surroundings_test
}  // namespace isostep::test
