// Rollback by hand: a game with netcode of its own needs nothing of ours but save, load, step and hash.
// Two peers play the same match; each sees the other's input four frames late, predicts it, and rolls back when wrong.
// SPDX-License-Identifier: MIT
#include <array>
#include <cstdint>
#include <cstdio>

#include "isostep/state/concepts.hpp"
#include "isostep/world/world.hpp"

namespace iso = isostep;
using S = iso::Q32_32;
using World = iso::World<S>;

constexpr int kFrames = 240;
constexpr int kLate = 4;  // [frames]

/// Two pucks that their players push about.
struct Game {
  World world{{.gravity = {0, -10, 0}}};
  std::array<iso::BodyId, 2> pucks;

  Game() {
    const auto floor = world.add_shape(iso::Box{{20, 1, 20}});
    world.create({.shape = floor, .position = {0, -1, 0}});
    const auto puck = world.add_shape(iso::Sphere{0.5});
    for (int player = 0; player < 2; ++player) {
      pucks[player] = world.create({.type = iso::dynamic, .shape = puck, .position = {4 * player - 2, 0.5, 0}});
    }
  }
  void step(const std::array<int, 2>& push) {
    for (int player = 0; player < 2; ++player) world.apply_impulse(pucks[player], {S(push[player]) * S(0.125), 0, 0});
    world.step();
  }
};

/// A player rushes, waits, backs off.
int input_of(int player, int frame) { return (frame / (11 + 6 * player) + player) % 3 - 1; }

struct Peer {
  Game game;
  std::array<iso::Snapshot<World>, kLate + 1> saved;  // a ring: the state before each of the last frames
  std::array<int, kFrames> guess = {};                // of the other's input
  int rollbacks = 0;

  void play(int frame, int player) {
    const int other = 1 - player;
    const int known = frame - kLate;  // the newest frame of which the other's input has arrived
    if (known >= 0 && guess[known] != input_of(other, known)) {
      ++rollbacks;
      game.world.load(saved[known % saved.size()]);
      for (int past = known; past < frame; ++past) {
        guess[past] = input_of(other, known);
        advance(past, player);
      }
    }
    guess[frame] = known >= 0 ? input_of(other, known) : 0;
    advance(frame, player);
  }
  void advance(int frame, int player) {
    game.world.save(saved[frame % saved.size()]);
    std::array<int, 2> push;
    push[player] = input_of(player, frame);
    push[1 - player] = guess[frame];
    game.step(push);
  }
};

int main() {
  Peer peers[2];
  Game straight;  // what a machine that knew all inputs would have played
  for (int frame = 0; frame < kFrames; ++frame) {
    for (int player = 0; player < 2; ++player) peers[player].play(frame, player);
    straight.step({input_of(0, frame), input_of(1, frame)});
  }
  // The last inputs arrive: roll back once more, to the game that really happened.
  for (int player = 0; player < 2; ++player) {
    Peer& peer = peers[player];
    peer.game.world.load(peer.saved[(kFrames - kLate) % peer.saved.size()]);
    for (int frame = kFrames - kLate; frame < kFrames; ++frame) {
      peer.guess[frame] = input_of(1 - player, frame);
      peer.advance(frame, player);
    }
  }
  const bool equal =
      peers[0].game.world.hash() == straight.world.hash() && peers[1].game.world.hash() == straight.world.hash();
  std::printf("%d and %d rollbacks, %s\n", peers[0].rollbacks, peers[1].rollbacks,
              equal ? "all three worlds equal" : "DIVERGED");
  return equal && peers[0].rollbacks > 10 && peers[1].rollbacks > 10 ? 0 : 1;
}
