// Queries alone: what a ray and a box meet. Worlds' own answers: world_queries_test.cpp.
// SPDX-License-Identifier: MIT

#include "isostep/query/cast_queries.hpp"
#include "isostep/query/overlap_queries.hpp"

#include "unit/world/systems.hpp"

namespace isostep::test {
namespace queries_test {

/// Three balls in a row.
template <class S> class QueriesOf : public ::testing::Test {
 protected:
  QueriesOf() : systems(made()) {}
  World<S>& made() {
    const ShapeId ball = add_ball(world, 0.5);
    for (int i = 0; i < 3; ++i) balls[i] = world.create(moving<S>(ball, {2.0 * i, 0, 0}));
    return world;
  }

  World<S> world{settings<S>(0)};
  BodyId balls[3];
  Systems<S> systems;
  FaultLog faults;
  CastQueries<S> casts{systems.state, systems.map, systems.proxies, faults};
  OverlapQueries<S> overlaps{systems.state, systems.map, systems.proxies, faults};
};
TYPED_TEST_SUITE(QueriesOf, SystemScalars);

TYPED_TEST(QueriesOf, a_ray_meets_the_nearest_body_that_it_may_see) {
  using S = TypeParam;
  const Vec3<S> from = vec<S>(-2, 0, 0), way = vec<S>(8, 0, 0);
  const auto hit = this->casts.cast_ray(from, way, {});
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->body, this->balls[0]);
  EXPECT_NEAR(to_double(hit->point.x), -0.5, 1e-4);
  QueryFilter others;
  others.ignore = this->balls[0];
  const auto behind = this->casts.cast_ray(from, way, others);
  ASSERT_TRUE(behind);
  EXPECT_EQ(behind->body, this->balls[1]);
  std::vector<RayCastHit<S>> all;
  this->casts.cast_ray_all(from, way, all, {});
  ASSERT_EQ(all.size(), 3u);
  EXPECT_EQ(all[2].body, this->balls[2]);
}

TYPED_TEST(QueriesOf, bodies_in_a_box_come_ascending_by_slot) {
  using S = TypeParam;
  std::vector<BodyId> found;
  this->overlaps.overlap_aabb({vec<S>(-1, -1, -1), vec<S>(3, 1, 1)}, found, {});
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0], this->balls[0]);
  EXPECT_EQ(found[1], this->balls[1]);
}

TYPED_TEST(QueriesOf, a_question_that_is_refused_leaves_its_fault_in_the_log) {
  using S = TypeParam;
  EXPECT_FALSE(this->overlaps.closest_point(vec<S>(0, 0, 0), S(-1), {}));
  EXPECT_EQ(this->faults.last().fault, Fault::bad_argument);
  EXPECT_STREQ(this->faults.last().field, "max_distance");
  EXPECT_STREQ(this->faults.last().command, "closest_point");
}

}  // namespace queries_test
}  // namespace isostep::test
