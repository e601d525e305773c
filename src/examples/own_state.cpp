// A game whose own state (score, clock, dice) is a composite with its world, inside a session: rolled back, hashed and
// written together. The session is a sync test, which finds whatever a game forgets to save.
// SPDX-License-Identifier: MIT
#include <cstdio>

#include "isostep/core/random.hpp"
#include "isostep/session/session.hpp"
#include "isostep/state/composite.hpp"
#include "isostep/world/world.hpp"

namespace iso = isostep;
using S = iso::Q32_32;
using World = iso::World<S>;

struct Paddle {  // what the player does in a frame
  std::int8_t way = 0;
  friend bool operator==(Paddle, Paddle) = default;
  ISO_FIELDS(way)
};

struct Rules {  // what the game remembers beside its world: a plain struct with `fields` is saved by copying
  std::uint32_t score = 0;
  std::uint32_t frames_until_ball = 1;
  iso::Pcg32 dice = iso::Pcg32::seeded(7);
  ISO_FIELDS(score, frames_until_ball, dice)
};

struct Game : iso::Composite<World, Rules> {  // world and user: saved, loaded, hashed and written as one
  using Input = Paddle;
  iso::ShapeId ball;  // given once and for all: no state
  iso::BodyId paddle;

  Game() {
    ball = world.add_shape(iso::Sphere{0.25});
    paddle = world.create(
        {.type = iso::kinematic, .shape = world.add_shape(iso::Box{{1, 0.125, 1}}), .report_contacts = true});
  }
  void step(iso::InputView<Input> inputs) {
    world.set_velocity(paddle, {S(4 * inputs[0].way), 0, 0}, {0, 0, 0});
    if (--user.frames_until_ball == 0) {
      user.frames_until_ball = 20 + iso::random_below(user.dice, 20);
      world.create({.type = iso::dynamic, .shape = ball, .position = {iso::uniform(user.dice, S(-2), S(2)), 3, 0}});
    }
    world.step();
    user.score += static_cast<std::uint32_t>(world.events().contact_begin.size());
    for (const iso::BodyId body : world.bodies()) {
      if (world.center_of_mass(body).y < S(-3)) world.destroy(body);
    }
  }
};

int main() {
  iso::SessionConfig config;
  config.mode = iso::SessionMode::sync_test;  // rollback, lockstep: nothing else changes
  config.players = 1;
  Game game;
  iso::Session<Game> session(config);
  int flaws = 0;
  for (iso::Time now = 0; session.current() < 600; now += iso::kSecond / 60 + 1) {
    session.add_local_input(0, {static_cast<std::int8_t>(session.current() / 25 % 3 - 1)});
    iso::drive(session, game, now);
    while (const auto event = session.poll_event()) {
      const bool flaw =
          event->kind == iso::SessionEvent::Kind::desync || event->kind == iso::SessionEvent::Kind::unhashed;
      flaws += flaw ? 1 : 0;
    }
  }
  std::printf("score %u after 600 frames, %llu of them stepped again; %d flaws\n", game.user.score,
              static_cast<unsigned long long>(session.stats().steps - 600), flaws);
  return flaws == 0 && game.user.score > 0 ? 0 : 1;
}
