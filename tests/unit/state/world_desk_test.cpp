// WorldDesk over a toy engine: what a command returns and leaves behind, accepted or refused.
// SPDX-License-Identifier: MIT
#include "isostep/state/world_desk.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "determinism/hostile_environment.hpp"

namespace isostep {
namespace world_desk_test {

struct Add {
  std::uint32_t number;
  ISO_FIELDS(number)
};
struct Take {
  ISO_FIELDS()
};

/// A sum. Add returns it, 0 where it was refused.
struct Counter {
  using EveryCommand = CommandTypes<void, Take, Add>;
  WorldDesk desk;
  std::uint32_t sum = 0, deviations = 0;

  std::uint32_t execute(const Add& add) {
    deviations = probe_environment_here();
    return desk.faults.accept({add.number > 0 ? Fault::none : Fault::out_of_range, "", "number", "1 or more"})
               ? sum += add.number
               : 0;
  }
  bool execute(const Take&) {
    if (sum == 0) return desk.faults.refuse(Fault::bad_argument);
    --sum;
    return true;
  }
  std::uint64_t hash() const { return sum; }
};

using Bytes8 = std::vector<std::uint8_t>;

TEST(WorldDesk, AnAcceptedCommandReturnsWhatItMadeAndIsRecorded) {
  Counter counter;
  Bytes8 log;
  counter.desk.journal.record_to(&log);
  EXPECT_TRUE(counter.desk.journal.records_to(&log));
  EXPECT_EQ(counter.desk.run("add", counter, Add{5}), 5u);
  counter.desk.journal.record_step();
  EXPECT_TRUE(counter.desk.run("take", counter, Take{}));
  EXPECT_EQ(log, (Bytes8{1, 5, kStepMarker, 0}));
  counter.desk.journal.record_to(nullptr);
  EXPECT_EQ(counter.desk.run("add", counter, Add{5}), 9u);
  counter.desk.journal.record_step();
  EXPECT_EQ(log.size(), 4u);
}

TEST(WorldDesk, ARefusedCommandReturnsNothingAndIsNamedButNotRecorded) {
  Counter counter;
  Bytes8 log;
  counter.desk.journal.record_to(&log);
  EXPECT_EQ(counter.desk.run("add", counter, Add{0}), 0u);
  const FaultReport& fault = counter.desk.faults.last();
  EXPECT_EQ(fault, Fault::out_of_range);
  EXPECT_STREQ(fault.command, "add");
  EXPECT_STREQ(fault.field, "number");
  EXPECT_STREQ(fault.expected, "1 or more");
  EXPECT_TRUE(log.empty());
}

TEST(WorldDesk, CommandsClearTheLastFaultAndTheFirstStaysUntilItIsForgotten) {
  Counter counter;
  FaultLog& faults = counter.desk.faults;
  EXPECT_FALSE(counter.desk.run("take", counter, Take{}));
  EXPECT_EQ(counter.desk.run("add", counter, Add{0}), 0u);
  EXPECT_STREQ(faults.last().command, "add");
  EXPECT_STREQ(faults.first().command, "take");
  counter.desk.run("add", counter, Add{1});
  EXPECT_EQ(faults.last(), Fault::none);
  EXPECT_EQ(faults.first(), Fault::bad_argument);
  faults.forget();
  EXPECT_EQ(faults.first(), Fault::none);
}

TEST(WorldDesk, OtherCallsLeaveTheFaultWhereTheyAreAccepted) {
  FaultLog faults;
  EXPECT_FALSE(faults.accept_call("ask", {Fault::not_finite, "", "point", "a finite number"}));
  EXPECT_TRUE(faults.accept_call("ask again", {}));
  EXPECT_STREQ(faults.last().command, "ask");
  EXPECT_STREQ(faults.first().command, "ask");
}

TEST(WorldDesk, ACallInsideAnotherIsRefused) {
  Counter counter;
  Bytes8 log;
  counter.desk.journal.record_to(&log);
  {
    const ExclusiveCall step = counter.desk.enter("step");
    EXPECT_TRUE(step.allowed());
    EXPECT_EQ(counter.desk.run("add", counter, Add{5}), 0u);
    EXPECT_EQ(counter.desk.faults.last(), Fault::called_in_step);
    EXPECT_STREQ(counter.desk.faults.last().command, "add");
    const ExclusiveCall load = counter.desk.enter("load");
    EXPECT_FALSE(load.allowed());
    EXPECT_STREQ(counter.desk.faults.last().command, "load");
  }
  EXPECT_EQ(counter.sum, 0u);
  EXPECT_TRUE(log.empty());
  EXPECT_EQ(counter.desk.run("add", counter, Add{5}), 5u);
}

TEST(WorldDesk, LoadsAreCountedAndClearTheFault) {
  Counter counter;
  counter.desk.run("take", counter, Take{});
  EXPECT_EQ(counter.desk.journal.loads(), 0u);
  counter.desk.note_load();
  EXPECT_EQ(counter.desk.journal.loads(), 1u);
  EXPECT_EQ(counter.desk.faults.last(), Fault::none);
}

TEST(WorldDesk, TracesHashesWhereItIsTold) {
  Counter counter;
  std::vector<std::uint64_t> hashes;
  counter.desk.note_hash(counter);
  EXPECT_TRUE(hashes.empty());
  counter.desk.trace = &hashes;
  counter.sum = 4;
  counter.desk.note_hash(counter);
  counter.sum = 7;
  counter.desk.note_hash(counter);
  EXPECT_EQ(hashes, (std::vector<std::uint64_t>{4, 7}));
}

#if defined(ISOSTEP_HOSTILE_ENVIRONMENTS)
TEST(WorldDesk, CommandsRunInThePinnedFloatEnvironment) {
  const test::Hostile caller(test::kMasks | test::kUp | test::kFlush | test::kDenormalsAreZero);
  Counter counter;
  counter.desk.run("add", counter, Add{1});
  EXPECT_EQ(counter.deviations, 0u);
  EXPECT_EQ(test::Hostile::control(), test::kMasks | test::kUp | test::kFlush | test::kDenormalsAreZero);
}
#endif

}  // namespace world_desk_test
}  // namespace isostep
