// Messages: each is read as it was written, and no other bytes are.
// SPDX-License-Identifier: MIT
#include "isostep/session/protocol/message.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <vector>

#include "isostep/session/config.hpp"

namespace isostep {
namespace message_test {

using Buffer = std::vector<std::uint8_t>;

const Buffer kCredential(kCredentialCap, 0x81);

Hello hello() {
  Hello hello;
  hello.spectator = true;
  hello.seat = 7;
  hello.seats = 2;
  hello.credential = kCredential;
  hello.token = 0x1122334455667788u;
  hello.have = {1234, 0xabcdef};
  hello.partial = {1200, 0xfedcba};
  hello.partial_size = 70000;
  hello.identity.set("scene", "arena", true);
  hello.identity.set("compiler", "any", false);
  return hello;
}
Welcome welcome() {
  return {.match = 0xfeedc0de12345678u,
          .players = 4,
          .hosted = 1,
          .player = 2,
          .others = 0b1000,
          .token = 7,
          .start = {kLastFrame, 9},
          .hash = 10,
          .snapshot_size = 0xffffffffu,
          .snapshot_from = 0xfffffffeu,
          .opens = 77};
}

TEST(Message, EachIsReadAsItWasWritten) {
  Buffer bytes{1, 2, 3};
  write_hello(hello(), bytes);
  EXPECT_EQ(message_kind(bytes).value(), MessageKind::hello);
  const Hello read = read_hello(bytes).value();
  EXPECT_TRUE(read.spectator);
  EXPECT_EQ(read.seat, 7);
  EXPECT_EQ(read.seats, 2);
  EXPECT_EQ(read.token, hello().token);
  EXPECT_EQ(Buffer(read.credential.begin(), read.credential.end()), kCredential);
  EXPECT_EQ(read.have.frame, 1234);
  EXPECT_EQ(read.have.chain, 0xabcdefu);
  EXPECT_EQ(read.partial.frame, 1200);
  EXPECT_EQ(read.partial.chain, 0xfedcbau);
  EXPECT_EQ(read.partial_size, 70000u);
  EXPECT_TRUE(compare_headers(read.identity, hello().identity).key.empty());

  write_welcome(welcome(), bytes);
  EXPECT_EQ(message_kind(bytes).value(), MessageKind::welcome);
  const Welcome there = read_welcome(bytes).value();
  EXPECT_EQ(there.match, 0xfeedc0de12345678u);
  EXPECT_EQ(there.players, 4);
  EXPECT_EQ(there.hosted, 1u);
  EXPECT_EQ(there.player, 2);
  EXPECT_EQ(there.others, 0b1000u);
  EXPECT_EQ(there.seated(), 0b1100u);
  EXPECT_EQ(there.token, 7u);
  EXPECT_EQ(there.start.frame, kLastFrame);
  EXPECT_EQ(there.start.chain, 9u);
  EXPECT_EQ(there.hash, 10u);
  EXPECT_EQ(there.snapshot_size, 0xffffffffu);
  EXPECT_EQ(there.snapshot_from, 0xfffffffeu);
  EXPECT_EQ(there.opens, 77);

  write_refusal({"solver", "a", "b"}, bytes);
  const Refusal refusal = read_refusal(bytes).value();
  EXPECT_EQ(refusal.key.view(), "solver");
  EXPECT_EQ(refusal.in_file.view(), "a");
  EXPECT_EQ(refusal.here.view(), "b");

  write_piece({5, Buffer{1, 2, 3}}, bytes);
  const Piece piece = read_piece(bytes).value();
  EXPECT_EQ(piece.offset, 5u);
  EXPECT_EQ(Buffer(piece.bytes.begin(), piece.bytes.end()), (Buffer{1, 2, 3}));

  write_progress(99, bytes);
  EXPECT_EQ(read_progress(bytes).value(), 99u);
  write_open(42, bytes);
  EXPECT_EQ(read_open(bytes).value(), 42);
  write_ready(bytes);
  EXPECT_EQ(bytes, Buffer{static_cast<std::uint8_t>(MessageKind::ready)});
}

TEST(Message, CutOrExtendedTheyAreRefused) {
  const auto check = [](const Buffer& bytes, const std::function<bool(Bytes)>& reads) {
    ASSERT_TRUE(reads(bytes));
    for (std::size_t size = 0; size < bytes.size(); ++size) ASSERT_FALSE(reads(Bytes(bytes).first(size))) << size;
    Buffer longer = bytes;
    longer.push_back(0);
    ASSERT_FALSE(reads(longer));
  };
  Buffer bytes;
  write_hello(hello(), bytes);
  check(bytes, [](Bytes message) { return read_hello(message).ok(); });
  write_welcome(welcome(), bytes);
  check(bytes, [](Bytes message) { return read_welcome(message).ok(); });
  write_refusal({"solver", "a", "b"}, bytes);
  check(bytes, [](Bytes message) { return read_refusal(message).ok(); });
  write_piece({5, Buffer{1, 2, 3}}, bytes);
  check(bytes, [](Bytes message) { return read_piece(message).ok(); });
  write_progress(99, bytes);
  check(bytes, [](Bytes message) { return read_progress(message).ok(); });
  write_ask({true, 0}, bytes);
  check(bytes, [](Bytes message) { return read_ask(message).ok(); });
  write_open(42, bytes);
  check(bytes, [](Bytes message) { return read_open(message).ok(); });
}

TEST(Message, WelcomesThatMakeNoSenseAreRefused) {
  const auto reads = [](const std::function<void(Welcome&)>& change) {
    Welcome its = welcome();
    change(its);
    Buffer bytes;
    write_welcome(its, bytes);
    return read_welcome(bytes).ok();
  };
  EXPECT_TRUE(reads([](Welcome& w) { w.players = 32; }));
  EXPECT_TRUE(reads([](Welcome& w) { w.players = 32, w.player = 0, w.hosted = 0, w.others = 0xfffffffeu; }));
  EXPECT_TRUE(reads([](Welcome& w) { w.player = 0xff, w.others = 0, w.opens = kNoFrame; }));
  EXPECT_FALSE(reads([](Welcome& w) { w.player = 0xff, w.others = 0; })) << "a spectator that plays";
  EXPECT_FALSE(reads([](Welcome& w) { w.player = 0xff, w.opens = kNoFrame; })) << "a spectator with players";
  EXPECT_TRUE(reads([](Welcome& w) { w.player = 0, w.others = 0b1110; }));
  EXPECT_FALSE(reads([](Welcome& w) { w.others = 0b10000; })) << "more than play";
  EXPECT_FALSE(reads([](Welcome& w) { w.others = 0b1100; })) << "the first once more";
  EXPECT_FALSE(reads([](Welcome& w) { w.others = 0b1010; })) << "one before the first";
  EXPECT_FALSE(reads([](Welcome& w) { w.players = 0, w.hosted = 0; }));
  EXPECT_FALSE(reads([](Welcome& w) { w.players = 33; }));
  EXPECT_FALSE(reads([](Welcome& w) { w.hosted = 32; }));
  EXPECT_FALSE(reads([](Welcome& w) { w.player = 4; }));
  EXPECT_FALSE(reads([](Welcome& w) { w.player = 0xfe; }));
  EXPECT_FALSE(reads([](Welcome& w) { w.start.frame = kNoFrame; }));
  EXPECT_FALSE(reads([](Welcome& w) { w.start.frame = kLastFrame + 1; }));
  EXPECT_FALSE(reads([](Welcome& w) { w.snapshot_size = w.snapshot_from - 1; }));
  EXPECT_FALSE(reads([](Welcome& w) { w.opens = -2; }));
  EXPECT_FALSE(reads([](Welcome& w) { w.opens = kLastFrame + 1; }));
}

TEST(Message, AHelloOfSomethingElseIsRefusedByName) {
  Buffer bytes;
  write_hello(hello(), bytes);
  Buffer other = bytes;
  other[1] ^= 1;
  EXPECT_EQ(read_hello(other).error().code, ErrorCode::corrupt);
  other = bytes;
  other[5] ^= 1;
  EXPECT_EQ(read_hello(other).error().code, ErrorCode::incompatible);
  EXPECT_EQ(read_hello(other).error().place.view(), "protocol");
  Hello late = hello();
  late.have.frame = kLastFrame + 1;
  write_hello(late, other);
  EXPECT_FALSE(read_hello(other).ok());
  late.have.frame = kNoFrame;
  write_hello(late, other);
  EXPECT_FALSE(read_hello(other).ok());
}

TEST(Message, WhatIsAskedForIsAPauseOrASpeed) {
  const auto reads = [](const Ask& ask) {
    Buffer bytes;
    write_ask(ask, bytes);
    const Result<Ask> read = read_ask(bytes);
    return read && read.value().is_paused == ask.is_paused && read.value().speed == ask.speed;
  };
  EXPECT_TRUE(reads({true, 0}));
  EXPECT_TRUE(reads({false, 0}));
  EXPECT_TRUE(reads({false, Tempo::kSlowest}));
  EXPECT_FALSE(reads({true, Tempo::kNormal})) << "both";
  EXPECT_FALSE(reads({false, Tempo::kSlowest - 1}));
  EXPECT_FALSE(reads({false, Tempo::kFastest + 1}));
}

TEST(Message, HowManySeatsIsOneAtLeast) {
  Buffer bytes;
  for (const int seats : {0, 1, static_cast<int>(kMaxPlayers), static_cast<int>(kMaxPlayers) + 1, 255}) {
    Hello its = hello();
    its.seats = seats;
    write_hello(its, bytes);
    EXPECT_EQ(read_hello(bytes).ok(), seats >= 1 && seats <= static_cast<int>(kMaxPlayers)) << seats;
  }
}

TEST(Message, SeatsAndCredentialsOutOfRangeAreRefused) {
  Buffer bytes;
  const auto reads = [&](int seat, std::size_t size) {
    const Buffer credential(size, 1);
    Hello its = hello();
    its.seat = seat;
    its.credential = credential;
    write_hello(its, bytes);
    return read_hello(bytes).ok();
  };
  for (const int seat : {-128, -2, 32, 127}) EXPECT_FALSE(reads(seat, 3)) << seat;
  for (const int seat : {-1, 0, 7, 31}) EXPECT_TRUE(reads(seat, 3)) << seat;
  EXPECT_TRUE(reads(0, 0));
  EXPECT_TRUE(reads(0, kCredentialCap));
  EXPECT_FALSE(reads(0, kCredentialCap + 1));
}

TEST(Message, ARefusalIsTextForPeopleAndNothingElse) {
  for (const char* text : {"\x1b[2J", "two\nlines", "\x80", "\x7f"}) {
    Buffer bytes;
    write_refusal({"key", text, "here"}, bytes);
    EXPECT_FALSE(read_refusal(bytes).ok());
    write_refusal({text, "there", "here"}, bytes);
    EXPECT_FALSE(read_refusal(bytes).ok());
  }
}

TEST(Message, UnknownKindsAndSizesAreNoMessages) {
  EXPECT_FALSE(message_kind({}).ok());
  for (unsigned kind = 0; kind < 256; ++kind) {
    EXPECT_EQ(message_kind(Buffer{static_cast<std::uint8_t>(kind)}).ok(),
              kind >= 1 && kind <= static_cast<unsigned>(MessageKind::farewell))
        << kind;
  }
  Buffer bytes(kReliableCap, 1);
  EXPECT_TRUE(message_kind(bytes).ok());
  bytes.push_back(1);
  EXPECT_FALSE(message_kind(bytes).ok());
}

TEST(Message, OpeningsOutOfRangeAreRefused) {
  Buffer bytes;
  for (const Frame frame : {Frame{-1}, Frame{INT32_MIN}, Frame{INT32_MAX}, kLastFrame + 1}) {
    write_open(frame, bytes);
    EXPECT_FALSE(read_open(bytes).ok()) << frame;
  }
  write_open(kLastFrame, bytes);
  EXPECT_TRUE(read_open(bytes).ok());
}

}  // namespace message_test
}  // namespace isostep
