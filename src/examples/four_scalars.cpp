// The crate of hello.cpp in every scalar: what four_scalars.c and the examples of other languages must print, too. With
// the word "frames" it prints the hash of every frame.
// SPDX-License-Identifier: MIT
#include <cinttypes>
#include <cstdio>
#include <cstring>

#include "isostep/state/concepts.hpp"
#include "isostep/world/world.hpp"

namespace iso = isostep;

namespace {

template <class S> bool play(const char* family, bool frames) {
  iso::World<S> world({.hz = 60, .substeps = 8, .gravity = {S(0), S(-10), S(0)}});
  world.create({.shape = world.add_shape(iso::Box{{50, 1, 50}}), .position = {S(0), S(-1), S(0)}});
  const iso::BodyId body = world.create({.type = iso::dynamic,
                                         .shape = world.add_shape(iso::Box{{0.5, 0.5, 0.5}}),
                                         .position = {S(0), S(2), S(0)},
                                         .user_data = 42});
  world.apply_impulse(body, {S(0), S(3), S(0)});
  iso::Snapshot<iso::World<S>> frame;
  world.save(frame);
  std::uint64_t hashes[2];
  for (std::uint64_t& hash : hashes) {
    world.load(frame);
    for (int step = 0; step < 120; ++step) {
      world.step();
      if (frames) std::printf("%s %d %016" PRIx64 "\n", family, step, world.hash());
    }
    hash = world.hash();
  }
  if (!frames) std::printf("%s %016" PRIx64 " %s\n", family, hashes[0], hashes[0] == hashes[1] ? "equal" : "DIFFERENT");
  return hashes[0] == hashes[1];
}

}  // namespace

int main(int count, char** arguments) {
  const bool frames = count == 2 && std::strcmp(arguments[1], "frames") == 0;
  const bool equal = play<float>("f32", frames) && play<double>("f64", frames) && play<iso::Q16_16>("q16", frames) &&
                     play<iso::Q32_32>("q32", frames);
  return std::fflush(stdout) == 0 ? (equal ? 0 : 1) : 74;
}
