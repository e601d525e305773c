// Two players walk onto a lift, jump and ride, over a bad line with rollback; both machines in one process.
// SPDX-License-Identifier: MIT
#include <cstdio>

#include "isostep/replay/recorder.hpp"
#include "isostep/session/session.hpp"
#include "isostep/state/composite.hpp"
#include "transport/pump.hpp"
#include "transport/simulated_network.hpp"

namespace iso = isostep;
using S = iso::Q32_32;
using iso::transport::SimulatedNetwork;

constexpr iso::Frame kFrames = 600;
constexpr iso::Frame kRide = 120;  // [frames] the lift waits below, goes up, and comes down

struct Pad {
  std::int8_t walk = 0;  // [1/32 m/s] along x
  std::int8_t jump = 0;
  friend bool operator==(Pad, Pad) = default;
  ISO_FIELDS(walk, jump)
};

struct Jumps {
  std::uint32_t count = 0;
  ISO_FIELDS(count)
};
struct Game : iso::Composite<iso::World<S>, Jumps> {
  using Input = Pad;
  iso::BodyId lift;  // given once and for all: no state
  iso::CharacterId walkers[2];

  Game() {
    world.create({.shape = world.add_shape(iso::Box{{20, 1, 20}}), .position = {0, -1, 0}});
    const auto platform = world.add_shape(iso::Box{{1.5, 0.125, 1.5}});
    lift = world.create({.type = iso::kinematic, .shape = platform, .position = {0, 0, 0}});
    const auto capsule = world.add_shape(iso::Capsule{0.3, 0.6});
    for (int n : {0, 1}) {
      const auto body = world.create({.type = iso::kinematic, .shape = capsule, .position = {8 * n - 4, 1, n}});
      walkers[n] = world.add(iso::CharacterSettings<S>{.body = body});
    }
  }
  void step(iso::InputView<Input> inputs) {
    const auto phase = static_cast<iso::Frame>(world.tick()) / kRide % 3;
    world.set_velocity(lift,
                       {0,
                        phase == 0   ? 0
                        : phase == 1 ? 2
                                     : -2,
                        0},
                       {0, 0, 0});  // what stands on it goes with it
    for (int n : {0, 1}) {
      iso::CharacterInput<S> walk = *world.input(walkers[n]);  // a jump in the air waits for the ground
      walk.move = {S(inputs[n].walk) * S(0.03125), 0, 0};
      if (inputs[n].jump != 0) {
        walk.jump = 4;
        ++user.count;
      }
      world.set_input(walkers[n], walk);
    }
    world.step();
  }
  bool rides(int player) const { return world.state(walkers[player])->ground == lift; }
};

/// A player walks to the lift, then to and fro on it, and jumps now and then.
Pad pad_of(int player, iso::Frame frame) {
  const int there = player == 0 ? 64 : -64, away = frame / 40 % 2 == 0 ? there / 4 : -there / 4;
  return {static_cast<std::int8_t>(frame < 120 ? there : away), static_cast<std::int8_t>(frame % (130 + player) == 0)};
}

struct Machine {
  Game game;
  iso::Session<Game> session;
  SimulatedNetwork::Port port;
  std::uint64_t hashes[kFrames] = {};  // of the final frames
  int ridden = 0;                      // [turns] in which both stood on the lift

  Machine(const iso::SessionConfig& config, SimulatedNetwork::Port its_port) : session(config), port(its_port) {}
  void confirmed(iso::Frame frame, std::uint64_t hash) {
    if (frame < kFrames) hashes[frame] = hash;
  }
  void turn(int player, iso::Time now) {
    iso::transport::deliver(port, session, now);
    session.add_local_input(player, pad_of(player, session.current()));
    iso::drive(session, game, now, *this);
    iso::transport::dispatch(port, session, now);
    ridden += game.rides(0) && game.rides(1) ? 1 : 0;
  }
};

int main() {
  iso::SessionConfig config;
  config.mode = iso::SessionMode::rollback;
  config.identity = iso::make_replay_header(iso::identity_of_world(Game().world.settings(), "walkers")).value();
  SimulatedNetwork network;
  const auto line = network.add_client(iso::transport::parse_profile("latency=75,jitter=20,loss=5").value());
  Machine client(config, network.port(line));
  config.host = true;
  config.seed = 20;  // a game draws it anew for every match
  Machine host(config, network.port(SimulatedNetwork::kHost));

  network.connect(line);
  for (iso::Time now = 0; host.session.confirmed() < kFrames || client.session.confirmed() < kFrames; now += 1000) {
    if (now > 30 * iso::kSecond) return 1;
    network.advance_to(now);
    host.turn(0, now);
    client.turn(1, now);
  }
  iso::Frame equal = 0;
  for (iso::Frame frame = 0; frame < kFrames; ++frame) equal += host.hashes[frame] == client.hashes[frame] ? 1 : 0;
  const auto again = host.session.stats().steps - static_cast<std::uint64_t>(kFrames);
  std::printf("%d of %d frames equal; %llu frames were stepped again; both rode the lift in %d turns\n",
              static_cast<int>(equal), static_cast<int>(kFrames), static_cast<unsigned long long>(again), host.ridden);
  return equal == kFrames && again > 20 && host.ridden > 100 && client.ridden > 100 ? 0 : 1;
}
