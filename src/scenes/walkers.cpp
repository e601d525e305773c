// Characters of a capsule of 0.3 m and 0.6 m half a cylinder, 15 in a row, who fall on the pile and walk with 2 m/s.
// SPDX-License-Identifier: MIT
#include "walkers.hpp"

#include "build.hpp"
#include "isostep/store/state.hpp"
#include "named.hpp"
#include "shapes.hpp"

namespace isostep::scenes {
namespace {

constexpr int kRow = 15;
constexpr double kApart = 0.65, kAbove = 8;  // [m] between two, and of the floor
constexpr double kSpeed = 2;                 // [m/s]
constexpr std::uint32_t kSeed = 77;

template <class S> S scalar(double value) { return value_of<S>(value, "script"); }

template <class S> void add_walkers(World<S>& world) {
  BodyDefinition<S> body;
  body.type = BodyType::kinematic;
  body.allow_sleep = false;
  body.shape = world.add_shape(Capsule<S>{scalar<S>(0.3), scalar<S>(0.6)});
  for (int n = 0; n < kWalkers; ++n) {
    const double column = n % kRow - 0.5 * (kRow - 1), row = n / kRow - 0.5 * (kRow - 1);
    body.position = {scalar<S>(kApart * column), scalar<S>(kAbove), scalar<S>(kApart * row)};
    CharacterSettings<S> walker;
    walker.body = world.create(body);
    walker.step_height = scalar<S>(0.4);
    world.add(walker);
  }
}

}  // namespace

Scene walkers() {
  Scene scene = pile(1000);
  scene.frames = 900;
  scene.script = Script::walkers;
  return scene;
}

template <class S> void lead_walkers(World<S>& world) {
  const std::uint64_t tick = world.tick();
  if (tick < kWalkersCome || tick % kWalkersTurn != 0) return;
  if (tick == kWalkersCome) add_walkers(world);
  Draws draws(kSeed);
  for (std::uint64_t i = 0; i < (tick - kWalkersCome) / kWalkersTurn * kWalkers; ++i) draws.next();
  for (const CharacterId id : world.state().records->characters.slot_map().template ids<CharacterId>()) {
    const SinCos<S> way = sin_cos(scalar<S>(kTurn * draws.unit()));
    CharacterInput<S> walk;
    walk.move = {scalar<S>(kSpeed) * way.cos, S(0), scalar<S>(kSpeed) * way.sin};
    world.set_input(id, walk);
  }
}

#define ISO_INSTANTIATE(S) template void lead_walkers<S>(World<S>&);
ISO_FOR_EACH_SCALAR(ISO_INSTANTIATE)
#undef ISO_INSTANTIATE

}  // namespace isostep::scenes
