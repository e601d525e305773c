// The big ballistics demonstration: eight rounds of artillery and eight of a pistol at two cubes.
// SPDX-License-Identifier: MIT
#include "book.hpp"
#include "scenes/build.hpp"
#include "scenes/shapes.hpp"

namespace isostep::scenes {
namespace {

constexpr int kRounds = 16, kBetween = 16;  // [1], [frames]

/// Artillery and pistol in turn. Of one size, and slower than the book's: a ball that rolls at 35 m/s turns faster than
/// Q16.16 counts. Material of the book: bounces a little.
SceneBody round_of(int n) {
  const bool artillery = n % 2 == 0;
  SceneBody round = body_of(sphere_part(0.4), {0.25 * (n / 2) - 0.875, 1.5, 0});
  round.mass = artillery ? 200.0 : 1.5;
  round.velocity = artillery ? Vector{0, 16, 20} : Vector{0, 0, 24};
  round.friction = 0.9;
  round.restitution = 0.1;
  round.rolling_resistance = 0.1;
  round.linear_damping = 0.05;
  round.angular_damping = 0.2;
  return round;
}

}  // namespace

Scene ballistics() {
  Scene scene;
  scene.frames = 900;
  scene.script = Script::guns;
  scene.bodies.push_back(fixed_box({0, -1, 60}, {50, 1, 120}));
  for (const double z : {20.0, 65.0}) {
    SceneBody cube = body_of(box_part({1, 1, 1}), {0, 1, z});
    cube.mass = 8;
    cube.friction = 0.9;
    cube.restitution = 0.1;
    scene.bodies.push_back(cube);
  }
  return scene;
}

template <class S> void shoot(World<S>& world) {
  const auto n = static_cast<int>(world.tick()) / kBetween;
  if (world.tick() % kBetween != 0 || n >= kRounds) return;
  add_body(world, round_of(n), 100 + static_cast<std::uint64_t>(n), "script");
}

#define ISO_INSTANTIATE(S) template void shoot<S>(World<S>&);
ISO_FOR_EACH_SCALAR(ISO_INSTANTIATE)
#undef ISO_INSTANTIATE

}  // namespace isostep::scenes
