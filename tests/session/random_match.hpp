// RandomMatch: a match in virtual time drawn from a seed, in which machines stand still, die, leave, come back and are
// cut off from each other, and what must hold of it: one history, one host, and in the end it goes on.
// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <vector>

#include "session/match_checks.hpp"
#include "session/toy_game.hpp"

namespace isostep::test {

class RandomMatch {
 public:
  using Kind = SessionEvent::Kind;

  explicit RandomMatch(std::uint64_t seed)
      : random_(Pcg32::seeded(seed)),
        config_(drawn_config()),
        match_(
            config_, [] { return std::make_unique<Toy>(40); },
            [seed](int player, Frame frame) { return toy_input(seed, player, frame); }, seed) {
    watch(0);
    for (int p = 1; p < config_.players; ++p) {
      match_.add(transport::parse_profile(drawn_line()).value());
      watch(match_.size() - 1);
    }
  }

  void play() {
    pass(6 * kSecond);
    const int disturbances = 4 + static_cast<int>(random_.next() % 8);
    for (int i = 0; i < disturbances; ++i) {
      disturb();
      pass((200 + random_.next() % (random_.next() % 3 == 0 ? 9000 : 2500)) * 1000);
    }
    heal();
    pass(45 * kSecond);
    const Frame before = newest_;
    pass(3 * kSecond);
    goes_on_ = newest_ > before + 60;
  }

  /// Frames that two machines confirmed with different hashes.
  Frame two_histories = 0;
  Frame first_of_them = kNoFrame;
  std::function<void(std::size_t)> on_watch;  // a machine has come, and its was_confirmed is set
  /// Perhaps nobody is left who knows what was final: a majority died, or a host that was one alone.
  bool has_lost_memory() const { return 2 * deaths_ >= config_.players || has_lost_roster_; }
  bool goes_on() const { return goes_on_; }
  int hosts() {
    int count = 0;
    for (std::size_t i = 0; i < match_.size(); ++i)
      count += lives(i) && match_.machine(i).session.config().host ? 1 : 0;
    return count;
  }
  int playing() {
    int count = 0;
    for (std::size_t i = 0; i < match_.size(); ++i) {
      count += lives(i) && match_.machine(i).session.phase() == SessionPhase::playing ? 1 : 0;
    }
    return count;
  }
  const SessionConfig& config() const { return config_; }
  const std::string& story() const { return story_; }
  int migrations() const { return migrations_; }
  VirtualMatch<Toy>& match() { return match_; }
  bool lives(std::size_t i) const { return !dead_[i]; }

