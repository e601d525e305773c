// Queries of worlds about space, against a search of every body; and worlds that move and tell their stages.
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <map>
#include <optional>

#include "determinism/mess.hpp"
#include "isostep/collision/narrowphase/collide.hpp"
#include "isostep/collision/query/closest_point.hpp"
#include "isostep/collision/query/ray_cast.hpp"

namespace isostep::test {
namespace world_queries_test {

template <class S> class WorldQueries : public ::testing::Test {
 protected:
  WorldQueries() : world(settings<S>(-10, 60, 4)), mess(build_mess(world)) {
    for (int i = 0; i < 200; ++i) world.step();
    EXPECT_GT(world.counts().asleep, 0u);
    EXPECT_GT(world.counts().awake, 10u);
  }

  /// visit(id, child, transform) for every part of every body that the filter sees, ascending by slot.
  template <class Visit> void visit_parts(QueryFilter filter, Visit&& visit) const {
    for (const BodyId id : world.bodies()) {
      const BodyProperties<S>& body = properties(id);
      if ((body.filter.category & filter.mask) == 0 || (!filter.sensors && (body.flags & body_flag::kSensor) != 0))
        continue;
      const Transform<S> placed = Transform<S>::of(world.pose(id));
      for (const Child<S>& child : world.state().shapes[body.shape]->children)
        visit(id, child.primitive, compose(placed, Transform<S>::of(child.pose)));
    }
  }
  const BodyProperties<S>& properties(BodyId id) const {
    const BodyProperties<S>* const found = world.view(id).properties;
    EXPECT_NE(found, nullptr) << "a body in no set";
    return *found;
  }

  World<S> world;
  Mess<S> mess;
};
TYPED_TEST_SUITE(WorldQueries, AllScalars);

TYPED_TEST(WorldQueries, a_ray_meets_what_a_search_of_every_body_says_it_meets_first) {
  using S = TypeParam;
  World<S>& w = this->world;
  Dice dice(3);
  int hits = 0, misses = 0;
  for (int i = 0; i < 300; ++i) {
    const Vec3<S> origin = vec<S>(dice.point(6) + D3{0, 7, 0}), along = vec<S>(dice.point(12));
    QueryFilter filter;
    filter.sensors = i % 3 == 0;
    const auto found = w.cast_ray(origin, along, filter);
    std::optional<S> best;
    BodyId nearest;
    this->visit_parts(filter, [&](BodyId id, const Primitive<S>& primitive, const Transform<S>& at) {
      RayHit<S> hit;
      if (!ray_cast(primitive, at, origin, along, S(1), hit)) return;
      if (best && !(hit.fraction < *best)) return;
      best = hit.fraction;
      nearest = id;
    });
    ASSERT_EQ(found.has_value(), best.has_value()) << "ray " << i;
    if (!found) {
      ++misses;
      continue;
    }
    ++hits;
    EXPECT_EQ(found->fraction, *best) << "ray " << i;
    EXPECT_EQ(found->body, nearest) << "ray " << i;
    EXPECT_LE(dot(real(found->normal), real(along)), 1e-3);
  }
  EXPECT_GT(hits, 50);
  EXPECT_GT(misses, 20);
}

TYPED_TEST(WorldQueries, all_hits_of_a_ray_are_those_of_a_search_of_every_body_nearest_first) {
  using S = TypeParam;
  World<S>& w = this->world;
  Dice dice(7);
  std::size_t most = 0;
  for (int i = 0; i < 400; ++i) {
    const Vec3<S> origin = vec<S>(dice.point(6) + D3{0, 7, 0}), along = vec<S>(dice.point(12));
    QueryFilter filter;
    filter.sensors = i % 3 == 0;
    std::map<std::uint32_t, S> first;  // of each body, by slot
    this->visit_parts(filter, [&](BodyId id, const Primitive<S>& primitive, const Transform<S>& at) {
      RayHit<S> hit;
      if (!ray_cast(primitive, at, origin, along, S(1), hit)) return;
      const auto [known, fresh] = first.try_emplace(id.slot, hit.fraction);
      if (!fresh) known->second = min(known->second, hit.fraction);
    });
    std::vector<RayCastHit<S>> hits(1);  // what is there stays
    w.cast_ray_all(origin, along, hits, filter);
    ASSERT_EQ(hits.size(), first.size() + 1) << "ray " << i;
    for (std::size_t k = 1; k < hits.size(); ++k) {
      ASSERT_EQ(first.count(hits[k].body.slot), 1u);
      EXPECT_EQ(hits[k].fraction, first[hits[k].body.slot]);
      if (k == 1) continue;
      const bool later = hits[k - 1].fraction < hits[k].fraction;
      const bool tie = hits[k - 1].fraction == hits[k].fraction && hits[k - 1].body.slot < hits[k].body.slot;
      EXPECT_TRUE(later || tie) << "ray " << i;
    }
    const auto nearest = w.cast_ray(origin, along, filter);
    ASSERT_EQ(nearest.has_value(), hits.size() > 1);
    if (nearest) {
      EXPECT_EQ(nearest->body, hits[1].body);
    }
    most = std::max(most, hits.size() - 1);
  }
  EXPECT_GE(most, 3u);
}

TYPED_TEST(WorldQueries, a_query_does_not_see_who_is_to_be_ignored) {
  using S = TypeParam;
  World<S> w(settings<S>(0));
  const ShapeId box = add_box(w, 0.5, 0.5, 0.5);
  const BodyId eye = w.create(still<S>(box, {0, 1, 0})), other = w.create(still<S>(box, {3, 1, 0}));
  const BodyId gone = w.create(still<S>(box, {6, 1, 0}));
  w.destroy(gone);
  const Vec3<S> here = vec<S>(0, 1, 0), along = vec<S>(8, 0, 0);
  QueryFilter filter;
  EXPECT_EQ(w.cast_ray(here, along, filter)->body, eye);
  filter.ignore = eye;
  EXPECT_EQ(w.cast_ray(here, along, filter)->body, other);
  EXPECT_EQ(w.closest_point(here, S(4), filter)->body, other);
  std::vector<RayCastHit<S>> hits;
  w.cast_ray_all(here, along, hits, filter);
  ASSERT_EQ(hits.size(), 1u);
  EXPECT_EQ(hits[0].body, other);
  std::vector<BodyId> near, over;
  w.overlap_aabb(Aabb<S>::around(here, vec<S>(4, 1, 1)), near, filter);
  EXPECT_EQ(near, std::vector<BodyId>{other});
  w.overlap_shape(primitive_of(Sphere<S>{S(4)}), Pose<S>{here, Quat<Unit<S>>::identity()}, over, filter);
  EXPECT_EQ(over, std::vector<BodyId>{other});
  filter.ignore = gone;
  EXPECT_EQ(w.cast_ray(here, along, filter)->body, eye) << "a stale id ignores nobody";
}

TYPED_TEST(WorldQueries, hits_of_bodies_in_one_place_come_by_slot) {
  using S = TypeParam;
  World<S> w(settings<S>(0));
  const ShapeId box = add_box(w, 0.5, 0.5, 0.5);
  for (int i = 0; i < 70; ++i) w.create(still<S>(box, {i % 7 * 2.0, 1, 0}));  // more than are sorted by insertion
  std::vector<RayCastHit<S>> hits;
  w.cast_ray_all(vec<S>(-4, 1, 0), vec<S>(32, 0, 0), hits);
  ASSERT_EQ(hits.size(), 70u);
  for (std::uint32_t k = 0; k < 70; ++k) EXPECT_EQ(hits[k].body.slot, k / 10 + 7 * (k % 10));
}

TYPED_TEST(WorldQueries, of_two_bodies_in_one_place_a_ray_and_a_point_find_the_lower_slot) {
  using S = TypeParam;
  World<S> w(settings<S>(0));
  const ShapeId box = add_box(w, 0.5, 0.5, 0.5);
  std::vector<BodyId> twins;
  for (int i = 0; i < 6; ++i) twins.push_back(w.create(still<S>(box, {3, 1, 0})));
  for (int i = 0; i < 40; ++i) w.create(still<S>(box, {i * 0.7 - 14, 8, 1}));
  w.destroy(twins[0]);
  w.destroy(twins[1]);
  const BodyId late = w.create(still<S>(box, {3, 1, 0}));
  EXPECT_EQ(late.slot, twins[1].slot);
  EXPECT_EQ(w.cast_ray(vec<S>(-4, 1, 0), vec<S>(16, 0, 0))->body, late);
  EXPECT_EQ(w.closest_point(vec<S>(3, 3, 0), S(4))->body, late);
}

TYPED_TEST(WorldQueries, the_closest_body_is_the_closest_of_all) {
  using S = TypeParam;
  World<S>& w = this->world;
  Dice dice(4);
  int found_any = 0;
  for (int i = 0; i < 200; ++i) {
    const Vec3<S> point = vec<S>(dice.point(5) + D3{0, 4, 0});
    const S reach = num<S>(dice.in(0, 3));
    const auto found = w.closest_point(point, reach);
    std::optional<S> best;
    BodyId nearest;
    this->visit_parts({}, [&](BodyId id, const Primitive<S>& primitive, const Transform<S>& at) {
      const S distance = closest_point(primitive, at, point).distance;
      if (reach < distance || (best && !(distance < *best))) return;
      best = distance;
      nearest = id;
    });
    ASSERT_EQ(found.has_value(), best.has_value()) << i;
    if (!found) continue;
    ++found_any;
    EXPECT_EQ(found->distance, *best);
    EXPECT_EQ(found->body, nearest);
    const double off = length(real(point) - real(found->point));
    EXPECT_NEAR(off, std::fabs(to_double(found->distance)), 64 * grain<S>(8));
  }
  EXPECT_GT(found_any, 40);
}

TYPED_TEST(WorldQueries, an_overlap_names_every_body_it_meets_once_in_order) {
  using S = TypeParam;
  World<S>& w = this->world;
  Dice dice(6);
  std::size_t total = 0;
  for (int i = 0; i < 100; ++i) {
    const Pose<S> pose = {vec<S>(dice.point(2.5) + D3{0, 1.5, 0}), dice.orientation<S>()};
    const Primitive<S> shape = i % 2 == 0 ? primitive_of(Box<S>{vec<S>(0.75, 0.5, 1)}) : primitive_of(Sphere<S>{S(1)});
    std::vector<BodyId> found, expected;
    w.overlap_shape(shape, pose, found);
    this->visit_parts({}, [&](BodyId id, const Primitive<S>& primitive, const Transform<S>& at) {
      Manifold<S> manifold;
      const Transform<S> here = Transform<S>::of({Vec3<S>::zero(), pose.orientation});
      collide(shape, here, primitive, Transform<S>{at.position - pose.position, at.rotation}, S(0), manifold);
      if (manifold.count > 0 && (expected.empty() || expected.back() != id)) expected.push_back(id);
    });
    // A hair's breadth may fall on either side, for the search composes its frames in another order.
    std::vector<BodyId> difference;
    const auto before = [](BodyId a, BodyId b) { return a.slot < b.slot; };
    EXPECT_TRUE(std::is_sorted(found.begin(), found.end(), before));
    std::set_symmetric_difference(found.begin(), found.end(), expected.begin(), expected.end(),
                                  std::back_inserter(difference), before);
    EXPECT_TRUE(difference.empty()) << i;
    total += found.size();
  }
  EXPECT_GT(total, 150u);
}

TYPED_TEST(WorldQueries, masks_and_sensors_decide_what_is_seen) {
  using S = TypeParam;
  World<S> w(settings<S>(0));
  BodyDefinition<S> d = still<S>(add_ball(w, 0.5), {0, 0, 0});
  d.filter.category = 2;
  const BodyId tagged = w.create(d);
  d.position = vec<S>(2, 0, 0);
  d.filter.category = 4;
  d.sensor = true;
  const BodyId sensor = w.create(d);
  const Vec3<S> left = vec<S>(-5, 0, 0), right = vec<S>(5, 0, 0), along = vec<S>(10, 0, 0);
  EXPECT_EQ(w.cast_ray(left, along)->body, tagged);
  EXPECT_EQ(w.cast_ray(right, -along)->body, tagged);
  EXPECT_EQ(w.cast_ray(right, -along, {0xffffffffu, true})->body, sensor);
  EXPECT_FALSE(w.cast_ray(left, along, {1, false}).has_value());
  EXPECT_EQ(w.closest_point(right, S(10), {4, true})->body, sensor);
  EXPECT_FALSE(w.closest_point(right, S(10), {4, false}).has_value());
  std::vector<BodyId> found;
  w.overlap_shape(primitive_of(Sphere<S>{S(4)}), Pose<S>::identity(), found, {0xffffffffu, true});
  EXPECT_EQ(found, (std::vector<BodyId>{tagged, sensor}));
}

TYPED_TEST(WorldQueries, questions_that_cannot_be_answered_find_nothing) {
  using S = TypeParam;
  World<S>& w = this->world;
  const Vec3<S> outside = {Limits<S>::position() + S(1), S(0), S(0)};
  EXPECT_FALSE(w.cast_ray(outside, vec<S>(-1, 0, 0)).has_value());
  EXPECT_FALSE(w.cast_ray(vec<S>(0, 5, 0), outside).has_value());
  EXPECT_FALSE(w.closest_point(outside, S(1)).has_value());
  EXPECT_FALSE(w.closest_point(vec<S>(0, 1, 0), S(-1)).has_value());
  std::vector<BodyId> found;
  w.overlap_shape(primitive_of(Sphere<S>{S(-1)}), Pose<S>::identity(), found);
  EXPECT_TRUE(found.empty());
}

TYPED_TEST(WorldQueries, a_created_or_teleported_body_is_found_before_any_step) {
  using S = TypeParam;
  World<S> w(settings<S>(0));
  const BodyId id = w.create(moving<S>(add_ball(w, 0.5), {0, 0, 0}));
  EXPECT_EQ(w.cast_ray(vec<S>(0, 5, 0), vec<S>(0, -10, 0))->body, id);
  ASSERT_TRUE(w.set_pose(id, {vec<S>(9, 0, 0), Quat<Unit<S>>::identity()}));
  EXPECT_FALSE(w.cast_ray(vec<S>(0, 5, 0), vec<S>(0, -10, 0)).has_value());
  EXPECT_EQ(w.cast_ray(vec<S>(9, 5, 0), vec<S>(0, -10, 0))->body, id);
  ASSERT_TRUE(w.destroy(id));
  EXPECT_FALSE(w.cast_ray(vec<S>(9, 5, 0), vec<S>(0, -10, 0)).has_value());
}

TYPED_TEST(WorldQueries, a_moved_world_goes_on_as_it_was) {
  using S = TypeParam;
  World<S> w(settings<S>()), twin(settings<S>());
  build_mess(w);
  build_mess(twin);
  for (int i = 0; i < 30; ++i) w.step(), twin.step();
  World<S> moved(std::move(w));
  EXPECT_EQ(moved.hash(), twin.hash());
  for (int i = 0; i < 30; ++i) moved.step(), twin.step();
  EXPECT_EQ(moved.hash(), twin.hash());
  w = std::move(moved);
  w.step();
  twin.step();
  EXPECT_EQ(w.hash(), twin.hash());
}

TYPED_TEST(WorldQueries, a_trace_is_the_hash_before_a_step_and_after_each_stage) {
  std::vector<std::uint64_t> trace;
  this->world.trace_to(&trace);
  struct Seen {
    const World<TypeParam>* world;
    std::vector<std::uint64_t> hashes;
  } seen{&this->world, {this->world.hash()}};
  this->world.step({[](void* user, Stage, const StageView&) {
                      Seen& s = *static_cast<Seen*>(user);
                      s.hashes.push_back(s.world->hash());
                    },
                    &seen});
  EXPECT_EQ(trace.size(), kTraceHashes);
  EXPECT_EQ(trace, seen.hashes);
  EXPECT_NE(trace.front(), trace.back());
  this->world.trace_to(nullptr);
  this->world.step();
  EXPECT_EQ(trace.size(), kTraceHashes);
}

TYPED_TEST(WorldQueries, the_stages_of_a_step_are_reported_once_each_in_order) {
  std::vector<Stage> seen;
  StageObserver observer;
  observer.user = &seen;
  observer.after = [](void* user, Stage stage, const StageView&) {
    static_cast<std::vector<Stage>*>(user)->push_back(stage);
  };
  const std::uint64_t before = this->world.hash();
  this->world.step(observer);
  EXPECT_NE(this->world.hash(), before);
  ASSERT_EQ(seen.size(), kStages);
  for (std::uint32_t i = 0; i < kStages; ++i) EXPECT_EQ(seen[i], static_cast<Stage>(i));
}

TYPED_TEST(WorldQueries, a_portable_form_with_a_force_on_a_sleeper_is_refused) {
  using S = TypeParam;
  World<S> w(settings<S>());
  add_ground(w);
  const ShapeId box = add_box(w, 0.5, 0.5, 0.5);
  const BodyId sleeper = w.create(moving<S>(box, {0, 0.5, 0}));
  ASSERT_TRUE(settle(w));
  const BodyId awake = w.create(moving<S>(box, {9, 9, 0}));
  ASSERT_TRUE(w.apply_force(awake, vec<S>(3, 5, 7)));
  ASSERT_EQ(w.state().forces.size(), 1u);
  // The record as written: slot, zero, then the acceleration, whose bits occur once.
  std::vector<std::uint8_t> record;
  Writer(record).write(w.state().forces[0]);
  std::vector<std::uint8_t> bytes = bytes_of(w);
  const auto at = std::search(bytes.begin(), bytes.end(), record.begin(), record.end());
  ASSERT_NE(at, bytes.end());
  *at = static_cast<std::uint8_t>(sleeper.slot);
  World<S> other(settings<S>());
  Reader reader(bytes);
  EXPECT_FALSE(other.read_portable(reader).ok());
  EXPECT_EQ(other.counts().bodies, 0u);
}

TYPED_TEST(WorldQueries, bodies_near_a_box_are_those_whose_fat_boxes_meet_it_and_a_view_shows_them) {
  using S = TypeParam;
  World<S> w(settings<S>());
  const ShapeId ball = add_ball(w, 0.5);
  std::vector<BodyId> line;
  for (int i = 0; i < 60; ++i) {
    const bool fixed = i % 2 == 0;
    BodyDefinition<S> d = moving<S>(ball, {2.0 * (59 - i), 0, 0}, {0, 0, fixed ? 0.0 : 1.0});
    d.type = fixed ? BodyType::static_ : BodyType::dynamic;
    d.filter.category = i % 3 == 0 ? 2u : 1u;
    d.sensor = i % 5 == 0;
    line.push_back(w.create(d));
  }
  const auto near = [&](double from, double to, QueryFilter filter) {
    std::vector<BodyId> found = {line[7]};  // appended to
    w.overlap_aabb({vec<S>(from, -0.25, -0.25), vec<S>(to, 0.25, 0.25)}, found, filter);
    return found;
  };
  for (const auto& [from, to] : {std::pair{0.0, 118.0}, std::pair{9.3, 20.7}, std::pair{10.7, 11.3}}) {
    for (const QueryFilter filter : {QueryFilter{}, QueryFilter{2, false}, QueryFilter{3, true}}) {
      std::vector<BodyId> expected = {line[7]};
      for (int i = 0; i < 60; ++i) {
        const double x = 2.0 * (59 - i);
        const bool seen = (filter.mask & (i % 3 == 0 ? 2u : 1u)) != 0 && (filter.sensors || i % 5 != 0);
        if (seen && from <= x + 0.6 && x - 0.6 <= to) expected.push_back(line[static_cast<std::size_t>(i)]);
      }
      EXPECT_EQ(near(from, to, filter), expected) << from << " " << filter.mask;
    }
  }
  const BodyView<S> view = w.view(line[5]);
  ASSERT_NE(view.state, nullptr);
  EXPECT_EQ(view.state->slot, line[5].slot);
  EXPECT_EQ(view.properties->type, BodyType::dynamic);
  ASSERT_EQ(view.children.size(), 1u);
  EXPECT_EQ(view.children[0].primitive.radius, num<S>(0.5));
  EXPECT_EQ(view.pose.position, vec<S>(108, 0, 0));
  w.destroy(line[5]);
  EXPECT_EQ(w.view(line[5]).state, nullptr);
}

}  // namespace world_queries_test
}  // namespace isostep::test
