// A player's seat is its own: by a token that nobody can compute, for as long as it is kept, whoever else wants it.
// SPDX-License-Identifier: MIT
#include "isostep/session/host/leadership.hpp"
#include "isostep/session/protocol/siphash.hpp"
#include "session/admission_scene.hpp"

namespace isostep::test {
namespace reservation_test {

constexpr Time kBackWithin = 2 * kSecond;

/// Takes part in nothing but the first words.
using Stranger = hostile::Rogue;
/// Runs the match until it was answered.
void greet(OpenMatch& scene, Stranger& stranger, const Hello& hello) {
  bool said = false;
  scene.match.run(kSecond, [&] {
    stranger.listen();
    if (stranger.is_connected && !said) said = stranger.greet(hello);
    return stranger.is_welcome || stranger.is_refused;
  });
}
Hello hello_with(const OpenMatch& scene, std::uint64_t token) {
  Hello hello = hostile::hello_of(scene.config);
  hello.token = token;
  return hello;
}

// --- tokens ---

TEST(Tokens, AreKeyedByTheHostsSecretAndOfNoUseForAnother) {
  FullMatch scene(players_of(3));
  const auto drawn = [](std::uint64_t purpose, std::uint64_t n) {
    std::uint8_t words[32] = {};
    store_le(words, purpose);
    store_le(words + 8, std::uint64_t{Leadership::kFirstTerm});
    store_le(words + 16, n);
    return siphash_2_4({1, 0}, words);  // the seed of a virtual match
  };
  Stranger stranger(scene.match, profile(kLine));
  Hello watcher = hello_with(scene, 0);
  watcher.spectator = true;
  greet(scene, stranger, watcher);
  ASSERT_TRUE(stranger.is_welcome);
  EXPECT_EQ(stranger.welcome.match, drawn(0, 0));
  EXPECT_EQ(stranger.welcome.token, 0u);
  for (int p = 1; p < 3; ++p) {
    const std::uint64_t token = scene.player(p).session.token();
    EXPECT_TRUE(token == drawn(1, 0) || token == drawn(1, 1));
  }
}

TEST(Tokens, OfALiveSeatTakeItOverFromAnotherAddress) {
  FullMatch scene(players_of(3));
  Player& first = scene.player(2);
  const std::uint64_t token = first.session.token();
  scene.crash(first);
  Player& second = scene.come(scene.with_token(token));
  EXPECT_TRUE(scene.plays(second, kBackWithin));
  EXPECT_EQ(second.session.local_player(), 2);
  EXPECT_NE(second.session.token(), token);
  scene.pass(kSecond);
  Player& third = scene.come(scene.with_token(token));
  EXPECT_EQ(scene.refusal_of(third), "seats: all taken") << "it was of use once";
  EXPECT_EQ(second.session.phase(), SessionPhase::playing);
}

TEST(Tokens, OfALineThatOnlySeemedDeadEndItsOldConnectionWithAReason) {
  FullMatch scene(players_of(2));
  Player& old = scene.player(1);
  Player& restarted = scene.come(scene.with_token(old.session.token()));
  EXPECT_EQ(scene.refusal_of(old), "seat: taken over from another address");
  EXPECT_TRUE(scene.plays(restarted, kBackWithin));
  scene.pass(5 * kSecond);
  EXPECT_EQ(restarted.session.phase(), SessionPhase::playing) << "the two do not fight for it";
}

TEST(Tokens, ThatAreWrongAreCountedAndMakeANewPlayer) {
  OpenMatch scene(players_of(3));
  Player& first = scene.come();
  scene.pass(kSecond);
  scene.host().start(scene.match.now());
  ASSERT_TRUE(scene.plays(first, 2 * kSecond));
  const std::uint64_t before = scene.host().stats().refused;
  Player& second = scene.come(scene.with_token(first.session.token() ^ 1));
  EXPECT_TRUE(scene.plays(second, 4 * kSecond)) << "there was a free seat";
  EXPECT_EQ(scene.host().stats().refused, before + 1);
  EXPECT_NE(second.session.local_player(), first.session.local_player());
  Player& third = scene.come(scene.with_token(first.session.token() ^ 2));
  EXPECT_EQ(scene.refusal_of(third), "seats: all taken");
  EXPECT_EQ(first.session.phase(), SessionPhase::playing);
}

TEST(Tokens, AreComparedOnceAConnection) {
  FullMatch scene(players_of(2));
  const std::uint64_t token = scene.player(1).session.token();
  Stranger guesser(scene.match, profile(kLine));
  scene.match.run(kSecond, [&] { return guesser.listen(), guesser.is_connected; });
  const std::uint64_t before = scene.host().stats().refused;
  for (std::uint64_t n = 100; n > 0; --n) guesser.greet(hello_with(scene, token + n - 1));  // the right one at last
  scene.match.run(kSecond, [&] { return guesser.listen(), guesser.is_refused; });
  EXPECT_TRUE(guesser.is_refused);
  EXPECT_FALSE(guesser.is_welcome);
  EXPECT_GE(scene.host().stats().refused, before + 2);
  EXPECT_EQ(scene.player(1).session.phase(), SessionPhase::playing);
}

/// The connection ends after the host has given a new token and before the player has read it.
TEST(Tokens, AreGoodUntilTheNextOneHasArrived) {
  FullMatch scene(players_of(2));
  Player& first = scene.player(1);
  const std::uint64_t token = first.session.token();
  scene.crash(first);
  for (int i = 0; i < 3; ++i) {
    Stranger unlucky(scene.match, profile(kLine));
    greet(scene, unlucky, hello_with(scene, token));
    ASSERT_TRUE(unlucky.is_welcome);
    EXPECT_NE(unlucky.welcome.token, token);
    scene.match.network().cut(unlucky.id);
    scene.pass(kSecond / 10);
  }
  Player& second = scene.come(scene.with_token(token));
  EXPECT_TRUE(scene.plays(second, kBackWithin));
}

// --- reservations ---

TEST(Reservation, KeepsTheSeatOfALineThatDroppedOneSecondAgo) {
  for (const int players : {2, 4}) {
    FullMatch scene(players_of(players));
    Player& owner = scene.player(players - 1);
    const int seat = owner.session.local_player();
    scene.drop(owner);
    scene.pass(kSecond);
    ASSERT_EQ(owner.session.phase(), SessionPhase::lost);
    Player& stranger = scene.come();
    EXPECT_EQ(scene.refusal_of(stranger), "seats: reserved");
    owner.returns = true;
    const Time from = scene.match.now();
    EXPECT_TRUE(scene.plays(owner, kBackWithin));
    EXPECT_EQ(owner.session.local_player(), seat);
    std::printf("%d players: back in the match after %d ms\n", players,
                static_cast<int>((scene.match.now() - from) / 1000));
    scene.pass(kSecond);
    expect_sound_machine(owner, false);
  }
}

TEST(Reservation, LeavesOtherSeatsToOthers) {
  OpenMatch scene(players_of(4));
  Player &one = scene.come(scene.with_seat(1)), &two = scene.come(scene.with_seat(2));
  scene.pass(kSecond);
  scene.host().start(scene.match.now());
  scene.pass(3 * kSecond);
  scene.drop(one);
  scene.pass(kSecond);
  Player& stranger = scene.come();
  ASSERT_TRUE(scene.plays(stranger, 4 * kSecond));
  EXPECT_EQ(stranger.session.local_player(), 3);
  EXPECT_EQ(two.session.local_player(), 2);
  one.returns = true;
  EXPECT_TRUE(scene.plays(one, kBackWithin));
  EXPECT_EQ(one.session.local_player(), 1);
}

TEST(Reservation, EndsAfterItsTime) {
  SessionConfig config = players_of(2);
  ASSERT_EQ(config.reservation, 60 * kSecond);
  FullMatch scene(config);
  scene.drop(scene.player(1));
  const Time dropped = scene.match.now();
  scene.pass(59 * kSecond);
  EXPECT_EQ(scene.refusal_of(scene.come()), "seats: reserved");
  scene.pass(dropped + 61 * kSecond - scene.match.now());
  EXPECT_TRUE(scene.plays(scene.come(), 2 * kSecond));
}

TEST(Reservation, IsAlsoOfWhoWasCutOutOfALivingConnection) {
  SessionConfig config = players_of(2);
  config.patience = config.exclusion = kSecond;
  config.silence = 10 * kSecond;
  FullMatch scene(config);
  Player& owner = scene.player(1);
  scene.match.network().set_silent(owner.endpoint, true);
  ASSERT_TRUE(scene.match.run(3 * kSecond, [&] { return scene.match.host().heard(Kind::left, 1); }));
  EXPECT_EQ(scene.refusal_of(scene.come()), "seats: all taken");
  scene.match.network().set_silent(owner.endpoint, false);
  const auto is_back = [&] { return scene.match.host().count(Kind::joined, 1) == 2; };
  EXPECT_TRUE(scene.match.run(kBackWithin, is_back));
  EXPECT_FALSE(owner.heard(Kind::lost_host));
}

TEST(Reservation, IsNotOfWhoNeverPlayed) {
  OpenMatch scene(players_of(2));
  scene.host().start(0);
  scene.pass(kSecond);
  Stranger passing(scene.match, profile(kLine));
  greet(scene, passing, hello_with(scene, 0));
  ASSERT_TRUE(passing.is_welcome);
  EXPECT_EQ(scene.refusal_of(scene.come()), "seats: all taken");
  scene.match.network().cut(passing.id);
  scene.pass(kSecond / 10);
  EXPECT_TRUE(scene.plays(scene.come(), kBackWithin));
}

TEST(Reservation, AConnectionThatNeverPlaysKeepsASeatForHalfAMinuteAtLeast) {
  for (const Time reservation : {Time{0}, 40 * kSecond}) {
    SessionConfig config = players_of(2);
    config.reservation = reservation;
    OpenMatch scene(config);
    scene.host().start(0);
    scene.pass(kSecond);
    Stranger idle(scene.match, profile(kLine));
    greet(scene, idle, hello_with(scene, 0));
    ASSERT_TRUE(idle.is_welcome);
    const auto stay = [&](Time time) {
      scene.match.run(time, [&] {
        idle.listen();
        PacketHeader header;
        header.match = idle.welcome.match;
        header.ack_mask = 3;  // who acknowledges nothing is put out
        for (const int p : {0, 1}) header.ack[p] = idle.ends[p];
        std::uint8_t buffer[kDatagramCap];
        const Bytes bytes = PacketWriter(header, buffer).bytes();
        idle.say(Channel::datagram, {bytes.begin(), bytes.end()});
        return false;
      });
    };
    const Time kept = reservation == 0 ? 30 * kSecond : reservation;
    stay(kept - 2 * kSecond);
    Player& early = scene.come();
    stay(kSecond);
    EXPECT_EQ(scene.refusal_of(early), "seats: all taken");
    stay(2 * kSecond);
    Player& player = scene.come();
    stay(kBackWithin);
    EXPECT_EQ(player.session.phase(), SessionPhase::playing);
    EXPECT_TRUE(idle.is_refused);
    EXPECT_EQ(idle.refusal.here.view(), "not played on for too long");
  }
}

TEST(Reservation, DoesNotRunOutWhileTheHostStandsStill) {
  FullMatch scene(players_of(2));
  Player& owner = scene.player(1);
  scene.drop(owner);
  scene.pass(kSecond);
  scene.match.host().plays = false;
  scene.pass(120 * kSecond);
  scene.match.host().plays = true;
  EXPECT_EQ(scene.refusal_of(scene.come()), "seats: reserved");
  owner.returns = true;
  EXPECT_TRUE(scene.plays(owner, kBackWithin));
}

}  // namespace reservation_test
}  // namespace isostep::test
