// Whatever is rolled back, each happening is told once and ends once, and what is confirmed is what really happened.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "event_log_ledger.hpp"
#include "isostep/core/random.hpp"

namespace isostep {
namespace event_log_test {

struct Hit {
  std::uint32_t who;
  std::uint32_t strength;  // differs between guess and truth without being another hit

  friend bool operator==(const Hit& a, const Hit& b) { return a.who == b.who; }
};
using Log = EventLog<Hit>;

/// "p7@3" is `who` 7 predicted in frame 3, c confirmed, r retracted; capitals where it is the first of its happening.
std::string told(Log& log) {
  std::string text;
  for (const Notice<Hit>& notice : all_of(log)) {
    const char kind = "pcr"[static_cast<int>(notice.kind)];
    text += text.empty() ? "" : " ";
    text += static_cast<char>(notice.first ? kind - 'a' + 'A' : kind);
    text += std::to_string(notice.event.who) + "@" + std::to_string(notice.frame);
  }
  return text;
}
void step(Log& log, Frame frame, const std::vector<std::uint32_t>& hits = {}) {
  log.before_step(frame);
  for (const std::uint32_t who : hits) log.tell({who, 0});
  log.after_step(frame);
}
void steps(Log& log, Frame first, Frame last) {
  for (Frame frame = first; frame <= last; ++frame) step(log, frame);
}
void confirm(Log& log, Frame first, Frame last) {
  for (Frame frame = first; frame <= last; ++frame) log.confirmed(frame, 0);
}

TEST(EventLog, TellsAPredictionAtOnceAndItsConfirmationLater) {
  Log log;
  step(log, 0, {7, 8});
  EXPECT_EQ(told(log), "P7@0 P8@0");
  EXPECT_EQ(told(log), "");
  steps(log, 1, 9);
  EXPECT_EQ(told(log), "");
  confirm(log, 0, 4);
  EXPECT_EQ(told(log), "c7@0 c8@0");
  confirm(log, 5, 9);
  EXPECT_EQ(told(log), "");
}

TEST(EventLog, WhatIsConfirmedBeforeItIsPolledIsToldOnce) {
  Log log;
  step(log, 0, {7});
  step(log, 1, {8});
  log.confirmed(0, 0);
  EXPECT_EQ(told(log), "C7@0 P8@1");
}

TEST(EventLog, AFrameSteppedAgainWithTheSameEventsTellsNothing) {
  Log log;
  step(log, 0, {7});
  step(log, 1, {8, 9});
  told(log);
  log.rolled_back(0);
  step(log, 0, {7});
  step(log, 1, {8, 9});
  step(log, 2);
  EXPECT_EQ(told(log), "");
  confirm(log, 0, 2);
  EXPECT_EQ(told(log), "c7@0 c8@1 c9@1");
}

TEST(EventLog, WhatNeverHappenedIsRetractedOnceAndWhatWasNotForeseenIsPredicted) {
  Log log({.reach = 0});
  step(log, 0);
  step(log, 1, {7});
  told(log);
  log.rolled_back(0);
  step(log, 0, {8});
  step(log, 1);
  EXPECT_EQ(told(log), "r7@1 P8@0");
  confirm(log, 0, 1);
  EXPECT_EQ(told(log), "c8@0");
}

TEST(EventLog, AGuessThatWasNotYetPolledLeavesNoTrace) {
  Log log({.reach = 0});
  step(log, 0, {7});
  log.rolled_back(0);
  step(log, 0, {8});
  EXPECT_EQ(told(log), "P8@0");
}

TEST(EventLog, AnEventThatMovesWithinReachIsTheSameHappening) {
  for (const Frame to : {6, 8, 12, 14}) {
    Log log;
    for (Frame f = 0; f < 20; ++f) step(log, f, f == 10 ? std::vector{7u} : std::vector<std::uint32_t>{});
    const Notice<Hit> before = all_of(log).at(0);
    log.rolled_back(1);
    for (Frame f = 1; f < 20; ++f) step(log, f, f == to ? std::vector{7u} : std::vector<std::uint32_t>{});
    EXPECT_EQ(told(log), "");
    confirm(log, 0, 19);
    const std::vector<Notice<Hit>> after = all_of(log);
    ASSERT_EQ(after.size(), 1u);
    EXPECT_EQ(after[0].kind, NoticeKind::confirmed);
    EXPECT_EQ(after[0].frame, to);
    EXPECT_FALSE(after[0].first);
    EXPECT_EQ(after[0].happening, before.happening);
  }
}

TEST(EventLog, AnEventThatMovesOutOfReachIsAnother) {
  for (const Frame to : {5, 15}) {
    Log log;
    for (Frame f = 0; f < 20; ++f) step(log, f, f == 10 ? std::vector{7u} : std::vector<std::uint32_t>{});
    told(log);
    log.rolled_back(1);
    for (Frame f = 1; f < 20; ++f) step(log, f, f == to ? std::vector{7u} : std::vector<std::uint32_t>{});
    EXPECT_EQ(told(log), "r7@10 P7@" + std::to_string(to));
  }
}

TEST(EventLog, ARetractionWaitsForTheFramesInWhichTheEventMayStillCome) {
  Log log({.reach = 3});
  step(log, 0, {7});
  EXPECT_EQ(told(log), "P7@0");
  log.rolled_back(0);
  steps(log, 0, 2);
  EXPECT_EQ(told(log), "");
  Log other({.reach = 3});
  step(other, 0, {7});
  told(other);
  other.rolled_back(0);
  steps(other, 0, 2);
  EXPECT_EQ(told(other), "");

  step(log, 3, {7});
  EXPECT_EQ(told(log), "");
  confirm(log, 0, 3);
  EXPECT_EQ(told(log), "c7@3");
  step(other, 3);
  EXPECT_EQ(told(other), "r7@0");
}

TEST(EventLog, NothingIsRetractedWhileTheRollbackIsNotOver) {
  Log log({.reach = 0});
  steps(log, 0, 4);
  step(log, 5, {7});
  told(log);
  log.rolled_back(2);
  EXPECT_EQ(told(log), "");
  step(log, 2);
  EXPECT_EQ(told(log), "");
  steps(log, 3, 4);
  EXPECT_EQ(told(log), "");
  step(log, 5, {7});
  EXPECT_EQ(told(log), "");
}

TEST(EventLog, TheSameFrameGoesBeforeANearOne) {
  Log log;
  step(log, 0, {7});
  step(log, 1, {7});
  const std::vector<Notice<Hit>> before = all_of(log);
  log.rolled_back(0);
  step(log, 0);
  step(log, 1, {7});
  steps(log, 2, 8);
  const std::vector<Notice<Hit>> after = all_of(log);
  ASSERT_EQ(after.size(), 1u);
  EXPECT_EQ(after[0].kind, NoticeKind::retracted);
  EXPECT_EQ(after[0].happening, before[0].happening);
}

TEST(EventLog, EqualEventsOfAFrameCountOneByOne) {
  Log log({.reach = 0});
  step(log, 0, {7, 7});
  EXPECT_EQ(told(log), "P7@0 P7@0");
  log.rolled_back(0);
  step(log, 0, {7, 7, 7});
  EXPECT_EQ(told(log), "P7@0");
  log.rolled_back(0);
  step(log, 0, {7});
  EXPECT_EQ(told(log), "r7@0 r7@0");
  confirm(log, 0, 0);
  EXPECT_EQ(told(log), "c7@0");
}

TEST(EventLog, TheConfirmationCarriesWhatReallyHappened) {
  Log log;
  log.before_step(0);
  log.tell({7, 100});
  log.after_step(0);
  EXPECT_EQ(all_of(log).at(0).event.strength, 100u);
  log.before_step(0);  // a step again is a rollback, said or not
  log.tell({7, 90});
  log.after_step(0);
  log.confirmed(0, 0);
  const std::vector<Notice<Hit>> notices = all_of(log);
  ASSERT_EQ(notices.size(), 1u);
  EXPECT_EQ(notices[0].kind, NoticeKind::confirmed);
  EXPECT_EQ(notices[0].event.strength, 90u);
}

TEST(EventLog, AConfirmedFrameThatIsSteppedAgainTellsNothing) {
  Log log;
  step(log, 0, {7});
  step(log, 1, {8});
  confirm(log, 0, 0);
  log.rolled_back(0);  // before anyone asked
  step(log, 0, {7});
  step(log, 1, {8});
  EXPECT_EQ(told(log), "C7@0 P8@1");
  log.rolled_back(0);
  step(log, 0, {7});
  step(log, 1, {8});
  EXPECT_EQ(told(log), "");
  confirm(log, 0, 1);
  EXPECT_EQ(told(log), "c8@1");
  EXPECT_EQ(log.lost().homeless, 0u);
}

TEST(EventLog, ARestartKeepsWhatComesAgainAndRetractsWhatNobodyKnows) {
  Log log({.reach = 2});
  step(log, 0, {5});
  step(log, 1, {6});
  steps(log, 2, 9);
  step(log, 10, {7});
  EXPECT_EQ(told(log), "P5@0 P6@1 P7@10");
  confirm(log, 0, 0);
  log.restarted(9);
  EXPECT_EQ(told(log), "r6@1 c5@0");
  step(log, 9);
  step(log, 10, {7});
  EXPECT_EQ(told(log), "");
  confirm(log, 9, 10);
  EXPECT_EQ(told(log), "c7@10");
}

TEST(EventLog, ARestartBeforeWhatIsConfirmedTellsNothingTwice) {
  Log log;
  step(log, 0);
  step(log, 1, {7});
  confirm(log, 0, 1);
  EXPECT_EQ(told(log), "C7@1");
  log.restarted(0);
  step(log, 0);
  log.confirmed(0, 0);
  step(log, 1, {7});
  step(log, 2, {8});
  confirm(log, 1, 2);
  EXPECT_EQ(told(log), "C8@2");
}

TEST(EventLog, AtTheEndWhatIsPredictedStillIsRetracted) {
  Log log;
  step(log, 0, {7});
  step(log, 1, {8});
  confirm(log, 0, 0);
  EXPECT_EQ(told(log), "C7@0 P8@1");
  log.finish();
  EXPECT_EQ(told(log), "r8@1");
}

TEST(EventLog, ACrowdedFrameKeepsItsFirstEventsAndCountsTheOthersOnceConfirmed) {
  Log log({.frames = 4, .events = 2});
  for (int again = 0; again < 3; ++again) {
    log.before_step(0);
    EXPECT_TRUE(log.tell({1, 0}));
    EXPECT_TRUE(log.tell({2, 0}));
    EXPECT_FALSE(log.tell({3, 0}));
    EXPECT_FALSE(log.tell({4, 0}));
    log.after_step(0);
    EXPECT_EQ(log.lost().crowded, 0u);
  }
  step(log, 1, {1, 2, 3});
  EXPECT_EQ(told(log), "P1@0 P2@0 P1@1 P2@1");
  EXPECT_EQ(log.lost().crowded, 0u);
  confirm(log, 0, 0);
  EXPECT_EQ(told(log), "c1@0 c2@0");
  EXPECT_EQ(log.lost().crowded, 2u);
  confirm(log, 1, 1);
  EXPECT_EQ(told(log), "c1@1 c2@1");
  EXPECT_EQ(log.lost().crowded, 3u);
  EXPECT_EQ(log.lost().homeless, 0u);
}

TEST(EventLog, WithoutPollingTheNewestAreLostAndCountedAndPromisesAreKept) {
  Log log({.frames = 2, .events = 2});
  step(log, 0, {1, 2});
  EXPECT_EQ(told(log), "P1@0 P2@0");
  step(log, 1, {3, 4});
  step(log, 2, {5, 6});
  confirm(log, 0, 2);
  EXPECT_EQ(log.lost().homeless, 2u);
  EXPECT_EQ(told(log), "c1@0 c2@0 C3@1 C4@1");
  step(log, 3, {7});
  EXPECT_EQ(told(log), "P7@3");
  EXPECT_EQ(log.lost().homeless, 2u);
}

TEST(EventLog, AnEventBetweenFramesIsRefusedAndCounted) {
  Log log;
  EXPECT_FALSE(log.tell({7, 0}));
  step(log, 0);
  EXPECT_FALSE(log.tell({7, 0}));
  EXPECT_EQ(log.lost().homeless, 2u);
  EXPECT_EQ(told(log), "");
}

TEST(EventLog, WhatIsMissingIsBoundedByRetractingEarly) {
  Log log({.frames = 1, .events = 2, .reach = 1000});
  std::uint32_t predicted = 0, retracted = 0;
  for (std::uint32_t i = 0; i < 20; ++i) {
    step(log, 0, {2 * i, 2 * i + 1});
    for (const Notice<Hit>& notice : all_of(log)) {
      predicted += notice.kind == NoticeKind::predicted;
      retracted += notice.kind == NoticeKind::retracted;
    }
    EXPECT_LE(predicted - retracted, 4u);
  }
  EXPECT_EQ(predicted, 40u);
  EXPECT_EQ(log.lost().homeless, 0u);
}

std::vector<Hit> truth_of(Frame frame) {
  std::vector<Hit> hits;
  Pcg32 random = Pcg32::seeded(static_cast<std::uint64_t>(frame));
  for (std::uint32_t n = random_below(random, 4); n > 0; --n) {
    hits.push_back({random_below(random, 3), static_cast<std::uint32_t>(frame)});
  }
  return hits;
}

TEST(EventLog, AnyRollbacksConfirmWhatAStraightRunEmits) {
  Pcg32 random = Pcg32::seeded(5);
  constexpr Frame kFrames = 600, kWindow = 8;
  Log log({.frames = 64, .events = 8, .reach = 2});
  Ledger<Hit> ledger;
  Frame next = 0, confirmed = kNoFrame;
  std::size_t rollbacks = 0;
  while (confirmed < kFrames - 1) {
    const Frame to = std::min({next + 1, confirmed + 1 + kWindow, kFrames});
    const Frame final = std::min(random_between(random, confirmed - 1, confirmed + 2), to - 1);
    const Frame from = final > confirmed ? std::min(confirmed + 1, next) : random_between(random, confirmed + 1, next);
    if (from < next) log.rolled_back(from), ++rollbacks;
    for (Frame frame = from; frame < to; ++frame) {
      // A guess makes it early or late, or something else.
      const bool wrong = frame > final && random_below(random, 2) == 0;
      log.before_step(frame);
      for (const Hit& hit : truth_of(wrong ? frame + random_between(random, -2, 2) : frame)) log.tell(hit);
      log.after_step(frame);
    }
    next = to;
    while (confirmed < final) log.confirmed(++confirmed, 0);
    if (random_below(random, 4) != 0) ledger.take(log);
  }
  log.finish();
  ledger.take(log);
  ledger.expect_lives();

  std::size_t at = 0;
  for (Frame frame = 0; frame < kFrames; ++frame) {
    for (const Hit& hit : truth_of(frame)) {
      ASSERT_LT(at, ledger.confirmed.size());
      EXPECT_EQ(ledger.confirmed[at].first, frame);
      EXPECT_EQ(ledger.confirmed[at].second.who, hit.who);
      EXPECT_EQ(ledger.confirmed[at].second.strength, hit.strength);
      ++at;
    }
  }
  EXPECT_EQ(at, ledger.confirmed.size());
  EXPECT_EQ(ledger.played, at + ledger.taken_back);
  EXPECT_EQ(log.lost().homeless, 0u);
  EXPECT_EQ(log.lost().crowded, 0u);
  EXPECT_GT(rollbacks, 50u);
  EXPECT_GT(ledger.taken_back, 20u);
  EXPECT_GT(ledger.moved, 20u);
}

}  // namespace event_log_test
}  // namespace isostep
