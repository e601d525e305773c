// Hosts that die, stand still and return, and states that go wrong, drawn from a seed: in the end the match has one
// host and one history.
// SPDX-License-Identifier: MIT
#include <algorithm>

#include "session/match_checks.hpp"
#include "session/toy_game.hpp"

namespace isostep::test {
namespace migration_chaos_test {

constexpr int kSeeds = 20;

SessionConfig config_of(Pcg32& random) {
  SessionConfig config;
  config.players = 3 + static_cast<int>(random.next() % 5);
  config.mode = random.next() % 2 == 0 ? SessionMode::lockstep : SessionMode::rollback;
  config.migration = (2 + random.next() % 3) * kSecond / 2;
  config.history = random.next() % 2 == 0 ? 300 : 3600;
  config.silence = (2 + random.next() % 3) * kSecond;
  config.repair = random.next() % 2 == 0;
  return config;
}

/// Most machines are well at any time, so that there is a majority; whoever it is that fails, the host too.
class MigrationChaos {
 public:
  explicit MigrationChaos(std::uint64_t seed)
      : random_(Pcg32::seeded(seed)),
        config_(config_of(random_)),
        match_(
            config_, [] { return std::make_unique<Toy>(300); },
            [seed](int player, Frame frame) { return toy_input(seed, player, frame); }, seed) {
    const char* const lines[] = {"lan", "wifi", "latency=30,jitter=5,loss=0.5", "reorder", "duplicate"};
    for (int p = 1; p < config_.players; ++p) match_.add(profile(lines[random_.next() % std::size(lines)]));
  }
  void play() {
    pass(8 * kSecond);
    for (int i = 0; i < 12; ++i) {
      disturb();
      pass((500 + random_.next() % 6000) * 1000);
    }
    for (std::size_t i = 0; i < match_.size(); ++i) revive(i);
    pass(60 * kSecond);
  }
  VirtualMatch<Toy>& match() { return match_; }
  /// More than one, where a machine has not heard that it is no more.
  std::vector<std::size_t> hosts() {
    std::vector<std::size_t> all;
    for (std::size_t i = 0; i < match_.size(); ++i) {
      if (match_.machine(i).session.config().host) all.push_back(i);
    }
    return all;
  }
  int killed_hosts = 0, damages = 0;

 private:
  /// A game whose session has lost the match asks its lobby where that is.
  void pass(Time time) {
    match_.run(time, [&] {
      if (match_.now() % (kSecond / 2) != 0) return false;
      const std::size_t host = living_host();
      for (std::size_t i = 0; i < match_.size() && host < match_.size(); ++i) {
        Machine<Toy>& machine = match_.machine(i);
        const SessionPhase phase = machine.session.phase();
        const bool is_gone = phase == SessionPhase::lost || (machine.is_offline && phase == SessionPhase::waiting);
        if (machine.plays && is_gone) match_.network().connect(machine.endpoint, match_.machine(host).endpoint);
      }
      return false;
    });
  }
  std::size_t living_host() {
    Frame newest = kNoFrame;
    std::size_t found = match_.size();
    for (const std::size_t i : hosts()) {
      if (!match_.machine(i).plays || match_.machine(i).end() <= newest) continue;
      newest = match_.machine(i).end();
      found = i;
    }
    return found;
  }
  void revive(std::size_t i) {
    match_.machine(i).plays = true;
    match_.network().set_silent(match_.machine(i).endpoint, false);
    match_.network().set_side(match_.machine(i).endpoint, 0);
  }
  std::size_t ill() {
    std::size_t count = 0;
    for (std::size_t i = 0; i < match_.size(); ++i) count += match_.machine(i).plays ? 0 : 1;
    return count;
  }
  /// One and the same all the time, so that the others are a majority.
  std::size_t fragile() const { return match_.size() - 1; }
  void damage(Machine<Toy>& machine) {
    ++damages;
    const Frame at = machine.session.current() + 5;
    machine.tamper = [at](Toy& game, Frame frame) {
      if (frame == at) game.state.places[3] ^= 8;
    };
  }
  void disturb() {
    const std::size_t host = living_host();
    const std::size_t any = random_.next() % match_.size();
    const bool may_fail = 2 * (ill() + 1) < match_.size() && host < match_.size();
    switch (random_.next() % 7) {
      case 0:
      case 1:  // the host's process or its line; it may be back before anybody has missed it
        if (!may_fail) break;
        match_.machine(host).plays = false;
        match_.network().set_silent(match_.machine(host).endpoint, random_.next() % 2 == 0);
        ++killed_hosts;
        break;
      case 2:  // a client
        if (may_fail && any != host) match_.machine(any).plays = false;
        break;
      case 3:  // a bit of a client's memory
        if (config_.repair && may_fail && fragile() != host) damage(match_.machine(fragile()));
        break;
      case 4:  // a line that breaks
        match_.network().cut(match_.machine(any).endpoint);
        break;
      default:
        for (std::size_t i = 0; i < match_.size(); ++i) revive(i);
        break;
    }
  }

  Pcg32 random_;
  SessionConfig config_;
  VirtualMatch<Toy> match_;
};

TEST(MigrationChaos, EndsWithOneHostOneHistoryAndEverybodyBack) {
  int killed = 0, new_hosts = 0, deposed = 0, damages = 0, repairs = 0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    MigrationChaos chaos(seed);
    chaos.play();
    killed += chaos.killed_hosts;
    damages += chaos.damages;
    VirtualMatch<Toy>& match = chaos.match();
    const std::vector<std::size_t> hosts = chaos.hosts();
    ASSERT_EQ(hosts.size(), 1u);
    const Machine<Toy>& host = match.machine(hosts[0]);
    std::vector<int> seats;
    for (std::size_t i = 0; i < match.size(); ++i) {
      SCOPED_TRACE("machine " + std::to_string(i));
      const Machine<Toy>& machine = match.machine(i);
      EXPECT_EQ(machine.session.phase(), SessionPhase::playing);
      EXPECT_TRUE(machine.in_order);
      EXPECT_FALSE(machine.heard(SessionEvent::Kind::misuse));
      EXPECT_FALSE(machine.heard(SessionEvent::Kind::bad_snapshot));
      seats.push_back(machine.session.local_player());
      new_hosts += machine.session.config().host && i != 0 ? 1 : 0;
      deposed += machine.count(SessionEvent::Kind::deposed);
      repairs += machine.count(SessionEvent::Kind::repaired, machine.session.local_player());
      // What an old host confirmed alone may be otherwise in the match that went on; the newest frames are everybody's.
      const Frame end = std::min(machine.end(), host.end());
      EXPECT_GT(end, host.end() - 40);
      for (Frame f = end - 300; f < end; ++f) {
        ASSERT_GE(f, std::max(machine.first, host.first));
        ASSERT_EQ(machine.hashes[static_cast<std::size_t>(f - machine.first)],
                  host.hashes[static_cast<std::size_t>(f - host.first)])
            << f;
      }
    }
    std::sort(seats.begin(), seats.end());
    for (std::size_t i = 0; i < seats.size(); ++i)
      EXPECT_EQ(seats[i], static_cast<int>(i)) << "each has one, and another";
  }
  EXPECT_GT(killed, 30);
  EXPECT_GT(new_hosts, 5);
  EXPECT_GT(deposed, 10);
  EXPECT_GT(damages, 10);
  EXPECT_GT(repairs, 5);
}

}  // namespace migration_chaos_test
}  // namespace isostep::test
