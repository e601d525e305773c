// A match over UDP that nobody reads or forges: two machines in one process, ENet between them, a key from the lobby.
// SPDX-License-Identifier: MIT
#include <chrono>
#include <cstdio>
#include <utility>

#include "isostep/replay/recorder.hpp"
#include "isostep/session/session.hpp"
#include "isostep/state/composite.hpp"
#include "sealed/sealed_transport.hpp"
#include "transport/enet_transport.hpp"
#include "transport/pump.hpp"

namespace iso = isostep;
using S = iso::Q32_32;
using iso::transport::EnetTransport;

struct Push {
  std::int8_t way = 0;
  friend bool operator==(Push, Push) = default;
  ISO_FIELDS(way)
};
struct Nothing {
  ISO_FIELDS()
};
struct Game : iso::Composite<iso::World<S>, Nothing> {
  using Input = Push;
  iso::BodyId balls[2];

  Game() {
    world.create({.shape = world.add_shape(iso::Box{{20, 1, 20}}), .position = {0, -1, 0}});
    const auto ball = world.add_shape(iso::Sphere{0.5});
    for (int n : {0, 1}) balls[n] = world.create({.type = iso::dynamic, .shape = ball, .position = {4 * n - 2, 1, 0}});
  }
  void step(iso::InputView<Input> inputs) {
    for (int n : {0, 1}) world.apply_impulse(balls[n], {S(0.125) * S(inputs[n].way), 0, 0});
    world.step();
  }
};

// README: begin
struct Machine {
  EnetTransport port;
  iso::sealed::SealedTransport<EnetTransport> line;  // says and hears what `port` would, sealed
  iso::Session<Game> session;
  Game game;
  std::uint64_t hashes[60] = {};

  Machine(EnetTransport its_port, const iso::sealed::LobbyKey& key, const iso::SessionConfig& config)
      : port(std::move(its_port)), line(port, {.keys = {key}, .own_key = key.id}), session(config) {}
  void turn(int player, iso::Time now) {
    port.poll();
    iso::transport::deliver(line, session, now);
    session.add_local_input(player, {static_cast<std::int8_t>(session.current() / 9 % 3 - 1)});
    iso::drive(session, game, now, *this);
    iso::transport::dispatch(line, session, now);
    port.flush();
  }
  // README: end
  void confirmed(iso::Frame frame, std::uint64_t hash) {
    if (frame < 60) hashes[frame] = hash;
  }
};

iso::Time steady_now() {
  const auto since = std::chrono::steady_clock::now().time_since_epoch();
  return static_cast<iso::Time>(std::chrono::duration_cast<std::chrono::microseconds>(since).count());
}

int main() {
  iso::sealed::LobbyKey key{.id = 1};
  key.secret.fill(0x5a);  // a lobby draws it anew for every match, and tells the match's machines over TLS

  iso::SessionConfig config;
  config.silence = config.patience = 60 * iso::kSecond;  // this machine may be busy
  config.identity = iso::make_replay_header(iso::identity_of_world(Game().world.settings(), "two balls")).value();
  const iso::transport::EnetSettings settings{.bind_address = "127.0.0.1", .key = iso::sealed::packet_key(key)};
  iso::Result<EnetTransport> here = EnetTransport::listen(0, settings);
  if (!here) return 1;
  iso::Result<EnetTransport> there = EnetTransport::connect("127.0.0.1", here.value().port(), settings);
  if (!there) return 1;
  Machine client(std::move(there.value()), key, config);
  config.host = true;
  config.seed = 20;  // a game draws it anew for every match
  Machine host(std::move(here.value()), key, config);

  const iso::Time end = steady_now() + 60 * iso::kSecond;
  while (host.session.confirmed() < 60 || client.session.confirmed() < 60) {
    const iso::Time now = steady_now();
    if (now > end) return 1;
    host.turn(0, now);
    client.turn(1, now);
    host.port.wait(1000);
  }
  int equal = 0;
  for (int frame = 0; frame < 60; ++frame) equal += host.hashes[frame] == client.hashes[frame] ? 1 : 0;
  std::printf("%d of 60 frames equal; the client has shown key %llu\n", equal,
              static_cast<unsigned long long>(host.line.key_of(0).value_or(0)));
  return equal == 60 ? 0 : 1;
}
