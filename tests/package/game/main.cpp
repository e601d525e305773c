// A game outside the tree: drops a stack, kicks it, records everything; prints its last hash.
// SPDX-License-Identifier: MIT
//
// game REPLAY BEHAVIOUR: the behaviour version is what `isostep selfcheck` prints.
#include <cinttypes>
#include <cstdio>
#include <cstdlib>
#include <isostep/state/record.hpp>
#include <isostep/world/world.hpp>
#include <vector>

namespace iso = isostep;
using Number = iso::Q32_32;
using World = iso::World<Number>;

namespace {

iso::Result<iso::ReplayHeader> header_of(const World& world, std::uint64_t behaviour) {
  std::vector<std::uint8_t> bytes;
  iso::Writer writer(bytes);
  writer.write(world.settings().gravity);
  writer.write(world.settings().allow_sleep);
  iso::ReplayIdentity identity{};
  identity.behaviour = behaviour;
  identity.scalar = iso::ScalarTraits<Number>::kName;
  identity.scalar_id = iso::ScalarTraits<Number>::kId;
  identity.hz = static_cast<std::uint32_t>(world.settings().hz);
  identity.substeps = static_cast<std::uint32_t>(world.settings().substeps);
  identity.solver = "soft_step";
  identity.settings_digest = iso::hash_bytes(bytes.data(), bytes.size());
  identity.scene = "a game";
  return iso::make_replay_header(identity);
}

bool write_file(const char* path, const std::vector<std::uint8_t>& bytes) {
  std::FILE* file = std::fopen(path, "wb");
  if (file == nullptr) return false;
  const bool whole = std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size();
  return std::fclose(file) == 0 && whole;
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 3) return 64;
  World world;
  std::vector<std::uint8_t> tape, replay;
  iso::Recorder<World> recorder(iso::sink_to(replay));
  const auto header = header_of(world, std::strtoull(arguments[2], nullptr, 16));
  if (!header || !recorder.begin(world, header.value())) return 1;
  world.record_to(&tape);

  std::vector<iso::BodyId> crates;
  for (int frame = 0; frame < 200; ++frame) {
    tape.clear();
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
    if (!recorder.frame(tape, world.hash())) return 1;
  }
  if (!recorder.finish() || !write_file(arguments[1], replay)) return 1;
  std::printf("%016" PRIx64 "\n", world.hash());
  return 0;
}
