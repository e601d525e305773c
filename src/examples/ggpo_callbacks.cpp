// The engine under netcode of GGPO's shape: the netcode owns states, inputs and time; the game has four callbacks.
// SPDX-License-Identifier: MIT
#include <array>
#include <cstdint>
#include <cstdio>

#include "isostep/state/composite.hpp"
#include "isostep/world/world.hpp"

namespace iso = isostep;
using S = iso::Q32_32;
using World = iso::World<S>;
constexpr int kFrames = 240, kWindow = 6;  // [frames] in all; that inputs take to the other
using Inputs = std::array<std::uint8_t, 2>;
constexpr std::uint8_t kLeft = 1, kRight = 2, kThrow = 4;

/// The callbacks in the manner of such libraries; the first pointer is there because these two peers share a process.
struct Callbacks {
  void (*save_game_state)(void* game, unsigned char** buffer, int* checksum, int frame);
  void (*load_game_state)(void* game, unsigned char* buffer);
  void (*free_buffer)(void* game, unsigned char* buffer);
  void (*advance_frame)(void* game);
};

/// This class stands for that library. The other's inputs come late and are guessed to stay as they were.
class Netcode {
 public:
  Netcode(const Callbacks& callbacks, void* game, int local) : call_(callbacks), game_(game), local_(local) { save(); }
  void play(std::uint8_t input) {
    inputs_[frame_][local_] = input;
    call_.advance_frame(game_);
  }
  void receive(int frame, std::uint8_t input) {
    if (inputs_[frame][1 - local_] == input) return;
    for (int later = frame; later < kFrames; ++later) inputs_[later][1 - local_] = input;
    const int now = frame_;
    call_.load_game_state(game_, saved_[frame % saved_.size()]);
    for (frame_ = frame; frame_ < now;) call_.advance_frame(game_);
    ++rollbacks;
  }
  Inputs synchronise_input() const { return inputs_[frame_]; }  // for the game, inside advance_frame
  void frame_advanced() {
    ++frame_;
    save();
  }
  int rollbacks = 0;
  std::array<int, kFrames + 1> checksums = {};

 private:
  void save() {
    unsigned char*& buffer = saved_[frame_ % saved_.size()];
    if (buffer != nullptr) call_.free_buffer(game_, buffer);
    call_.save_game_state(game_, &buffer, &checksums[frame_], frame_);
  }
  Callbacks call_;
  void* game_;
  int local_, frame_ = 0;
  std::array<Inputs, kFrames> inputs_ = {};
  std::array<unsigned char*, kWindow + 1> saved_ = {};  // a ring
};

/// The game's own state: saved, loaded and hashed with the world.
struct Own {
  iso::BodyId ball;  // thrown last
  ISO_FIELDS(ball)
};
using State = iso::Composite<World, Own>;
using Saved = iso::Snapshot<State>;

struct Game : State {
  iso::ShapeId shape = world.add_shape(iso::Sphere{0.5});
  iso::BodyId pucks[2];
  Netcode* netcode = nullptr;
  std::array<Saved, kWindow + 1> snapshots;  // written again and again: once warm, nothing allocates
  Game() {
    world.create({.shape = world.add_shape(iso::Box{{20, 1, 20}}), .position = {0, -1, 0}});
    for (int n : {0, 1}) pucks[n] = world.create({.type = iso::dynamic, .shape = shape, .position = {4 * n - 2, 1, 0}});
  }
  void advance() {
    const Inputs inputs = netcode->synchronise_input();
    for (int n : {0, 1}) {
      world.apply_impulse(pucks[n], {S(0.125) * S((inputs[n] >> 1 & 1) - (inputs[n] & 1)), 0, 0});
      if ((inputs[n] & kThrow) == 0) continue;
      if (user.ball) world.destroy(user.ball);
      const auto above = world.pose(pucks[n]).position + iso::Vec3<S>{0, 2, 0};
      user.ball = world.create({.type = iso::dynamic, .shape = shape, .position = above});
    }
    world.step();
    netcode->frame_advanced();
  }
};

/// A buffer is a snapshot, opaque to the netcode; write_portable gives bytes where they are wanted.
const Callbacks kCallbacks = {
    [](void* game, unsigned char** buffer, int* checksum, int frame) {
      Game& g = *static_cast<Game*>(game);
      Saved& snapshot = g.snapshots[frame % g.snapshots.size()];
      g.save(snapshot);
      *buffer = reinterpret_cast<unsigned char*>(&snapshot);
      *checksum = static_cast<int>(g.hash());
    },
    [](void* game, unsigned char* buffer) { static_cast<Game*>(game)->load(*reinterpret_cast<Saved*>(buffer)); },
    [](void*, unsigned char*) {},  // the snapshots stay the game's
    [](void* game) { static_cast<Game*>(game)->advance(); }};

std::uint8_t input_of(int player, int frame) {
  const std::uint8_t way = (frame / (11 + 6 * player) + player) % 2 == 0 ? kLeft : kRight;
  return (frame + 30 * player) % 60 == 0 ? way | kThrow : way;
}

int main() {
  Game games[2];
  Netcode netcode[2] = {{kCallbacks, &games[0], 0}, {kCallbacks, &games[1], 1}};
  for (int frame = 0; frame < kFrames + kWindow; ++frame) {
    for (int player : {0, 1}) {
      games[player].netcode = &netcode[player];
      if (frame >= kWindow) netcode[player].receive(frame - kWindow, input_of(1 - player, frame - kWindow));
      if (frame < kFrames) netcode[player].play(input_of(player, frame));
    }
  }
  const bool equal = netcode[0].checksums == netcode[1].checksums;
  std::printf("%d and %d rollbacks, %s\n", netcode[0].rollbacks, netcode[1].rollbacks, equal ? "equal" : "DIVERGED");
  return equal && netcode[0].rollbacks > 10 && netcode[1].rollbacks > 10 ? 0 : 1;
}
