// A game for two over a bad line, both machines in one process; rollback here, lockstep by one word.
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

struct Push {  // what a player does in a frame, and how it travels
  std::int8_t way = 0;
  friend bool operator==(Push, Push) = default;
  ISO_FIELDS(way)
};

// README: begin
struct Score {  // what the game remembers beside its world
  std::uint32_t touches = 0;
  ISO_FIELDS(touches)
};
struct Game : iso::Composite<iso::World<S>, Score> {  // world and user: saved, rolled back and hashed as one
  using Input = Push;
  iso::BodyId pucks[2];  // given once and for all: no state

  Game() {
    world.create({.shape = world.add_shape(iso::Box{{20, 1, 20}}), .position = {0, -1, 0}});
    const auto ball = world.add_shape(iso::Sphere{0.5});
    for (int n : {0, 1})
      pucks[n] = world.create(
          {.type = iso::dynamic, .shape = ball, .position = {4 * n - 2, 1, 0}, .report_contacts = true});
  }
  void step(iso::InputView<Input> inputs) {
    for (int n : {0, 1}) world.apply_impulse(pucks[n], {S(0.125) * S(inputs[n].way), 0, 0});
    world.step();
    user.touches += static_cast<std::uint32_t>(world.events().contact_begin.size());
  }
};
// README: end

struct Machine {
  Game game;
  iso::Session<Game> session;
  SimulatedNetwork::Port port;
  std::uint64_t hashes[300] = {};  // of the final frames

  Machine(const iso::SessionConfig& config, SimulatedNetwork::Port its_port) : session(config), port(its_port) {}
  void confirmed(iso::Frame frame, std::uint64_t hash) {  // drive() calls this
    if (frame < 300) hashes[frame] = hash;
  }
  // README: begin
  void turn(int player, iso::Time now) {
    iso::transport::deliver(port, session, now);
    session.add_local_input(player, {static_cast<std::int8_t>((session.current() / (11 + 6 * player)) % 3 - 1)});
    iso::drive(session, game, now, *this);
    iso::transport::dispatch(port, session, now);
  }
  // README: end
};

int main() {
  iso::SessionConfig config;
  config.mode = iso::SessionMode::rollback;  // lockstep: nothing else changes
  config.identity = iso::make_replay_header(iso::identity_of_world(Game().world.settings(), "two pucks")).value();
  SimulatedNetwork network;
  const auto line = network.add_client(iso::transport::parse_profile("latency=80,jitter=20,loss=5").value());
  Machine client(config, network.port(line));
  config.host = true;
  config.seed = 20;  // a game draws it anew for every match
  Machine host(config, network.port(SimulatedNetwork::kHost));

  network.connect(line);
  for (iso::Time now = 0; host.session.confirmed() < 300 || client.session.confirmed() < 300; now += 1000) {
    if (now > 20 * iso::kSecond) return 1;
    network.advance_to(now);
    host.turn(0, now);
    client.turn(1, now);
  }
  int equal = 0;
  for (int frame = 0; frame < 300; ++frame) equal += host.hashes[frame] == client.hashes[frame] ? 1 : 0;
  std::printf("%d of 300 frames equal; %llu frames were stepped again\n", equal,
              static_cast<unsigned long long>(host.session.stats().steps - 300));
  return equal == 300 && host.session.stats().steps > 320 ? 0 : 1;
}
