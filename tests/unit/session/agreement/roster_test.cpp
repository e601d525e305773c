// The roster: whose token is whose, who is a majority, and what is refused of it.
// SPDX-License-Identifier: MIT
#include "isostep/session/agreement/roster.hpp"

#include <gtest/gtest.h>

#include "isostep/session/config.hpp"
#include "isostep/session/protocol/message.hpp"

namespace isostep {
namespace roster_test {

Roster of(int count) {
  Roster roster;
  roster.term = 3;
  roster.version = 5;
  roster.settings.deadline = 8;
  roster.settings.votes = true;
  roster.count = static_cast<std::uint8_t>(count);
  for (int m = 0; m < count; ++m) {
    Roster::Machine& machine = roster.machines[m];
    machine.players = 1u << m;
    machine.proof = proof_of(100 + static_cast<std::uint64_t>(m));
    machine.life = 7;
    machine.is_in = machine.was_in = true;
    machine.address.append("10.0.0.").append_number(static_cast<std::uint64_t>(m));
  }
  return roster;
}

TEST(Roster, KnowsAMachineByItsTokenAndByItsPlayer) {
  const Roster roster = of(4);
  EXPECT_EQ(roster.machine_of(102), 2);
  EXPECT_EQ(roster.machine_of(104), -1);
  EXPECT_EQ(roster.machine_of(0), -1);
  EXPECT_EQ(roster.machine_of(roster.machines[2].proof), -1) << "the proof is no token";
  EXPECT_EQ(roster.machine_with(3), 3);
  EXPECT_EQ(roster.machine_with(4), -1);
  EXPECT_EQ(roster.machine_with(-1), -1);
}

TEST(Roster, OfTwoGroupsApartAtMostOneIsAMajority) {
  for (int count = 1; count <= 6; ++count) {
    Roster roster = of(count);
    int ties = 0;
    // Whoever was in, or is: also while one roster takes the place of the other.
    for (std::uint32_t leaves = 0; leaves < 1u << count; leaves += 2) {
      for (int m = 0; m < count; ++m) roster.machines[m].is_in = (leaves >> m & 1) == 0;
      for (std::uint32_t group = 0; group < 1u << count; ++group) {
        const std::uint32_t others = ((1u << count) - 1) & ~group;
        EXPECT_FALSE(roster.is_majority(group) && roster.is_majority(others)) << count << " " << leaves << " " << group;
        ties += roster.is_majority(group) ? 1 : 0;
      }
    }
    EXPECT_GT(ties, 0);
  }
  EXPECT_FALSE(Roster{}.is_majority(~std::uint64_t{0})) << "there is none yet";
  EXPECT_TRUE(of(4).is_majority(0b0011));
  EXPECT_FALSE(of(4).is_majority(0b1100)) << "half of them, without the host";
  EXPECT_TRUE(of(4).is_majority(0b1110));
}

/// Whoever is elected by a roster is the host, and its vote casts none before a roster of its own has a majority.
TEST(Roster, AMajorityOfARosterAndOneOfTheNextHaveAMachineInCommon) {
  constexpr int kCount = 4;
  constexpr std::uint32_t kAll = (1u << kCount) - 1;
  for (std::uint32_t in = 1; in <= kAll; ++in) {
    for (std::uint32_t now_in = 1; now_in <= kAll; ++now_in) {
      for (std::uint8_t maker = 0; maker < kCount; ++maker) {
        Roster first = of(kCount), next = of(kCount);
        first.casting = first.was_casting = first.host = 1;
        next.casting = next.host = maker;
        next.was_casting = first.casting;
        for (int m = 0; m < kCount; ++m) {
          first.machines[m].is_in = first.machines[m].was_in = next.machines[m].was_in = (in >> m & 1) != 0;
          next.machines[m].is_in = (now_in >> m & 1) != 0;
        }
        Roster elected = first;
        elected.host = maker;
        for (std::uint32_t group = 0; group <= kAll; ++group) {
          const std::uint32_t others = kAll & ~group;
          EXPECT_FALSE(first.is_majority(group) && elected.is_majority(others)) << in << " " << group;
          EXPECT_FALSE(first.is_majority(group) && next.is_majority(others)) << in << " " << now_in << " " << group;
        }
      }
    }
  }
}

TEST(Roster, ArrivesAsItWasSent) {
  const Roster roster = of(9 < kMaxPlayers + 1 ? 9 : 8);
  std::vector<std::uint8_t> bytes;
  write_roster(roster, bytes);
  const Result<Roster> read = read_roster(bytes);
  ASSERT_FALSE(!read);
  EXPECT_EQ(read.value().version, 5u);
  EXPECT_EQ(read.value().term, 3u);
  EXPECT_EQ(read.value().settings, roster.settings);
  EXPECT_EQ(read.value().machines[3].life, 7u);
  EXPECT_EQ(read.value().count, roster.count);
  EXPECT_EQ(read.value().machines[3].proof, roster.machines[3].proof);
  EXPECT_EQ(read.value().machines[3].address.view(), "10.0.0.3");
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_FALSE(read_roster(Bytes(bytes.data(), size)).ok()) << size;
  }
  bytes.push_back(0);
  EXPECT_FALSE(read_roster(bytes).ok());
}

TEST(Roster, IsSealedForEachOfWhoseTokenTheHostKnows) {
  Roster roster = of(3);
  std::vector<std::uint8_t> scratch, bytes;
  for (std::uint64_t m = 0; m < 3; ++m) roster.machines[m].seal = seal_of(roster, 100 + m, scratch);
  write_roster(roster, bytes);
  const Roster read = read_roster(bytes).value();
  for (std::uint64_t m = 0; m < 3; ++m) EXPECT_TRUE(is_sealed_for(read, 100 + m, scratch));
  EXPECT_FALSE(is_sealed_for(read, 103, scratch)) << "of whom it does not tell";
  EXPECT_FALSE(is_sealed_for(read, 0, scratch));
  const auto holds = [&](auto change) {
    Roster changed = read;
    change(changed);
    return is_sealed_for(changed, 101, scratch);
  };
  EXPECT_TRUE(holds([](Roster&) {}));
  EXPECT_FALSE(holds([](Roster& r) { ++r.version; }));
  EXPECT_FALSE(holds([](Roster& r) { ++r.term; }));
  EXPECT_FALSE(holds([](Roster& r) { r.settings.asks_admission = true; }));
  EXPECT_FALSE(holds([](Roster& r) { ++r.machines[2].life; }));
  EXPECT_FALSE(holds([](Roster& r) { --r.count; }));
  EXPECT_FALSE(holds([](Roster& r) { r.machines[2].address = "10.0.0.9"; }));
  EXPECT_FALSE(holds([](Roster& r) { r.machines[2].is_in = false; }));
  EXPECT_FALSE(holds([](Roster& r) { r.machines[2].proof ^= 1; }));
  EXPECT_FALSE(holds([](Roster& r) { r.machines[1].seal = 0; }));
  EXPECT_TRUE(holds([](Roster& r) { r.machines[2].seal = 0; })) << "another's is the other's affair";
}

TEST(Roster, ThatCannotBeIsRefused) {
  const auto reads = [](auto change) {
    Roster roster = of(3);
    change(roster);
    std::vector<std::uint8_t> bytes;
    write_roster(roster, bytes);
    return read_roster(bytes).ok();
  };
  EXPECT_TRUE(reads([](Roster&) {}));
  EXPECT_FALSE(reads([](Roster& r) { r.version = 0; }));
  EXPECT_FALSE(reads([](Roster& r) { r.term = 0; }));
  EXPECT_FALSE(reads([](Roster& r) { r.settings.deadline = kMostDeadline + 1; }));
  EXPECT_FALSE(reads([](Roster& r) { r.host = 3; }));
  EXPECT_FALSE(reads([](Roster& r) { r.casting = 3; }));
  EXPECT_FALSE(reads([](Roster& r) { r.was_casting = 3; }));
  EXPECT_TRUE(reads([](Roster& r) { r.was_casting = Roster::kNoCasting; }));
  EXPECT_FALSE(reads([](Roster& r) { r.machines[1].players = 1; })) << "a player twice";
  EXPECT_FALSE(reads([](Roster& r) { r.machines[1].address = Address("a\nb"); }));
}

TEST(Roster, NamesPlayersOfTheMatchAlone) {
  Roster roster = of(3);
  EXPECT_TRUE(roster.is_of(3));
  EXPECT_FALSE(roster.is_of(2));
  roster.machines[1].players = 1u << 31;
  EXPECT_FALSE(roster.is_of(31));
  EXPECT_TRUE(roster.is_of(32));
}

TEST(Roster, MessagesOfACandidateAreChecked) {
  Candidate candidate;
  candidate.version = 7;
  candidate.ends[1] = 50;
  std::vector<std::uint8_t> bytes;
  write_candidate(candidate, bytes);
  ASSERT_TRUE(read_candidate(bytes).ok());
  EXPECT_EQ(read_candidate(bytes).value().ends[1], 50);
  candidate.ends[1] = -1;
  write_candidate(candidate, bytes);
  EXPECT_FALSE(read_candidate(bytes).ok());
  write_redirect(Address("host:1"), bytes);
  EXPECT_EQ(read_redirect(bytes).value().view(), "host:1");
  bytes.back() = 7;
  EXPECT_FALSE(read_redirect(bytes).ok());
  Support support;
  support.term = 9;
  support.ends[2] = 70;
  write_support(support, bytes);
  EXPECT_EQ(read_support(bytes).value().term, 9u);
  EXPECT_EQ(read_support(bytes).value().ends[2], 70);
  support.ends[2] = -1;
  write_support(support, bytes);
  EXPECT_FALSE(read_support(bytes).ok());
  write_enrolled(9, bytes);
  EXPECT_EQ(read_enrolled(bytes).value(), 9u);
  bytes.pop_back();
  EXPECT_FALSE(read_enrolled(bytes).ok());
  EXPECT_FALSE(read_known(bytes).ok());
}

}  // namespace roster_test
}  // namespace isostep
