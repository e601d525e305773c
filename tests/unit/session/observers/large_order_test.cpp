// Large orders: pieces are read as they were written, and only an unbroken row of them becomes an order.
// SPDX-License-Identifier: MIT
#include "isostep/session/observers/large_order.hpp"

#include <gtest/gtest.h>

#include "isostep/core/random.hpp"

namespace isostep {
namespace large_order_test {

struct Stick {
  std::int8_t way = 0;
  bool valid() const { return way != 77; }
  friend bool operator==(const Stick&, const Stick&) = default;
  ISO_FIELDS(way)
};
using Input = WithOrders<Stick, 10>;
using Codec = InputCodec<Input>;

Input piece(std::uint8_t sequence, std::uint16_t offset, std::uint16_t total, std::uint8_t size) {
  Input input;
  input.brief.way = 3;
  input.sequence = sequence;
  input.offset = offset;
  input.total = total;
  input.size = size;
  for (std::uint8_t i = 0; i < size; ++i) input.bytes[i] = static_cast<std::uint8_t>(offset + i);
  return input;
}
Input idle(std::uint8_t sequence) {
  Input input;
  input.sequence = sequence;
  return input;
}
bool reads(const Input& input) {
  std::uint8_t bytes[64];
  const std::size_t size = Codec::encode(input, bytes);
  Input read;
  return Codec::decode({bytes, size}, read) && read == input;
}

TEST(LargeOrderCodec, ReadsWhatItWroteAndNothingElse) {
  EXPECT_TRUE(reads(idle(7)));
  EXPECT_TRUE(reads(piece(1, 0, 25, 10)));
  EXPECT_TRUE(reads(piece(3, 20, 25, 5)));
  EXPECT_TRUE(reads(piece(1, Input::kOrderCap - 4, Input::kOrderCap, 4)));
  EXPECT_FALSE(reads(piece(1, 0, 25, 9))) << "short, and not the last";
  EXPECT_FALSE(reads(piece(1, 20, 25, 6))) << "past the end";
  EXPECT_FALSE(reads(piece(1, 25, 25, 1)));
  EXPECT_FALSE(reads(piece(1, 26, 25, 10)));
  EXPECT_FALSE(reads(piece(1, 0, Input::kOrderCap + 1, 10))) << "larger than an order may be";
  Input bad = piece(1, 0, 25, 10);
  bad.brief.way = 77;
  EXPECT_FALSE(reads(bad)) << "the small input is none";
  std::uint8_t bytes[64];
  const std::size_t size = Codec::encode(piece(1, 0, 25, 10), bytes);
  Input read;
  for (std::size_t cut = 0; cut < size; ++cut) EXPECT_FALSE(Codec::decode({bytes, cut}, read)) << cut;
  EXPECT_FALSE(Codec::decode({bytes, size + 1}, read));
  bytes[1] = 11;
  EXPECT_FALSE(Codec::decode({bytes, 64}, read)) << "longer than a piece";
}

TEST(LargeOrderCodec, GuessesNoPieces) {
  const Input guess = DefaultPredictor<Input>::Type::predict(piece(9, 0, 25, 10), 1);
  EXPECT_EQ(guess.size, 0);
  EXPECT_EQ(guess.sequence, 9);
  EXPECT_EQ(guess.brief.way, 3);
}

struct Receiver {
  Bytes take(const Input& input, bool is_absent = false) { return assembly.take(2, is_absent, input.piece()); }
  OrderAssembly assembly;
};

TEST(OrderAssembly, GivesAnOrderInTheFrameOfItsLastPiece) {
  Receiver receiver;
  EXPECT_TRUE(receiver.take(idle(0)).empty());
  EXPECT_TRUE(receiver.take(piece(1, 0, 25, 10)).empty());
  EXPECT_TRUE(receiver.take(idle(1)).empty()) << "frames without a piece may lie between";
  EXPECT_TRUE(receiver.take(piece(2, 10, 25, 10)).empty());
  const Bytes whole = receiver.take(piece(3, 20, 25, 5));
  ASSERT_EQ(whole.size(), 25u);
  for (std::uint8_t i = 0; i < 25; ++i) EXPECT_EQ(whole[i], i);
  EXPECT_EQ(receiver.assembly.completed(2), 1u);
  EXPECT_EQ(receiver.take(piece(4, 0, 8, 8)).size(), 8u) << "one piece is an order as well";
  EXPECT_TRUE(receiver.take(idle(4)).empty());
}

TEST(OrderAssembly, DropsWhatIsBroken) {
  const auto completes = [](const Input& second, bool is_absent, const Input& last) {
    Receiver receiver;
    receiver.take(piece(250, 0, 25, 10));
    receiver.take(second, is_absent);
    receiver.take(piece(252, 10, 25, 10));
    return !receiver.take(last).empty();
  };
  EXPECT_TRUE(completes(piece(251, 0, 25, 10), false, piece(253, 20, 25, 5))) << "begun anew";
  EXPECT_FALSE(completes(idle(250), false, piece(253, 20, 25, 5))) << "a piece is missing";
  EXPECT_FALSE(completes(piece(251, 0, 25, 10), true, piece(253, 20, 25, 5))) << "nobody was there";
  EXPECT_FALSE(completes(piece(251, 0, 24, 10), false, piece(253, 20, 25, 5))) << "of another size";
  EXPECT_FALSE(completes(piece(251, 0, 25, 10), false, piece(254, 20, 25, 5)));
  EXPECT_FALSE(completes(piece(251, 0, 25, 10), false, idle(253)));
}

TEST(OrderAssembly, IsStateAlsoInTheMiddleOfAnOrder) {
  Receiver receiver, other;
  const std::uint64_t at_first = receiver.assembly.hash();
  receiver.take(piece(1, 0, 25, 10));
  receiver.take(piece(2, 10, 25, 10));
  EXPECT_NE(receiver.assembly.hash(), at_first);
  OrderAssembly::Snapshot kept;
  receiver.assembly.save(kept);
  std::vector<std::uint8_t> bytes;
  Writer writer(bytes);
  receiver.assembly.write_portable(writer);
  Reader reader(bytes);
  ASSERT_TRUE(other.assembly.read_portable(reader).ok());
  EXPECT_EQ(other.assembly.hash(), receiver.assembly.hash());
  EXPECT_EQ(other.take(piece(3, 20, 25, 5)).size(), 25u);
  EXPECT_EQ(receiver.take(piece(3, 20, 25, 5)).size(), 25u);
  EXPECT_EQ(other.assembly.hash(), receiver.assembly.hash());
  receiver.assembly.load(kept);
  EXPECT_TRUE(receiver.take(idle(3)).empty());
  EXPECT_EQ(receiver.assembly.completed(2), 0u);
}

TEST(OrderAssembly, ReadsNoStateThatCannotBe) {
  Receiver receiver;
  receiver.take(piece(1, 0, 25, 10));
  std::vector<std::uint8_t> bytes;
  Writer writer(bytes);
  receiver.assembly.write_portable(writer);
  Pcg32 random = Pcg32::seeded(1);
  int refused = 0;
  for (int i = 0; i < 2000; ++i) {
    std::vector<std::uint8_t> damaged = bytes;
    if (i % 2 == 0) damaged.resize(random.next() % bytes.size());
    else damaged[random.next() % bytes.size()] ^= static_cast<std::uint8_t>(1u << random.next() % 8);
    Receiver other;
    const std::uint64_t before = other.assembly.hash();
    Reader reader(damaged);
    if (other.assembly.read_portable(reader).ok()) {
      for (std::uint8_t n = 2; n < 6; ++n) other.take(piece(n, 10, 25, 10));
      continue;
    }
    ++refused;
    EXPECT_EQ(other.assembly.hash(), before);
  }
  EXPECT_GT(refused, 1000);
}

}  // namespace large_order_test
}  // namespace isostep
