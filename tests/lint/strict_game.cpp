// A game of its own warnings: see CMakeLists.txt. It is compiled, not linked.
// SPDX-License-Identifier: MIT
#include "isostep/isostep.hpp"

namespace {

struct Input {
  std::int16_t x = 0, y = 0;
};

struct Game {
  isostep::World<isostep::Q32_32> world;

  void step(isostep::InputView<Input>) { world.step(); }
};

}  // namespace

int main() {
  Game game;
  isostep::World<float> coarse;
  isostep::World<double> fine;
  isostep::ParticleWorld<isostep::Q16_16> particles;
  return game.world.tick() + coarse.tick() + fine.tick() + particles.tick() == 0 ? 0 : 1;
}
