// A crate, a ray, an event and a rollback: the interface in one page, over 32.32 fixed point.
// SPDX-License-Identifier: MIT
#include <cstdint>
#include <cstdio>

#include "isostep/state/concepts.hpp"
#include "isostep/world/world.hpp"

namespace iso = isostep;
using World = iso::World<iso::Q32_32>;  // or float, double, Q16_16

int main() {
  // clang-format off
  // README: begin
  World world({.hz = 60, .substeps = 8, .gravity = {0, -10, 0}});
  auto ground = world.add_shape(iso::Box{{50, 1, 50}});
  world.create({.shape = ground, .position = {0, -1, 0}});
  auto crate = world.add_shape(iso::Box{{0.5, 0.5, 0.5}});
  auto body = world.create({.type = iso::dynamic, .shape = crate, .position = {0, 2, 0}, .user_data = 42});
  world.apply_impulse(body, {0, 3, 0});

  iso::Snapshot<World> frame;
  world.save(frame);                                       // into the caller's object: no allocation once warm
  for (int i = 0; i < 120; ++i) world.step();
  std::uint64_t hash = world.hash();                       // the same on every machine

  world.load(frame);                                       // same ids, same future
  for (int i = 0; i < 120; ++i) world.step();
  bool equal = world.hash() == hash;

  auto hit = world.cast_ray({0, 5, 0}, {0, -10, 0});       // the crate
  // README: end
  // clang-format on

  // A second crate, of wood, which a ray can be told to look for alone; what steps report, and how hard it lands.
  constexpr std::uint32_t kWood = 2, kAll = 3;
  auto wooden = world.create({.type = iso::dynamic,
                              .shape = crate,
                              .position = {3, 2, 0},
                              .material = {.friction = 0.5, .restitution = 0.25},
                              .filter = {kWood, kAll},
                              .report_contacts = true});  // a bad one: null id, and world.fault() says why
  iso::Q32_32 hardest = 0;
  for (int i = 0; i < 120; ++i) {
    iso::StepReport report = world.step();  // clean() unless a limit was met
    for (const auto& touch : world.events().contact_begin) hardest = iso::max(hardest, touch.impulse);
    if (!report.clean()) return 1;
  }
  auto wood = world.cast_ray({3, 5, 0}, {0, -10, 0}, {.mask = kWood});

  std::printf("%016llx %s, hardest impact %.2f kg m/s, ray hits user %llu\n", static_cast<unsigned long long>(hash),
              equal ? "equal after rollback" : "DIFFERENT after rollback", iso::to_double(hardest),
              static_cast<unsigned long long>(hit ? world.user_data(hit->body) : 0));
  const bool found = hit && hit->body == body && wood && wood->body == wooden;
  return equal && found && hardest > iso::Q32_32(1) ? 0 : 1;
}
