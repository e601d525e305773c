// State hashes: known answers, pieces against the whole, fields against memory.
// SPDX-License-Identifier: MIT
#include "isostep/state/hash.hpp"

#include <gtest/gtest.h>

#include <string_view>
#include <vector>

#include "isostep/core/crc32c.hpp"
#include "toy.hpp"

namespace isostep {
namespace hash_test {

Bytes bytes_of(std::string_view text) { return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}; }

template <class S> toy::Thing<S> thing(int i) {
  toy::Thing<S> t{};
  t.velocity = {S(i), S(-i - 1), S(2)};
  t.charge = S(-3);
  t.visits = 0x01020304u + static_cast<std::uint32_t>(i);
  t.mood = toy::Mood::cross;
  t.marks[0] = 0xaa;
  t.marks[1] = 0xbb;
  return t;
}

template <class S> class HashRecords : public testing::Test {};
using Scalars = testing::Types<float, double, Q16_16, Q32_32>;
TYPED_TEST_SUITE(HashRecords, Scalars);

TYPED_TEST(HashRecords, FieldByFieldGivesTheHashOfTheMemory) {
  using Thing = toy::Thing<TypeParam>;
  std::vector<Thing> things;
  for (int i = 0; i < 100; ++i) {
    things.push_back(thing<TypeParam>(i));
    ASSERT_TRUE(memory_is_canonical(things.back()));
    ASSERT_EQ(hash_records(things.data(), things.size()), hash_records_by_fields(things.data(), things.size()));
    ASSERT_EQ(hash_records(things.data(), things.size()), hash_bytes(things.data(), things.size() * sizeof(Thing)));
  }
}

TYPED_TEST(HashRecords, PiecesOneAfterAnotherGiveTheHashOfTheWhole) {
  std::vector<toy::Thing<TypeParam>> things;
  for (int i = 0; i < 50; ++i) things.push_back(thing<TypeParam>(i));
  for (std::size_t cut = 0; cut <= things.size(); cut += 7) {
    HashStream stream;
    update_records(stream, things.data(), cut);
    update_records(stream, things.data() + cut, things.size() - cut);
    EXPECT_EQ(stream.value(), hash_records(things.data(), things.size()));
  }
}

TYPED_TEST(HashRecords, EveryBitOfARecordCounts) {
  auto t = thing<TypeParam>(7);
  const std::uint64_t before = hash_records(&t, 1);
  auto* bytes = reinterpret_cast<std::uint8_t*>(&t);
  for (std::size_t bit = 0; bit < 8 * sizeof t; ++bit) {
    bytes[bit / 8] ^= static_cast<std::uint8_t>(1u << bit % 8);
    ASSERT_NE(hash_records(&t, 1), before) << "bit " << bit;
    bytes[bit / 8] ^= static_cast<std::uint8_t>(1u << bit % 8);
  }
}

TEST(Hash, MinusZeroIsNotZero) {
  const float zeros[2] = {0.0f, -0.0f};
  EXPECT_NE(hash_records(&zeros[0], 1), hash_records(&zeros[1], 1));
}

TEST(Hash, PaddingIsLeftOut) {
  toy::Padded a{}, b{};
  std::memset(static_cast<void*>(&a), 0x00, sizeof a);
  std::memset(static_cast<void*>(&b), 0xff, sizeof b);
  for (toy::Padded* p : {&a, &b}) {
    p->big = 5;
    p->flag = true;
    p->small = -1;
    p->middle = -300;
  }
  EXPECT_EQ(hash_records_by_fields(&a, 1), hash_records_by_fields(&b, 1));
}

TEST(Hash, KnownAnswersOfXxh3) {
  // XXH3-64 of no bytes with seed 0, as the reference implementation publishes it.
  EXPECT_EQ(hash_bytes(nullptr, 0), 0x2d06800538d394c2u);
}

TEST(Hash, PiecesHashAsTheWhole) {
  std::vector<std::uint8_t> bytes(5000);
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<std::uint8_t>(i * i >> 3);
  for (std::size_t piece : {1u, 7u, 64u, 255u, 1024u, 4999u}) {
    HashStream stream;
    for (std::size_t at = 0; at < bytes.size(); at += piece) {
      stream.update(bytes.data() + at, std::min(piece, bytes.size() - at));
    }
    EXPECT_EQ(stream.value(), hash_bytes(bytes.data(), bytes.size())) << piece;
    EXPECT_EQ(stream.value(), stream.value());
  }
}

TEST(HashCombiner, TellsOrderAndCountApart) {
  const auto combined = [](std::initializer_list<std::uint64_t> words) {
    HashCombiner combiner;
    for (const std::uint64_t word : words) combiner.add(word);
    return combiner.value();
  };
  EXPECT_EQ(combined({1, 2}), combined({1, 2}));
  EXPECT_NE(combined({1, 2}), combined({2, 1}));
  EXPECT_NE(combined({1, 1}), combined({2, 2}));
  EXPECT_NE(combined({1}), combined({1, 0}));
  EXPECT_NE(combined({}), combined({0}));
}

TEST(Crc32c, KnownAnswers) {
  // "123456789" is the catalogue's check value; the others are RFC 3720 B.4.
  EXPECT_EQ(crc32c(bytes_of("123456789")), 0xe3069283u);
  std::vector<std::uint8_t> bytes(32, 0);
  EXPECT_EQ(crc32c(bytes), 0x8a9136aau);
  bytes.assign(32, 0xff);
  EXPECT_EQ(crc32c(bytes), 0x62a8ab43u);
  for (std::size_t i = 0; i < 32; ++i) bytes[i] = static_cast<std::uint8_t>(i);
  EXPECT_EQ(crc32c(bytes), 0x46dd794eu);
  EXPECT_EQ(crc32c({}), 0u);
}

TEST(Crc32c, GoesOnWhereAPieceEnded) {
  const std::string_view text = "a chunk of a file that is a little longer than eight bytes";
  for (std::size_t cut = 0; cut <= text.size(); ++cut) {
    EXPECT_EQ(crc32c(bytes_of(text.substr(cut)), crc32c(bytes_of(text.substr(0, cut)))), crc32c(bytes_of(text)));
  }
}

TEST(Bytes, AreLittleEndian) {
  std::uint8_t bytes[8];
  store_le(bytes, std::uint64_t{0x0102030405060708u});
  for (unsigned i = 0; i < 8; ++i) EXPECT_EQ(bytes[i], 8 - i);
  EXPECT_EQ(load_le<std::uint32_t>(bytes), 0x05060708u);
  EXPECT_EQ(load_le<std::uint16_t>(bytes + 6), 0x0102u);
}

}  // namespace hash_test
}  // namespace isostep
