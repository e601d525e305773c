// A game outside the tree: drops a stack, kicks it, records everything; prints its last hash.
// SPDX-License-Identifier: MIT
//
// game REPLAY: writes the recording there.
#include <cinttypes>
#include <cstdio>
#include <isostep/isostep.hpp>
#include <vector>

namespace iso = isostep;
using Number = iso::Q32_32;
using World = iso::World<Number>;

namespace {

bool write_file(const char* path, const std::vector<std::uint8_t>& bytes) {
  std::FILE* file = std::fopen(path, "wb");
  if (file == nullptr) return false;
  const bool whole = std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size();
  return std::fclose(file) == 0 && whole;
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) return 64;
  if (const iso::SelfcheckResult check = iso::selfcheck(); !check.sound())
    return std::fprintf(stderr, "%s\n", iso::describe(check).c_str()), 2;
  World world;
  std::vector<std::uint8_t> replay;
  iso::WorldRecorder<Number> recorder(world, iso::sink_to(replay));
  if (!recorder.begin("a game")) return 1;

  std::vector<iso::BodyId> crates;
  for (int frame = 0; frame < 200; ++frame) {
    if (frame == 0) {
      const auto ground = world.add_shape(iso::HalfSpace<Number>{{0, 1, 0}, 0});
      const auto crate = world.add_shape(iso::Box{{0.5, 0.5, 0.5}});
      world.create({.shape = ground});
      for (int i = 0; i < 5; ++i) {
        crates.push_back(world.create(
            {.type = iso::BodyType::dynamic, .shape = crate, .position = {0, Number(i) + Number(0.5), 0}}));
      }
    }
    if (frame == 100) world.apply_impulse(crates.back(), {3, 0, 1});
    if (frame == 150) world.destroy(crates.front());
    world.step();
    if (!recorder.end_frame()) return 1;
  }
  if (!recorder.finish() || !write_file(arguments[1], replay)) return 1;
  std::printf("%016" PRIx64 "\n", world.hash());
  return 0;
}
