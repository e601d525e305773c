// Relays: spectators that serve spectators. The host pays for one, all confirm the same match, late if that is wanted.
// SPDX-License-Identifier: MIT
#include "session/altered_packet.hpp"
#include "session/pace_watch.hpp"

namespace isostep::test {
namespace relay_test {

using Kind = SessionEvent::Kind;
constexpr Time kMs = 1000;  // [us]
constexpr const char* kGoodLine = "latency=30,jitter=5,loss=0.5";
constexpr int kPlayers = 4;

/// A match of four and those who watch it.
struct Broadcast {
  explicit Broadcast(SessionMode mode = SessionMode::rollback, Frame history = 7200, Frame delay = 0) {
    config = config_of(kPlayers, mode);
    config.history = history;
    watcher = config;
    watcher.mode = SessionMode::spectator;
    watcher.local_players = 0;
    relay = watcher;
    relay.relays = true;
    relay.broadcast_delay = delay;
    match = std::make_unique<VirtualMatch<Toy>>(
        config, [] { return std::make_unique<Toy>(200); },
        [](int player, Frame frame) { return toy_input(5, player, frame); });
    for (int p = 1; p < kPlayers; ++p) match->add(profile(kGoodLine));
  }
  Machine<Toy>& add_relay(transport::EndpointId home = 0) { return match->add(profile(kGoodLine), relay, home); }
  Machine<Toy>& add_leaf(const Machine<Toy>& of, std::string_view line = kGoodLine) {
    Machine<Toy>& leaf = match->add(profile(line), watcher, of.endpoint);
    leaf.returns = true;
    return leaf;
  }
  void pass(Time time) {
    match->run(time, [] { return false; });
  }
  /// [bytes] that the host sends in so much time.
  std::uint64_t host_bytes(Time time) {
    const std::uint64_t before = match->host().session.stats().bytes_out;
    pass(time);
    return match->host().session.stats().bytes_out - before;
  }
  SessionConfig config, watcher, relay;
  std::unique_ptr<VirtualMatch<Toy>> match;
};

void expect_watched_all(const Machine<Toy>& machine, const Machine<Toy>& host, Frame behind) {
  EXPECT_EQ(machine.first, 0);
  EXPECT_GE(machine.end(), host.end() - behind);
  EXPECT_EQ(machine.restarts, 0);
  EXPECT_FALSE(machine.guessed);
  EXPECT_EQ(machine.session.phase(), SessionPhase::watching);
}

class Relays : public testing::TestWithParam<SessionMode> {};
INSTANTIATE_TEST_SUITE_P(Modes, Relays, testing::Values(SessionMode::lockstep, SessionMode::rollback));

TEST_P(Relays, OfSixteenLeavesCostTheHostOneSpectator) {
  Broadcast alone(GetParam()), tree(GetParam());
  alone.match->add(profile(kGoodLine), alone.watcher);
  Machine<Toy>& relay = tree.add_relay();
  std::vector<Machine<Toy>*> leaves;
  for (int n = 0; n < 16; ++n) leaves.push_back(&tree.add_leaf(relay, n % 4 == 3 ? "mobile" : kGoodLine));
  alone.pass(10 * kSecond);
  tree.pass(10 * kSecond);
  const std::uint64_t one = alone.host_bytes(20 * kSecond), its = tree.host_bytes(20 * kSecond);
  std::printf("the host sends %d kB/s with one spectator, %d with a relay of 16; the relay %d\n",
              static_cast<int>(one / 20000), static_cast<int>(its / 20000),
              static_cast<int>(relay.session.stats().bytes_out / (tree.match->now() / 1000)));
  EXPECT_LE(its * 100, one * 102);
  EXPECT_EQ(relay.session.stats().peers, 17);
  for (const Machine<Toy>* leaf : leaves) expect_watched_all(*leaf, tree.match->host(), 40);
  expect_one_history(*tree.match);
}

TEST_P(Relays, StandUnderRelays) {
  Broadcast tree(GetParam());
  Machine<Toy>& first = tree.add_relay();
  Machine<Toy>& second = tree.add_relay(first.endpoint);
  Machine<Toy>& near = tree.add_leaf(first);
  Machine<Toy>& far = tree.add_leaf(second, "mobile");
  tree.pass(20 * kSecond);
  Machine<Toy>& late = tree.add_leaf(second);
  tree.pass(10 * kSecond);
  for (const Machine<Toy>* machine : {&first, &second, &near, &far, &late}) {
    expect_watched_all(*machine, tree.match->host(), 60);
  }
  EXPECT_EQ(tree.match->host().session.stats().peers, kPlayers);
  for (std::size_t p = 1; p < kPlayers; ++p) {
    EXPECT_GT(far.session.stats().players[p].round_trip, 40u * kMs) << "figures travel down the tree";
  }
  expect_one_history(*tree.match);
}

TEST_P(Relays, ServeLateLeavesTheirOwnState) {
  Broadcast tree(GetParam(), 200);
  Machine<Toy>& relay = tree.add_relay();
  tree.pass(15 * kSecond);
  Machine<Toy>* late[3] = {&tree.add_leaf(relay), &tree.add_leaf(relay, "mobile"), &tree.add_leaf(relay)};
  tree.pass(10 * kSecond);
  for (const Machine<Toy>* leaf : late) {
    EXPECT_EQ(leaf->restarts, 1);
    EXPECT_GT(leaf->first, 700);
    EXPECT_GE(leaf->end(), tree.match->host().end() - 60);
    EXPECT_EQ(leaf->session.phase(), SessionPhase::watching);
  }
  expect_one_history(*tree.match);
}

TEST_P(Relays, ThatDieAreReplacedWithoutAGap) {
  Broadcast tree(GetParam());
  Machine<Toy>& dies = tree.add_relay();
  Machine<Toy>& stays = tree.add_relay();
  std::vector<Machine<Toy>*> leaves;
  for (int n = 0; n < 6; ++n) leaves.push_back(&tree.add_leaf(dies));
  tree.pass(12 * kSecond);
  dies.plays = false;
  tree.match->network().set_silent(dies.endpoint, true);
  for (std::size_t n = 0; n < leaves.size(); ++n) leaves[n]->home = n % 2 == 0 ? stays.endpoint : 0;
  tree.pass(15 * kSecond);
  for (const Machine<Toy>* leaf : leaves) {
    EXPECT_TRUE(leaf->heard(Kind::lost_host));
    EXPECT_TRUE(leaf->in_order);
    expect_watched_all(*leaf, tree.match->host(), 60);
  }
  expect_one_history(*tree.match, true);
}

TEST_P(Relays, ThatLoseTheirHostForAWhileKeepTheirLeaves) {
  Broadcast tree(GetParam());
  Machine<Toy>& relay = tree.add_relay();
  relay.returns = true;
  Machine<Toy>* leaves[2] = {&tree.add_leaf(relay), &tree.add_leaf(relay)};
  tree.pass(10 * kSecond);
  tree.match->network().cut(relay.endpoint);  // all its connections
  tree.pass(10 * kSecond);
  for (const Machine<Toy>* leaf : leaves) expect_watched_all(*leaf, tree.match->host(), 60);
  expect_watched_all(relay, tree.match->host(), 60);
  expect_one_history(*tree.match, true);
}

TEST_P(Relays, AndTheirLeavesTakeTheHostsStateAgainWhenTheirsIsWrong) {
  for (const bool is_relay : {false, true}) {
    SCOPED_TRACE(is_relay);
    Broadcast tree(GetParam());
    tree.watcher.repair = tree.relay.repair = true;
    Machine<Toy>& relay = tree.add_relay();
    Machine<Toy>& leaf = tree.add_leaf(relay);
    Machine<Toy>& other = tree.add_leaf(relay);
    Machine<Toy>& wrong = is_relay ? relay : leaf;
    wrong.tamper = [&wrong](Toy& game, Frame frame) {
      if (frame == 400 && wrong.restarts == 0) game.state.places[2] ^= 1;
    };
    tree.pass(30 * kSecond);
    EXPECT_TRUE(wrong.heard(Kind::desync));
    EXPECT_TRUE(is_relay || !other.heard(Kind::desync));
    EXPECT_EQ(tree.match->host().session.stats().peers, kPlayers);
    const std::vector<std::uint64_t>& host = tree.match->host().hashes;
    for (const Machine<Toy>* machine : {&relay, &leaf, &other}) {
      ASSERT_GT(machine->end(), 1600);
      for (Frame frame = 1500; frame < std::min(machine->end(), tree.match->host().end()); ++frame) {
        ASSERT_EQ(machine->hashes[static_cast<std::size_t>(frame - machine->first)],
                  host[static_cast<std::size_t>(frame)]);
      }
    }
  }
}

TEST_P(Relays, ShowTheMatchLate) {
  constexpr Frame kDelay = 600;
  Broadcast tree(GetParam(), 1600, kDelay);
  Machine<Toy>& relay = tree.add_relay();
  Frame newest_told = 0, ahead = 0;  // what any leaf was told of, and how far that is beyond what may be shown
  const auto watch = [&](Machine<Toy>& leaf) {
    leaf.middle = [&](Channel channel, std::vector<std::uint8_t>& bytes) {
      const Result<Packet> packet = read_packet(bytes);
      if (channel != Channel::datagram || !packet) return;
      Frame told = packet.value().header.frame;
      if (told == 0 && packet.value().slice_count == 0) return;  // the match has not begun for us
      for (std::uint8_t i = 0; i < packet.value().slice_count; ++i) {
        const InputSlice& slice = packet.value().slices[i];
        if (slice.first + slice.count > told) told = slice.first + slice.count;
      }
      newest_told = std::max(newest_told, told);
      ahead = std::max(ahead, told - (tree.match->host().session.current() - kDelay));
    };
  };
  Machine<Toy>& first = tree.add_leaf(relay);
  watch(first);
  tree.pass(30 * kSecond);
  Machine<Toy>& late = tree.add_leaf(relay, "mobile");
  watch(late);
  tree.pass(15 * kSecond);
  const Frame now = tree.match->host().session.current();
  EXPECT_GT(newest_told, now - kDelay - 120);
  // Inputs wait some frames before the host steps them.
  EXPECT_LE(ahead, GetParam() == SessionMode::lockstep ? tree.match->host().session.stats().delay + 2 : 2);
  for (const Machine<Toy>* machine : {&relay, &first, &late}) {
    EXPECT_GT(machine->end(), now - kDelay - 120);
    EXPECT_LE(machine->session.current(), now - kDelay + 10);
    EXPECT_EQ(machine->session.phase(), SessionPhase::watching);
  }
  EXPECT_GT(late.first, 1000) << "a snapshot, as late as the rest";
  EXPECT_LE(late.first, now - 15 * 60 - kDelay + 120);
  PaceWatch<Toy> pace(*tree.match);
  pace.watch(5 * kSecond);
  EXPECT_NEAR(pace.hundred_seconds(first.endpoint), 6000, 40) << "evenly, once it has begun";
  expect_one_history(*tree.match);
}

TEST(RelayLimits, SilentLeavesCostLittleAndAreOutSoon) {
  Broadcast tree;
  Machine<Toy>& relay = tree.add_relay();
  Machine<Toy>& good = tree.add_leaf(relay);
  tree.pass(10 * kSecond);
  const std::uint64_t before = relay.session.stats().bytes_out;
  tree.pass(4 * kSecond);
  const std::uint64_t usual = relay.session.stats().bytes_out - before;
  Machine<Toy>& silent = tree.add_leaf(relay);
  silent.returns = false;
  silent.outgoing = [](Channel channel, std::vector<std::uint8_t>& bytes) {
    alter_packet(
        bytes, [](PacketHeader& header) { header.ack_mask = 0; }, NothingAltered{});
    static_cast<void>(channel);
  };
  const std::uint64_t from = relay.session.stats().bytes_out;
  tree.pass(4 * kSecond);
  EXPECT_LE(relay.session.stats().bytes_out - from, usual + 4 * 1000);
  tree.pass(4 * kSecond);
  EXPECT_EQ(relay.session.stats().put_out, 1u);
  EXPECT_FALSE(relay.heard(Kind::desync));
  expect_watched_all(good, tree.match->host(), 40);
}

TEST(RelayLimits, NobodyPlaysAtARelayAndItHasItsPlaces) {
  Broadcast tree;
  tree.relay.max_peers = 2;
  Machine<Toy>& relay = tree.add_relay();
  tree.add_leaf(relay);
  tree.add_leaf(relay);
  tree.pass(3 * kSecond);
  Machine<Toy>& third = tree.add_leaf(relay);
  SessionConfig player = tree.config;
  player.local_players = 0;
  Machine<Toy>& intruder = tree.match->add(profile(kGoodLine), player, relay.endpoint);
  tree.pass(3 * kSecond);
  EXPECT_EQ(third.last(Kind::refused).field.key.view(), "spectators");
  EXPECT_EQ(intruder.last(Kind::refused).field.key.view(), "relay");
  EXPECT_EQ(relay.session.stats().peers, 3);
}

TEST(RelayLimits, NoiseOfALeafIsWithoutEffect) {
  Broadcast tree;
  Machine<Toy>& relay = tree.add_relay();
  Machine<Toy>& good = tree.add_leaf(relay);
  Machine<Toy>& rogue = tree.add_leaf(relay);
  Pcg32 random = Pcg32::seeded(2);
  rogue.outgoing = [&](Channel, std::vector<std::uint8_t>& bytes) {
    if (random.next() % 3 == 0)
      bytes[random.next() % bytes.size()] ^= static_cast<std::uint8_t>(1u << random.next() % 8);
    if (random.next() % 9 == 0) bytes.resize(1 + random.next() % bytes.size());
  };
  tree.pass(20 * kSecond);
  EXPECT_GT(relay.session.stats().refused, 100u);
  EXPECT_FALSE(relay.heard(Kind::desync));
  expect_watched_all(good, tree.match->host(), 40);
  expect_watched_all(relay, tree.match->host(), 40);
}

}  // namespace relay_test
}  // namespace isostep::test
