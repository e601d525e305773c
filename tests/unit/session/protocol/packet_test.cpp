// Datagrams: what is written is read, nothing is larger than a datagram, every stream gets on, damage is refused.
// SPDX-License-Identifier: MIT
#include "isostep/session/protocol/packet.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "isostep/core/random.hpp"
#include "isostep/session/protocol/wire.hpp"
#include "isostep/session/timeline/input_codec.hpp"

namespace isostep {
namespace packet_test {

using Buffer = std::vector<std::uint8_t>;

Frame any_frame(Pcg32& random) {
  const Frame frames[] = {0, 1, 100, 100000, kLastFrame - 1, kLastFrame, static_cast<Frame>(random.next() >> 2)};
  return frames[random.next() % 7];
}
PacketHeader any_header(Pcg32& random) {
  PacketHeader header;
  header.match = std::uint64_t{random.next()} << 32 | random.next();
  header.number = static_cast<std::uint16_t>(random.next());
  header.time = static_cast<std::uint16_t>(random.next());
  header.has_echo = random.next() % 2 == 0;
  if (header.has_echo) header.echo = static_cast<std::uint16_t>(random.next());
  header.started = random.next() % 2 == 0;
  header.is_far = random.next() % 2 == 0;
  if (random.next() % 4 == 0) header.waits_for = random.next();
  if (random.next() % 2 == 0) {
    header.stretch = static_cast<std::uint8_t>(random.next() % 255 + 1);
    header.slowest = static_cast<std::uint8_t>(random.next() % 2 == 0 ? 0xff : random.next() % kMaxPlayers);
  }
  if (random.next() % 3 == 0) {
    header.figured = static_cast<std::uint8_t>(random.next() % kMaxPlayers);
    header.figures = {0, random.next(), random.next(), random.next(), random.next(), random.next() % 1001};
  }
  header.frame = any_frame(random);
  if (random.next() % 2 == 0) {
    header.tempo = {1 + random.next() % 1000, any_frame(random), static_cast<std::uint8_t>(4 + random.next() % 13),
                    random.next() % 2 == 0,
                    static_cast<std::uint8_t>(random.next() % 2 == 0 ? 0xff : random.next() % 32)};
  }
  if (random.next() % 2 == 0) header.report = {any_frame(random), std::uint64_t{random.next()} << 32 | random.next()};
  if (random.next() % 2 == 0) {
    header.reporter = static_cast<std::uint8_t>(random.next() % kMaxPlayers);
    header.passed_on = {any_frame(random), random.next()};
  }
  header.ack_mask = random.next();
  for (std::size_t p = 0; p < kMaxPlayers; ++p) {
    if ((header.ack_mask >> p & 1) == 0) continue;
    header.ack[p] = any_frame(random);
    header.slack[p] = static_cast<std::int8_t>(random.next());
  }
  return header;
}
/// Every member takes the most bytes that it can.
PacketHeader largest_header() {
  PacketHeader header;
  header.has_echo = header.started = header.is_far = true;
  header.stretch = 255;
  header.waits_for = ~0u;
  header.tempo = {~0u, 0, Tempo::kFastest, true, 31};
  header.frame = kLastFrame;
  header.report = header.passed_on = {0, ~std::uint64_t{0}};
  header.reporter = kMaxPlayers - 1;
  header.ack_mask = ~0u;
  return header;
}
InputStream any_stream(Pcg32& random, Frame first, std::size_t cap) {
  InputStream stream(1000, cap);
  stream.reset(first);
  Buffer input(random.next() % (cap + 1));
  const std::uint32_t restless = random.next() % 4 * 30;
  for (std::uint32_t n = random.next() % 300 + 1; n > 0; --n) {
    if (random.next() % 100 < restless) {
      if (random.next() % 4 == 0) input.resize(random.next() % (cap + 1));
      for (std::uint8_t& byte : input) {
        if (random.next() % 3 == 0) byte = static_cast<std::uint8_t>(random.next());
      }
    }
    stream.append(random.next() % 100 < restless / 4 ? InputEntry{true, {}} : InputEntry{false, input});
  }
  return stream;
}
void expect_same(const PacketHeader& a, const PacketHeader& b) {
  ASSERT_EQ(a.match, b.match);
  ASSERT_EQ(a.number, b.number);
  ASSERT_EQ(a.figured, b.figured);
  ASSERT_EQ(a.figures.replaced, b.figures.replaced);
  ASSERT_EQ(a.figures.waited, b.figures.waited);
  ASSERT_EQ(a.figures.round_trip, b.figures.round_trip);
  ASSERT_EQ(a.figures.jitter, b.figures.jitter);
  ASSERT_EQ(a.figures.loss, b.figures.loss);
  ASSERT_EQ(a.time, b.time);
  ASSERT_EQ(a.has_echo, b.has_echo);
  ASSERT_EQ(a.echo, b.echo);
  ASSERT_EQ(a.started, b.started);
  ASSERT_EQ(a.is_far, b.is_far);
  ASSERT_EQ(a.stretch, b.stretch);
  ASSERT_EQ(a.slowest, b.slowest);
  ASSERT_EQ(a.waits_for, b.waits_for);
  ASSERT_EQ(a.frame, b.frame);
  ASSERT_EQ(a.tempo.number, b.tempo.number);
  ASSERT_EQ(a.tempo.from, b.tempo.from);
  ASSERT_EQ(a.tempo.by, b.tempo.by);
  ASSERT_TRUE(a.tempo.same_as(b.tempo));
  ASSERT_EQ(a.report.frame, b.report.frame);
  ASSERT_EQ(a.report.chain, b.report.chain);
  ASSERT_EQ(a.reporter, b.reporter);
  ASSERT_EQ(a.passed_on.chain, b.passed_on.chain);
  ASSERT_EQ(a.ack_mask, b.ack_mask);
  ASSERT_TRUE(std::equal(a.ack, a.ack + kMaxPlayers, b.ack));
  ASSERT_TRUE(std::equal(a.slack, a.slack + kMaxPlayers, b.slack));
}

TEST(Packet, WhatIsWrittenIsRead) {
  Pcg32 random = Pcg32::seeded(2);
  std::uint8_t buffer[kDatagramCap];
  for (int run = 0; run < 3000; ++run) {
    const PacketHeader header = any_header(random);
    PacketWriter writer(header, buffer);
    std::vector<InputStream> streams;
    std::vector<std::pair<std::uint8_t, Frame>> counts;
    for (std::uint8_t p = 0; p < kMaxPlayers; ++p) {
      if (random.next() % 2 == 0) continue;
      const Frame first = any_frame(random) / 2;
      streams.push_back(any_stream(random, first, random.next() % 2 == 0 ? 4 : kInputCap));
      const Frame count = writer.add_slice(p, streams.back(), streams.back().begin());
      if (count > 0) counts.emplace_back(p, count);
      else streams.pop_back();
    }
    ASSERT_LE(writer.bytes().size(), kDatagramCap);
    const Buffer bytes(writer.bytes().begin(), writer.bytes().end());
    const Result<Packet> read = read_packet(bytes);
    ASSERT_TRUE(read.ok()) << read.error().message.view();
    const Packet& packet = read.value();
    expect_same(packet.header, header);
    ASSERT_EQ(packet.slice_count, counts.size());
    for (std::size_t i = 0; i < counts.size(); ++i) {
      const InputSlice& slice = packet.slices[i];
      ASSERT_EQ(slice.player, counts[i].first);
      ASSERT_EQ(slice.count, counts[i].second);
      ASSERT_EQ(slice.first, streams[i].begin());
      SliceReader reader(slice);
      InputEntry entry;
      for (Frame frame = slice.first; frame < slice.first + slice.count; ++frame) {
        ASSERT_TRUE(reader.next(entry));
        ASSERT_TRUE(same_input(entry, streams[i].at(frame))) << frame;
      }
      ASSERT_FALSE(reader.next(entry));
      ASSERT_FALSE(reader.failed());
    }
  }
}

std::size_t slice_bytes(const InputStream& stream) {
  std::uint8_t buffer[kDatagramCap];
  PacketWriter writer(PacketHeader{}, buffer);
  const std::size_t before = writer.bytes().size();
  EXPECT_GT(writer.add_slice(0, stream, stream.begin()), 0);
  return writer.bytes().size() - before;
}

TEST(Packet, WhatDoesNotChangeCostsAByteForSixtyFourFrames) {
  // Player, first frame and size take a byte each below 128, the count 1 or 2; then the input once: its mark, its
  // length and four bytes; then runs.
  InputStream held(500, 4), absent(500, 4);
  const std::uint8_t input[4] = {1, 2, 3, 4};
  for (int f = 0; f < 1; ++f) held.append({false, input});
  EXPECT_EQ(slice_bytes(held), 4u + 6u);
  for (int f = 1; f < 65; ++f) held.append({false, input});
  EXPECT_EQ(slice_bytes(held), 4u + 6u + 1u);
  held.append({false, input});
  EXPECT_EQ(slice_bytes(held), 4u + 6u + 2u);
  absent.append_absent_until(64);
  EXPECT_EQ(slice_bytes(absent), 4u + 1u);
  absent.append_absent_until(400);
  EXPECT_EQ(slice_bytes(absent), 5u + 2u) << "no slice is longer than 128 frames";
}

TEST(Packet, AChangedByteCostsItselfAndItsMask) {
  InputStream stream(500, 8);
  std::uint8_t input[8] = {};
  stream.append({false, input});
  const std::size_t one = slice_bytes(stream);
  input[5] = 9;
  stream.append({false, input});
  EXPECT_EQ(slice_bytes(stream), one + 3);  // the mark, the mask, the byte
}

TEST(Packet, EveryStreamGetsOnHoweverLongTheInputs) {
  Pcg32 random = Pcg32::seeded(4);
  std::vector<InputStream> streams(kMaxPlayers, InputStream(100, kInputCap));
  for (InputStream& stream : streams) {
    for (int f = 0; f < 100; ++f) {
      Buffer input(kInputCap);
      for (std::uint8_t& byte : input) byte = static_cast<std::uint8_t>(random.next());
      stream.append({false, input});
    }
  }
  // As a session sends: who is first in a datagram goes round; everything sent is heard.
  Frame acked[kMaxPlayers] = {};
  std::uint8_t buffer[kDatagramCap];
  for (std::size_t round = 0; round < 100; ++round) {
    Frame before[kMaxPlayers];
    std::copy(acked, acked + kMaxPlayers, before);
    for (std::size_t turn = 0; turn < kMaxPlayers; ++turn) {
      PacketWriter writer(largest_header(), buffer);
      for (std::size_t i = 0; i < kMaxPlayers; ++i) {
        const std::size_t p = (turn + i) % kMaxPlayers;
        const Frame sent = writer.add_slice(static_cast<std::uint8_t>(p), streams[p], acked[p]);
        if (i == 0 && acked[p] < 100) {
          ASSERT_GE(sent, 1) << "the first always fits";
        }
        acked[p] += sent;
      }
      ASSERT_LE(writer.bytes().size(), kDatagramCap);
      ASSERT_TRUE(read_packet(writer.bytes()).ok());
    }
    for (std::size_t p = 0; p < kMaxPlayers; ++p) ASSERT_TRUE(acked[p] == 100 || acked[p] > before[p]);
  }
  for (const Frame frame : acked) EXPECT_EQ(frame, 100);
}

TEST(Packet, FramesThatAStreamHasNotAreNotSent) {
  InputStream stream(10, 1);
  stream.reset(50);
  for (int f = 0; f < 20; ++f) stream.append({true, {}});
  std::uint8_t buffer[kDatagramCap];
  PacketWriter writer(PacketHeader{}, buffer);
  const std::size_t before = writer.bytes().size();
  for (const Frame first : {0, 59, 70, 71, kLastFrame}) EXPECT_EQ(writer.add_slice(0, stream, first), 0);
  EXPECT_EQ(writer.bytes().size(), before);
  EXPECT_EQ(writer.add_slice(0, stream, 60, 0), 0) << "no more than is asked for";
  EXPECT_EQ(writer.add_slice(0, stream, 61, 3), 3);
  EXPECT_EQ(writer.add_slice(1, stream, 60), 10);
}

TEST(Packet, CutAnywhereItIsRefusedOrAWholeNumberOfSlices) {
  Pcg32 random = Pcg32::seeded(8);
  std::uint8_t buffer[kDatagramCap];
  for (int run = 0; run < 50; ++run) {
    PacketWriter writer(any_header(random), buffer);
    std::vector<std::size_t> ends{writer.bytes().size()};
    for (std::uint8_t p = 0; p < 3; ++p) {
      writer.add_slice(p, any_stream(random, 5, 4), 5);
      ends.push_back(writer.bytes().size());
    }
    for (std::size_t size = 0; size <= writer.bytes().size(); ++size) {
      const bool at_end = std::find(ends.begin(), ends.end(), size) != ends.end();
      ASSERT_EQ(read_packet(writer.bytes().first(size)).ok(), at_end) << size;
    }
  }
}

/// The bytes of a header in which nothing is optional but the acknowledgements that are asked for.
WireWriter head(std::uint8_t* buffer, std::uint32_t flags = 0, std::uint32_t frame = 7, std::uint8_t mask = 0) {
  WireWriter writer(buffer, kDatagramCap);
  writer.byte(0xd1);
  writer.fixed(std::uint64_t{1});
  writer.fixed(std::uint16_t{3});
  writer.fixed(std::uint16_t{2});
  writer.number(flags);
  writer.number(frame);
  if ((flags & 0x8c) == 0) writer.byte(mask);
  return writer;
}
bool reads(const std::uint8_t* buffer, const WireWriter& writer) { return read_packet({buffer, writer.size()}).ok(); }

TEST(Packet, ValuesOutOfRangeAreRefused) {
  std::uint8_t buffer[kDatagramCap + 1];
  EXPECT_TRUE(reads(buffer, head(buffer)));
  EXPECT_TRUE(reads(buffer, head(buffer, 0, kLastFrame)));
  EXPECT_FALSE(reads(buffer, head(buffer, 0, kLastFrame + 1u)));
  EXPECT_FALSE(reads(buffer, head(buffer, 0, 0xffffffffu)));
  EXPECT_FALSE(reads(buffer, head(buffer, 512))) << "no flag";
  const auto waiting = [&](std::uint32_t players) {
    WireWriter writer(buffer, kDatagramCap);
    writer.byte(0xd1);
    writer.fixed(std::uint64_t{1});
    writer.fixed(std::uint16_t{3});
    writer.fixed(std::uint16_t{2});
    writer.byte(64);
    writer.number(players);
    writer.number(7);
    writer.byte(0);
    return reads(buffer, writer);
  };
  EXPECT_TRUE(waiting(1));
  EXPECT_TRUE(waiting(~0u));
  EXPECT_FALSE(waiting(0)) << "waiting for nobody is not said";
  const auto tempo = [&](std::uint32_t number, std::int32_t from, std::uint8_t speed, std::uint8_t by) {
    WireWriter writer = head(buffer, 128);
    writer.number(number);
    writer.difference(from);
    writer.byte(speed);
    writer.byte(by);
    writer.byte(0);
    return reads(buffer, writer);
  };
  EXPECT_TRUE(tempo(1, -7, 4, 0xff));
  EXPECT_TRUE(tempo(1, 0, 128 + 16, 31));
  EXPECT_FALSE(tempo(0, 0, 8, 0)) << "no change";
  EXPECT_FALSE(tempo(1, -8, 8, 0)) << "before the first frame";
  EXPECT_FALSE(tempo(1, 0, 3, 0));
  EXPECT_FALSE(tempo(1, 0, 17, 0));
  EXPECT_FALSE(tempo(1, 0, 8, 32));
  const auto slow = [&](std::uint8_t stretch, std::uint8_t player) {
    WireWriter writer(buffer, kDatagramCap);
    writer.byte(0xd1);
    writer.fixed(std::uint64_t{1});
    writer.fixed(std::uint16_t{3});
    writer.fixed(std::uint16_t{2});
    writer.byte(32);
    writer.byte(stretch);
    writer.byte(player);
    writer.number(7);
    writer.byte(0);
    return reads(buffer, writer);
  };
  EXPECT_TRUE(slow(1, 0));
  EXPECT_TRUE(slow(255, 31));
  EXPECT_TRUE(slow(255, 0xff));
  EXPECT_FALSE(slow(0, 0)) << "slow by nothing is not said";
  EXPECT_FALSE(slow(1, 32));
  EXPECT_FALSE(slow(1, 0xfe));
  const auto report_at = [&](std::int32_t difference) {
    WireWriter writer = head(buffer, 4);
    writer.difference(difference);
    writer.fixed(std::uint64_t{1});
    writer.byte(0);
    return reads(buffer, writer);
  };
  EXPECT_TRUE(report_at(-7));
  EXPECT_FALSE(report_at(-8));
  EXPECT_TRUE(report_at(kLastFrame - 7));
  EXPECT_FALSE(report_at(kLastFrame - 6));
  EXPECT_FALSE(report_at(INT32_MAX));
  EXPECT_FALSE(report_at(INT32_MIN));
  const auto reporter = [&](std::uint8_t player) {
    WireWriter writer = head(buffer, 8);
    writer.byte(player);
    writer.difference(0);
    writer.fixed(std::uint64_t{1});
    writer.byte(0);
    return reads(buffer, writer);
  };
  EXPECT_TRUE(reporter(31));
  EXPECT_FALSE(reporter(32));
  EXPECT_FALSE(reporter(0xff));
  const auto ack_at = [&](std::int32_t difference) {
    WireWriter writer = head(buffer, 0, 7, 1);
    writer.difference(difference);
    writer.byte(0);
    return reads(buffer, writer);
  };
  EXPECT_TRUE(ack_at(-7));
  EXPECT_FALSE(ack_at(-8));
  EXPECT_FALSE(ack_at(INT32_MAX));
  EXPECT_FALSE(ack_at(INT32_MIN));
  buffer[0] = 0xd0;
  EXPECT_FALSE(read_packet({buffer, 8}).ok());
  std::fill(std::begin(buffer), std::end(buffer), std::uint8_t{0});
  EXPECT_FALSE(read_packet({buffer, sizeof buffer}).ok());
}

bool slice_reads(std::uint8_t player, std::int32_t first, std::uint32_t count, std::uint32_t size, bool twice = false) {
  std::uint8_t buffer[kDatagramCap];
  WireWriter writer = head(buffer, 0, 0);
  for (int n = 0; n < (twice ? 2 : 1); ++n) {
    writer.byte(player);
    writer.difference(first);  // to the header's frame, 0
    writer.number(count);
    writer.number(size);
    writer.byte(0x40);
  }
  return reads(buffer, writer);
}
TEST(Packet, SlicesOutOfRangeAreRefused) {
  EXPECT_TRUE(slice_reads(0, 0, 1, 1));
  EXPECT_TRUE(slice_reads(31, kLastFrame, 128, 1));
  EXPECT_FALSE(slice_reads(32, 0, 1, 1));
  EXPECT_FALSE(slice_reads(0, kLastFrame + 1, 1, 1));
  EXPECT_FALSE(slice_reads(0, -1, 1, 1));
  EXPECT_FALSE(slice_reads(0, INT32_MIN, 1, 1));
  EXPECT_FALSE(slice_reads(0, 0, 0, 1));
  EXPECT_FALSE(slice_reads(0, 0, 129, 1));
  EXPECT_FALSE(slice_reads(0, 0, 0xffffffffu, 1));
  EXPECT_FALSE(slice_reads(0, 0, 1, 2));
  EXPECT_FALSE(slice_reads(0, 0, 1, 0xffffffffu));
  EXPECT_FALSE(slice_reads(3, 0, 1, 1, true)) << "one player twice";
}

}  // namespace packet_test
}  // namespace isostep
