// The game of all matches between languages, in C++: a floor, and a puck a player, whom its input pushes left or right.
// SPDX-License-Identifier: MIT
//
// The same in C: tests/c/session/puck_game.c, in C#: tests/csharp/Pucks.cs.in, in JavaScript: tests/js/pucks.mjs. With
// two players it is the game of src/examples/lockstep_game.cpp.
#pragma once

#include <vector>

#include "isostep/replay/recorder.hpp"
#include "isostep/session/session.hpp"
#include "isostep/state/composite.hpp"

namespace isostep::test {

struct Push {
  std::int8_t way = 0;
  friend bool operator==(Push, Push) = default;
  ISO_FIELDS(way)
};
/// The input of a player who is asked when `current` is the session's frame.
inline Push push_of(Frame current, int player) {
  return {static_cast<std::int8_t>(current / (11 + 6 * player) % 3 - 1)};
}

struct Score {
  std::uint32_t touches = 0;
  ISO_FIELDS(touches)
};
template <class S> struct Pucks : Composite<World<S>, Score> {
  using Input = Push;
  std::vector<BodyId> pucks;

  explicit Pucks(int players = 2) {
    auto& engine = this->world;
    engine.create({.shape = engine.add_shape(Box{{20, 1, 20}}), .position = {0, -1, 0}});
    const auto ball = engine.add_shape(Sphere{0.5});
    for (int n = 0; n < players; ++n)
      pucks.push_back(engine.create(
          {.type = dynamic, .shape = ball, .position = {S(4 * n - 2), 1, 0}, .report_contacts = true}));
  }
  void step(InputView<Input> inputs) {
    for (std::size_t n = 0; n < pucks.size(); ++n) {
      const int way = inputs[static_cast<int>(n)].way;
      this->world.apply_impulse(pucks[n], {S(0.125) * S(way), 0, 0});
    }
    this->world.step();
    this->user.touches += static_cast<std::uint32_t>(this->world.events().contact_begin.size());
  }
};

template <class S> SessionConfig config_of(const Pucks<S>& game) {
  SessionConfig config;
  config.mode = SessionMode::rollback;
  config.players = static_cast<int>(game.pucks.size());
  config.identity = make_replay_header(identity_of_world(game.world.settings(), "pucks")).value();
  return config;
}
template <class S> SessionConfig host_config_of(const Pucks<S>& game) {
  SessionConfig config = config_of(game);
  config.host = true;
  config.seed = 20;
  return config;
}

}  // namespace isostep::test
