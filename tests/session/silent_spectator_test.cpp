// Spectators that never acknowledge: what they cost the host, when they are out, and that honest ones do not suffer.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <deque>
#include <string>

#include "isostep/session/protocol/message.hpp"
#include "session/pace_watch.hpp"

namespace isostep::test {
namespace silent_spectator_test {

constexpr const char* kGoodLine = "latency=30,jitter=5,loss=0.5";

/// The chatter of a silent spectator beside its greeting.
enum class Chatter { headers, rubbish, one_frame };

/// Greets, sends one small datagram a second, and acknowledges nothing. It comes again as soon as it is put out.
class SilentSpectator {
 public:
  SilentSpectator(ToyMatch& match, Chatter chatter, bool needs_snapshot, bool returns)
      : match_(match),
        endpoint_(match.network().add_client(profile(kGoodLine))),
        port_(match.network().port(endpoint_)),
        chatter_(chatter),
        needs_snapshot_(needs_snapshot),
        returns_(returns) {
    match.network().connect(endpoint_);
  }

  void tick() {
    while (const std::optional<transport::Arrival> arrival = port_.receive()) {
      if (arrival->kind == transport::ArrivalKind::connected) greet();
      if (arrival->kind == transport::ArrivalKind::disconnected) leave();
      if (arrival->kind != transport::ArrivalKind::message || arrival->channel != Channel::reliable) continue;
      if (const Result<Welcome> welcome = read_welcome(arrival->bytes)) match_number_ = welcome.value().match;
    }
    if (is_in_ && match_.now() >= next_) chat();
    if (returns_ && is_out_) is_out_ = !match_.network().connect(endpoint_);
  }
  /// [bytes] that the host sent it.
  std::uint64_t cost() const {
    const transport::DirectionStatistics& down = match_.network().statistics(endpoint_, transport::Direction::down);
    return down.datagram_bytes + down.reliable_bytes;
  }
  bool is_out() const { return is_out_; }
  Time longest_stay() const { return longest_stay_; }
  int visits() const { return visits_; }

 private:
  void greet() {
    ++visits_;
    is_in_ = true;
    came_ = match_.now();
    next_ = came_ + kSecond;
    Hello hello;
    hello.spectator = true;
    const std::uint64_t start = needs_snapshot_ ? 1 : Toy().hash();
    hello.have = {0, start};
    hello.identity = match_.host().session.config().identity;
    std::vector<std::uint8_t> bytes;
    write_hello(hello, bytes);
    EXPECT_TRUE(port_.send(0, Channel::reliable, bytes).ok());
  }
  void leave() {
    if (is_in_) longest_stay_ = std::max(longest_stay_, match_.now() - came_);
    is_in_ = false;
    is_out_ = true;
  }
  void chat() {
    next_ += kSecond;
    PacketHeader header;
    header.match = match_number_;
    header.frame = match_.host().session.current();
    if (chatter_ == Chatter::one_frame) {  // one more each time
      header.ack_mask = 0xff;
      for (Frame& ack : header.ack) ack = acknowledged_;
      ++acknowledged_;
    }
    std::uint8_t buffer[kDatagramCap] = {0};
    const Bytes said = PacketWriter(header, buffer).bytes();
    const Bytes rubbish(buffer, 1);
    static_cast<void>(port_.send(0, Channel::datagram, chatter_ == Chatter::rubbish ? rubbish : said).ok());
  }

