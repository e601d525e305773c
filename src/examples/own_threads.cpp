// A step on a game's own threads: four worlds, one a number of threads, and one hash.
// SPDX-License-Identifier: MIT
#include <cinttypes>
#include <cstdio>

#include "isostep/world/world.hpp"
#include "thread_pool.hpp"

namespace iso = isostep;
using World = iso::World<float>;

/// A pyramid of 15 layers, 1240 boxes: enough to be worth sharing.
static void build(World& world) {
  const auto ground = world.add_shape(iso::Box{{50, 1, 50}});
  world.create({.shape = ground, .position = {0, -1, 0}});
  const auto box = world.add_shape(iso::Box{{0.5, 0.5, 0.5}});
  for (int layer = 0; layer < 15; ++layer) {
    const int side = 15 - layer;
    for (int i = 0; i < side * side; ++i) {
      const float x = static_cast<float>(i % side) - 0.5f * static_cast<float>(side - 1);
      const float z = static_cast<float>(i / side) - 0.5f * static_cast<float>(side - 1);
      world.create({.type = iso::dynamic, .shape = box, .position = {1.0625f * x, 0.5f + layer, 1.0625f * z}});
    }
  }
}

int main() {
  std::uint64_t first = 0;
  for (const int threads : {1, 2, 3, 8}) {
    ThreadPool pool(threads);
    World world;
    build(world);
    world.use_threads(pool.runner());
    for (int i = 0; i < 60; ++i) world.step();
    std::printf("%d threads: %016" PRIx64 "\n", threads, world.hash());
    if (threads == 1) first = world.hash();
    if (world.hash() != first) return 1;
  }
}
