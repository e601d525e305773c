// EnetMachine: a session of toys over ENet on this machine, and what it was told as final.
// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <string>
#include <utility>

#include "isostep/session/session.hpp"
#include "session/toy_game.hpp"
#include "transport/enet_transport.hpp"
#include "transport/pump.hpp"

namespace isostep::test {

inline Time steady_now() {
  const auto since = std::chrono::steady_clock::now().time_since_epoch();
  return static_cast<Time>(std::chrono::duration_cast<std::chrono::microseconds>(since).count());
}

class EnetMachine {
 public:
  /// Patient, for a test waits for what happens and never for a time; but a host is missed soon. The address is ours.
  static SessionConfig patient_config(int number, int players) {
    SessionConfig config;
    config.players = players;
    config.host = number == 0;
    config.local_players = number == 0 ? 1 : 0;
    config.seed = static_cast<std::uint64_t>(number) + 1;
    config.silence = config.patience = 600 * kSecond;
    config.migration = kSecond;
    return config;
  }

  explicit EnetMachine(const SessionConfig& config) : port(listen()), session(with_address(config, port)) {}
  EnetMachine(transport::EnetTransport its_port, const SessionConfig& config)
      : port(std::move(its_port)), session(config) {}

  bool connect_to(const EnetMachine& other) { return port.connect_to(other.session.config().address.view()).ok(); }
  void confirmed(Frame frame, std::uint64_t hash) {
    if (was_confirmed) was_confirmed(frame, hash);
  }
  int count(SessionEvent::Kind kind) { return events[static_cast<int>(kind)]; }
  void turn(Time now) {
    port.poll();
    transport::deliver(port, session, now);
    const int player = session.local_player();
    if (player >= 0) session.add_local_input(player, toy_input(1, player, session.current()));
    drive(session, game, now, *this);
    transport::dispatch(port, session, now);
    port.flush();
    while (const std::optional<SessionEvent> event = session.poll_event()) ++events[static_cast<int>(event->kind)];
  }

  transport::EnetTransport port;
  Session<Toy> session;
  Toy game;
  std::function<void(Frame, std::uint64_t hash)> was_confirmed;
  std::map<int, int> events;  // how many of each kind

 private:
  static transport::EnetTransport listen() {
    return std::move(
        transport::EnetTransport::listen(0, {.bind_address = "127.0.0.1", .timeout = 600 * kSecond}).value());
  }
  static SessionConfig with_address(SessionConfig config, const transport::EnetTransport& port) {
    config.address = Address("127.0.0.1:" + std::to_string(port.port()));
    return config;
  }
};

/// It keeps what it was told as final.
struct RememberingMachine : EnetMachine {
  template <class... Arguments>
  explicit RememberingMachine(Arguments&&... arguments) : EnetMachine(std::forward<Arguments>(arguments)...) {
    was_confirmed = [this](Frame frame, std::uint64_t hash) { hashes[frame] = hash; };
  }
  Frame end() const { return hashes.empty() ? 0 : hashes.rbegin()->first + 1; }
  std::map<Frame, std::uint64_t> hashes;
};

}  // namespace isostep::test
