// Rays and casts of worlds against a search of every part of every body: the same hits, whatever trees there are.
// SPDX-License-Identifier: MIT
#include "unit/world/query_world.hpp"

namespace isostep::test {
namespace query_casts_test {

template <class S> class QueryCasts : public ::testing::Test {
 protected:
  /// A cast of a random shape of the world, and what a search says of it.
  struct Drawn {
    ShapeCast<S> cast;
    std::vector<ShapeCastHit<S>> expected;
  };
  Drawn draw_cast(int i) {
    QueryWorld<S>& q = scene;
    const ShapeId shape = q.solids()[q.dice.below(static_cast<std::uint32_t>(q.solids().size()))];
    ShapeCast<S> cast = {shape, {vec<S>(q.place()), q.dice.template orientation<S>()}, q.way(i), q.filter()};
    const Child<S>& part = q.world.state().shapes[shape.slot]->children[0];
    if (part.primitive.blob == 0 && q.dice.one_in(2)) cast.shape = part.primitive;
    return {cast, FullSearch<S>(q.world).cast_shape(cast)};
  }

  QueryWorld<S> scene{5};
};
TYPED_TEST_SUITE(QueryCasts, AllScalars);

TYPED_TEST(QueryCasts, rays_meet_what_a_search_without_trees_meets) {
  using S = TypeParam;
  QueryWorld<S>& q = this->scene;
  const FullSearch<S> search(q.world);
  std::size_t hits = 0, most = 0, insides = 0, triangles = 0;
  for (int i = 0; i < 600; ++i) {
    const Vec3<S> origin = vec<S>(q.place()), way = q.way(i);
    const QueryFilter filter = q.filter();
    const auto expected = search.cast_ray(origin, way, filter);
    std::vector<RayCastHit<S>> all(1);  // what is there stays
    q.world.cast_ray_all(origin, way, all, filter);
    ASSERT_EQ(all.size(), expected.size() + 1) << i;
    for (std::size_t k = 0; k < expected.size(); ++k) expect_same(all[k + 1], expected[k], i);
    RayCastHit<S> room[3];
    const std::size_t count = q.world.cast_ray_all(origin, way, std::span<RayCastHit<S>>(room), filter);
    ASSERT_EQ(count, std::min<std::size_t>(3, expected.size())) << i;
    for (std::size_t k = 0; k < count; ++k) expect_same(room[k], expected[k], i);
    const auto first = q.world.cast_ray(origin, way, filter);
    ASSERT_EQ(first.has_value(), !expected.empty()) << i;
    if (first) expect_same(*first, expected[0], i);
    hits += first.has_value();
    most = std::max(most, expected.size());
    for (const auto& hit : expected) insides += hit.inside, triangles += hit.triangle != 0;
  }
  EXPECT_GT(hits, 200u);
  EXPECT_GE(most, 4u);
  EXPECT_GE(insides, 8u);
  EXPECT_GT(triangles, 100u);
}

TYPED_TEST(QueryCasts, casts_meet_what_a_search_without_trees_meets) {
  using S = TypeParam;
  QueryWorld<S>& q = this->scene;
  std::size_t hits = 0, most = 0, insides = 0, triangles = 0;
  for (int i = 0; i < 400; ++i) {
    const auto [cast, expected] = this->draw_cast(i);
    std::vector<ShapeCastHit<S>> all(1);
    q.world.cast_shape_all(cast.shape, cast.pose, cast.translation, all, cast.filter);
    ASSERT_EQ(all.size(), expected.size() + 1) << i;
    for (std::size_t k = 0; k < expected.size(); ++k) expect_same(all[k + 1], expected[k], i);
    ShapeCastHit<S> room[3];
    const std::size_t count =
        q.world.cast_shape_all(cast.shape, cast.pose, cast.translation, std::span<ShapeCastHit<S>>(room), cast.filter);
    ASSERT_EQ(count, std::min<std::size_t>(3, expected.size())) << i;
    for (std::size_t k = 0; k < count; ++k) expect_same(room[k], expected[k], i);
    const auto first = q.world.cast_shape(cast.shape, cast.pose, cast.translation, cast.filter);
    ASSERT_EQ(first.has_value(), !expected.empty()) << i;
    if (first) expect_same(*first, expected[0], i);
    hits += first.has_value();
    most = std::max(most, expected.size());
    for (const auto& hit : expected) {
      insides += hit.inside, triangles += hit.triangle != 0;
      EXPECT_NEAR(length(real(hit.normal)), 1, 1e-4) << i;
      EXPECT_TRUE(hit.inside || dot(real(hit.normal), real(cast.translation)) < 1e-3) << i;
    }
  }
  EXPECT_GT(hits, 200u);
  EXPECT_GE(most, 5u);
  EXPECT_GT(insides, 40u);
  EXPECT_GT(triangles, 100u);
}

/// Stands for threads, in another order than theirs.
struct OneByOne {
  static void run(void*, std::int32_t copies, TaskRunner::Task task, void* data) {
    for (std::int32_t i = 0; i < copies; ++i) task(data);
  }
};

TYPED_TEST(QueryCasts, batches_are_as_one_by_one_for_any_number_of_threads) {
  using S = TypeParam;
  QueryWorld<S>& q = this->scene;
  std::vector<RayCast<S>> rays;
  std::vector<ShapeCast<S>> casts;
  for (int i = 0; i < 100; ++i) {
    rays.push_back({vec<S>(q.place()), q.way(i), q.filter()});
    casts.push_back(this->draw_cast(i).cast);
  }
  for (const std::int32_t threads : {1, 2, 3, 4}) {
    TaskRunner runner;
    runner.run = &OneByOne::run;
    runner.threads = threads;
    q.world.use_threads(runner);
    std::vector<RayCastHit<S>> hits(2 * rays.size());
    std::vector<ShapeCastHit<S>> cast_hits(casts.size());
    ASSERT_TRUE(q.world.cast_rays(rays, hits));
    ASSERT_TRUE(q.world.cast_shapes(casts, cast_hits));
    for (std::size_t i = 0; i < rays.size(); ++i) {
      RayCastHit<S> alone[2] = {};
      q.world.cast_ray_all(rays[i].origin, rays[i].translation, std::span<RayCastHit<S>>(alone), rays[i].filter);
      for (std::size_t k = 0; k < 2; ++k) expect_same(hits[2 * i + k], alone[k], static_cast<int>(i));
      const auto cast = q.world.cast_shape(casts[i].shape, casts[i].pose, casts[i].translation, casts[i].filter);
      expect_same(cast_hits[i], cast.value_or(ShapeCastHit<S>{}), static_cast<int>(i));
    }
  }
  q.world.use_threads({});
}

TYPED_TEST(QueryCasts, of_a_batch_what_is_refused_hits_nothing_and_is_told) {
  using S = TypeParam;
  QueryWorld<S>& q = this->scene;
  std::vector<RayCast<S>> rays(20, {vec<S>(0, 9, 0), vec<S>(0, -16, 0), {}});
  std::vector<RayCastHit<S>> hits(rays.size());
  ASSERT_TRUE(q.world.cast_rays(rays, hits));
  rays[7].origin.x = Limits<S>::position() + S(1);
  EXPECT_FALSE(q.world.cast_rays(rays, hits));
  EXPECT_EQ(q.world.fault(), Fault::out_of_range);
  EXPECT_STREQ(q.world.fault().command, "cast_rays");
  for (std::size_t i = 0; i < hits.size(); ++i) EXPECT_EQ(static_cast<bool>(hits[i].body), i != 7);
  EXPECT_FALSE(q.world.cast_rays(rays, std::span<RayCastHit<S>>(hits).first(19)));
  EXPECT_EQ(q.world.fault(), Fault::bad_argument);
  EXPECT_TRUE(q.world.cast_rays({}, {}));
}

TYPED_TEST(QueryCasts, a_world_that_loads_a_snapshot_answers_as_the_one_that_saved_it) {
  using S = TypeParam;
  QueryWorld<S>& q = this->scene;
  typename World<S>::Snapshot frame;
  q.world.save(frame);
  World<S> past(settings<S>(-10, 60, 4));
  std::vector<RayCast<S>> rays;
  std::vector<ShapeCast<S>> casts;
  for (int i = 0; i < 60; ++i) {
    rays.push_back({vec<S>(q.place()), q.way(i), q.filter()});
    casts.push_back(this->draw_cast(i).cast);
  }
  std::vector<RayCastHit<S>> hits(rays.size()), again(rays.size());
  std::vector<ShapeCastHit<S>> cast_hits(rays.size()), cast_again(rays.size());
  ASSERT_TRUE(q.world.cast_rays(rays, hits));
  ASSERT_TRUE(q.world.cast_shapes(casts, cast_hits));
  for (int i = 0; i < 30; ++i) q.world.step();
  ASSERT_TRUE(past.load(frame));
  ASSERT_TRUE(past.cast_rays(rays, again));
  ASSERT_TRUE(past.cast_shapes(casts, cast_again));
  for (std::size_t i = 0; i < rays.size(); ++i) {
    expect_same(again[i], hits[i], static_cast<int>(i));
    expect_same(cast_again[i], cast_hits[i], static_cast<int>(i));
  }
}

TYPED_TEST(QueryCasts, overlaps_name_children_and_triangles_in_order) {
  using S = TypeParam;
  QueryWorld<S>& q = this->scene;
  std::size_t found = 0, triangles = 0;
  for (int i = 0; i < 150; ++i) {
    const ShapeId shape = q.solids()[q.dice.below(static_cast<std::uint32_t>(q.solids().size()))];
    const Pose<S> pose = {vec<S>(q.place()), q.dice.template orientation<S>()};
    QueryFilter filter = q.filter();
    filter.per = HitPer::triangle;
    std::vector<OverlapHit> each, parts, bodies;
    q.world.overlap_shape(shape, pose, each, filter);
    const auto before = [](const OverlapHit& a, const OverlapHit& b) {
      return std::tuple(a.body.slot, a.child, a.triangle) < std::tuple(b.body.slot, b.child, b.triangle);
    };
    EXPECT_TRUE(std::is_sorted(each.begin(), each.end(), before));
    std::vector<OverlapHit> expected_parts, expected_bodies;
    std::vector<BodyId> expected_ids, ids;
    for (const OverlapHit& hit : each) {
      const bool new_body = expected_parts.empty() || !(expected_parts.back().body == hit.body);
      if (new_body || expected_parts.back().child != hit.child) expected_parts.push_back(hit);
      if (new_body) expected_bodies.push_back(hit), expected_ids.push_back(hit.body);
    }
    filter.per = HitPer::child;
    q.world.overlap_shape(shape, pose, parts, filter);
    EXPECT_EQ(parts, expected_parts) << i;
    filter.per = HitPer::body;
    q.world.overlap_shape(shape, pose, bodies, filter);
    EXPECT_EQ(bodies, expected_bodies) << i;
    q.world.overlap_shape(shape, pose, ids, filter);
    EXPECT_EQ(ids, expected_ids) << i;
    const auto first = q.world.overlap_first(shape, pose, filter);
    ASSERT_EQ(first.has_value(), !bodies.empty()) << i;
    EXPECT_TRUE(!first || *first == bodies[0]) << i;
    found += bodies.size();
    for (const OverlapHit& hit : each) triangles += hit.triangle != 0;
  }
  EXPECT_GT(found, 30u);
  EXPECT_GT(triangles, 30u);
}

TYPED_TEST(QueryCasts, questions_that_cannot_be_asked_are_refused) {
  using S = TypeParam;
  World<S>& w = this->scene.world;
  const Pose<S> here = Pose<S>::identity();
  const Vec3<S> down = vec<S>(0, -1, 0), far_off = {Limits<S>::position() + S(1), S(0), S(0)};
  const Primitive<S> ball = primitive_of(Sphere<S>{S(1)});
  const auto refused = [&](const QueryShape<S>& shape, const Pose<S>& pose, Vec3<S> way, Fault fault) {
    w.forget_faults();
    EXPECT_FALSE(w.cast_shape(shape, pose, way));
    EXPECT_EQ(w.fault(), fault);
    EXPECT_STREQ(w.fault().command, "cast_shape");
  };
  refused(ball, {far_off, here.orientation}, down, Fault::out_of_range);
  refused(ball, here, far_off, Fault::out_of_range);
  refused(primitive_of(Sphere<S>{S(-1)}), here, down, Fault::bad_shape);
  refused(primitive_of(HalfSpace<S>{{Unit<S>(0), Unit<S>(1), Unit<S>(0)}, S(0)}), here, down, Fault::bad_shape);
  refused(ShapeId{}, here, down, Fault::null_id);
  const ShapeId two = add_two_boxes(w, {1, 1, 1}, {0, 0, 0}, {1, 1, 1}, {2, 0, 0});
  refused(two, here, down, Fault::bad_shape);
  EXPECT_TRUE(w.remove_shape(two));
  refused(two, here, down, Fault::stale_id);
}

/// [m] Outside of a box's surface, or inside of it.
template <class S> double off_box(const Pose<S>& pose, D3 half, D3 point) {
  const D3 p = rotated<S>(conjugate(pose.orientation), point - real(pose.position));
  const D3 over = {std::fabs(p.x) - half.x, std::fabs(p.y) - half.y, std::fabs(p.z) - half.z};
  const double inside = std::max({over.x, over.y, over.z});
  return inside < 0 ? -inside : length({std::max(over.x, 0.0), std::max(over.y, 0.0), std::max(over.z, 0.0)});
}
TYPED_TEST(QueryCasts, the_point_of_a_hit_lies_on_both_shapes) {
  using S = TypeParam;
  Dice dice(41);
  const D3 half = {0.5, 0.25, 1}, cast_half = {1, 0.5, 0.25};
  int hits = 0;
  double worst = 0;
  for (int i = 0; i < 400; ++i) {
    World<S> w(settings<S>());
    BodyDefinition<S> d = still<S>(add_box(w, half.x, half.y, half.z), {0, 0, 0});
    d.orientation = dice.template orientation<S>();
    w.create(d);
    const D3 from = dice.arrow_of(4);
    const Pose<S> start = {vec<S>(from), dice.template orientation<S>()};
    const Vec3<S> way = vec<S>(from * -2 + dice.point(0.5));
    const auto hit = w.cast_shape(add_box(w, cast_half.x, cast_half.y, cast_half.z), start, way);
    if (!hit) continue;
    ++hits;
    const Pose<S> there = {start.position + way * convert<S>(hit->fraction), start.orientation};
    worst = std::max({worst, off_box<S>({Vec3<S>::zero(), d.orientation}, half, real(hit->point)),
                      off_box<S>(there, cast_half, real(hit->point))});
  }
  EXPECT_GT(hits, 300);
  EXPECT_LT(worst, 3e-3);
}

}  // namespace query_casts_test
}  // namespace isostep::test
