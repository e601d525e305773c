// Drawn matches over ENet in which machines stand still, die, leave and come back: one history, and it goes on.
// RandomMatch tries these by the thousand in virtual time; here real packets do.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <vector>

#include "enet_machine.hpp"
#include "sample.hpp"

namespace isostep::test {
namespace random_enet_test {

class RandomEnetMatch {
 public:
  explicit RandomEnetMatch(std::uint64_t seed) : random_(Pcg32::seeded(seed)), players_(2 + draw(3)) {
    for (int number = 0; number < players_; ++number) begin(EnetMachine::patient_config(number, players_));
    for (std::size_t i = 1; i < machines_.size(); ++i) EXPECT_TRUE(machines_[i]->connect_to(*machines_[0]));
  }

  void play() {
    ASSERT_TRUE(goes_on()) << story_;
    for (int i = 0; i < 4; ++i) {
      disturb();
      run(kSecond * (1 + draw(3)), [] { return false; });
    }
    for (std::size_t i = 0; i < machines_.size(); ++i) {
      asleep_until_[i] = 0;
      if (is_dead_[i]) come_back(i);
    }
    if (!has_lost_memory()) EXPECT_TRUE(goes_on()) << story_;
    EXPECT_EQ(twice_, 0) << story_ << " first frame " << first_twice_;
  }

 private:
  int draw(int count) { return static_cast<int>(random_.next() % static_cast<std::uint32_t>(count)); }
  void begin(const SessionConfig& config) {
    asleep_until_.push_back(0);
    is_dead_.push_back(false);
    machines_.push_back(nullptr);
    renew(machines_.size() - 1, config);
  }
  void renew(std::size_t i, const SessionConfig& config) {
    machines_[i] = std::make_unique<EnetMachine>(config);
    machines_[i]->was_confirmed = [this](Frame frame, std::uint64_t hash) {
      newest_ = std::max(newest_, frame);
      if (said_.emplace(frame, hash).first->second == hash) return;
      if (twice_++ == 0) first_twice_ = frame;
    };
  }
  /// Perhaps nobody is left who knows what was final: a majority died, or a host that was one alone.
  bool has_lost_memory() const { return 2 * deaths_ >= players_ || has_lost_roster_; }
  bool plays(std::size_t i) const { return !is_dead_[i]; }
  /// The machine at which a game that has lost the match asks for it: its host, or else who saw most of it.
  std::size_t somebody(std::size_t but) const {
    std::size_t found = machines_.size();
    const auto rank = [&](std::size_t i) {
      const Session<Toy>& session = machines_[i]->session;
      return std::pair(session.config().host, session.confirmed());
    };
    for (std::size_t i = 0; i < machines_.size(); ++i) {
      if (i != but && plays(i) && (found == machines_.size() || rank(found) < rank(i))) found = i;
    }
    return found;
  }
  void disturb() {
    const auto i = static_cast<std::size_t>(draw(players_));
    switch (draw(4)) {
      case 0: {
        const Time pause = (200 + draw(3000)) * Time{1000};
        story_ += " hitch " + std::to_string(i) + " " + std::to_string(pause / 1000);
        asleep_until_[i] = steady_now() + pause;
        break;
      }
      case 1: die(i, false); break;
      case 2: die(i, true); break;
      default:
        if (is_dead_[i]) come_back(i);
        break;
    }
  }
  /// Its process is gone; or it is closed, and says so.
  void die(std::size_t i, bool says_so) {
    if (is_dead_[i]) return;
    story_ += (says_so ? " leaves " : " dies ") + std::to_string(i);
    const Session<Toy>& session = machines_[i]->session;
    has_lost_roster_ = has_lost_roster_ || (session.config().host && session.stats().machines <= 2);
    ++deaths_;
    if (says_so) {
      for (int peer = 0; peer < 64; ++peer) machines_[i]->port.disconnect(static_cast<PeerId>(peer));
      machines_[i]->port.flush();
    }
    is_dead_[i] = true;
  }
  /// A new process with the token of the one that died. Where nobody is left nothing is.
  void come_back(std::size_t i) {
    const std::size_t home = somebody(i);
    if (home == machines_.size()) {
      story_ += " wakes " + std::to_string(i);
      is_dead_[i] = false;
      return;
    }
    story_ += " returns " + std::to_string(i);
    SessionConfig config = EnetMachine::patient_config(static_cast<int>(i), players_);
    config.host = false;
    config.local_players = 0;
    config.token = machines_[i]->session.token();
    renew(i, config);
    is_dead_[i] = false;
    EXPECT_TRUE(machines_[i]->connect_to(*machines_[home]));
  }
  template <class Done> bool run(Time most, const Done& done) {
    Time asked = 0;
    for (const Time end = steady_now() + most; steady_now() < end;) {
      const Time now = steady_now();
      const bool asks = now > asked + kSecond / 4;
      if (asks) asked = now;
      for (std::size_t i = 0; i < machines_.size(); ++i) {
        if (!plays(i) || now < asleep_until_[i]) continue;
        machines_[i]->turn(steady_now());
        const SessionPhase phase = machines_[i]->session.phase();
        const bool is_lost = phase == SessionPhase::lost || phase == SessionPhase::refused;
        const std::size_t home = asks && is_lost ? somebody(i) : machines_.size();
        if (home < machines_.size()) static_cast<void>(machines_[i]->connect_to(*machines_[home]));
      }
      if (done()) return true;
      machines_[0]->port.wait(1000);
    }
    return false;
  }
  /// All play, and a second more becomes final.
  bool goes_on() {
    Frame until = kNoFrame;
    return run(300 * kSecond, [&] {
      int playing = 0;
      for (const auto& machine : machines_) playing += machine->session.phase() == SessionPhase::playing ? 1 : 0;
      if (playing < players_) until = kNoFrame;
      else if (until == kNoFrame) until = newest_ + 60;
      return until != kNoFrame && newest_ > until;
    });
  }

  Pcg32 random_;
  int players_;
  std::vector<std::unique_ptr<EnetMachine>> machines_;
  std::vector<Time> asleep_until_;  // [us]
  std::vector<bool> is_dead_;
  std::map<Frame, std::uint64_t> said_;
  Frame newest_ = 0, first_twice_ = kNoFrame;
  int twice_ = 0;
  std::string story_;
  int deaths_ = 0;
  bool has_lost_roster_ = false;
};

TEST(RandomOverEnet, OneHistory) {
  for (std::uint64_t seed = 1; seed <= sampled(40u, 2u); ++seed) {
    SCOPED_TRACE(seed);
    RandomEnetMatch(seed).play();
  }
}

}  // namespace random_enet_test
}  // namespace isostep::test
