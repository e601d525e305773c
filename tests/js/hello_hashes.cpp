// The hashes of src/examples/hello.cpp's frames natively: hello_hashes SCALAR, one a line, then how hard it lands.
// SPDX-License-Identifier: MIT
#include <cstdio>
#include <string_view>

#include "isostep/world/world.hpp"

namespace iso = isostep;

namespace {

template <class S> struct Play {
  iso::World<S> world{{.hz = 60, .substeps = 8, .gravity = {0, -10, 0}}};
  S hardest = S(0);

  void frames(int count) {
    for (int i = 0; i < count; ++i) {
      world.step();
      std::printf("%016llx\n", static_cast<unsigned long long>(world.hash()));
    }
  }
  int run() {
    const auto ground = world.add_shape(iso::Box{{50, 1, 50}});
    world.create({.shape = ground, .position = {0, -1, 0}});
    const auto crate = world.add_shape(iso::Box{{0.5, 0.5, 0.5}});
    const auto body = world.create({.type = iso::dynamic, .shape = crate, .position = {0, 2, 0}, .user_data = 42});
    world.apply_impulse(body, {0, 3, 0});
    typename iso::World<S>::Snapshot frame;
    world.save(frame);
    frames(120);
    world.load(frame);
    frames(120);
    world.create({.type = iso::dynamic,
                  .shape = crate,
                  .position = {3, 2, 0},
                  .material = {.friction = S(0.5), .restitution = S(0.25)},
                  .filter = {2, 3},
                  .report_contacts = true});
    for (int i = 0; i < 120; ++i) {
      frames(1);
      for (const auto& touch : world.events().contact_begin) hardest = iso::max(hardest, touch.impulse);
    }
    std::printf("%.17g\n", iso::to_double(hardest));
    return 0;
  }
};

}  // namespace

int main(int count, char** words) {
  const std::string_view scalar = count > 1 ? words[1] : "";
  if (scalar == "f32") return Play<float>().run();
  if (scalar == "f64") return Play<double>().run();
  if (scalar == "q16") return Play<iso::Q16_16>().run();
  if (scalar == "q32") return Play<iso::Q32_32>().run();
  std::fprintf(stderr, "usage: hello_hashes f32|f64|q16|q32\n");
  return 64;
}
