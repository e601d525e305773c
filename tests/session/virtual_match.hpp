// A whole match in one process and in virtual time: every peer's session and game, and the network between them.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdlib>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "isostep/session/session.hpp"
#include "transport/simulated_network.hpp"

namespace isostep::test {

/// The input of a player in a frame; a pure function.
template <class Game> using Bot = std::function<typename Game::Input(int player, Frame frame)>;
template <class Game> using Maker = std::function<std::unique_ptr<Game>()>;

/// One machine of the match: it plays what its session says and keeps what was confirmed.
template <class Game> struct Machine {
  using Network = transport::SimulatedNetwork;

  Machine(Network& network, transport::EndpointId id, const SessionConfig& config, std::unique_ptr<Game> its_game)
      : endpoint(id), port(network.port(id)), session(config), game(std::move(its_game)) {}

  void before_step(Frame frame) {
    if (will_step) will_step(frame);
    if (frame >= newest) {
      newest = frame + 1;
      ++new_frames;
    }
    if (tamper) tamper(*game, frame);
    for (int p = 0; p < session.config().players; ++p) {
      guessed = guessed || session.status(frame, p) == InputStatus::predicted;
    }
  }
  void after_step(Frame frame) {
    ++steps;
    if (stepped) stepped(*game, frame);
  }
  void rolled_back(Frame frame) {
    if (went_back) went_back(frame);
  }
  void confirmed(Frame frame, std::uint64_t hash) {
    if (was_confirmed) was_confirmed(frame, hash);
    if (!keeps) return;
    if (hashes.empty()) first = frame;
    in_order = in_order && frame == first + static_cast<Frame>(hashes.size());
    hashes.push_back(hash);
    inputs.emplace_back();
    for (int p = 0; p < session.config().players; ++p) {
      inputs.back().push_back({session.status(frame, p) == InputStatus::disconnected, session.input(frame, p)});
    }
  }
  void restarted(Frame frame) {
    ++restarts;
    if (restarts_at) restarts_at(frame);
    if (!hashes.empty() && frame > first + static_cast<Frame>(hashes.size())) {
      hashes.clear();
      inputs.clear();
    }
  }

  void turn(Time world_now, const Bot<Game>& bot) {
    const Time now =
        world_now + world_now / 1000 * static_cast<Time>(fast) - world_now / 1000 * static_cast<Time>(late);
    while (const std::optional<transport::Arrival> arrival = port.receive()) {
      if (arrival->kind == transport::ArrivalKind::connected) session.connected(arrival->peer, now, arrival->incoming);
      if (arrival->kind == transport::ArrivalKind::disconnected) session.disconnected(arrival->peer, now);
      if (arrival->kind != transport::ArrivalKind::message) {
        is_offline = arrival->kind == transport::ArrivalKind::disconnected;
      }
      if (arrival->kind == transport::ArrivalKind::message) {
        Bytes bytes = arrival->bytes;
        if (middle) {
          changed.assign(bytes.begin(), bytes.end());
          middle(arrival->channel, changed);
          bytes = changed;
        }
        session.receive(arrival->peer, arrival->channel, bytes, now);
      }
    }
    for (int p = 0; p < session.config().players; ++p) {
      if (!session.wants_input(p)) continue;
      seat = p;
      session.add_local_input(p, bot(p, session.current()));
    }
    if (forgets) play_by_hand(now);
    else drive(session, *game, now, *this);
    if (const std::optional<Address> address = session.poll_connect()) connects_to = address->view();
    while (const std::optional<Outgoing> out = session.poll_send(now)) {
      if (muted) continue;
      Bytes bytes = out->bytes;
      if (outgoing && !bytes.empty()) {
        changed.assign(bytes.begin(), bytes.end());
        outgoing(out->channel, changed);
        bytes = changed;
      }
      if (!bytes.empty()) static_cast<void>(port.send(out->peer, out->channel, bytes).ok());
      if (out->close) port.disconnect(out->peer);
    }
    while (const std::optional<SessionEvent> event = session.poll_event()) events.push_back(*event);
    if (after_turn) after_turn();
  }
  /// What drive() does, but in turns that the caller forgets.
  void play_by_hand(Time now) {
    const auto requests = session.advance(now);
    if (forgets(requests)) return;
    for (const Request<typename Game::Input>& request : requests) {
      if (request.kind != RequestKind::step) {
        carry_out(session, *game, request, *this);
        continue;
      }
      before_step(request.frame);
      game->step(request.inputs);
      after_step(request.frame);
    }
    while (const auto final_frame = session.poll_confirmed()) confirmed(final_frame->frame, final_frame->hash);
  }
  /// Counts the events of one player, or of any.
  int count(SessionEvent::Kind kind, int player = -1) const {
    int count = 0;
    for (const SessionEvent& event : events)
      count += event.kind == kind && (player < 0 || event.player == player) ? 1 : 0;
    return count;
  }
  bool heard(SessionEvent::Kind kind, int player = -1) const { return count(kind, player) > 0; }
  /// The last one; of kNoFrame when there was none.
  SessionEvent last(SessionEvent::Kind kind, int player = -1) const {
    SessionEvent found{.kind = kind};
    for (const SessionEvent& event : events) {
      if (event.kind == kind && (player < 0 || event.player == player)) found = event;
    }
    return found;
  }
  bool played(Frame frame, int player) const {
    return frame >= first && frame < end() && !at(frame)[static_cast<std::size_t>(player)].absent;
  }
  /// One past the last frame whose hash is known.
  Frame end() const { return first + static_cast<Frame>(hashes.size()); }

  struct Said {
    bool absent;
    typename Game::Input input;
  };
  const std::vector<Said>& at(Frame frame) const { return inputs[static_cast<std::size_t>(frame - first)]; }

  transport::EndpointId endpoint;
  Network::Port port;
  Session<Game> session;
  std::unique_ptr<Game> game;
  std::function<void(Game&, Frame)> tamper;                                   // before a step: a fault to be found
  std::function<void(Channel, std::vector<std::uint8_t>&)> middle, outgoing;  // alter what arrives, and what is sent
  // The callbacks of what the observer sees, and of the end of every turn.
  std::function<void(Frame)> will_step;
  std::function<void(const Game&, Frame)> stepped;
  std::function<void(Frame)> went_back;
  std::function<void(Frame)> restarts_at;
  std::function<void(Frame, std::uint64_t)> was_confirmed;
  std::function<void()> after_turn;
  std::function<bool(std::span<const Request<typename Game::Input>>)> forgets;  // requests that are not carried out
  std::string connects_to;  // an address that its session asked for, and that the network has not been given yet
  bool muted = false;
  bool is_offline = false;                      // the transport's last word
  bool returns = false;                         // connects again when the host is lost, as a game would,
  transport::EndpointId home = Network::kHost;  // to this one
  bool keeps = true;                            // what was confirmed
  Time fast = 0, late = 0;                      // [permille] of its clock
  int seat = -1;                                // the player for which it was asked last
  bool guessed = false;                         // stepped a frame on a predicted input
  bool plays = true;                            // takes turns at all
  Time slow = 0;                                // [us] between its turns
  Time step_time = 0;                           // [us] that a frame takes it; one that is stepped again takes nothing
  Time next_turn = 0;
  std::vector<SessionEvent> events;
  Frame first = 0;
  std::vector<std::uint64_t> hashes;      // after frames first, first + 1, ...
  std::vector<std::vector<Said>> inputs;  // of the same frames
  bool in_order = true;
  int restarts = 0;
  std::uint64_t steps = 0, new_frames = 0;  // all that were stepped, and those for the first time
  Frame newest = 0;

 private:
  std::vector<std::uint8_t> changed;
};

template <class Game> class VirtualMatch {
 public:
  VirtualMatch(const SessionConfig& config, Maker<Game> maker, Bot<Game> bot, std::uint64_t seed = 1)
      : config_(config),
        network_({.seed = seed, .max_peers = static_cast<PeerId>(config.max_peers + config.max_strangers)}),
        maker_(std::move(maker)),
        bot_(std::move(bot)) {
    SessionConfig host = config;
    host.host = true;
    host.seed = seed;
    host.address = "0";
    machines_.push_back(std::make_unique<Machine<Game>>(network_, transport::SimulatedNetwork::kHost, host, maker_()));
  }

  Machine<Game>& host() { return *machines_[0]; }
  Machine<Game>& machine(std::size_t i) { return *machines_[i]; }
  std::size_t size() const { return machines_.size(); }
  transport::SimulatedNetwork& network() { return network_; }
  Time now() const { return now_; }

  /// It connects to `home`: the host, or a relay.
  Machine<Game>& add(const transport::NetworkProfile& profile, const SessionConfig& config,
                     transport::EndpointId home = transport::SimulatedNetwork::kHost) {
    const transport::EndpointId id = network_.add_client(profile);
    SessionConfig own = config;
    if (config.migration > 0) {
      own.address.append_number(id);
      own.seed = config.seed + id + 1;
    }
    machines_.push_back(std::make_unique<Machine<Game>>(network_, id, own, maker_()));
    machines_.back()->home = home;
    network_.connect(id, home);
    return *machines_.back();
  }
  Machine<Game>& add(const transport::NetworkProfile& profile) {
    SessionConfig client = config_;
    client.local_players = 0;
    return add(profile, client);
  }

  /// Runs until `done` says so or virtual time is over; whether it was done.
  template <class Done> bool run(Time limit, Done&& done) {
    const Time end = now_ + limit;
    for (; now_ < end; now_ += kTick) {
      network_.advance_to(now_);
      for (auto& machine : machines_) {
        if (!machine->plays || now_ < machine->next_turn) continue;
        const std::uint64_t before = machine->new_frames;
        // A tick is coarser than what a frame takes: what it was late by is not lost.
        const Time from = now_ - machine->next_turn < kTick ? machine->next_turn : now_;
        machine->turn(now_, bot_);
        if (!machine->connects_to.empty()) {
          const int target = std::atoi(std::exchange(machine->connects_to, {}).c_str());
          network_.connect(machine->endpoint, static_cast<transport::EndpointId>(target));
        }
        const Time busy = (machine->new_frames - before) * machine->step_time;
        machine->next_turn = busy > 0 ? from + busy : now_ + machine->slow;
        const SessionPhase phase = machine->session.phase();
        const bool is_gone = phase == SessionPhase::lost || (machine->is_offline && phase == SessionPhase::waiting);
        if (machine->returns && is_gone) network_.connect(machine->endpoint, machine->home);
      }
      if (done()) return true;
    }
    return false;
  }
  /// Runs until every machine has confirmed so many frames.
  bool run_to(Frame frames, Time limit) {
    return run(limit, [&] {
      for (const auto& machine : machines_) {
        if (machine->plays && machine->end() < frames) return false;
      }
      return true;
    });
  }

  /// Plays the same inputs straight through by one process: the hashes that all peers must have.
  std::vector<std::uint64_t> straight(Frame frames, std::size_t of = 0) {
    std::unique_ptr<Game> game = maker_();
    std::vector<std::uint64_t> hashes;
    for (Frame frame = 0; frame < frames; ++frame) {
      std::vector<typename Game::Input> values;
      std::vector<InputStatus> statuses;
      for (const auto& said : machine(of).inputs[static_cast<std::size_t>(frame)]) {
        values.push_back(said.input);
        statuses.push_back(said.absent ? InputStatus::disconnected : InputStatus::confirmed);
      }
      game->step({values, statuses});
      hashes.push_back(game->hash());
    }
    return hashes;
  }

 private:
  static constexpr Time kTick = 1000;  // [us]

  SessionConfig config_;
  transport::SimulatedNetwork network_;
  Maker<Game> maker_;
  Bot<Game> bot_;
  std::vector<std::unique_ptr<Machine<Game>>> machines_;
  Time now_ = 0;
};

}  // namespace isostep::test
