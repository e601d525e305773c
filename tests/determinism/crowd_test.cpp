// A budget of pairs that is met: which pairs are kept is a function of the state, so nothing that is none of it shows.
// SPDX-License-Identifier: MIT

#include "examples/thread_pool.hpp"
#include "isostep/core/random.hpp"
#include "unit/world/worlds.hpp"

namespace isostep::test {
namespace crowd_test {

/// Heaps of balls, boxes and compounds that overlap, on a floor, beside sleepers and a moving platform; the budget is
/// met in most frames and, as heaps come apart and others are dropped, not in all.
template <class S> void add_heap(World<S>& world, Pcg32& random, int count, D3 at) {
  const Child<S> parts[2] = {{primitive_of(Sphere<S>{num<S>(0.25)}), {vec<S>(0.25, 0, 0), Quat<Unit<S>>::identity()}},
                             {primitive_of(Sphere<S>{num<S>(0.25)}), {vec<S>(-0.25, 0, 0), Quat<Unit<S>>::identity()}}};
  const ShapeId shapes[3] = {add_ball(world, 0.25), add_box(world, 0.25, 0.25, 0.5),
                             world.add_shape(std::span<const Child<S>>(parts))};
  for (int i = 0; i < count; ++i) {
    const auto jitter = [&] { return static_cast<double>(random_between(random, -4, 4)) / 16; };
    const double x = jitter(), y = jitter(), z = jitter();
    world.create(moving<S>(shapes[i % 3], {at.x + x, at.y + y, at.z + z}));
  }
}
template <class S> Settings<S> small_budget() {
  Settings<S> s = settings<S>(-10, 60, 4);
  s.most_pairs = 800;
  return s;
}
template <class S> void build_crowds(World<S>& world) {
  Pcg32 random = Pcg32::seeded(5);
  add_ground(world);
  BodyDefinition<S> platform = moving<S>(add_box(world, 1, 0.25, 1), {4, 0.5, 0});
  platform.type = BodyType::kinematic;
  platform.velocity = vec<S>(0.25, 0, 0);
  world.create(platform);
  for (int i = 0; i < 4; ++i) world.create(moving<S>(add_box(world, 0.5, 0.25, 0.5), {-4, 0.25 + 0.5 * i, 0}));
  for (int i = 0; i < 60; ++i) world.step();  // the stack falls asleep
  add_heap(world, random, 60, {0, 1, 0});
  add_heap(world, random, 20, {4, 1.5, 0});
}
/// One frame: every so often a heap is dropped on the sleepers, and the oldest bodies go.
template <class S> std::uint64_t play_crowds(World<S>& world, int frame, std::uint32_t& crowded) {
  Pcg32 random = Pcg32::seeded(static_cast<std::uint64_t>(frame) + 100);
  if (frame % 40 == 20) add_heap(world, random, 30, {-4, 3, 0});
  crowded += world.step().crowded != 0 ? 1u : 0u;
  return world.hash();
}

template <class S> class CrowdBits : public ::testing::Test {
 protected:
  static constexpr int kFrames = 100;
  struct Played {
    std::vector<std::uint64_t> hashes;
    std::uint32_t crowded = 0;  // frames
  };
  static Played play_on(World<S>& world, int from, int frames) {
    Played played;
    for (int i = 0; i < frames; ++i) played.hashes.push_back(play_crowds(world, from + i, played.crowded));
    return played;
  }
  static const Played& expected() {
    static const Played played = [] {
      World<S> world(small_budget<S>());
      build_crowds(world);
      return play_on(world, 0, kFrames);
    }();
    return played;
  }
};
TYPED_TEST_SUITE(CrowdBits, AllScalars);

TYPED_TEST(CrowdBits, the_scene_meets_its_budget_in_many_frames_and_not_in_all) {
  EXPECT_GT(this->expected().crowded, 20u);
  EXPECT_LT(this->expected().crowded, 95u);
}

TYPED_TEST(CrowdBits, are_the_same_for_every_thread_and_lane) {
  using S = TypeParam;
  ThreadPool pool(3);
  for (const bool threads : {false, true}) {
    World<S> world(small_budget<S>());
    if (threads) world.use_threads(pool.runner());
    else world.use_simd(Simd::scalar);
    build_crowds(world);
    EXPECT_EQ(this->play_on(world, 0, this->kFrames).hashes, this->expected().hashes);
  }
}

/// A loaded world has another tree, other caches, another past; one read from bytes has none.
TYPED_TEST(CrowdBits, are_the_same_after_a_rollback_and_from_the_portable_form) {
  using S = TypeParam;
  World<S> world(small_budget<S>()), dirty(small_budget<S>());
  build_crowds(world);
  Pcg32 random = Pcg32::seeded(77);
  add_heap(dirty, random, 40, {1, 2, 3});
  for (int i = 0; i < 10; ++i) dirty.step();
  typename World<S>::Snapshot snapshot;
  for (int frame = 0; frame < this->kFrames - 10; frame += 7) {
    world.save(snapshot);
    const auto straight = this->play_on(world, frame, 10);
    world.load(snapshot);
    ASSERT_EQ(this->play_on(world, frame, 10).hashes, straight.hashes) << frame;
    dirty.load(snapshot);
    ASSERT_EQ(this->play_on(dirty, frame, 10).hashes, straight.hashes) << frame;
    world.load(snapshot);
    const std::vector<std::uint8_t> bytes = bytes_of(world);
    World<S> fresh;
    Reader reader(bytes);
    ASSERT_TRUE(fresh.read_portable(reader));
    ASSERT_EQ(this->play_on(fresh, frame, 10).hashes, straight.hashes) << frame;
    ASSERT_EQ(this->play_on(world, frame, 7).hashes.back(), straight.hashes[6]) << frame;
  }
}

}  // namespace crowd_test
}  // namespace isostep::test