 private:
  SessionConfig drawn_config() {
    SessionConfig config;
    config.players = 2 + static_cast<int>(random_.next() % 7);
    config.mode = random_.next() % 2 == 0 ? SessionMode::lockstep : SessionMode::rollback;
    config.migration = (1 + random_.next() % 4) * kSecond / 2;
    config.deadline = random_.next() % 2 == 0 ? 0 : 8;
    config.repair = random_.next() % 3 == 0;
    config.history = random_.next() % 2 == 0 ? 300 : 3600;
    config.reservation = 600 * kSecond;
    return config;
  }
  const char* drawn_line() {
    const char* const lines[] = {"lan",     "wifi",      "latency=30,jitter=5,loss=0.5",
                                 "reorder", "duplicate", "latency=80,jitter=30,loss=2"};
    return lines[random_.next() % std::size(lines)];
  }
  void watch(std::size_t i) {
    dead_.push_back(false);
    match_.machine(i).keeps = false;
    match_.machine(i).was_confirmed = [this](Frame frame, std::uint64_t hash) {
      if (frame > newest_) newest_ = frame;
      const auto [it, is_new] = said_.emplace(frame, hash);
      if (is_new || it->second == hash) return;
      ++two_histories;
      if (first_of_them == kNoFrame) first_of_them = frame;
    };
    if (on_watch) on_watch(i);
  }
  std::size_t machine_with_host() {
    std::size_t found = match_.size();
    for (std::size_t i = 0; i < match_.size(); ++i) {
      if (!lives(i) || !match_.machine(i).session.config().host) continue;
      const auto confirmed = [&](std::size_t j) { return match_.machine(j).session.confirmed(); };
      if (found == match_.size() || confirmed(i) > confirmed(found)) found = i;
    }
    return found;
  }
  /// The machine at which a game that knows none asks for the match: its host, or else who saw most of it.
  std::size_t somebody() {
    std::size_t found = machine_with_host();
    if (found < match_.size()) return found;
    for (std::size_t i = 0; i < match_.size(); ++i) {
      if (!lives(i) || match_.machine(i).session.stats().machines == 0) continue;
      const auto confirmed = [&](std::size_t j) { return match_.machine(j).session.confirmed(); };
      if (found == match_.size() || confirmed(i) > confirmed(found)) found = i;
    }
    return found;
  }
  /// Games that have lost the match ask a lobby where it is; it knows a host, or else a machine that is there.
  void pass(Time time) {
    match_.run(time, [&] {
      if (match_.now() % (kSecond / 4) != 0) return false;
      for (std::size_t i = 0; i < match_.size(); ++i) {
        Machine<Toy>& machine = match_.machine(i);
        const SessionPhase phase = machine.session.phase();
        migrations_ += machine.count(Kind::new_host);
        machine.events.clear();
        const bool is_gone = phase == SessionPhase::lost || (machine.is_offline && phase == SessionPhase::waiting);
        const bool is_refused = phase == SessionPhase::refused;
        if (!lives(i) || !machine.plays || (!is_gone && !is_refused)) continue;
        const std::size_t home = somebody();
        if (home == match_.size() || home == i) continue;
        match_.network().connect(machine.endpoint, match_.machine(home).endpoint);
      }
      return false;
    });
  }
  void tell(const char* what, std::size_t i, std::uint64_t more = 0) {
    story_ += std::to_string(match_.now() / 1000) + " " + what + " " + std::to_string(i) +
              (more != 0 ? " " + std::to_string(more) : "") + "; ";
  }
  std::size_t drawn_machine() {
    // The host, of whom most depends, as often as all others.
    const std::size_t host = machine_with_host();
    if (host < match_.size() && random_.next() % 2 == 0) return host;
    for (;;) {
      const std::size_t i = random_.next() % match_.size();
      if (lives(i)) return i;
    }
  }
  int living() const {
    int count = 0;
    for (std::size_t i = 0; i < dead_.size(); ++i) count += dead_[i] ? 0 : 1;
    return count;
  }
  void die(std::size_t i) {
    const auto& session = match_.machine(i).session;
    has_lost_roster_ = has_lost_roster_ || (session.config().host && session.stats().machines <= 2);
    match_.machine(i).plays = false;
    match_.network().set_silent(match_.machine(i).endpoint, true);
    dead_[i] = true;
    waiting_.push_back(match_.machine(i).session.token());
  }
  void come_back(bool with_token) {
    if (waiting_.empty()) return;
    const std::size_t which = random_.next() % waiting_.size();
    SessionConfig config = config_;
    config.local_players = 0;
    config.token = with_token ? waiting_[which] : 0;
    if (with_token) waiting_.erase(waiting_.begin() + static_cast<std::ptrdiff_t>(which));
    const std::size_t found = somebody(), home = found < match_.size() ? found : 0;
    match_.add(transport::parse_profile(drawn_line()).value(), config, match_.machine(home).endpoint);
    watch(match_.size() - 1);
    tell(with_token ? "returns" : "stranger", match_.size() - 1, home + 1);
    if (!with_token) strangers_.push_back(match_.size() - 1);
  }
  void disturb() {
    const std::size_t i = drawn_machine();
    Machine<Toy>& machine = match_.machine(i);
    switch (random_.next() % 12) {
      case 0:
      case 1: {  // stands still: its process, and with it what it hears
        const Time time = (100 + random_.next() % (random_.next() % 2 == 0 ? 1500 : 8000)) * 1000;
        machine.next_turn = match_.now() + time;
        tell("hitch", i, time / 1000);
        break;
      }
      case 2:
        if (living() < 2) break;
        tell("dies", i);
        ++deaths_;
        die(i);
        break;
      case 3:  // hangs up
        if (living() < 2) break;
        tell("leaves", i);
        for (int p = 0; p < 64; ++p) machine.port.disconnect(static_cast<PeerId>(p));
        ++deaths_;
        die(i);
        break;
      case 4: {
        tell("cut", i);
        if (machine.endpoint != 0) match_.network().cut(machine.endpoint);
        break;
      }
      case 5:
      case 6: {  // two groups that do not hear each other
        std::uint32_t group = random_.next();
        if (random_.next() % 3 == 0) group = 1u << i;
        tell("split", group & ((1u << match_.size()) - 1));
        for (std::size_t j = 0; j < match_.size(); ++j) {
          match_.network().set_side(match_.machine(j).endpoint, static_cast<int>(group >> (j % 32) & 1));
        }
        break;
      }
      case 7:  // one direction of all lines to the first host
        tell("deaf", 0);
        for (std::size_t j = 1; j < match_.size(); ++j) {
          const char* const line = random_.next() % 2 == 0 ? "latency=30,down.loss=100" : "latency=30,up.loss=100";
          if (lives(j))
            match_.network().set_profile(match_.machine(j).endpoint, transport::parse_profile(line).value());
        }
        break;
      case 8:
      case 9: come_back(true); break;
      case 10: come_back(random_.next() % 4 != 0); break;
      default:
        tell("heal", 0);
        mend_lines();
        break;
    }
  }
  void mend_lines() {
    for (std::size_t j = 0; j < match_.size(); ++j) {
      match_.network().set_side(match_.machine(j).endpoint, 0);
      if (j > 0 && lives(j)) {
        match_.network().set_profile(match_.machine(j).endpoint,
                                     transport::parse_profile("latency=30,jitter=5,loss=0.5").value());
      }
    }
  }
  /// All that died start again, with their tokens; and nobody else is there.
  void heal() {
    mend_lines();
    for (const std::size_t i : strangers_) {
      if (lives(i)) die(i), waiting_.pop_back();
    }
    while (!waiting_.empty()) come_back(true);
    tell("healed", 0);
  }

  Pcg32 random_;
  SessionConfig config_;
  VirtualMatch<Toy> match_;
  std::map<Frame, std::uint64_t> said_;
  Frame newest_ = 0;
  std::vector<bool> dead_;
  std::vector<std::uint64_t> waiting_;  // tokens of who died
  std::vector<std::size_t> strangers_;
  std::string story_;
  int deaths_ = 0, migrations_ = 0;
  bool goes_on_ = false, has_lost_roster_ = false;
};

}  // namespace isostep::test
