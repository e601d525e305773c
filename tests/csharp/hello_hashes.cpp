// The scene of hello.cpp in every scalar: the hash of each of its frames, for the C# game to have the same.
// SPDX-License-Identifier: MIT
#include <cinttypes>
#include <cstdint>
#include <cstdio>

#include "isostep/state/concepts.hpp"
#include "isostep/world/world.hpp"

namespace iso = isostep;

namespace {

template <class S> void play(const char* name) {
  using World = iso::World<S>;
  World world({.hz = 60, .substeps = 8, .gravity = {0, -10, 0}});
  const auto ground = world.add_shape(iso::Box{{50, 1, 50}});
  world.create({.shape = ground, .position = {0, -1, 0}});
  const auto crate = world.add_shape(iso::Box{{0.5, 0.5, 0.5}});
  const auto body = world.create(
      {.type = iso::dynamic, .shape = crate, .position = {0, 2, 0}, .user_data = 42, .report_contacts = true});
  world.apply_impulse(body, {0, 3, 0});
  iso::Snapshot<World> frame;
  world.save(frame);
  for (int time = 0; time < 2; ++time) {
    for (int i = 0; i < 120; ++i) {
      world.step();
      std::printf("%s %d %016" PRIx64 " %zu\n", name, i, world.hash(), world.events().contact_begin.size());
    }
    world.load(frame);
  }
  const auto hit = world.cast_ray({0, 5, 0}, {0, -10, 0});
  std::printf("%s hit %" PRIu64 " %.6f\n", name, hit ? world.user_data(hit->body) : 0,
              hit ? iso::to_double(hit->point.y) : 0);
}

}  // namespace

int main() {
  play<float>("F32");
  play<double>("F64");
  play<iso::Q16_16>("Fixed16");
  play<iso::Q32_32>("Fixed32");
}
