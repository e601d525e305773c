// Particles: a cloth hung by two corners, a ball thrown into it, and the same twelve frames played twice.
// SPDX-License-Identifier: MIT
#include "isostep/particles/bodies/cloth.hpp"

#include <cstdio>

#include "isostep/state/concepts.hpp"

namespace iso = isostep;
using S = iso::Q32_32;
using World = iso::ParticleWorld<S>;

int main() {
  // README: begin
  World world({.hz = 60, .substeps = 4, .gravity = {0, -10, 0}});
  auto cotton = world.add(iso::ParticleMaterial<S>{.damping = 0.8, .radius = 0.05, .friction = 0.4, .collides = true});
  auto cloth = iso::build(world, iso::ClothDefinition<S>{.columns = 9, .rows = 9, .mass = 4, .material = cotton});
  world.add(iso::Collider<S>{.type = iso::ColliderType::plane, .normal = {0, 1, 0}});
  auto ball = world.create({.position = {0, 2, 2}, .velocity = {0, 1, -6}, .mass = 0.5, .material = cotton});
  auto tether = world.add(iso::Link<S>{.type = iso::LinkType::cable, .a = ball, .anchor = {0, 4, 2}, .length = 5});

  iso::Snapshot<World> frame;
  for (int i = 0; i < 60; ++i) {
    if (i == 48) world.save(frame);
    if (!world.step().clean()) return 1;
  }
  std::uint64_t hash = world.hash();

  world.load(frame);
  for (int i = 48; i < 60; ++i) world.step();
  bool equal = world.hash() == hash;
  // README: end
  const S y = world.position(cloth.particles.back()).y;
  std::printf("%zu springs, the last corner at %.3f m, hash %016llx\n", cloth.springs.size(), iso::to_double(y),
              static_cast<unsigned long long>(hash));
  return equal && cloth && world.remove(tether) && y < S(1) ? 0 : 1;
}
