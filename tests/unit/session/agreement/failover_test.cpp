// Tenure and Election without a network: who hosts, in which term, what is final, and who steps down.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "isostep/session/agreement/election.hpp"
#include "isostep/session/agreement/tenure.hpp"
#include "isostep/session/client/host_search.hpp"

namespace isostep {
namespace failover_test {

using Duty = Tenure::Duty;
using Step = Election::Step;
constexpr Time kPatience = kSecond;
constexpr Time kTurn = 10000;  // [us]

Roster of(int count) {
  Roster roster;
  roster.term = roster.version = 1;
  roster.count = static_cast<std::uint8_t>(count);
  for (int m = 0; m < count; ++m) {
    Roster::Machine& machine = roster.machines[m];
    machine.players = 1u << m;
    machine.proof = proof_of(100 + static_cast<std::uint64_t>(m));
    machine.life = 10 + static_cast<std::uint64_t>(m);
    machine.is_in = machine.was_in = true;
    machine.address.append_number(static_cast<std::uint64_t>(m));
  }
  return roster;
}

TEST(Roster, HasNoVoteForAProcessThatRemembersNothing) {
  const Roster roster = of(3);
  EXPECT_EQ(roster.voter_of(101, 11), 1);
  EXPECT_EQ(roster.voter_of(101, 0), -1) << "it has started again";
  EXPECT_EQ(roster.voter_of(101, 12), -1) << "another's life";
  EXPECT_EQ(roster.machine_of(101), 1);
}

TEST(Roster, AQuorumIsAMajorityOrAllWhoRemember) {
  const Roster roster = of(5);
  EXPECT_TRUE(roster.is_quorum(0b01110, 0));
  EXPECT_FALSE(roster.is_quorum(0b00011, 0b00100)) << "two who may know of another host are not here";
  EXPECT_TRUE(roster.is_quorum(0b00011, 0b11100));
  EXPECT_FALSE(roster.is_quorum(0, 0b11111)) << "nobody is left";
}

/// A host among others who hear it as long as the test says.
struct Hosted {
  explicit Hosted(int count) : roster(of(count)) { tenure.begin(1, kPatience, 0, 0, now); }
  Duty turn(std::uint32_t hears, Frame own_end, Time time = kTurn) {
    now += time;
    for (int m = 1; m < roster.count; ++m) {
      if ((hears >> m & 1) != 0) followers[m].heard = now;
    }
    return tenure.turn(roster, {followers, roster.count}, own_end, now);
  }
  Roster roster;
  Tenure tenure;
  Follower followers[kMaxPlayers + 1];
  Time now = kSecond;
};

TEST(Tenure, WhatAMajorityHasIsFinalAndNothingElse) {
  Hosted host(5);
  host.followers[1].has = 40;
  host.followers[2].has = 30;
  host.followers[3].has = 10;
  EXPECT_EQ(host.turn(0b11110, 50), Duty::serves);
  EXPECT_EQ(host.tenure.final_end(), 30) << "the host and two of four others have it";
  host.followers[3].has = 45;
  host.followers[2].has = 50;
  host.turn(0b11110, 50);
  EXPECT_EQ(host.tenure.final_end(), 45);
  host.followers[3].has = 0;
  host.turn(0b11110, 60);
  EXPECT_EQ(host.tenure.final_end(), 45) << "once final, for ever";
}

TEST(Tenure, OfAHostThatFollowsAnotherWhatWasBeforeCountsWithWhatItTookOver) {
  Hosted host(3);
  host.tenure.begin(2, kPatience, 100, 20, host.now);
  host.followers[1].has = host.followers[2].has = 99;
  host.turn(0b110, 120);
  EXPECT_EQ(host.tenure.final_end(), 20);
  host.followers[2].has = 100;
  host.turn(0b110, 120);
  EXPECT_EQ(host.tenure.final_end(), 100);
}

TEST(Tenure, LeasesEndBeforeTheOthersPatience) {
  Hosted host(3);
  EXPECT_LT(host.tenure.lease(), kPatience);
  ASSERT_EQ(host.turn(0b110, 10), Duty::serves);
  host.followers[1].has = host.followers[2].has = 10;
  const Time heard = host.now;
  while (host.now - heard <= host.tenure.lease() - kTurn) ASSERT_EQ(host.turn(0, 20), Duty::serves);
  host.turn(0, 20);
  EXPECT_EQ(host.turn(0, 20), Duty::stands);
  EXPECT_FALSE(host.tenure.is_backed());
  EXPECT_LT(host.now - heard, kPatience);
  host.followers[1].has = host.followers[2].has = 20;
  host.turn(0, 20);
  EXPECT_EQ(host.tenure.final_end(), 10) << "not without a lease";
  Duty duty = Duty::stands;
  while (duty == Duty::stands) duty = host.turn(0, 20);
  EXPECT_EQ(duty, Duty::steps_down);
  EXPECT_LE(host.now - heard, 3 * kPatience);
}

TEST(Tenure, WhoSleptLongerThanItsLeaseStepsDownWhateverItHearsThen) {
  Hosted host(4);
  ASSERT_EQ(host.turn(0b1110, 10), Duty::serves);
  EXPECT_EQ(host.turn(0b1110, 10, host.tenure.lease()), Duty::serves);
  EXPECT_EQ(host.turn(0b1110, 10, host.tenure.lease() + 1), Duty::steps_down);
  Hosted two(2);
  ASSERT_EQ(two.turn(0b10, 10), Duty::serves);
  EXPECT_EQ(two.turn(0, 10, 60 * kSecond), Duty::serves) << "the other alone is no majority";
}

TEST(Tenure, HalfAndTheHostSuffice) {
  Hosted host(4);
  ASSERT_EQ(host.turn(0b1110, 10), Duty::serves);
  for (int n = 0; n < 500; ++n) ASSERT_EQ(host.turn(0b0010, 10), Duty::serves);
}

TEST(Tenure, WhenNobodyElseRemembersTheRestIsTheMatch) {
  Hosted host(3);
  ASSERT_EQ(host.turn(0b110, 10), Duty::serves);
  host.followers[1].heard = host.followers[2].heard = 0;
  host.followers[1].is_over = true;
  EXPECT_EQ(host.turn(0, 10), Duty::stands) << "the other may have been its voter";
  host.followers[2].is_over = true;
  EXPECT_EQ(host.turn(0, 10), Duty::reforms);
}

TEST(Tenure, ARosterIsReplacedOnceAMajorityHasItAndAllThatIsFinal) {
  Hosted host(3);
  host.followers[1].has = 30;
  host.followers[2].has = 10;
  ASSERT_EQ(host.turn(0b110, 30), Duty::serves);
  ASSERT_EQ(host.tenure.final_end(), 30);
  const auto may = [&](std::uint64_t enrolled) {
    return host.tenure.may_go_on_to_next(host.roster, enrolled, {host.followers, 3});
  };
  EXPECT_TRUE(may(0b011));
  EXPECT_FALSE(may(0b101)) << "what the first has as final, the second does not have";
  EXPECT_FALSE(may(0b001));
}

/// Machines that have lost their host, and hear each other at once where `reaches` says so.
struct Seekers {
  explicit Seekers(int count) : roster(of(count)), elections(static_cast<std::size_t>(count)) {
    for (Election& election : elections) {
      election.follow(1);
      election.has_log_of(1);
    }
  }
  bool turn(int machine) {
    Election& election = elections[static_cast<std::size_t>(machine)];
    const Step step = election.turn(roster, machine, true, now);
    if (step == Step::calls) {
      Candidate candidate;
      candidate.term = election.term();
      candidate.log_term = election.log_term();
      for (int m = 0; m < roster.count; ++m) {
        const bool comes = m != machine && (visitors[machine] >> m & 1) != 0;
        if (comes && elections[static_cast<std::size_t>(m)].give_support(candidate)) {
          election.supported(m, candidate.term);
        }
      }
    }
    return step == Step::wins;
  }
  void come(int from, int to) {
    elections[static_cast<std::size_t>(to)].came(from);
    visitors[to] |= 1u << from;
  }
  Roster roster;
  std::vector<Election> elections;
  std::uint32_t visitors[8] = {};
  Time now = kSecond;
};

TEST(Election, ToWhomAMajorityComesIsTheHostOfALaterTerm) {
  Seekers seekers(4);
  for (Election& election : seekers.elections) election.begin(seekers.now, false);
  EXPECT_EQ(seekers.elections[1].target(seekers.roster, 1), 1);
  EXPECT_EQ(seekers.elections[3].target(seekers.roster, 3), 1) << "all ask the same first";
  seekers.come(2, 1);
  EXPECT_FALSE(seekers.turn(1)) << "half, without the host";
  seekers.come(3, 1);
  bool wins = false;
  for (; !wins && seekers.now < 3 * kSecond; seekers.now += kTurn) wins = seekers.turn(1);
  EXPECT_TRUE(wins);
  EXPECT_EQ(seekers.elections[1].term(), 2u);
  EXPECT_FALSE(seekers.elections[2].may_follow(1)) << "the host of before is none any more";
}

TEST(Election, OfTwoWhoCallInOneTermOneWins) {
  Seekers seekers(5);
  for (Election& election : seekers.elections) election.begin(seekers.now, false);
  // Machine 4 has come to both: the one does not know yet that it has gone.
  for (const int m : {3, 4}) seekers.come(m, 1);
  for (const int m : {0, 4}) seekers.come(m, 2);
  int wins = 0;
  for (; seekers.now < kSecond + kSecond * 9 / 10; seekers.now += kTurn) {
    wins += seekers.turn(1) ? 1 : 0;
    if (seekers.turn(2)) wins += 100;
  }
  EXPECT_GT(wins, 0);
  EXPECT_TRUE(wins < 100 || wins % 100 == 0) << "not both";
}

TEST(Election, AProcessWithoutMemoryDoesNotVoteButMissesNobodyEither) {
  Seekers seekers(3);
  Election& election = seekers.elections[1];
  election.begin(seekers.now, false);
  election.is_over(0);
  EXPECT_EQ(election.turn(seekers.roster, 1, true, seekers.now), Step::waits);
  election.is_over(2);  // all others have started again: nobody else knows anything
  Step step = election.turn(seekers.roster, 1, true, seekers.now);
  for (int n = 0; n < 100 && step != Step::calls; ++n) {
    seekers.now += kTurn;
    step = election.turn(seekers.roster, 1, true, seekers.now);
  }
  EXPECT_EQ(step, Step::calls);
  EXPECT_EQ(election.turn(seekers.roster, 1, true, seekers.now), Step::wins);
  EXPECT_FALSE(election.has_majority(seekers.roster)) << "so the match is formed anew of it";
}

TEST(Election, SupportsOneInATermAndNobodyWithAnOlderLog) {
  Election voter;
  voter.follow(3);
  voter.has_log_of(3);
  Candidate candidate;
  candidate.term = 4;
  candidate.log_term = 2;
  EXPECT_FALSE(voter.give_support(candidate));
  candidate.log_term = 3;
  EXPECT_TRUE(voter.give_support(candidate));
  EXPECT_FALSE(voter.give_support(candidate)) << "another of the same term";
  candidate.term = 3;
  EXPECT_FALSE(voter.give_support(candidate));
  EXPECT_FALSE(voter.may_follow(3));
  EXPECT_TRUE(voter.may_follow(4));
}

TEST(Election, WhoSupportsAnotherCallsNoMore) {
  Seekers seekers(5);
  Election& election = seekers.elections[1];
  election.begin(seekers.now, false);
  for (const int m : {2, 3}) seekers.come(m, 1);
  Step step = Step::waits;
  for (int n = 0; n < 100 && step != Step::calls; ++n) {
    seekers.now += kTurn;
    step = election.turn(seekers.roster, 1, true, seekers.now);
  }
  ASSERT_EQ(step, Step::calls);
  const std::uint32_t called = election.term();
  Candidate other;
  other.term = called + 1;
  other.log_term = election.log_term();
  ASSERT_TRUE(election.give_support(other));
  EXPECT_FALSE(election.has_called());
  for (const int m : {2, 3}) election.supported(m, called);
  EXPECT_NE(election.turn(seekers.roster, 1, true, seekers.now), Step::wins) << "as the host of another's term";
}

TEST(Election, NobodyUsesTheTermsUp) {
  Election voter;
  voter.follow(3);
  Candidate candidate;
  candidate.term = 0xffffffffu;
  EXPECT_FALSE(voter.give_support(candidate));
  EXPECT_FALSE(voter.may_follow(candidate.term));
  candidate.term = 3 + (1u << 16);
  EXPECT_TRUE(voter.give_support(candidate)) << "a voter that was away for long";
  EXPECT_FALSE(Election().may_follow(0xffffffffu)) << "of nobody";

  Seekers seekers(4);
  Election& election = seekers.elections[1];
  election.begin(seekers.now, false);
  election.hear_term(0xffffffffu);
  for (const int m : {2, 3}) seekers.come(m, 1);
  for (int n = 0; n < 100 && !election.has_called(); ++n) {
    seekers.now += kTurn;
    election.turn(seekers.roster, 1, true, seekers.now);
  }
  EXPECT_EQ(election.term(), 2u);
}

TEST(HostSearch, ARosterThatComesLaterTakesTheVictoryBack) {
  Welcome welcome;
  welcome.token = 101;
  welcome.life = 11;
  welcome.term = 1;
  HostSearch search(0);
  search.is_welcome(welcome);
  Roster roster = of(3);
  ASSERT_TRUE(search.take_newer(roster));
  search.begin(kSecond, false);
  search.election().is_over(0);
  search.election().is_over(2);
  Time now = kSecond;
  while (!search.is_elected() && now < 5 * kSecond) search.turn(true, now += kTurn);
  ASSERT_TRUE(search.is_elected());
  ++roster.version;
  ASSERT_TRUE(search.take_newer(roster));
  EXPECT_FALSE(search.is_elected()) << "its supporters were counted by other places";
}

TEST(Election, AsksAroundUntilNobodyIsLeftAndStillCountsWhoComes) {
  Seekers seekers(3);
  Election& election = seekers.elections[2];
  election.begin(seekers.now, true);
  EXPECT_EQ(election.target(seekers.roster, 2), 0) << "the host first, which spoke until the connection ended";
  int asked = 0;
  Step step = Step::waits;
  for (; step != Step::gives_up && seekers.now < 30 * kSecond; seekers.now += kTurn) {
    step = election.turn(seekers.roster, 2, true, seekers.now);
    asked += step == Step::goes_on ? 1 : 0;
  }
  EXPECT_EQ(step, Step::gives_up);
  EXPECT_GE(asked, 5);
  election.came(1);
  step = Step::waits;
  for (int n = 0; n < 100 && step != Step::calls; ++n, seekers.now += kTurn) {
    step = election.turn(seekers.roster, 2, true, seekers.now);
  }
  EXPECT_EQ(step, Step::calls);
}

TEST(Election, GoesOnWithThoseWhoAreHereWhenTheGameSaysSo) {
  Seekers seekers(5);
  Election& election = seekers.elections[1];
  election.begin(seekers.now, false);
  seekers.come(2, 1);
  EXPECT_EQ(election.turn(seekers.roster, 1, true, seekers.now), Step::waits);
  election.force();
  bool wins = false;
  for (; !wins && seekers.now < 3 * kSecond; seekers.now += kTurn) wins = seekers.turn(1);
  EXPECT_TRUE(wins);
  EXPECT_EQ(election.supporters(), 0b110u);
}

}  // namespace failover_test
}  // namespace isostep
