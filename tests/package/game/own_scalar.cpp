// A world over the game's own number format: a crate falls onto the ground and rests there.
// SPDX-License-Identifier: MIT
#include <cstdio>
#include <isostep/world/world.hpp>

#include "number.hpp"

int main() {
  namespace iso = isostep;
  using game::Number;
  iso::World<Number> world;
  const auto ground = world.add_shape(iso::HalfSpace<Number>{{0, 1, 0}, 0});
  const auto shape = world.add_shape(iso::Box{{0.5, 0.5, 0.5}});
  world.create({.shape = ground});
  const auto crate = world.create({.type = iso::BodyType::dynamic, .shape = shape, .position = {0, 2, 0}});
  if (!crate) return 1;

  iso::World<Number>::Snapshot frame;
  world.save(frame);
  for (int i = 0; i < 120; ++i) world.step();
  const Number height = world.pose(crate).position.y;
  std::printf("%s with %s lanes, resting at %f\n", iso::ScalarTraits<Number>::kName, world.simd_name(),
              iso::to_double(height));
  if (iso::abs(height - Number(0.5)) > Number(0.01)) return 2;

  const auto hash = world.hash();
  world.load(frame);
  for (int i = 0; i < 120; ++i) world.step();
  if (world.hash() != hash) return 3;
  return iso::sin(Number(1)) > Number(0.84147) && iso::sin(Number(1)) < Number(0.84148) ? 0 : 4;
}
