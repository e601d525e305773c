// A crowd of boxes, balls and chains on several threads, for the thread sanitizer to watch: the hashes of one thread.
// SPDX-License-Identifier: MIT
#include <cinttypes>
#include <cstdio>

#include "examples/thread_pool.hpp"
#include "isostep/world/world.hpp"

namespace iso = isostep;
using World = iso::World<float>;

constexpr int kFrames = 24;

/// Ten layers of a pyramid and as many chains of four balls: joints, contacts of every number of points, many colours.
static void build(World& world) {
  world.use_simd(iso::Simd::scalar);  // kernels of wider lanes are not watched
  const auto ground = world.add_shape(iso::Box{{50, 1, 50}});
  world.create({.shape = ground, .position = {0, -1, 0}});
  const auto box = world.add_shape(iso::Box{{0.5, 0.5, 0.5}});
  const auto ball = world.add_shape(iso::Sphere{0.25});
  for (int layer = 0; layer < 10; ++layer) {
    const int side = 10 - layer;
    for (int i = 0; i < side * side; ++i) {
      const float x = static_cast<float>(i % side) - 0.5f * static_cast<float>(side);
      const float z = static_cast<float>(i / side) - 0.5f * static_cast<float>(side);
      const float y = 0.5f + static_cast<float>(layer);
      world.create({.type = iso::dynamic, .shape = box, .position = {1.0625f * x, y, 1.0625f * z}});
    }
    iso::BodyId last = {};
    for (int i = 0; i < 4; ++i) {
      const iso::Vec3<float> at = {static_cast<float>(layer) - 5, 11 + 0.5f * static_cast<float>(i), 0};
      const auto link = world.create({.type = iso::dynamic, .shape = ball, .position = at});
      const iso::Pose<float> frame = {at - iso::Vec3<float>{0, 0.25f, 0}, iso::Quat<float>::identity()};
      if (i > 0) world.create(world.joint_at(iso::JointType::ball, last, link, frame));
      last = link;
    }
  }
}

int main() {
  std::uint64_t expected = 0;
  for (const int threads : {1, 2, 3, 8}) {
    ThreadPool pool(threads);
    int asked = 0;
    struct Counted {
      iso::TaskRunner inner;
      int* asked;
    } counted = {pool.runner(), &asked};
    World world;
    build(world);
    world.use_threads({[](void* user, std::int32_t copies, iso::TaskRunner::Task task, void* data) {
                         const Counted& c = *static_cast<Counted*>(user);
                         ++*c.asked;
                         c.inner.run(c.inner.user, copies, task, data);
                       },
                       &counted, threads});
    for (int i = 0; i < kFrames; ++i) world.step();
    const iso::WorldCounts counts = world.counts();
    std::printf("%d threads: %016" PRIx64 ", %u contacts, asked %d times\n", threads, world.hash(), counts.contacts,
                asked);
    if (threads == 1) expected = world.hash();
    if (world.hash() != expected || counts.contacts < 1000 || (threads > 1 && asked != 2 * kFrames)) return 1;
  }
}
