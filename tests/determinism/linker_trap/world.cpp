// Steps a pile of every scalar and prints its hashes: linked against the library, and against the library at -O0 behind
// a user's file that was compiled with -mfma.
// SPDX-License-Identifier: MIT
#include "isostep/world/world.hpp"

#include <cinttypes>
#include <cstdio>

namespace {

using namespace isostep;

template <class S> void run() {
  World<S> world;
  const ShapeId ground = world.add_shape(HalfSpace<S>{{Unit<S>(0), Unit<S>(1), Unit<S>(0)}, S(0)});
  const ShapeId crate = world.add_shape(Box{{0.5, 0.4, 0.3}});
  const ShapeId ball = world.add_shape(Sphere{0.4});
  const ShapeId pill = world.add_shape(Capsule{0.3, 0.3});
  world.create({.shape = ground});
  const ShapeId shapes[] = {crate, ball, pill};
  for (int i = 0; i < 24; ++i) {
    BodyDefinition<S> body;
    body.type = BodyType::dynamic;
    body.shape = shapes[i % 3];
    body.position = {S(i % 4) * S(0.75), S(1) + S(i) * S(0.375), S(i % 3) * S(0.625)};
    body.angular_velocity = {S(i % 5), S(1), S(0)};
    world.create(body);
  }
  for (int frame = 0; frame < 90; ++frame) world.step();
  std::printf("%s %016" PRIx64 "\n", ScalarTraits<S>::kName, world.hash());
}

}  // namespace

int main() {
  run<float>();
  run<double>();
  run<Q16_16>();
  run<Q32_32>();
}
