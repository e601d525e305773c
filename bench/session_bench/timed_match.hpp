// TimedMatch: a match in virtual time that says what sessions cost without their games, turn by turn.
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <chrono>
#include <functional>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include "isostep/session/session.hpp"
#include "scene_bench/clock.hpp"
#include "transport/simulated_network.hpp"

namespace isostep::bench {

/// [us] A clock that is read in some 20 ns. It counts what else the machine does: take minima.
inline double microseconds() {
  return std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// A game that notes its own time.
template <class Game> class Clocked {
 public:
  using Input = typename Game::Input;
  using Snapshot = typename Game::Snapshot;

  explicit Clocked(std::unique_ptr<Game> game) : game_(std::move(game)) {}
  void step(InputView<Input> inputs) {
    timed([&] { game_->step(inputs); });
  }
  void save(Snapshot& to) const {
    timed([&] { game_->save(to); });
  }
  void load(const Snapshot& from) {
    timed([&] { game_->load(from); });
  }
  std::uint64_t hash() const {
    std::uint64_t hash = 0;
    timed([&] { hash = game_->hash(); });
    return hash;
  }
  /// [us] The time spent since the last call.
  double take_spent() { return std::exchange(spent_, 0); }

 private:
  template <class Work> void timed(Work&& work) const {
    const double start = microseconds();
    work();
    spent_ += microseconds() - start;
  }

  std::unique_ptr<Game> game_;
  mutable double spent_ = 0;
};

/// [us] The time that the session took within one frame.
struct FrameCost {
  double receive = 0;  // connected, disconnected, receive
  double drive = 0;    // add_local_input and drive(), without the game
  double send = 0;     // poll_send, poll_event
  double all() const { return receive + drive + send; }
};
/// One call of drive() [ms of CPU], the game included.
struct Drive {
  Frame depth = 0;  // of its rollback
  int steps = 0;
  double ms = 0;
};

template <class Game> using Bot = std::function<typename Game::Input(int player, Frame frame)>;

/// The time at which a machine's loop comes round.
enum class Loop : std::uint8_t {
  woken,   // by a datagram, and when wait() is over
  polling  // every millisecond
};

template <class Game> class TimedPeer {
 public:
  TimedPeer(transport::SimulatedNetwork& network, transport::EndpointId id, const SessionConfig& config,
            std::unique_ptr<Game> game)
      : endpoint(id), session(config), port_(network.port(id)), game_(std::move(game)) {}

  void turn(Time now, Loop loop, const Bot<Game>& bot) {
    frame_ = static_cast<std::size_t>(session.current());
    if (costs.size() <= frame_) costs.resize(frame_ + 1);
    if (!receive(now) && loop == Loop::woken && now < wake_) return;
    play(now, bot);
    send(now);
    wake_ = now + session.wait(now);
  }

  void rolled_back(Frame frame) { went_back_to_ = frame; }

  transport::EndpointId endpoint;
  Session<Clocked<Game>> session;
  std::vector<FrameCost> costs;  // by frame
  std::vector<Drive> drives;
  std::vector<Time> stepped_at;  // [us] by frame: of the turn in which it was stepped for the first time

 private:
  bool receive(Time now) {
    bool any = false;
    while (const std::optional<transport::Arrival> arrival = port_.receive()) {
      any = true;
      const double start = microseconds();
      if (arrival->kind == transport::ArrivalKind::connected) session.connected(arrival->peer, now);
      if (arrival->kind == transport::ArrivalKind::disconnected) session.disconnected(arrival->peer, now);
      if (arrival->kind == transport::ArrivalKind::message) {
        session.receive(arrival->peer, arrival->channel, arrival->bytes, now);
      }
      costs[frame_].receive += microseconds() - start;
    }
    return any;
  }
  void play(Time now, const Bot<Game>& bot) {
    const Frame before = session.current();
    went_back_to_ = before;
    const double cpu = thread_milliseconds(), start = microseconds();
    for (int player = 0; player < session.config().players; ++player) {
      if (session.wants_input(player)) session.add_local_input(player, bot(player, before));
    }
    const int steps = drive(session, game_, now, *this);
    costs[frame_].drive += microseconds() - start - game_.take_spent();
    drives.push_back({before - went_back_to_, steps, thread_milliseconds() - cpu});
    stepped_at.resize(static_cast<std::size_t>(session.current()), now);
  }
  void send(Time now) {
    double start = microseconds();
    while (const std::optional<Outgoing> out = session.poll_send(now)) {
      costs[frame_].send += microseconds() - start;
      if (!out->bytes.empty()) static_cast<void>(port_.send(out->peer, out->channel, out->bytes).ok());
      if (out->close) port_.disconnect(out->peer);
      start = microseconds();
    }
    while (session.poll_event()) {}
    costs[frame_].send += microseconds() - start;
  }

  transport::SimulatedNetwork::Port port_;
  Clocked<Game> game_;
  std::size_t frame_ = 0;  // of this turn
  Frame went_back_to_ = 0;
  Time wake_ = 0;
};

/// A match whose turns are the same for the same settings, whatever they cost: so repetitions can be compared turn by
/// turn.
template <class Game> class TimedMatch {
 public:
  using Maker = std::function<std::unique_ptr<Game>()>;

  TimedMatch(SessionConfig config, const transport::NetworkProfile& line, const Maker& maker, Bot<Game> bot)
      : network_({.seed = 1, .max_peers = 64}), bot_(std::move(bot)) {
    config.host = true;
    config.seed = 1;
    const auto add = [&](transport::EndpointId id) {
      peers_.push_back(std::make_unique<TimedPeer<Game>>(network_, id, config, maker()));
    };
    add(transport::SimulatedNetwork::kHost);
    config.host = false;
    config.local_players = 0;
    for (int player = 1; player < config.players; ++player) {
      add(network_.add_client(line));
      network_.connect(peers_.back()->endpoint);
    }
  }

  /// Runs until all machines have stepped so many frames.
  void run_to(Frame frames, Loop loop) {
    const Time limit = now_ + static_cast<Time>(frames) * kSecond / 10 + 60 * kSecond;
    for (; least_frame() < frames; now_ += 1000) {
      if (now_ > limit) throw std::runtime_error("the match does not go on");
      network_.advance_to(now_);
      for (auto& peer : peers_) peer->turn(now_, loop, bot_);
    }
  }

  const TimedPeer<Game>& peer(std::size_t i) const { return *peers_[i]; }
  std::size_t size() const { return peers_.size(); }
  transport::SimulatedNetwork& network() { return network_; }
  Time now() const { return now_; }

 private:
  Frame least_frame() const {
    Frame least = kLastFrame;
    for (const auto& peer : peers_) least = std::min(least, peer->session.current());
    return least;
  }

  transport::SimulatedNetwork network_;
  Bot<Game> bot_;
  std::vector<std::unique_ptr<TimedPeer<Game>>> peers_;
  Time now_ = 0;
};

}  // namespace isostep::bench
