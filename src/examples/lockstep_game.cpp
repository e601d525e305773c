// A game for two over the session layer: rollback here, lockstep by one word; the network is a queue of 80 ms.
// SPDX-License-Identifier: MIT
#include <cstdint>
#include <cstdio>
#include <deque>
#include <vector>

#include "isostep/session/session.hpp"
#include "isostep/world/recorder.hpp"

namespace iso = isostep;
using S = iso::Q32_32;

struct Push {
  std::int8_t way = 0;  // -1, 0, 1
  friend bool operator==(Push, Push) = default;
  template <class Visitor, class Self> static constexpr void fields(Visitor&& visit, Self&& self) {
    visit("way", self.way);
  }
};
Push input_of(int player, int frame) {
  return {static_cast<std::int8_t>((frame / (11 + 6 * player) + player) % 3 - 1)};
}

/// All its state is the world's: save, load, hash and the portable form are inherited.
struct Game : iso::World<S> {
  using Input = Push;
  iso::BodyId pucks[2];

  Game() {
    create({.shape = add_shape(iso::Box{{20, 1, 20}}), .position = {0, -1, 0}});
    const auto ball = add_shape(iso::Sphere{0.5});
    for (int n : {0, 1}) pucks[n] = create({.type = iso::dynamic, .shape = ball, .position = {4 * n - 2, 1, 0}});
  }
  void step(iso::InputView<Input> inputs) {
    for (int n : {0, 1}) apply_impulse(pucks[n], {S(0.125) * S(inputs[n].way), 0, 0});
    World::step();
  }
};

/// One machine: its game, its session, what is on the way to it, and what it knows to be final.
struct Peer {
  struct Parcel {
    iso::Time due;
    iso::Channel channel;
    std::vector<std::uint8_t> bytes;
  };
  Game game;
  iso::Session<Game> session;
  std::deque<Parcel> wire;
  std::vector<std::uint64_t> roots;
  int rollbacks = 0;

  explicit Peer(const iso::SessionConfig& config) : session(config) { session.connected(0, 0); }
  // drive() tells it:
  void rolled_back(iso::Frame) { ++rollbacks; }
  void confirmed(iso::Frame, std::uint64_t root) { roots.push_back(root); }

  void turn(int player, Peer& other, iso::Time now) {
    for (; !wire.empty() && wire.front().due <= now; wire.pop_front()) {
      session.receive(0, wire.front().channel, wire.front().bytes, now);
    }
    session.add_local_input(player, input_of(player, session.current()));
    drive(session, game, now, *this);
    while (const auto out = session.poll_send(now)) {
      other.wire.push_back({now + 80000, out->channel, {out->bytes.begin(), out->bytes.end()}});
    }
  }
};

int main() {
  iso::SessionConfig config;
  config.mode = iso::SessionMode::rollback;  // lockstep: nothing else changes
  config.most_delay = config.delay = 1;
  const auto identity = iso::make_replay_header(iso::identity_of_world(Game().settings(), "two pucks"));
  if (!identity) return 1;
  config.identity = identity.value();
  Peer client(config);
  config.host = true;
  Peer host(config);
  for (iso::Time now = 0; now < 6 * iso::kSecond; now += 1000) {
    host.turn(0, client, now);
    client.turn(1, host, now);
  }
  const std::size_t frames = iso::min(host.roots.size(), client.roots.size());
  host.roots.resize(frames);
  client.roots.resize(frames);
  const bool equal = host.roots == client.roots;
  std::printf("%zu frames final, %d and %d rollbacks, %s\n", frames, host.rollbacks, client.rollbacks,
              equal ? "equal" : "DIVERGED");
  return equal && frames > 200 && host.rollbacks > 10 && client.rollbacks > 10 ? 0 : 1;
}
