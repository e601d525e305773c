// Threads: however many, in whatever order they come and whether they come at all, a step's bits are those of one.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "determinism/mess.hpp"
#include "examples/thread_pool.hpp"
#include "isostep/scalar/environment.hpp"
#include "scenes/build.hpp"
#include "scenes/named.hpp"

namespace isostep::test {
namespace threads_test {

/// The hashes of a scene that is worth sharing in every scalar and at every width: a pyramid that settles, and ragdolls
/// that fall into it.
template <class S> std::vector<std::uint64_t> hashes_of(const char* scene, const TaskRunner& runner, int frames) {
  const scenes::Scene what = *scenes::find_scene(scene);
  World<S> world(scenes::settings_of<S>(what));
  scenes::build(what, world);
  world.use_threads(runner);
  std::vector<std::uint64_t> hashes;
  for (int i = 0; i < frames; ++i) {
    world.step();
    hashes.push_back(world.hash());
  }
  return hashes;
}

/// Another's runner, and how often it was asked.
struct Counted {
  TaskRunner inner;
  int calls = 0;

  TaskRunner runner() {
    const auto run = [](void* user, std::int32_t copies, TaskRunner::Task task, void* data) {
      auto& self = *static_cast<Counted*>(user);
      ++self.calls;
      self.inner.run(self.inner.user, copies, task, data);
    };
    return {run, this, inner.threads};
  }
};

template <class S> class Threads : public ::testing::Test {
 protected:
  static constexpr int kFrames = 24;
  static const std::vector<std::uint64_t>& expected() {
    static const std::vector<std::uint64_t> hashes = hashes_of<S>("S3", {}, kFrames);
    return hashes;
  }
};
TYPED_TEST_SUITE(Threads, AllScalars);

TYPED_TEST(Threads, of_any_number_give_the_hashes_of_one) {
  for (const int threads : {1, 2, 3, 5, 8}) {
    ThreadPool pool(threads);
    Counted counted = {pool.runner()};
    EXPECT_EQ(hashes_of<TypeParam>("S3", counted.runner(), this->kFrames), this->expected()) << threads << " threads";
    EXPECT_GE(counted.calls, threads > 1 ? 2 * this->kFrames : 0);
  }
}

TYPED_TEST(Threads, that_come_one_after_another_or_not_at_all_change_nothing) {
  const auto in_turn = [](void*, std::int32_t copies, TaskRunner::Task task, void* data) {
    for (int i = 0; i < copies; ++i) task(data);
  };
  const auto nobody = [](void*, std::int32_t, TaskRunner::Task, void*) {};
  EXPECT_EQ(hashes_of<TypeParam>("S3", {in_turn, nullptr, 5}, this->kFrames), this->expected());
  EXPECT_EQ(hashes_of<TypeParam>("S3", {nobody, nullptr, 2}, this->kFrames), this->expected());
}

#if defined(__SSE2__) && defined(__GNUC__)
/// A pool whose threads round towards zero and know no denormals.
struct Hostile {
  ThreadPool pool{4};
  TaskRunner::Task asked = nullptr;
  void* what = nullptr;

  TaskRunner runner() {
    const auto run = [](void* user, std::int32_t copies, TaskRunner::Task task, void* data) {
      auto& self = *static_cast<Hostile*>(user);
      self.asked = task;
      self.what = data;
      const TaskRunner inner = self.pool.runner();
      inner.run(inner.user, copies, &Hostile::call, user);
    };
    return {run, this, 4};
  }
  static void call(void* user) {
    const auto& self = *static_cast<const Hostile*>(user);
    const std::uint64_t before = isostep::detail::FloatState::read();
    isostep::detail::FloatState::write(0x1f80 | 0x6000 | 0x8040);
    self.asked(self.what);
    EXPECT_EQ(isostep::detail::FloatState::read() & 0xffc0u, 0x1f80u | 0x6000u | 0x8040u);
    isostep::detail::FloatState::write(before);
  }
};

TYPED_TEST(Threads, in_whatever_float_environment_change_nothing) {
  Hostile hostile;
  EXPECT_EQ(hashes_of<TypeParam>("S3", hostile.runner(), this->kFrames), this->expected());
}
#endif

TYPED_TEST(Threads, share_joints_mixed_shapes_and_a_drum) {
  for (const char* scene : {"S4", "S7", "S9"}) {
    ThreadPool pool(3);
    EXPECT_EQ(hashes_of<TypeParam>(scene, pool.runner(), 40), hashes_of<TypeParam>(scene, {}, 40)) << scene;
  }
}

TYPED_TEST(Threads, are_not_asked_for_little) {
  ThreadPool pool(2);
  Counted counted = {pool.runner()};
  hashes_of<TypeParam>("S1x5", counted.runner(), 10);
  EXPECT_EQ(counted.calls, 0);
}

}  // namespace threads_test
}  // namespace isostep::test
