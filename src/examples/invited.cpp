// A match for invited players: a lobby gave each a ticket and a seat, and the host's game lets nobody else in.
// SPDX-License-Identifier: MIT
#include <cstdio>
#include <map>
#include <string>

#include "isostep/replay/recorder.hpp"
#include "isostep/session/session.hpp"
#include "transport/pump.hpp"
#include "transport/simulated_network.hpp"

namespace iso = isostep;
using iso::transport::SimulatedNetwork;

struct Turn {
  std::int8_t way = 0;
  friend bool operator==(Turn, Turn) = default;
  ISO_FIELDS(way)
};
struct Game {
  using Input = Turn;
  struct Snapshot {
    std::uint64_t place = 1;
  };
  Snapshot state;
  void step(iso::InputView<Turn> inputs) {
    for (const Turn& turn : inputs.values) state.place = state.place * 31 + static_cast<std::uint64_t>(turn.way + 128);
  }
  void save(Snapshot& to) const { to = state; }
  void load(const Snapshot& from) { state = from; }
  std::uint64_t hash() const { return state.place; }
};

struct Machine {
  Game game;
  iso::Session<Game> session;
  SimulatedNetwork::Port port;
  std::string told = "nothing";  // why it is not in the match

  Machine(const iso::SessionConfig& config, SimulatedNetwork::Port its_port) : session(config), port(its_port) {}
  void turn(iso::Time now) {
    iso::transport::deliver(port, session, now);
    for (int player = 0; player < 3; ++player) {
      if (session.wants_input(player)) session.add_local_input(player, {1});
    }
    iso::drive(session, game, now);
    iso::transport::dispatch(port, session, now);
    while (const auto event = session.poll_event()) {
      if (event->kind == iso::SessionEvent::Kind::refused) told = event->field.here.view();
    }
  }
};

// README: begin
void answer(iso::Session<Game>& session, const std::map<std::string, int>& seats_of_tickets) {
  while (const std::optional<iso::Applicant> applicant = session.poll_applicant()) {
    const auto ticket = seats_of_tickets.find({applicant->credential.begin(), applicant->credential.end()});
    if (ticket != seats_of_tickets.end() && ticket->second == applicant->seat) {
      session.admit(applicant->id);  // now, or in a later turn
    } else {
      session.refuse(applicant->id, "not invited");
    }
  }
}
// README: end

int main() {
  iso::SessionConfig config;
  config.players = 3;
  iso::SessionConfig host_config = config;
  host_config.host = host_config.asks_admission = true;
  host_config.seed = 20;  // a game draws it anew for every match, from the system
  SimulatedNetwork network;
  Machine host(host_config, network.port(SimulatedNetwork::kHost));
  const auto come = [&](const std::string& ticket, int seat) {
    iso::SessionConfig client = config;
    client.seat = seat;
    client.credential.assign(ticket.begin(), ticket.end());
    const auto line = network.add_client(iso::transport::parse_profile("wifi").value());
    network.connect(line);
    return Machine(client, network.port(line));
  };
  Machine ann = come("ann's ticket", 2), bob = come("bob's ticket", 1), eve = come("eve's ticket", 1);
  iso::Time now = 0;
  const auto pass = [&](iso::Time time) {
    for (const iso::Time end = now + time; now < end; now += 1000) {
      network.advance_to(now);
      for (Machine* machine : {&host, &ann, &bob, &eve}) machine->turn(now);
      answer(host.session, {{"ann's ticket", 2}, {"bob's ticket", 1}});
    }
  };
  pass(3 * iso::kSecond);
  const bool all_play = ann.session.local_player() == 2 && bob.session.local_player() == 1;
  host.session.kick(1, "away for too long");
  pass(iso::kSecond);
  std::printf("ann plays on seat %d; bob was told: %s; eve was told: %s\n", ann.session.local_player(),
              bob.told.c_str(), eve.told.c_str());
  return all_play && bob.told == "away for too long" && eve.told == "not invited" ? 0 : 1;
}
