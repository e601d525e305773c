// Laws of what random worlds answer: as a search of everything, in one order, the first of all, alone as in a batch.
// ISOSTEP_RANDOM_WORLDS=2000 tries so many seeds; without it a sample is.
// SPDX-License-Identifier: MIT
#include "random/asked.hpp"
#include "random/full_search.hpp"
#include "random/questions.hpp"
#include "random/world.hpp"

namespace isostep::test {
namespace random_queries_test {

template <class S> class RandomQueryLaws : public ::testing::Test {
 protected:
  static constexpr std::uint64_t kFrames = 60, kEvery = 6;

  /// ask(world, questions, seed) every few frames of every seed.
  template <class Ask> static void visit(std::uint64_t seeds, const Ask& ask) {
    for (std::uint64_t seed = 0; seed < asked("ISOSTEP_RANDOM_WORLDS", seeds); ++seed) {
      RandomWorld<S> random(seed, SolverName::soft_step);
      for (std::uint64_t f = 0; f < kFrames; ++f) {
        RandomWorld<S>::command(random.world, seed, f);
        random.world.step();
        if (f % kEvery != kEvery - 1) continue;
        ask(random.world, draw_questions(random.world, seed * 32452867 + f * 86028121 + 2), static_cast<int>(seed));
        if (HasFatalFailure()) return;
      }
    }
  }
  template <class Hit> static void expect_in_order(const std::vector<Hit>& all, int seed) {
    const auto key = [](const Hit& h) { return std::tuple(to_double(h.fraction), h.body.slot, h.child, h.triangle); };
    for (std::size_t i = 1; i < all.size(); ++i) EXPECT_LT(key(all[i - 1]), key(all[i])) << seed;
  }
  template <class Hit, class First>
  static void expect_all(const std::vector<Hit>& all, const std::vector<Hit>& expected, const First& first, int seed) {
    ASSERT_EQ(all.size(), expected.size()) << seed;
    for (std::size_t i = 0; i < all.size(); ++i) expect_same(all[i], expected[i], seed);
    ASSERT_EQ(first.has_value(), !all.empty()) << seed;
    if (first) expect_same(*first, all[0], seed);
  }
};
TYPED_TEST_SUITE(RandomQueryLaws, AllScalars);

TYPED_TEST(RandomQueryLaws, rays_and_casts_meet_what_a_search_of_everything_meets_in_one_order) {
  using S = TypeParam;
  std::size_t rays = 0, casts = 0, several = 0, triangles = 0, inside = 0;
  this->visit(30, [&](const World<S>& w, const Questions<S>& q, int seed) {
    const FullSearch<S> search(w);
    for (const RayCast<S>& ray : q.rays) {
      std::vector<RayCastHit<S>> all;
      w.cast_ray_all(ray.origin, ray.translation, all, ray.filter);
      this->expect_in_order(all, seed);
      this->expect_all(all, search.cast_ray(ray.origin, ray.translation, ray.filter),
                       w.cast_ray(ray.origin, ray.translation, ray.filter), seed);
      rays += !all.empty(), several += all.size() > 1;
      for (const auto& hit : all) triangles += hit.triangle != 0, inside += hit.inside;
    }
    for (const ShapeCast<S>& cast : q.casts) {
      std::vector<ShapeCastHit<S>> all;
      w.cast_shape_all(cast.shape, cast.pose, cast.translation, all, cast.filter);
      this->expect_in_order(all, seed);
      this->expect_all(all, search.cast_shape(cast), w.cast_shape(cast.shape, cast.pose, cast.translation, cast.filter),
                       seed);
      casts += !all.empty(), several += all.size() > 1;
      for (const auto& hit : all) triangles += hit.triangle != 0, inside += hit.inside;
    }
  });
  EXPECT_GT(rays, 1200u);
  EXPECT_GT(casts, 1200u);
  EXPECT_GT(several, 500u);
  EXPECT_GT(triangles, 500u);
  EXPECT_GT(inside, 500u);
}

TYPED_TEST(RandomQueryLaws, overlaps_and_nearest_points_are_those_of_a_search_of_everything) {
  using S = TypeParam;
  std::size_t overlaps = 0, nearest = 0, triangles = 0;
  this->visit(30, [&](const World<S>& w, const Questions<S>& q, int seed) {
    const FullSearch<S> search(w);
    for (const auto& asked : q.overlaps) {
      std::vector<OverlapHit> all;
      w.overlap_shape(asked.shape, asked.pose, all, asked.filter);
      ASSERT_EQ(all, search.overlap_shape(asked.shape, asked.pose, asked.filter)) << seed;
      const auto first = w.overlap_first(asked.shape, asked.pose, asked.filter);
      ASSERT_EQ(first.has_value(), !all.empty()) << seed;
      EXPECT_TRUE(!first || first->body == all[0].body) << seed;
      overlaps += !all.empty();
      for (const OverlapHit& hit : all) triangles += hit.triangle != 0;
    }
    for (const auto& asked : q.nearest) {
      const auto found = w.closest_point(asked.point, asked.most, asked.filter);
      const auto expected = search.closest_point(asked.point, asked.most, asked.filter);
      ASSERT_EQ(found.has_value(), expected.has_value()) << seed;
      if (!found) continue;
      ++nearest;
      EXPECT_EQ(found->body, expected->body) << seed;
      EXPECT_EQ(found->point, expected->point) << seed;
      EXPECT_EQ(found->normal, expected->normal) << seed;
      EXPECT_EQ(found->distance, expected->distance) << seed;
    }
  });
  EXPECT_GT(overlaps, 800u);
  EXPECT_GT(nearest, 1200u);
  EXPECT_GT(triangles, 150u);
}

TYPED_TEST(RandomQueryLaws, a_batch_answers_as_one_by_one) {
  using S = TypeParam;
  std::size_t hits = 0;
  this->visit(30, [&](const World<S>& w, const Questions<S>& q, int seed) {
    std::vector<RayCastHit<S>> of_rays(3 * q.rays.size());
    std::vector<ShapeCastHit<S>> of_casts(2 * q.casts.size());
    ASSERT_TRUE(w.cast_rays(q.rays, of_rays));
    ASSERT_TRUE(w.cast_shapes(q.casts, of_casts));
    for (std::size_t i = 0; i < q.rays.size(); ++i) {
      RayCastHit<S> alone[3] = {};
      hits +=
          w.cast_ray_all(q.rays[i].origin, q.rays[i].translation, std::span<RayCastHit<S>>(alone), q.rays[i].filter);
      for (std::size_t k = 0; k < 3; ++k) expect_same(of_rays[3 * i + k], alone[k], seed);
    }
    for (std::size_t i = 0; i < q.casts.size(); ++i) {
      const ShapeCast<S>& cast = q.casts[i];
      ShapeCastHit<S> alone[2] = {};
      hits += w.cast_shape_all(cast.shape, cast.pose, cast.translation, std::span<ShapeCastHit<S>>(alone), cast.filter);
      for (std::size_t k = 0; k < 2; ++k) expect_same(of_casts[2 * i + k], alone[k], seed);
    }
  });
  EXPECT_GT(hits, 2400u);
}

}  // namespace random_queries_test
}  // namespace isostep::test
