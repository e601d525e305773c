// CommandJournal over a toy engine: what a command returns and leaves behind, accepted or refused.
// SPDX-License-Identifier: MIT
#include "isostep/state/command_journal.hpp"

#include <gtest/gtest.h>

#include <variant>
#include <vector>

#include "determinism/hostile_environment.hpp"

namespace isostep {
namespace {

struct Add {
  std::uint32_t number;
  ISO_FIELDS(number)
};
struct Take {
  template <class Visitor, class Self> static constexpr void fields(Visitor&&, Self&&) {}
};

/// A sum. Add returns it, 0 where it was refused.
struct Counter {
  using Command = std::variant<Take, Add>;
  CommandJournal journal;
  std::uint32_t sum = 0, deviations = 0;

  std::uint32_t execute(const Add& add) {
    deviations = probe_environment_here();
    return journal.accept({add.number > 0 ? Fault::none : Fault::out_of_range, "", "number", "1 or more"})
               ? sum += add.number
               : 0;
  }
  bool execute(const Take&) {
    if (sum == 0) return journal.refuse(Fault::bad_argument);
    --sum;
    return true;
  }
  std::uint64_t hash() const { return sum; }
};

using Bytes8 = std::vector<std::uint8_t>;

TEST(CommandJournal, AnAcceptedCommandReturnsWhatItMadeAndIsRecorded) {
  Counter counter;
  Bytes8 log;
  counter.journal.record_to(&log);
  EXPECT_TRUE(counter.journal.records_to(&log));
  EXPECT_EQ(counter.journal.run("add", counter, Add{5}), 5u);
  counter.journal.record_step();
  EXPECT_TRUE(counter.journal.run("take", counter, Take{}));
  EXPECT_EQ(log, (Bytes8{1, 5, 0, 0, 0, kStepMarker, 0}));
  counter.journal.record_to(nullptr);
  EXPECT_EQ(counter.journal.run("add", counter, Add{5}), 9u);
  counter.journal.record_step();
  EXPECT_EQ(log.size(), 7u);
}

TEST(CommandJournal, ARefusedCommandReturnsNothingAndIsNamedButNotRecorded) {
  Counter counter;
  Bytes8 log;
  counter.journal.record_to(&log);
  EXPECT_EQ(counter.journal.run("add", counter, Add{0}), 0u);
  const FaultReport& fault = counter.journal.fault();
  EXPECT_EQ(fault, Fault::out_of_range);
  EXPECT_STREQ(fault.command, "add");
  EXPECT_STREQ(fault.field, "number");
  EXPECT_STREQ(fault.expected, "1 or more");
  EXPECT_TRUE(log.empty());
}

TEST(CommandJournal, CommandsClearTheLastFaultAndTheFirstStaysUntilItIsForgotten) {
  Counter counter;
  CommandJournal& journal = counter.journal;
  EXPECT_FALSE(journal.run("take", counter, Take{}));
  EXPECT_EQ(journal.run("add", counter, Add{0}), 0u);
  EXPECT_STREQ(journal.fault().command, "add");
  EXPECT_STREQ(journal.first_fault().command, "take");
  journal.run("add", counter, Add{1});
  EXPECT_EQ(journal.fault(), Fault::none);
  EXPECT_EQ(journal.first_fault(), Fault::bad_argument);
  journal.forget_faults();
  EXPECT_EQ(journal.first_fault(), Fault::none);
}

TEST(CommandJournal, OtherCallsLeaveTheFaultWhereTheyAreAccepted) {
  CommandJournal journal;
  EXPECT_FALSE(journal.accept_call("ask", {Fault::not_finite, "", "point", "a finite number"}));
  EXPECT_TRUE(journal.accept_call("ask again", {}));
  EXPECT_STREQ(journal.fault().command, "ask");
  EXPECT_STREQ(journal.first_fault().command, "ask");
}

TEST(CommandJournal, ACallInsideAnotherIsRefused) {
  Counter counter;
  Bytes8 log;
  counter.journal.record_to(&log);
  {
    const CommandJournal::Call step(counter.journal, "step");
    EXPECT_TRUE(step.allowed());
    EXPECT_EQ(counter.journal.run("add", counter, Add{5}), 0u);
    EXPECT_EQ(counter.journal.fault(), Fault::called_in_step);
    EXPECT_STREQ(counter.journal.fault().command, "add");
    const CommandJournal::Call load(counter.journal, "load");
    EXPECT_FALSE(load.allowed());
    EXPECT_STREQ(counter.journal.fault().command, "load");
  }
  EXPECT_EQ(counter.sum, 0u);
  EXPECT_TRUE(log.empty());
  EXPECT_EQ(counter.journal.run("add", counter, Add{5}), 5u);
}

TEST(CommandJournal, LoadsAreCountedAndClearTheFault) {
  Counter counter;
  counter.journal.run("take", counter, Take{});
  EXPECT_EQ(counter.journal.loads(), 0u);
  counter.journal.note_load();
  EXPECT_EQ(counter.journal.loads(), 1u);
  EXPECT_EQ(counter.journal.fault(), Fault::none);
}

TEST(CommandJournal, TracesHashesWhereItIsTold) {
  Counter counter;
  std::vector<std::uint64_t> hashes;
  counter.journal.trace(counter);
  EXPECT_FALSE(counter.journal.is_tracing());
  counter.journal.trace_to(&hashes);
  EXPECT_TRUE(counter.journal.is_tracing());
  counter.sum = 4;
  counter.journal.trace(counter);
  counter.sum = 7;
  counter.journal.trace(counter);
  EXPECT_EQ(hashes, (std::vector<std::uint64_t>{4, 7}));
}

#if defined(ISOSTEP_HOSTILE_ENVIRONMENTS)
TEST(CommandJournal, CommandsRunInThePinnedFloatEnvironment) {
  const test::Hostile caller(test::kMasks | test::kUp | test::kFlush | test::kDenormalsAreZero);
  Counter counter;
  counter.journal.run("add", counter, Add{1});
  EXPECT_EQ(counter.deviations, 0u);
  EXPECT_EQ(test::Hostile::control(), test::kMasks | test::kUp | test::kFlush | test::kDenormalsAreZero);
}
#endif

}  // namespace
}  // namespace isostep
