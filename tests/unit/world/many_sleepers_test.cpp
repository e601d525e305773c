// Many sleepers: what snapshots share of them, and that waking many at once is waking them one after another.
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <span>

#include "determinism/mess.hpp"
#include "isostep/state/archive.hpp"

namespace isostep::test {
namespace many_sleepers_test {

constexpr int kAcross = 28, kBalls = kAcross * kAcross;  // more than two pages of slots, and of islands

/// Balls that rest apart on the ground, each an island, and one that is told never to sleep.
template <class S> class ManySleepers : public ::testing::Test {
 protected:
  ManySleepers() : world(settings<S>(-10, 60, 2)) {
    ground = add_ground(world);
    ball = add_ball(world, 0.25);
    for (int i = 0; i < kBalls; ++i) balls.push_back(world.create(moving<S>(ball, place(i))));
    BodyDefinition<S> d = moving<S>(ball, {-20, 0.25, 0});
    d.allow_sleep = false;
    restless = world.create(d);
    for (int i = 0; i < 60; ++i) world.step();
  }
  static D3 place(int i) { return {1.0 * (i % kAcross), 0.25, 1.0 * (i / kAcross)}; }
  std::size_t islands() const { return world.state().sleeping.size(); }

  World<S> world;
  ShapeId ball;
  BodyId ground, restless;
  std::vector<BodyId> balls;
};
TYPED_TEST_SUITE(ManySleepers, AllScalars);

/// The world written down and rebuilt: nothing cached is left of its past.
template <class S> World<S> rebuilt(const World<S>& world) {
  std::vector<std::uint8_t> bytes;
  Writer writer(bytes);
  world.write_portable(writer);
  World<S> fresh;
  Reader reader(bytes);
  EXPECT_TRUE(fresh.read_portable(reader));
  return fresh;
}
/// Equal in hash, in what queries find and in the frames to come.
template <class S> void expect_equal(World<S>& a, World<S>& b) {
  ASSERT_EQ(a.hash(), b.hash());
  std::vector<BodyId> found_a, found_b;
  const Primitive<S> wide = primitive_of(Box<S>{vec<S>(40, 5, 40)});
  a.overlap_shape(wide, Pose<S>::identity(), found_a);
  b.overlap_shape(wide, Pose<S>::identity(), found_b);
  EXPECT_EQ(found_a, found_b);
  for (const BodyId body : found_a) {
    EXPECT_EQ(a.is_awake(body), b.is_awake(body));
    EXPECT_EQ(a.pose(body).position, b.pose(body).position);
  }
  for (int i = 0; i < 5; ++i) {
    a.step();
    b.step();
    ASSERT_EQ(a.hash(), b.hash());
  }
}

TYPED_TEST(ManySleepers, a_snapshot_shares_every_page_and_later_changes_part_with_those_they_touch) {
  World<TypeParam>& w = this->world;
  ASSERT_EQ(this->islands(), static_cast<std::size_t>(kBalls));
  const auto sleeping = w.state().sleeping;
  const SlotMap slots = w.state().body_slots;
  const auto shared = [](const auto& a, const auto& b) {
    std::size_t count = 0;
    for (std::size_t p = 0; p < a.pages(); ++p) count += a.shares_page(p, b) ? 1u : 0u;
    return count;
  };
  ASSERT_EQ(sleeping.pages(), 4u);
  ASSERT_EQ(slots.entries().pages(), 2u);
  for (int i = 0; i < 10; ++i) w.step();
  EXPECT_EQ(shared(sleeping, w.state().sleeping), 4u);
  ASSERT_TRUE(w.wake(this->balls[300]));
  EXPECT_EQ(shared(sleeping, w.state().sleeping), 2u) << "its own page, and that of the last, which took its place";
  EXPECT_EQ(shared(slots.entries(), w.state().body_slots.entries()), 2u);
  ASSERT_TRUE(w.destroy(this->balls[3]));
  EXPECT_EQ(shared(slots.entries(), w.state().body_slots.entries()), 1u);
  ASSERT_EQ(sleeping.size(), static_cast<std::size_t>(kBalls)) << "the copy is as it was";
}

TYPED_TEST(ManySleepers, new_gravity_wakes_all_as_waking_the_last_island_again_and_again_does) {
  using S = TypeParam;
  World<S>& w = this->world;
  World<S> one_by_one = rebuilt(w);
  const Vec3<S> gravity = vec<S>(0, -9, 0);
  w.step();
  one_by_one.step();
  ASSERT_TRUE(w.set_gravity(gravity));
  while (!one_by_one.state().sleeping.empty()) {
    const auto& sleeping = one_by_one.state().sleeping;
    const std::uint32_t slot = sleeping[sleeping.size() - 1]->bodies.states[0].slot;
    ASSERT_TRUE(one_by_one.wake(one_by_one.state().body_slots.template id_of<BodyId>(slot)));
  }
  ASSERT_TRUE(one_by_one.set_gravity(gravity));
  EXPECT_EQ(w.counts().asleep, 0u);
  EXPECT_EQ(w.state().untold.woke, one_by_one.state().untold.woke);
  EXPECT_EQ(w.state().untold.woke.size(), static_cast<std::size_t>(kBalls));
  expect_equal(w, one_by_one);
}

TYPED_TEST(ManySleepers, taking_the_ground_away_wakes_all_as_waking_them_by_slot_does) {
  using S = TypeParam;
  World<S>& w = this->world;
  World<S> one_by_one = rebuilt(w);
  ASSERT_TRUE(w.destroy(this->ground));
  for (const BodyId body : this->balls) ASSERT_TRUE(one_by_one.wake(body));
  ASSERT_TRUE(one_by_one.destroy(this->ground));
  EXPECT_EQ(w.counts().asleep, 0u);
  EXPECT_EQ(w.state().untold.woke, one_by_one.state().untold.woke);
  expect_equal(w, one_by_one);
}

TYPED_TEST(ManySleepers, loading_goes_back_over_waking_sleeping_making_and_destroying) {
  using S = TypeParam;
  World<S>& w = this->world;
  World<S> before = rebuilt(w);
  typename World<S>::Snapshot snapshot;
  w.save(snapshot);
  for (int i = 0; i < kBalls; i += 7) ASSERT_TRUE(w.wake(this->balls[static_cast<std::size_t>(i)]));
  for (int i = 3; i < kBalls; i += 50) ASSERT_TRUE(w.destroy(this->balls[static_cast<std::size_t>(i)]));
  for (int i = 0; i < 20; ++i) w.create(moving<S>(this->ball, {-5, 0.25 + i, 0}));
  for (int i = 0; i < 80; ++i) w.step();
  ASSERT_GT(w.counts().asleep, 600u);
  World<S> after = rebuilt(w);
  typename World<S>::Snapshot later;
  w.save(later);
  w.load(snapshot);
  expect_equal(w, before);
  w.load(later);
  expect_equal(w, after);
  w.load(snapshot);
  ASSERT_TRUE(w.set_gravity(vec<S>(0, -10, 0)));
  EXPECT_EQ(w.counts().awake, static_cast<std::uint32_t>(kBalls) + 1u);
  w.load(later);
  World<S> another(settings<S>(-10, 60, 2));
  another.load(later);
  expect_equal(w, another);
}

TYPED_TEST(ManySleepers, destroying_many_at_once_is_destroying_them_one_by_one) {
  using S = TypeParam;
  World<S>& w = this->world;
  const Mess<S> mess = build_mess(w, {-40, 0, 0});
  for (int i = 0; i < 90; ++i) w.step();
  const auto& awake = w.state().awake.states;
  ASSERT_GT(awake.size(), 10u);
  ASSERT_GT(w.counts().asleep, 600u);
  std::vector<BodyId> chosen = {mess.rotor, this->balls[10], this->balls[10], {}, mess.chain[2], mess.sensor};
  for (std::size_t i = 0; i < this->balls.size(); i += 3) chosen.push_back(this->balls[i]);
  for (std::size_t i = 0; i < mess.moving.size(); i += 2) chosen.push_back(mess.moving[i]);
  chosen.push_back(this->ground);
  World<S> one_by_one = rebuilt(w);
  w.step();
  one_by_one.step();
  std::vector<std::uint8_t> log, other_log;
  w.record_to(&log);
  one_by_one.record_to(&other_log);
  std::size_t accepted = 0;
  for (const BodyId body : chosen) accepted += one_by_one.destroy(body) ? 1u : 0u;
  EXPECT_EQ(w.destroy(std::span<const BodyId>(chosen)), accepted);
  EXPECT_EQ(w.first_fault(), Fault::stale_id) << "one was named twice";
  EXPECT_EQ(w.fault(), Fault::null_id) << "one never was";
  EXPECT_EQ(accepted, chosen.size() - 2);
  EXPECT_EQ(log, other_log);
  EXPECT_EQ(w.state().untold.woke, one_by_one.state().untold.woke);
  for (const BodyId body : chosen) EXPECT_FALSE(w.contains(body));
  expect_equal(w, one_by_one);
}

TYPED_TEST(ManySleepers, a_platform_that_moves_wakes_what_lies_on_it_alone_after_any_load) {
  using S = TypeParam;
  World<S>& w = this->world;
  const ShapeId slab = add_box(w, 2, 0.5, 2);
  BodyId platforms[3], loads[3];
  for (int i = 0; i < 3; ++i) {
    BodyDefinition<S> d = still<S>(slab, {-10, 0.5, 10.0 * i});
    d.type = BodyType::kinematic;
    platforms[i] = w.create(d);
    loads[i] = w.create(moving<S>(add_box(w, 0.5, 0.5, 0.5), {-10, 1.5, 10.0 * i}));
  }
  for (int i = 0; i < 60; ++i) w.step();
  ASSERT_EQ(w.counts().asleep, static_cast<std::uint32_t>(kBalls) + 3u);
  typename World<S>::Snapshot asleep;
  w.save(asleep);
  const auto expect_awake = [&](bool a, bool b, bool c) {
    EXPECT_EQ(w.is_awake(loads[0]), a);
    EXPECT_EQ(w.is_awake(loads[1]), b);
    EXPECT_EQ(w.is_awake(loads[2]), c);
    EXPECT_EQ(w.counts().asleep, static_cast<std::uint32_t>(kBalls + 3 - a - b - c));
  };
  const auto move = [&](int i) { ASSERT_TRUE(w.set_velocity(platforms[i], vec<S>(0, 1, 0), Vec3<S>::zero())); };
  move(1);
  expect_awake(false, true, false);
  w.load(asleep);
  expect_awake(false, false, false);
  move(1);
  move(2);
  expect_awake(false, true, true);
  typename World<S>::Snapshot two_awake;
  w.save(two_awake);
  w.load(asleep);
  move(0);
  expect_awake(true, false, false);
  w.load(two_awake);
  expect_awake(false, true, true);
  ASSERT_TRUE(w.destroy(platforms[0]));
  expect_awake(true, true, true);
}

}  // namespace many_sleepers_test
}  // namespace isostep::test