  ToyMatch& match_;
  transport::EndpointId endpoint_;
  transport::SimulatedNetwork::Port port_;
  Chatter chatter_;
  bool needs_snapshot_, returns_;
  bool is_in_ = false, is_out_ = false;
  std::uint64_t match_number_ = 0;
  Time came_ = 0, next_ = 0, longest_stay_ = 0;
  int visits_ = 0;
  Frame acknowledged_ = 1;
};

void pass(ToyMatch& match, std::deque<SilentSpectator>& silent, Time time) {
  match.run(time, [&] {
    for (SilentSpectator& one : silent) one.tick();
    return false;
  });
}

struct Case {
  Chatter chatter;
  bool needs_snapshot;
  bool is_early;  // there before the match begins
};
class Silent : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(Cases, Silent,
                         testing::Values(Case{Chatter::headers, false, false}, Case{Chatter::rubbish, false, false},
                                         Case{Chatter::headers, true, false}, Case{Chatter::headers, false, true}));

// Eight players whose inputs change every frame: the most there is to send.
TEST_P(Silent, SpectatorCostsLittleAndIsOutWithinTheSilence) {
  for (const int players : {2, 8}) {
    SCOPED_TRACE(players);
    ToyMatch match(config_of(players, SessionMode::rollback), kGoodLine);
    std::deque<SilentSpectator> silent;
    if (!GetParam().is_early) match.pass(15 * kSecond);
    silent.emplace_back(match, GetParam().chatter, GetParam().needs_snapshot, false);
    const Time before = match.now();
    match.run(20 * kSecond, [&] {
      silent[0].tick();
      return silent[0].is_out();
    });
    EXPECT_TRUE(silent[0].is_out());
    // The transport's connection, and its end, take a round trip.
    EXPECT_LE(silent[0].longest_stay(), match.host().session.config().silence + kSecond / 5);
    const std::uint64_t rate = silent[0].cost() * kSecond / (match.now() - before);
    EXPECT_LE(rate, 10000u) << "[bytes/s]";
    std::printf("%d players: a silent spectator costs %u bytes/s for %.2f s\n", players, unsigned(rate),
                double(silent[0].longest_stay()) / kSecond);
    expect_one_history(match);
  }
}

// It acknowledges a frame a second.
TEST(SilentSpectators, WhoAcknowledgesNextToNothingIsOutAsWell) {
  ToyMatch match(config_of(8, SessionMode::rollback), kGoodLine);
  match.pass(15 * kSecond);
  std::deque<SilentSpectator> silent;
  silent.emplace_back(match, Chatter::one_frame, false, false);
  const Time before = match.now();
  match.run(20 * kSecond, [&] {
    silent[0].tick();
    return silent[0].is_out();
  });
  EXPECT_TRUE(silent[0].is_out());
  EXPECT_LE(silent[0].longest_stay(), 2 * match.host().session.config().silence);
  EXPECT_LE(silent[0].cost(), 10000 * (match.now() - before) / kSecond);
  std::printf("one frame a second: %u bytes/s for %.2f s\n",
              unsigned(silent[0].cost() * kSecond / (match.now() - before)),
              double(silent[0].longest_stay()) / kSecond);
}

// One machine hosts four players for a minute.
struct Minute {
  std::uint64_t bytes = 0;
  int visits = 0;
};
Minute minute_with(std::size_t count, int players, bool returns, bool needs_snapshot) {
  ToyMatch match(config_of(players, SessionMode::rollback), kGoodLine);
  std::deque<SilentSpectator> silent;
  match.pass(10 * kSecond);
  const std::uint64_t before = match.host().session.stats().bytes_out;
  for (std::size_t i = 0; i < count; ++i) silent.emplace_back(match, Chatter::headers, needs_snapshot, returns);
  pass(match, silent, 60 * kSecond);
  Minute minute{match.host().session.stats().bytes_out - before, 0};
  for (const SilentSpectator& one : silent) minute.visits += one.visits();
  expect_one_history(match);
  return minute;
}

TEST(SilentSpectators, TwelveCostTheHostLessThanATwentiethOfAMinute) {
  for (const int players : {2, 4}) {
    for (const bool needs_snapshot : {false, true}) {
      SCOPED_TRACE(players);
      const std::uint64_t without = minute_with(0, players, false, false).bytes;
      const std::uint64_t with = minute_with(12, players, false, needs_snapshot).bytes;
      EXPECT_LE(with * 100, without * 105);
      std::printf("%d players, %s: %.1f kB a minute, with twelve silent %.1f kB: %+.1f %%\n", players,
                  needs_snapshot ? "by snapshot" : "by inputs", double(without) / 1e3, double(with) / 1e3,
                  100.0 * (double(with) / double(without) - 1));
    }
  }
}

TEST(SilentSpectators, WhoComeAgainAndAgainCostTheHostNoMore) {
  for (const bool needs_snapshot : {false, true}) {
    const std::uint64_t without = minute_with(0, 4, false, false).bytes;
    const Minute with = minute_with(12, 4, true, needs_snapshot);
    EXPECT_GE(with.visits, 12 * 10);
    EXPECT_LE(with.bytes * 100, without * 105);
    std::printf("%s, %d visits: %.1f kB a minute for %.1f kB: %+.1f %%\n", needs_snapshot ? "by snapshot" : "by inputs",
                with.visits, double(with.bytes) / 1e3, double(without) / 1e3,
                100.0 * (double(with.bytes) / double(without) - 1));
  }
}

/// A player and a spectator on a line of 150 +-50 ms that loses so many datagrams of a hundred.
void expect_nobody_is_put_out(SessionMode mode, int loss) {
  SCOPED_TRACE(loss);
  const std::string line = "latency=150,jitter=50,loss=" + std::to_string(loss);
  SessionConfig config = config_of(3, mode);
  config.patience = 60 * kSecond;  // the pauses are many, and the others wait for a player's
  ToyMatch match(config, kGoodLine);
  match.network().set_profile(match.machine(2).endpoint, profile(line));
  SessionConfig watcher = config_of(3, SessionMode::spectator);
  watcher.local_players = 0;
  match.pass(15 * kSecond);
  match.add(profile(line), watcher);
  match.pass(10 * kSecond);
  for (const std::size_t i : {2, 3, 2, 3}) {
    match.hitch(i, match.host().session.config().silence * 9 / 10);
    match.pass(10 * kSecond);
  }
  // The line loses everything for a while: what was under way is gone, and so are the acknowledgements.
  for (const std::size_t i : {2, 3}) {
    match.network().set_silent(match.machine(i).endpoint, true);
    match.pass(match.host().session.config().silence * 9 / 10 - kSecond / 2);
    match.network().set_silent(match.machine(i).endpoint, false);
    match.pass(10 * kSecond);
  }
  EXPECT_EQ(match.host().session.stats().put_out, 0u);
  for (const std::size_t i : {1, 2, 3}) EXPECT_EQ(match.machine(i).count(SessionEvent::Kind::lost_host), 0);
  EXPECT_FALSE(match.host().heard(SessionEvent::Kind::left, 2));
  EXPECT_LT(match.host().end() - match.machine(3).end(), 60) << "[frames] that the spectator is behind";
  expect_one_history(match, true);
}
TEST(BadLines, ArePutUpWithHoweverLongTheyPause) {
  for (const SessionMode mode : {SessionMode::lockstep, SessionMode::rollback}) {
    for (const int loss : {10, 30}) expect_nobody_is_put_out(mode, loss);
  }
}

// It falls behind by fifteen frames a second: when it has no more room for inputs, it acknowledges as fast as it steps.
TEST(SlowSpectators, ArePutUpWith) {
  ToyMatch match(config_of(2, SessionMode::rollback), kGoodLine);
  SessionConfig watcher = config_of(2, SessionMode::spectator);
  watcher.local_players = 0;
  Machine<Toy>& slow = match.add(profile(kGoodLine), watcher);
  slow.step_time = 22000;
  match.pass(300 * kSecond);
  EXPECT_GT(match.host().end() - slow.end(), match.host().session.config().history / 2);
  EXPECT_EQ(match.host().session.stats().put_out, 0u);
  EXPECT_EQ(slow.count(SessionEvent::Kind::lost_host), 0);
  expect_one_history(match);
}

}  // namespace silent_spectator_test
}  // namespace isostep::test
