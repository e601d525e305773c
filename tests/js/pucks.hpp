// The game of src/examples/lockstep_game.cpp over the scalar of the tests, and its host's configuration.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/session/session.hpp"
#include "isostep/state/composite.hpp"
#include "isostep/world/recorder.hpp"

namespace iso = isostep;
using isostep::Q16_16, isostep::Q32_32;
using S = ISOSTEP_TEST_SCALAR;

struct Push {
  std::int8_t way = 0;
  friend bool operator==(Push, Push) = default;
  template <class Visitor, class Self> static constexpr void fields(Visitor&& visit, Self&& self) {
    visit("way", self.way);
  }
};
struct Score {
  std::uint32_t touches = 0;
  template <class Visitor, class Self> static constexpr void fields(Visitor&& visit, Self&& self) {
    visit("touches", self.touches);
  }
};
struct Game : iso::Composite<iso::World<S>, Score> {
  using Input = Push;
  iso::BodyId pucks[2];

  Game() {
    world.create({.shape = world.add_shape(iso::Box{{20, 1, 20}}), .position = {0, -1, 0}});
    const auto ball = world.add_shape(iso::Sphere{0.5});
    for (int n : {0, 1}) pucks[n] = world.create({.type = iso::dynamic, .shape = ball, .position = {4 * n - 2, 1, 0}});
  }
  void step(iso::InputView<Input> inputs) {
    for (int n : {0, 1}) world.apply_impulse(pucks[n], {S(0.125) * S(inputs[n].way), 0, 0});
    world.step();
    user.touches += static_cast<std::uint32_t>(world.events().contact_begin.size());
  }
};

inline iso::SessionConfig config_of(const Game& game) {
  iso::SessionConfig config;
  config.mode = iso::SessionMode::rollback;
  config.host = true;
  config.seed = 20;
  config.identity = iso::make_replay_header(iso::identity_of_world(game.world.settings(), "two pucks")).value();
  return config;
}
