// A crate, a ray, an event and a rollback: the interface in one page, over 32.32 fixed point.
// SPDX-License-Identifier: MIT
#include <cstdint>
#include <cstdio>

#include "isostep/state/concepts.hpp"
#include "isostep/world/world.hpp"

namespace iso = isostep;
using World = iso::World<iso::Q32_32>;  // or float, double, Q16_16

int main() {
  constexpr std::uint32_t kGround = 1, kCrate = 2, kAll = 3;
  const iso::Material<iso::Q32_32> wood = {.friction = 0.5, .restitution = 0.25};

  // clang-format off: these lines are README's
  // README: begin
  World world({.hz = 60, .substeps = 8, .gravity = {0, -10, 0}});
  auto ground = world.add_shape(iso::Box{{50, 1, 50}});
  world.create({.shape = ground, .position = {0, -1, 0}, .filter = {kGround, kAll}});
  auto crate = world.add_shape(iso::Box{{0.5, 0.5, 0.5}});
  auto body = world.create({.type = iso::dynamic, .shape = crate, .position = {0, 2, 0}, .material = wood,
                            .filter = {kCrate, kAll}, .user_data = 42});  // a bad one: null id, world.fault() says why
  world.apply_impulse(body, {0, 3, 0});

  iso::Snapshot<World> frame;
  world.save(frame);                                       // into the caller's object: no allocation once warm
  iso::Q32_32 hardest = 0;
  for (int i = 0; i < 120; ++i) {
    iso::StepReport report = world.step();                 // clean() unless a limit was met
    for (const auto& touch : world.events().contact_begin) hardest = iso::max(hardest, touch.impulse);
    if (!report.clean()) return 1;
  }
  std::uint64_t hash = world.hash();                       // the same on every machine

  world.load(frame);                                       // same ids, same future
  for (int i = 0; i < 120; ++i) world.step();
  bool equal = world.hash() == hash;

  auto hit = world.cast_ray({0, 5, 0}, {0, -10, 0}, {.mask = kCrate});
  // README: end
  // clang-format on

  std::printf("%016llx %s, hardest impact %.2f kg m/s, ray hits user %llu\n", static_cast<unsigned long long>(hash),
              equal ? "equal after rollback" : "DIFFERENT after rollback", iso::to_double(hardest),
              static_cast<unsigned long long>(hit ? world.user_data(hit->body) : 0));
  return equal && hit && hit->body == body && hardest > iso::Q32_32(1) ? 0 : 1;
}
