// A step outside the tree whose work oneTBB's threads share: the hash is that of one thread.
// SPDX-License-Identifier: MIT
#include <isostep/isostep.hpp>

#include "threads/tbb_runner.hpp"

namespace iso = isostep;
using World = iso::World<iso::Q32_32>;

namespace {

std::uint64_t hash_after(World& world) {
  const auto ball = world.add_shape(iso::Sphere{0.5});
  world.create({.shape = world.add_shape(iso::Box{{20, 1, 20}}), .position = {0, -1, 0}});
  for (int i = 0; i < 64; ++i) {
    world.create({.type = iso::dynamic, .shape = ball, .position = {iso::Q32_32(i % 8), iso::Q32_32(1 + i / 8), 0}});
  }
  for (int i = 0; i < 30; ++i) world.step();
  return world.hash();
}

}  // namespace

int main() {
  iso::threads::TbbRunner threads(2);
  World alone, shared;
  shared.use_threads(threads.runner());
  return hash_after(alone) == hash_after(shared) ? 0 : 1;
}
