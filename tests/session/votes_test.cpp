// Players vote: all hear how it stands, what passes is done, and nobody is kicked without a majority.
// SPDX-License-Identifier: MIT
#include "session/pace_watch.hpp"

namespace isostep::test {
namespace votes_test {

using Kind = SessionEvent::Kind;
using Wish = Proposal::Kind;
constexpr const char* kGoodLine = "latency=30,jitter=5,loss=0.5";

/// One player at the host, two on machine 1, one on machine 2, one on machine 3: with the seats 0, 1 and 2, 3, 4.
struct VotingMatch : VirtualMatch<Toy> {
  explicit VotingMatch(bool votes = true, Time migration = 0) : VirtualMatch(config_for(votes, migration), make, say) {
    for (const int seats : {2, 1, 1}) {
      SessionConfig config = config_for(votes, migration);
      config.local_players = seats;
      add(profile(kGoodLine), config);
      pass(kSecond / 5);
    }
    pass(6 * kSecond);
  }
  static SessionConfig config_for(bool votes, Time migration) {
    SessionConfig config = config_of(5, SessionMode::rollback);
    config.votes = votes;
    config.migration = migration;
    return config;
  }
  static std::unique_ptr<Toy> make() { return std::make_unique<Toy>(); }
  static ToyInput say(int player, Frame frame) { return toy_input(3, player, frame); }
  void pass(Time time) {
    run(time, [] { return false; });
  }
  int heard_by(Kind kind) const {
    int machines = 0;
    for (std::size_t i = 0; i < 4; ++i) machines += const_cast<VotingMatch*>(this)->machine(i).heard(kind) ? 1 : 0;
    return machines;
  }
};

TEST(Votes, WhatMoreThanHalfAreForIsDone) {
  VotingMatch match;
  EXPECT_TRUE(match.machine(1).session.propose(2, {Wish::pause, 0}));
  match.pass(kSecond);
  EXPECT_EQ(match.heard_by(Kind::vote), 4);
  EXPECT_EQ(match.machine(3).last(Kind::vote).ballot.by, 2);
  EXPECT_EQ(match.machine(3).last(Kind::vote).ballot.voters, 0b11111u);
  EXPECT_TRUE(match.machine(2).session.vote(3, true));
  EXPECT_FALSE(match.machine(2).session.vote(4, true)) << "another's";
  match.pass(kSecond);
  EXPECT_EQ(match.heard_by(Kind::vote_passed), 0) << "two of five";
  EXPECT_TRUE(match.host().session.vote(0, true));
  match.pass(kSecond);
  EXPECT_EQ(match.heard_by(Kind::vote_passed), 4);
  EXPECT_EQ(match.heard_by(Kind::paused), 4);
  EXPECT_EQ(match.host().last(Kind::paused).player, 2);
  EXPECT_TRUE(match.host().session.propose(0, {Wish::speed, 12}));
  match.pass(kSecond);
  for (const int p : {1, 2}) EXPECT_TRUE(match.machine(1).session.vote(p, true));
  match.pass(kSecond);
  EXPECT_EQ(match.host().count(Kind::vote_passed), 2) << "both players of one machine at once";
  match.host().session.unpause();
  match.pass(2 * kSecond);
  EXPECT_EQ(match.machine(3).last(Kind::speed_changed).speed, 12);
  expect_one_history(match);
}

TEST(Votes, AKickTakesMoreThanHalfOfTheOthers) {
  VotingMatch match;
  EXPECT_FALSE(match.host().session.propose(0, {Wish::kick, 0})) << "the host's own";
  EXPECT_TRUE(match.host().session.propose(0, {Wish::kick, 3}));
  match.pass(kSecond);
  EXPECT_EQ(match.machine(2).last(Kind::vote).ballot.voters, 0b10111u) << "nobody judges itself";
  EXPECT_FALSE(match.machine(2).session.vote(3, false));
  EXPECT_TRUE(match.machine(1).session.vote(1, true));
  EXPECT_TRUE(match.machine(1).session.vote(2, false));
  match.pass(kSecond);
  EXPECT_EQ(match.machine(1).last(Kind::vote).ballot.no, 0b00100u);
  EXPECT_TRUE(match.machine(1).session.vote(2, true));  // the last word counts
  match.pass(kSecond);
  EXPECT_EQ(match.heard_by(Kind::vote_passed), 3) << "all who are left";
  match.pass(kSecond);
  EXPECT_EQ(match.machine(2).session.phase(), SessionPhase::refused);
  EXPECT_EQ(match.machine(2).last(Kind::refused).field.here.view(), "voted out");
  EXPECT_FALSE(match.host().played(match.host().end() - 1, 3));
}

TEST(Votes, HalfAgainstItOrTwentySecondsEndIt) {
  VotingMatch match;
  EXPECT_TRUE(match.machine(3).session.propose(4, {Wish::other, 77}));
  match.pass(kSecond);
  EXPECT_EQ(match.host().last(Kind::vote).ballot.proposal.subject, 77u);
  EXPECT_FALSE(match.host().session.propose(0, {Wish::pause, 0})) << "one at a time";
  for (const int p : {1, 2}) EXPECT_TRUE(match.machine(1).session.vote(p, false));
  EXPECT_TRUE(match.host().session.vote(0, false));
  match.pass(kSecond);
  EXPECT_EQ(match.heard_by(Kind::vote_failed), 4);
  const std::uint64_t refused = match.host().session.stats().refused;
  EXPECT_TRUE(match.machine(3).session.propose(4, {Wish::other, 78}));
  match.pass(kSecond);
  EXPECT_EQ(match.host().session.stats().refused, refused + 1) << "not again within half a minute";
  EXPECT_TRUE(match.host().session.propose(0, {Wish::pause, 0}));
  match.pass(19 * kSecond);
  EXPECT_EQ(match.host().count(Kind::vote_failed), 1);
  match.pass(2 * kSecond);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(match.machine(i).count(Kind::vote_failed), 2) << i;
  EXPECT_EQ(match.heard_by(Kind::paused), 0);
  match.pass(30 * kSecond);
  EXPECT_TRUE(match.machine(3).session.propose(4, {Wish::pause, 0}));
  match.pass(kSecond);
  EXPECT_EQ(match.host().session.stats().refused, refused + 1);
  expect_one_history(match);
}

TEST(Votes, WhoLeavesDoesNotCountAndALateOneHears) {
  VotingMatch match;
  EXPECT_TRUE(match.machine(2).session.propose(3, {Wish::pause, 0}));
  match.pass(kSecond);
  EXPECT_TRUE(match.host().session.vote(0, true));
  match.network().cut(match.machine(1).endpoint);  // two of the three who have said nothing
  match.pass(kSecond);
  EXPECT_TRUE(match.host().heard(Kind::vote_passed)) << "two of three";
  EXPECT_EQ(match.machine(1).count(Kind::vote_failed), 0);
  match.network().connect(match.machine(1).endpoint);
  match.pass(kSecond);
  EXPECT_EQ(match.machine(1).count(Kind::vote_failed), 1) << "to it, the vote ended with the connection";
}

TEST(Votes, WhoChangesItsMindAgainAndAgainIsHeardFourTimesASecond) {
  VotingMatch match;
  EXPECT_TRUE(match.host().session.propose(0, {Wish::pause, 0}));
  match.pass(kSecond);
  for (int n = 0; n < 200; ++n) {
    EXPECT_TRUE(match.machine(3).session.vote(4, n % 2 == 0));
    match.pass(10000);
  }
  EXPECT_GT(match.host().count(Kind::vote), 100);
  EXPECT_LE(match.machine(2).count(Kind::vote), 12);
}

TEST(Votes, AreOnlyWhereTheHostHasThem) {
  VotingMatch match(false);
  EXPECT_FALSE(match.host().session.propose(0, {Wish::pause, 0}));
  EXPECT_TRUE(match.machine(1).session.propose(1, {Wish::pause, 0}));
  EXPECT_FALSE(match.machine(1).session.propose(1, {Wish::speed, 3})) << "no speed";
  EXPECT_FALSE(match.machine(1).session.propose(1, {Wish::kick, 32})) << "no player";
  match.pass(kSecond);
  EXPECT_EQ(match.heard_by(Kind::vote), 0);
  EXPECT_EQ(match.host().session.stats().refused, 1u);
  EXPECT_FALSE(match.machine(1).session.vote(1, true));
}

TEST(Votes, OfPlayersWhoAreNobodyAreFalse) {
  VotingMatch match;
  ASSERT_TRUE(match.host().session.propose(0, {Wish::pause, 0}));
  match.pass(kSecond);
  for (const int nobody : {-1, 5, 31, 32, 1 << 30}) {
    for (const std::size_t i : {0, 1}) {
      EXPECT_FALSE(match.machine(i).session.vote(nobody, true)) << nobody;
      EXPECT_FALSE(match.machine(i).session.propose(nobody, {Wish::pause, 0})) << nobody;
    }
  }
}

TEST(Votes, EndWithTheHostThatCounted) {
  VotingMatch match(true, kSecond);
  EXPECT_TRUE(match.machine(3).session.propose(4, {Wish::pause, 0}));
  match.pass(kSecond);
  match.host().plays = false;
  match.network().set_silent(match.host().endpoint, true);
  match.pass(5 * kSecond);
  for (std::size_t i = 1; i < 4; ++i) EXPECT_EQ(match.machine(i).count(Kind::vote_failed), 1) << i;
  EXPECT_TRUE(match.machine(3).session.propose(4, {Wish::pause, 0}));
  match.pass(kSecond);
  for (std::size_t i = 1; i < 4; ++i) EXPECT_EQ(match.machine(i).count(Kind::vote), 2) << i;
  for (const int p : {1, 2}) EXPECT_TRUE(match.machine(1).session.vote(p, true));
  match.pass(2 * kSecond);
  for (std::size_t i = 1; i < 4; ++i) EXPECT_TRUE(match.machine(i).heard(Kind::paused)) << i;
}

TEST(Votes, DamagedWordsAreRefused) {
  std::vector<std::uint8_t> bytes;
  const auto cut_is_refused = [&](const auto& read) {
    EXPECT_TRUE(read(Bytes(bytes)).ok());
    for (std::size_t size = 0; size < bytes.size(); ++size) EXPECT_FALSE(read(Bytes(bytes).first(size)).ok()) << size;
    bytes.push_back(0);
    EXPECT_FALSE(read(Bytes(bytes)).ok());
  };
  write_proposal({31, {Wish::kick, 31}}, bytes);
  cut_is_refused(read_proposal);
  write_votes({1, 5, 2}, bytes);
  cut_is_refused(read_votes);
  write_ballot({.number = 1, .voters = 3, .yes = 1, .no = 2, .outcome = Ballot::Outcome::failed}, bytes);
  cut_is_refused(read_ballot);
  write_proposal({32, {Wish::pause, 0}}, bytes);
  EXPECT_FALSE(read_proposal(bytes).ok());
  for (const Proposal& proposal :
       {Proposal{Wish::kick, 32}, Proposal{Wish::speed, 17}, Proposal{Wish::speed, 264}, Proposal{Wish::pause, 1},
        Proposal{static_cast<Wish>(0), 0}, Proposal{static_cast<Wish>(6), 0}}) {
    write_proposal({0, proposal}, bytes);
    EXPECT_FALSE(read_proposal(bytes).ok()) << static_cast<int>(proposal.kind);
  }
  write_votes({1, 1, 1}, bytes);
  EXPECT_FALSE(read_votes(bytes).ok());
  write_ballot({.number = 0}, bytes);
  EXPECT_FALSE(read_ballot(bytes).ok());
  write_ballot({.number = 1, .yes = 1, .no = 1}, bytes);
  EXPECT_FALSE(read_ballot(bytes).ok());
  write_ballot({.number = 1, .outcome = static_cast<Ballot::Outcome>(3)}, bytes);
  EXPECT_FALSE(read_ballot(bytes).ok());
}

}  // namespace votes_test
}  // namespace isostep::test
