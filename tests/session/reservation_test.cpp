// A player's seat is its own: by a token that nobody can compute, for as long as it is kept, whoever else wants it.
// SPDX-License-Identifier: MIT
#include "isostep/session/siphash.hpp"
#include "session/admission_scene.hpp"

namespace isostep::test {
namespace {

constexpr Time kBackWithin = 2 * kSecond;

/// Takes part in nothing but the first words.
using Stranger = hostile::Rogue;
/// Runs the match until it was answered.
void greet(House& house, Stranger& stranger, const Hello& hello) {
  bool said = false;
  house.match.run(kSecond, [&] {
    stranger.listen();
    if (stranger.is_connected && !said) said = stranger.greet(hello);
    return stranger.is_welcome || stranger.is_refused;
  });
}
Hello hello_with(const House& house, std::uint64_t token) {
  Hello hello = hostile::hello_of(house.config);
  hello.token = token;
  return hello;
}

// --- tokens ---

TEST(Tokens, AreKeyedByTheHostsSecretAndOfNoUseForAnother) {
  FullHouse house(house_of(3));
  const auto drawn = [](std::uint64_t purpose, std::uint64_t n) {
    std::uint8_t words[24] = {};
    store_le(words, purpose);
    store_le(words + 8, n);
    return siphash_2_4({1, 0}, words);  // the seed of a virtual match
  };
  Stranger stranger(house.match, profile(kLine));
  Hello watcher = hello_with(house, 0);
  watcher.spectator = true;
  greet(house, stranger, watcher);
  ASSERT_TRUE(stranger.is_welcome);
  EXPECT_EQ(stranger.welcome.match, drawn(0, 0));
  EXPECT_EQ(stranger.welcome.token, 0u);
  for (int p = 1; p < 3; ++p) {
    const std::uint64_t token = house.player(p).session.token();
    EXPECT_TRUE(token == drawn(1, 0) || token == drawn(1, 1));
  }
}

TEST(Tokens, OfALiveSeatTakeItOverFromAnotherAddress) {
  FullHouse house(house_of(3));
  Player& first = house.player(2);
  const std::uint64_t token = first.session.token();
  house.crash(first);
  Player& second = house.come(house.with_token(token));
  EXPECT_TRUE(house.plays(second, kBackWithin));
  EXPECT_EQ(second.session.local_player(), 2);
  EXPECT_NE(second.session.token(), token);
  house.pass(kSecond);
  Player& third = house.come(house.with_token(token));
  EXPECT_EQ(house.refusal_of(third), "seats: all taken") << "it was of use once";
  EXPECT_EQ(second.session.phase(), SessionPhase::playing);
}

TEST(Tokens, OfALineThatOnlySeemedDeadEndItsOldConnectionWithAReason) {
  FullHouse house(house_of(2));
  Player& old = house.player(1);
  Player& restarted = house.come(house.with_token(old.session.token()));
  EXPECT_EQ(house.refusal_of(old), "seat: taken over from another address");
  EXPECT_TRUE(house.plays(restarted, kBackWithin));
  house.pass(5 * kSecond);
  EXPECT_EQ(restarted.session.phase(), SessionPhase::playing) << "the two do not fight for it";
}

TEST(Tokens, ThatAreWrongAreCountedAndMakeANewPlayer) {
  House house(house_of(3));
  Player& first = house.come();
  house.pass(kSecond);
  house.host().start(house.match.now());
  ASSERT_TRUE(house.plays(first, 2 * kSecond));
  const std::uint64_t before = house.host().stats().refused;
  Player& second = house.come(house.with_token(first.session.token() ^ 1));
  EXPECT_TRUE(house.plays(second, 4 * kSecond)) << "there was a free seat";
  EXPECT_EQ(house.host().stats().refused, before + 1);
  EXPECT_NE(second.session.local_player(), first.session.local_player());
  Player& third = house.come(house.with_token(first.session.token() ^ 2));
  EXPECT_EQ(house.refusal_of(third), "seats: all taken");
  EXPECT_EQ(first.session.phase(), SessionPhase::playing);
}

TEST(Tokens, AreComparedOnceAConnection) {
  FullHouse house(house_of(2));
  const std::uint64_t token = house.player(1).session.token();
  Stranger guesser(house.match, profile(kLine));
  house.match.run(kSecond, [&] { return guesser.listen(), guesser.is_connected; });
  const std::uint64_t before = house.host().stats().refused;
  for (std::uint64_t n = 100; n > 0; --n) guesser.greet(hello_with(house, token + n - 1));  // the right one at last
  house.match.run(kSecond, [&] { return guesser.listen(), guesser.is_refused; });
  EXPECT_TRUE(guesser.is_refused);
  EXPECT_FALSE(guesser.is_welcome);
  EXPECT_GE(house.host().stats().refused, before + 2);
  EXPECT_EQ(house.player(1).session.phase(), SessionPhase::playing);
}

/// The connection ends after the host has given a new token and before the player has read it.
TEST(Tokens, AreGoodUntilTheNextOneHasArrived) {
  FullHouse house(house_of(2));
  Player& first = house.player(1);
  const std::uint64_t token = first.session.token();
  house.crash(first);
  for (int i = 0; i < 3; ++i) {
    Stranger unlucky(house.match, profile(kLine));
    greet(house, unlucky, hello_with(house, token));
    ASSERT_TRUE(unlucky.is_welcome);
    EXPECT_NE(unlucky.welcome.token, token);
    house.match.network().cut(unlucky.id);
    house.pass(kSecond / 10);
  }
  Player& second = house.come(house.with_token(token));
  EXPECT_TRUE(house.plays(second, kBackWithin));
}

// --- reservations ---

TEST(Reservation, KeepsTheSeatOfALineThatDroppedOneSecondAgo) {
  for (const int players : {2, 4}) {
    FullHouse house(house_of(players));
    Player& owner = house.player(players - 1);
    const int seat = owner.session.local_player();
    house.drop(owner);
    house.pass(kSecond);
    ASSERT_EQ(owner.session.phase(), SessionPhase::lost);
    Player& stranger = house.come();
    EXPECT_EQ(house.refusal_of(stranger), "seats: reserved");
    owner.returns = true;
    const Time from = house.match.now();
    EXPECT_TRUE(house.plays(owner, kBackWithin));
    EXPECT_EQ(owner.session.local_player(), seat);
    std::printf("%d players: back in the match after %d ms\n", players,
                static_cast<int>((house.match.now() - from) / 1000));
    house.pass(kSecond);
    expect_sound_machine(owner, false);
  }
}

TEST(Reservation, LeavesOtherSeatsToOthers) {
  House house(house_of(4));
  Player &one = house.come(house.with_seat(1)), &two = house.come(house.with_seat(2));
  house.pass(kSecond);
  house.host().start(house.match.now());
  house.pass(3 * kSecond);
  house.drop(one);
  house.pass(kSecond);
  Player& stranger = house.come();
  ASSERT_TRUE(house.plays(stranger, 4 * kSecond));
  EXPECT_EQ(stranger.session.local_player(), 3);
  EXPECT_EQ(two.session.local_player(), 2);
  one.returns = true;
  EXPECT_TRUE(house.plays(one, kBackWithin));
  EXPECT_EQ(one.session.local_player(), 1);
}

TEST(Reservation, EndsAfterItsTime) {
  SessionConfig config = house_of(2);
  ASSERT_EQ(config.reservation, 60 * kSecond);
  FullHouse house(config);
  house.drop(house.player(1));
  const Time dropped = house.match.now();
  house.pass(59 * kSecond);
  EXPECT_EQ(house.refusal_of(house.come()), "seats: reserved");
  house.pass(dropped + 61 * kSecond - house.match.now());
  EXPECT_TRUE(house.plays(house.come(), 2 * kSecond));
}

TEST(Reservation, IsAlsoOfWhoWasCutOutOfALivingConnection) {
  SessionConfig config = house_of(2);
  config.patience = kSecond;
  config.silence = 10 * kSecond;
  FullHouse house(config);
  Player& owner = house.player(1);
  house.match.network().set_silent(owner.endpoint, true);
  ASSERT_TRUE(house.match.run(3 * kSecond, [&] { return house.match.host().heard(Kind::left, 1); }));
  EXPECT_EQ(house.refusal_of(house.come()), "seats: all taken");
  house.match.network().set_silent(owner.endpoint, false);
  const auto is_back = [&] { return house.match.host().count(Kind::joined, 1) == 2; };
  EXPECT_TRUE(house.match.run(kBackWithin, is_back));
  EXPECT_FALSE(owner.heard(Kind::lost_host));
}

TEST(Reservation, IsNotOfWhoNeverPlayed) {
  House house(house_of(2));
  house.host().start(0);
  house.pass(kSecond);
  Stranger passing(house.match, profile(kLine));
  greet(house, passing, hello_with(house, 0));
  ASSERT_TRUE(passing.is_welcome);
  EXPECT_EQ(house.refusal_of(house.come()), "seats: all taken");
  house.match.network().cut(passing.id);
  house.pass(kSecond / 10);
  EXPECT_TRUE(house.plays(house.come(), kBackWithin));
}

TEST(Reservation, AConnectionThatNeverPlaysKeepsNoSeatForLonger) {
  SessionConfig config = house_of(2);
  config.reservation = 3 * kSecond;
  House house(config);
  house.host().start(0);
  house.pass(kSecond);
  Stranger idle(house.match, profile(kLine));
  greet(house, idle, hello_with(house, 0));
  ASSERT_TRUE(idle.is_welcome);
  const auto keep_alive = [&] {
    idle.listen();
    PacketHeader header;
    header.match = idle.welcome.match;
    std::uint8_t buffer[kDatagramCap];
    const Bytes bytes = PacketWriter(header, buffer).bytes();
    idle.say(Channel::datagram, {bytes.begin(), bytes.end()});
    return false;
  };
  house.match.run(4 * kSecond, keep_alive);
  Player& player = house.come();
  house.match.run(kBackWithin, keep_alive);
  EXPECT_EQ(player.session.phase(), SessionPhase::playing);
  EXPECT_TRUE(idle.is_refused);
  EXPECT_EQ(idle.refusal.here.view(), "not played on for too long");
}

}  // namespace
}  // namespace isostep::test
