// The parts of a client without a client: partings, arriving snapshots, the way in, seats, wishes.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "isostep/session/client/entry.hpp"
#include "isostep/session/client/own_seats.hpp"
#include "isostep/session/client/partings.hpp"
#include "isostep/session/client/repair.hpp"
#include "isostep/session/client/wishes.hpp"
#include "isostep/session/host/secret_numbers.hpp"
#include "isostep/session/peer/tempo_track.hpp"

namespace isostep {
namespace parts_test {

using Message = std::vector<std::uint8_t>;

TEST(Partings, AFarewellComesBeforeItsConnectionEnds) {
  Partings partings;
  partings.hang_up(1);
  partings.bid_farewell(2);
  Message message;
  EXPECT_EQ(partings.write_next(message), PeerId{2});
  EXPECT_EQ(message_kind(message).value(), MessageKind::farewell);
  EXPECT_EQ(partings.write_next(message), PeerId{2});
  EXPECT_TRUE(message.empty());
  EXPECT_EQ(partings.write_next(message), PeerId{1});
  EXPECT_FALSE(partings.write_next(message).has_value());
}

TEST(SnapshotArrival, GoesOnWhereItsPiecesEnd) {
  Message bytes, message;
  SnapshotArrival arrival(bytes);
  const HashReport start{60, 7};
  arrival.begin(start, 4, 0);
  const std::uint8_t piece[] = {1, 2, 3};
  EXPECT_FALSE(arrival.take({1, Bytes(piece, 2)})) << "not the next";
  EXPECT_TRUE(arrival.take({0, Bytes(piece, 3)}));
  EXPECT_FALSE(arrival.take({3, Bytes(piece, 2)})) << "more than there is";
  EXPECT_TRUE(arrival.write_next(kSecond, kSecond, message));
  EXPECT_EQ(read_progress(message).value(), 3u);
  EXPECT_FALSE(arrival.write_next(kSecond, kSecond, message)) << "nothing new";
  EXPECT_TRUE(arrival.goes_on(start, 3));
  EXPECT_FALSE(arrival.goes_on({60, 8}, 3)) << "of another history";
  EXPECT_TRUE(arrival.take({3, Bytes(piece, 1)}));
  EXPECT_TRUE(arrival.is_whole());
  EXPECT_FALSE(arrival.take({4, {}})) << "nothing is no piece";
  EXPECT_TRUE(arrival.write_next(kSecond, kSecond, message)) << "all of it is told at once";
}

TEST(Repair, AsksAnewOnceTheHostKnowsThatTheStateHasCome) {
  Message bytes, message;
  SnapshotArrival arrival(bytes);
  HashLog hashes(64);
  Frame present = 0;
  Repair repair(arrival, hashes, present);
  FrameClock clock(60);
  repair.ask();
  ASSERT_TRUE(repair.write_next(message));
  EXPECT_EQ(message_kind(message).value(), MessageKind::resync);
  RepairOffer offer;
  offer.start.frame = 10;
  offer.snapshot_size = 1;
  repair.take(offer);
  const std::uint8_t piece[] = {1};
  ASSERT_TRUE(arrival.take({0, Bytes(piece, 1)}));
  std::vector<InputStream> streams(1, InputStream(64, 1));
  streams[0].reset(20);  // inputs before are gone: the state is too old
  EXPECT_FALSE(repair.tend(streams, 20, clock, kSecond));
  EXPECT_FALSE(repair.write_next(message)) << "the host still waits for the word that all has come";
  ASSERT_TRUE(arrival.write_next(kSecond, kSecond, message));
  ASSERT_TRUE(repair.write_next(message));
  EXPECT_EQ(message_kind(message).value(), MessageKind::resync);
}

TEST(TempoTrack, ASuccessorTakesUpWhatWasAnnounced) {
  TempoTrack tempos;
  Tempo pause;
  pause.number = 3;
  pause.from = 30;
  pause.is_paused = true;
  tempos.hear(pause);
  tempos.forget();  // connected to another, which has said nothing when it is lost
  EXPECT_FALSE(tempos.due_at(30).has_value());
  tempos.take_over();
  ASSERT_TRUE(tempos.due_at(30).has_value());
  EXPECT_TRUE(tempos.due_at(30)->is_paused);
}

TEST(SecretNumbers, OfTwoTermsHaveNoneInCommon) {
  SecretNumbers first(7, 1), second(7, 2);
  const std::uint64_t token = first.next_token(), life = first.next_life();
  EXPECT_NE(first.match(), second.match());
  EXPECT_NE(token, second.next_token());
  EXPECT_NE(life, second.next_life());
  EXPECT_NE(token, first.next_token());
}

TEST(Entry, WithoutASnapshotGoesOnFromTheStateThatWeHave) {
  Message bytes;
  SnapshotArrival arrival(bytes);
  Entry entry(arrival, false);
  Welcome welcome;
  welcome.start = {30, 5};
  EXPECT_TRUE(entry.fits(welcome, {30, 5}));
  EXPECT_FALSE(entry.fits(welcome, {30, 6}));
  entry.begin(welcome);
  EXPECT_TRUE(entry.is_due());
  EXPECT_FALSE(entry.is_restoring());
  entry.was_begun();
  EXPECT_FALSE(entry.is_under_way());
}

TEST(Entry, ASnapshotOfAnotherHashSpoilsTheGame) {
  Message bytes;
  SnapshotArrival arrival(bytes);
  Entry entry(arrival, false);
  Welcome welcome;
  welcome.start = {30, 5};
  welcome.hash = 9;
  welcome.snapshot_size = 1;
  entry.begin(welcome);
  EXPECT_FALSE(entry.is_due());
  const std::uint8_t piece[] = {1};
  ASSERT_TRUE(arrival.take({0, Bytes(piece, 1)}));
  entry.has_pieces();
  ASSERT_TRUE(entry.is_due());
  entry.was_begun();
  EXPECT_TRUE(entry.is_restored_by(30));
  EXPECT_FALSE(entry.has_hash(8));
  entry.spoil();
  Hello hello;
  entry.describe({30, 5}, hello);
  EXPECT_EQ(hello.have.frame, 0) << "from the beginning, for it is in no state of the match";
}

TEST(OwnSeats, AreCutOutWhereTheHostWentOnWithoutThem) {
  std::vector<InputStream> streams(2, InputStream(64, 1));
  InputRules rules{};
  rules.cap = 1;
  Timeline timeline(2, 16, rules);
  PeerLink host;
  OwnSeats own(streams, timeline, host);
  own.sit(0b10);
  EXPECT_EQ(own.first(), 1);
  EXPECT_FALSE(own.open(40, 32)) << "too far ahead";
  ASSERT_TRUE(own.open(3, 32));
  EXPECT_EQ(streams[1].end(), 3);
  const std::uint8_t input[] = {1};
  for (int i = 0; i < 4; ++i) streams[1].append({false, Bytes(input, 1)});
  host.acked[1] = 5;
  own.hear_acks();
  EXPECT_EQ(own.limit(100), 5);
  own.take(1, {true, {}});
  EXPECT_TRUE(own.is_closed());
  EXPECT_EQ(streams[1].end(), 5) << "what was not accepted is not played";
}

TEST(Wishes, AreToldOnceTheLastOfEachKind) {
  std::vector<InputStream> streams(2, InputStream(64, 1));
  Timeline timeline(2, 16, InputRules{});
  PeerLink host;
  OwnSeats own(streams, timeline, host);
  Ballot ballot;
  Wishes wishes(own, host, ballot);
  Message message;
  EXPECT_FALSE(wishes.pause(true)) << "nobody plays here yet";
  own.sit(0b11);
  own.go_on_from(0);
  EXPECT_FALSE(wishes.pause(true)) << "there is no host";
  host.is_connected = true;
  EXPECT_TRUE(wishes.pause(true));
  EXPECT_TRUE(wishes.set_speed(4));
  EXPECT_FALSE(wishes.set_speed(Tempo::kFastest + 1));
  ballot.voters = 0b01;
  EXPECT_FALSE(wishes.vote(0, true)) << "there is no vote";
  ballot.number = 1;
  EXPECT_FALSE(wishes.vote(1, true)) << "it has no vote";
  EXPECT_FALSE(wishes.vote(2, true)) << "it is not ours";
  EXPECT_TRUE(wishes.vote(0, true));
  EXPECT_TRUE(wishes.vote(0, false));
  ASSERT_TRUE(wishes.write_next(message));
  EXPECT_EQ(read_votes(message).value().no, 1u);
  ASSERT_TRUE(wishes.write_next(message));
  EXPECT_EQ(read_ask(message).value().speed, 4);
  EXPECT_FALSE(wishes.write_next(message));
}

}  // namespace parts_test
}  // namespace isostep
