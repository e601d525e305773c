// SnapshotTransfer: it takes what a line has, delays little else on it, and believes no nonsense.
// SPDX-License-Identifier: MIT
#include "isostep/session/peer/snapshot_transfer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <deque>

namespace isostep {
namespace snapshot_transfer_test {

/// A line of one rate and one round trip: what is sent waits for what was sent before.
struct Outcome {
  Time took = 0, worst_queue = 0;  // [us] that a datagram waited
};
Outcome send(std::uint32_t size, std::uint64_t rate, Time trip) {
  struct Piece {
    Time at;
    std::uint32_t end;  // [bytes]; 0: a datagram
    Time sent_at = 0;   // [us]
  };
  SnapshotTransfer transfer;
  transfer.begin(0, size);
  std::deque<Piece> line;
  Outcome outcome;
  Time free_at = 0;
  for (Time now = 0; !transfer.is_complete() && now < 300 * kSecond; now += 1000) {
    std::uint32_t arrived = 0;
    for (; !line.empty() && line.front().at <= now; line.pop_front()) {
      if (line.front().end > 0) arrived = line.front().end;
      if (line.front().end == 0) transfer.measured(now - line.front().sent_at, now);
    }
    if (arrived > 0) {
      EXPECT_TRUE(transfer.has_arrived(arrived));
    }
    while (const std::uint32_t piece = transfer.next_piece(now)) {
      transfer.was_sent(piece, now);
      free_at = std::max(free_at, now) + piece * kSecond / rate;
      line.push_back({free_at + trip, transfer.sent()});
    }
    // A datagram waits like everything else, and its echo comes a round trip later.
    if (now % 17000 == 0) {
      line.push_back({std::max(free_at, now) + trip, 0, now});
      outcome.worst_queue = std::max(outcome.worst_queue, std::max(free_at, now) - now);
    }
    outcome.took = now;
  }
  EXPECT_TRUE(transfer.is_complete());
  return outcome;
}

TEST(SnapshotTransfer, TakesNineTenthsOfTheLineAndDelaysItByAQuarterOfASecond) {
  for (const std::uint64_t rate : {50000u, 100000u, 200000u, 1000000u}) {
    for (const Time trip : {Time{1000}, Time{60000}, Time{300000}}) {
      SCOPED_TRACE(std::to_string(rate) + " bytes/s, " + std::to_string(trip) + " us");
      const Outcome outcome = send(5000000, rate, trip);
      EXPECT_LE(outcome.took, Time{5000000} * kSecond / rate * 10 / 9 + 4 * kSecond);
      EXPECT_LE(outcome.worst_queue, kSecond / 4);
      std::printf("%u kB/s, %u ms: %.1f %% of the line, queue %.0f ms\n", unsigned(rate / 1000), unsigned(trip / 1000),
                  5e14 / double(rate) / double(outcome.took), double(outcome.worst_queue) / 1000);
    }
  }
}

TEST(SnapshotTransfer, SendsLittleToWhoNeverAnswers) {
  SnapshotTransfer transfer;
  const Time now = 0;
  transfer.begin(0, 5000000);
  std::uint32_t sent = 0;
  while (const std::uint32_t piece = transfer.next_piece(now)) {
    transfer.was_sent(piece, now);
    sent += piece;
  }
  EXPECT_EQ(sent, 256u);
}

TEST(SnapshotTransfer, HasNeverMoreUnderWayThanItsFlightWhateverIsClaimed) {
  SnapshotTransfer transfer;
  transfer.begin(0, 0xffffffffu);
  for (Time now = 0; now < 1000 * kSecond; now += kSecond) {
    std::uint32_t sent = 0;
    while (const std::uint32_t piece = transfer.next_piece(now)) {
      transfer.was_sent(piece, now);
      sent += piece;
    }
    ASSERT_LE(sent, kSnapshotFlight + kReliableCap);
    ASSERT_TRUE(transfer.has_arrived(transfer.sent())) << "at once";
    transfer.measured(0, now);
  }
}

TEST(SnapshotTransfer, BelievesNoNonsense) {
  SnapshotTransfer transfer;
  transfer.begin(1000, 5000);
  EXPECT_EQ(transfer.progress().arrived, 1000u);
  EXPECT_EQ(transfer.progress().size, 5000u);
  transfer.was_sent(transfer.next_piece(0), 0);
  EXPECT_FALSE(transfer.has_arrived(1000)) << "known";
  EXPECT_FALSE(transfer.has_arrived(0));
  EXPECT_FALSE(transfer.has_arrived(transfer.sent() + 1)) << "never sent";
  EXPECT_TRUE(transfer.has_arrived(transfer.sent()));
  EXPECT_FALSE(transfer.is_complete());
}

TEST(SnapshotTransfer, OfWhatIsThereAlreadyHasNothingToSend) {
  SnapshotTransfer transfer;
  transfer.begin(5000, 5000);
  EXPECT_TRUE(transfer.is_complete());
  EXPECT_EQ(transfer.next_piece(0), 0u);
}

}  // namespace snapshot_transfer_test
}  // namespace isostep
