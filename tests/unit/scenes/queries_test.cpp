// S14: how many of its queries hit anything, the same in every scalar and in other engines.
// SPDX-License-Identifier: MIT
#include "scenes/queries.hpp"

#include <gtest/gtest.h>

#include "scenes/build.hpp"
#include "scenes/named.hpp"

namespace isostep::scenes {
namespace queries_test {

template <class S> class SceneQueries : public testing::Test {};
using Scalars = testing::Types<float, double, Q16_16, Q32_32>;
TYPED_TEST_SUITE(SceneQueries, Scalars);

template <class S> Vec3<S> vec(Point p) { return {from_double<S>(p.x), from_double<S>(p.y), from_double<S>(p.z)}; }

TYPED_TEST(SceneQueries, hit_as_often_as_other_engines_say) {
  using S = TypeParam;
  const Scene scene = *find_scene("S14");
  World<S> world(settings_of<S>(scene));
  const Built<S> built = build(scene, world);
  ASSERT_TRUE(world.set_filter(built.bodies[0], {2, 0xffffffffu, 0}));  // the hills
  QueryFilter of_bodies;
  of_bodies.mask = 1;
  std::size_t rays = 0, casts = 0, lists = 0, overlaps = 0;
  for (const DrawnQueries& queries : drawn_queries(10)) {
    world.step();
    std::vector<RayCast<S>> asked;
    std::vector<ShapeCast<S>> cast;
    for (const DrawnLine& line : queries.rays) asked.push_back({vec<S>(line.from), vec<S>(line.way), {}});
    for (std::size_t i = 0; i < queries.casts.size(); ++i) {
      const DrawnLine& line = queries.casts[i];
      const Primitive<S> shape =
          i % 2 == 0 ? primitive_of(Sphere<S>{from_double<S>(kCastRadius)}) : primitive_of(Box<S>{vec<S>(kCastHalf)});
      cast.push_back({shape, {vec<S>(line.from), Quat<Unit<S>>::identity()}, vec<S>(line.way), {}});
    }
    std::vector<RayCastHit<S>> hits(asked.size()), list;
    std::vector<ShapeCastHit<S>> cast_hits(cast.size());
    ASSERT_TRUE(world.cast_rays(asked, hits));
    ASSERT_TRUE(world.cast_shapes(cast, cast_hits));
    for (const auto& hit : hits) rays += static_cast<bool>(hit.body);
    for (const auto& hit : cast_hits) casts += static_cast<bool>(hit.body);
    for (std::size_t i = 0; i < 1000; ++i) world.cast_ray_all(asked[i].origin, asked[i].translation, list, of_bodies);
    std::vector<BodyId> found;
    for (const auto& line : cast) {
      const Sphere<S> ball = {from_double<S>(kOverlapRadius)};
      world.overlap_shape(primitive_of(ball), line.pose, found, of_bodies);
    }
    lists += list.size();
    overlaps += found.size();
  }
  EXPECT_EQ(rays, 75892u);
  EXPECT_EQ(casts, 7305u);
  EXPECT_EQ(lists, 4297u);
  EXPECT_EQ(overlaps, 4045u);
}

}  // namespace queries_test
}  // namespace isostep::scenes
