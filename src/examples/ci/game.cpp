// The game that continuous integration runs: whether this machine computes as it should, and the hash of every frame
// of a match that is always the same.
// SPDX-License-Identifier: MIT
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "isostep/replay/selfcheck.hpp"
#include "isostep/world/world.hpp"

namespace iso = isostep;

namespace {

int selfcheck() {
  const iso::SelfcheckResult check = iso::selfcheck();
  std::printf("%s\n", iso::describe(check).c_str());
  return check.sound() ? 0 : 1;
}

/// Ten crates fall on a floor, and a push comes now and then, as a player would give it.
template <class S> void play(const char* scalar, int frames) {
  iso::World<S> world({.hz = 60, .substeps = 4, .gravity = {0, -10, 0}});
  world.create({.shape = world.add_shape(iso::Box{{50, 1, 50}}), .position = {0, -1, 0}});
  const iso::ShapeId crate = world.add_shape(iso::Box{{0.5, 0.5, 0.5}});
  iso::BodyId bodies[10];
  for (int i = 0; i < 10; ++i) {
    bodies[i] = world.create({.type = iso::dynamic, .shape = crate, .position = {S(i % 3), S(1 + i), S(0)}});
  }
  for (int frame = 0; frame < frames; ++frame) {
    if (frame % 20 == 19) world.apply_impulse(bodies[frame / 20 % 10], {S(2), S(3), S(1)});
    world.step();
    std::printf("%s %d %016llx\n", scalar, frame, static_cast<unsigned long long>(world.hash()));
  }
}

}  // namespace

int main(int count, char** arguments) {
  if (count == 2 && std::strcmp(arguments[1], "selfcheck") == 0) return selfcheck();
  if (count == 3 && std::strcmp(arguments[1], "hashes") == 0) {
    play<float>("float", std::atoi(arguments[2]));
    play<iso::Q32_32>("q32.32", std::atoi(arguments[2]));
    return std::fflush(stdout) == 0 ? 0 : 74;
  }
  std::fprintf(stderr, "usage: game selfcheck | hashes FRAMES\n");
  return 64;
}
