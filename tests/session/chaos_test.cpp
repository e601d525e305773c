// Everything at once, drawn from a seed: lines change, players fall silent, go, come back and join, hosts stand
// still, and the match pauses and changes its speed.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "session/match_checks.hpp"
#include "session/toy_game.hpp"

namespace isostep::test {
namespace chaos_test {

constexpr int kSeeds = 40;

SessionConfig config_of(Pcg32& random) {
  SessionConfig config;
  config.players = 2 + static_cast<int>(random.next() % 7);
  config.mode = random.next() % 2 == 0 ? SessionMode::lockstep : SessionMode::rollback;
  config.window = 1 + static_cast<Frame>(random.next() % 12);
  config.local_players = static_cast<int>(random.next() % 3) % config.players;  // 0: a dedicated host
  config.history = random.next() % 2 == 0 ? 200 : 1200;
  config.hz = random.next() % 4 == 0 ? 30 : 60;
  config.patience = (1 + random.next() % 3) * kSecond;
  config.silence = (2 + random.next() % 3) * kSecond;
  config.exclusion = random.next() % 4 * kSecond;
  config.players_set_tempo = random.next() % 2 == 0;
  config.deadline = random.next() % 3 == 0 ? 1 + static_cast<Frame>(random.next() % 12) : 0;
  return config;
}

class Chaos {
 public:
  explicit Chaos(std::uint64_t seed)
      : random_(Pcg32::seeded(seed)),
        config_(config_of(random_)),
        match_(
            config_, [] { return std::make_unique<Toy>(300); },
            [seed](int player, Frame frame) { return toy_input(seed, player, frame); }, seed) {
    client_ = config_;
    spectator_ = client_;
    spectator_.mode = SessionMode::spectator;
  }

  void play() {
    // One or two players on each client.
    int left = config_.players - config_.local_players;
    int late = left > 2 ? static_cast<int>(random_.next() % 3) : 0;
    left -= late;
    while (left > 0) left -= come(left);
    pass(2 * kSecond);
    match_.host().session.start(match_.now());
    while (late > 0) late -= come(late);
    for (int i = 0; i < 25; ++i) {
      disturb();
      pass((1 + random_.next() % 3000) * 1000);
    }
    settle();
  }
  VirtualMatch<Toy>& match() { return match_; }
  std::uint64_t disturbances() const { return disturbances_; }

 private:
  void pass(Time time) {
    match_.run(time, [] { return false; });
  }
  /// A client, with so many players at most; how many it has.
  int come(int most) {
    client_.local_players = most > 1 ? 1 + static_cast<int>(random_.next() % 2) : 1;
    match_.add(line(), client_).returns = true;
    return client_.local_players;
  }
  transport::NetworkProfile line() {
    const char* const lines[] = {"loopback", "lan",       "wifi",    "mobile",    "severe",
                                 "burst",    "duplicate", "reorder", "asymmetric"};
    return profile(lines[random_.next() % std::size(lines)]);
  }
  Machine<Toy>& someone() { return match_.machine(1 + random_.next() % (match_.size() - 1)); }
  void disturb() {
    ++disturbances_;
    Machine<Toy>& one = someone();
    switch (random_.next() % 10) {
      case 0: match_.network().cut(one.endpoint); break;
      case 1: match_.network().set_silent(one.endpoint, true); break;
      case 2: match_.network().set_silent(one.endpoint, false); break;
      case 3: one.plays = !one.plays; break;
      case 4: match_.host().plays = !match_.host().plays; break;
      case 5: match_.network().set_profile(one.endpoint, line()); break;
      case 6: one.slow = random_.next() % 40000; break;
      case 8: (void)(random_.next() % 2 == 0 ? match_.host().session.pause() : one.session.pause()); break;
      case 9: match_.host().session.set_speed(4 + static_cast<int>(random_.next() % 13)); break;
      case 7:
        if (match_.size() < 12) match_.add(line(), spectator_).returns = true;
        break;
    }
  }
  /// Everything works again: everybody is to come back.
  void settle() {
    for (std::size_t i = 0; i < match_.size(); ++i) {
      Machine<Toy>& machine = match_.machine(i);
      machine.plays = true;
      machine.slow = 0;
      if (i == 0) continue;
      match_.network().set_silent(machine.endpoint, false);
      match_.network().set_profile(machine.endpoint, profile("lan"));
    }
    match_.host().session.unpause();
    match_.host().session.set_speed(Tempo::kNormal);
    pass(40 * kSecond);
  }

  Pcg32 random_;
  SessionConfig config_, client_, spectator_;
  VirtualMatch<Toy> match_;
  std::uint64_t disturbances_ = 0;
};

TEST(Chaos, EndsWithOneHistoryAndEverybodyBack) {
  std::uint64_t returns = 0, snapshots = 0, rollbacks = 0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Chaos chaos(seed);
    chaos.play();
    VirtualMatch<Toy>& match = chaos.match();
    expect_one_history(match, true);
    const Frame end = match.host().end();
    for (int player = 0; player < match.host().session.config().players; ++player) {
      EXPECT_TRUE(match.host().played(end - 1, player)) << "player " << player << " is not in the match";
    }
    for (std::size_t i = 1; i < match.size(); ++i) {
      const Machine<Toy>& machine = match.machine(i);
      EXPECT_GT(machine.end(), end - 40) << "client " << i;
      returns += static_cast<std::uint64_t>(machine.count(SessionEvent::Kind::lost_host));
      snapshots += static_cast<std::uint64_t>(machine.restarts);
      for (const std::uint64_t count : machine.session.stats().rollbacks) rollbacks += count;
    }
  }
  EXPECT_GT(returns, 50u);
  EXPECT_GT(snapshots, 10u);
  EXPECT_GT(rollbacks, 1000u);
}

}  // namespace chaos_test
}  // namespace isostep::test
