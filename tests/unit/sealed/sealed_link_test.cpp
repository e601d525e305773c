// The handshake and the seals of one connection: every bit of them, replays, orders, other keys.
// SPDX-License-Identifier: MIT
#include "sealed/sealed_link.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

namespace isostep::sealed {
namespace sealed_link_test {

using Bytevec = std::vector<std::uint8_t>;

LobbyKey key_of(std::uint64_t id, std::uint8_t fill) {
  LobbyKey key{.id = id};
  key.secret.fill(fill);
  return key;
}
const LobbyKey kKey = key_of(7, 0x5a);

Bytevec seal(SealedLink& link, Channel channel, const Bytevec& bytes) {
  Bytevec sealed(bytes.size() + SealedLink::kSeal);
  EXPECT_TRUE(link.seal(channel, bytes, sealed.data()));
  return sealed;
}
Opened open(SealedLink& link, Channel channel, const Bytevec& sealed, Bytevec* bytes = nullptr) {
  Bytevec opened(sealed.size());
  const Opened result = link.open(channel, sealed, opened.data());
  opened.resize(sealed.size() - std::min(sealed.size(), SealedLink::kSeal));
  if (bytes != nullptr) *bytes = opened;
  return result;
}

/// Two sides, and what they said to each other.
struct Pair {
  SealedLink client, host;
  Bytevec hello = Bytevec(SealedLink::kHello), reply = Bytevec(SealedLink::kReply), confirm;
  std::span<std::uint8_t, SealedLink::kHello> hello_span() {
    return std::span<std::uint8_t, SealedLink::kHello>(hello);
  }
  std::span<std::uint8_t, SealedLink::kReply> reply_span() {
    return std::span<std::uint8_t, SealedLink::kReply>(reply);
  }

  void greet() { EXPECT_TRUE(client.begin(kKey, hello_span())); }
  void answer() { EXPECT_TRUE(host.answer(kKey, hello, reply_span())); }
  void meet() {
    greet();
    answer();
    EXPECT_TRUE(client.take_reply(kKey, reply));
    confirm = seal(client, Channel::reliable, {});
    EXPECT_TRUE(host.take_confirm(confirm));
  }
};
std::unique_ptr<Pair> met() {
  auto pair = std::make_unique<Pair>();
  pair->meet();
  return pair;
}

TEST(SealedLink, BothSidesReadWhatTheOtherSeals) {
  const auto pair = met();
  const Bytevec said = {1, 2, 3, 4, 5};
  for (const Channel channel : {Channel::datagram, Channel::reliable}) {
    for (SealedLink* from : {&pair->client, &pair->host}) {
      SealedLink& to = from == &pair->client ? pair->host : pair->client;
      for (const std::size_t size : {std::size_t{0}, std::size_t{5}, kReliableCap}) {
        Bytevec heard, sealed = seal(*from, channel, Bytevec(size, 9));
        ASSERT_EQ(open(to, channel, sealed, &heard), Opened::good);
        EXPECT_EQ(heard, Bytevec(size, 9));
        EXPECT_EQ(open(to, channel, sealed), Opened::replayed);
        EXPECT_NE(open(*from, channel, sealed), Opened::good) << "sent back to who said it";
      }
    }
  }
  EXPECT_EQ(pair->client.key_id(), kKey.id);
  EXPECT_EQ(pair->host.key_id(), kKey.id);
  const Bytevec sealed = seal(pair->client, Channel::datagram, said);
  EXPECT_NE(open(pair->host, Channel::reliable, sealed), Opened::good) << "on the other channel";
}

TEST(SealedLink, NoBitOfADatagramOrAMessageCanBeChangedNorAByteCutOff) {
  const auto pair = met();
  for (const Channel channel : {Channel::datagram, Channel::reliable}) {
    const Bytevec said(40, 3), sealed = seal(pair->client, channel, said);
    for (std::size_t bit = 0; bit < 8 * sealed.size(); ++bit) {
      Bytevec changed = sealed;
      changed[bit / 8] ^= static_cast<std::uint8_t>(1u << bit % 8);
      // Of the count: it is another's, one that came before or one that is to come.
      const Opened opened = open(pair->host, channel, changed);
      ASSERT_TRUE(opened == Opened::forged || (bit < 32 && opened == Opened::replayed)) << bit;
    }
    for (std::size_t size = 0; size < sealed.size(); ++size) {
      ASSERT_EQ(open(pair->host, channel, Bytevec(sealed.begin(), sealed.begin() + static_cast<std::ptrdiff_t>(size))),
                size < SealedLink::kSeal ? Opened::truncated : Opened::forged);
    }
    Bytevec heard;
    EXPECT_EQ(open(pair->host, channel, sealed, &heard), Opened::good) << "what was refused changed something";
    EXPECT_EQ(heard, said);
  }
}

TEST(SealedLink, NoBitOfTheHandshakeCanBeChanged) {
  Pair whole;
  whole.greet();
  for (std::size_t bit = 0; bit < 8 * whole.hello.size(); ++bit) {
    Bytevec changed = whole.hello;
    changed[bit / 8] ^= static_cast<std::uint8_t>(1u << bit % 8);
    SealedLink host;
    std::uint64_t id = 0;
    const bool is_hello = SealedLink::read_key_id(changed, id);
    if (is_hello && id == kKey.id) {
      EXPECT_FALSE(host.answer(kKey, changed, whole.reply_span())) << bit;
    } else {
      EXPECT_LT(bit, 8u * 10) << "type, version, key id";
    }
  }
  whole.answer();
  for (std::size_t bit = 0; bit < 8 * whole.reply.size(); ++bit) {
    // X25519 takes a point for the same when its last bit differs, but the digest of the handshake does not.
    Bytevec changed = whole.reply;
    changed[bit / 8] ^= static_cast<std::uint8_t>(1u << bit % 8);
    SealedLink client = whole.client;
    EXPECT_FALSE(client.take_reply(kKey, changed)) << bit;
    EXPECT_NE(client.stage(), SealedLink::Stage::open);
  }
  ASSERT_TRUE(whole.client.take_reply(kKey, whole.reply));
  whole.confirm = seal(whole.client, Channel::reliable, {});
  for (std::size_t bit = 0; bit < 8 * whole.confirm.size(); ++bit) {
    Bytevec changed = whole.confirm;
    changed[bit / 8] ^= static_cast<std::uint8_t>(1u << bit % 8);
    EXPECT_FALSE(whole.host.take_confirm(changed)) << bit;
  }
  EXPECT_TRUE(whole.host.take_confirm(whole.confirm));
}

TEST(SealedLink, WhoLacksTheKeyGetsNowhere) {
  const LobbyKey other = key_of(kKey.id, 0x5b);
  Pair pair;
  EXPECT_TRUE(pair.client.begin(other, pair.hello_span()));
  EXPECT_FALSE(pair.host.answer(kKey, pair.hello, pair.reply_span())) << "who connects";
  pair.greet();
  EXPECT_TRUE(pair.client.begin(kKey, pair.hello_span()));
  // Who is connected to has not the key, and copies the hello's MAC.
  EXPECT_FALSE(pair.host.answer(other, pair.hello, pair.reply_span()));
  EXPECT_FALSE(pair.client.take_reply(kKey, Bytevec(SealedLink::kReply, 2)));
}

TEST(SealedLink, AHelloThatIsSentAgainDoesNotMakeAConnection) {
  const auto first = met();
  SealedLink host;
  Bytevec reply(SealedLink::kReply);
  ASSERT_TRUE(host.answer(kKey, first->hello, std::span<std::uint8_t, SealedLink::kReply>(reply)));
  EXPECT_NE(reply, first->reply);
  EXPECT_FALSE(host.take_confirm(first->confirm));
  EXPECT_EQ(host.stage(), SealedLink::Stage::answered);
}

TEST(SealedLink, APointOfLowOrderIsNoKey) {
  // Everybody's shared secret with it is zero. Only who has the lobby's key can say it, and gains nothing.
  Pair pair;
  pair.greet();
  pair.answer();
  Bytevec reply = pair.reply;
  std::fill(reply.begin() + 1, reply.begin() + 33, std::uint8_t{0});
  EXPECT_FALSE(pair.client.take_reply(kKey, reply));
}

TEST(SealedLink, AnotherConnectionOfTheSameKeyHasOtherKeys) {
  const auto before = met(), now = met();
  for (const Channel channel : {Channel::datagram, Channel::reliable}) {
    const Bytevec old = seal(before->client, channel, {1, 2, 3});
    EXPECT_EQ(open(now->host, channel, old), Opened::forged);
    EXPECT_NE(seal(now->client, channel, {1, 2, 3}), old);
  }
}

TEST(SealedLink, DatagramsMayOvertakeEachOtherWithinTheWindowAndMessagesMayNot) {
  const auto pair = met();
  std::vector<Bytevec> datagrams;
  for (std::uint32_t i = 0; i <= transport::ReplayWindow::kSize; ++i)
    datagrams.push_back(seal(pair->client, Channel::datagram, {1}));
  EXPECT_EQ(open(pair->host, Channel::datagram, datagrams.back()), Opened::good);
  for (std::size_t i = datagrams.size() - 1; i-- > 1;) {
    ASSERT_EQ(open(pair->host, Channel::datagram, datagrams[i]), Opened::good) << i;
  }
  for (const Bytevec& datagram : datagrams) EXPECT_EQ(open(pair->host, Channel::datagram, datagram), Opened::replayed);

  const Bytevec first = seal(pair->client, Channel::reliable, {1}), second = seal(pair->client, Channel::reliable, {2});
  EXPECT_EQ(open(pair->host, Channel::reliable, second), Opened::displaced);
  EXPECT_EQ(open(pair->host, Channel::reliable, first), Opened::good);
  EXPECT_EQ(open(pair->host, Channel::reliable, first), Opened::replayed);
  EXPECT_EQ(open(pair->host, Channel::reliable, second), Opened::good);
}

TEST(SealedLink, ACountIsUsedOnceAndThenThereAreNoMore) {
  const auto pair = met();
  for (const Channel channel : {Channel::datagram, Channel::reliable}) {
    pair->client.skip_to(channel, SealedLink::kLastCount - 1);
    const Bytevec last = seal(pair->client, channel, {1});
    EXPECT_EQ(open(pair->host, channel, last), channel == Channel::datagram ? Opened::good : Opened::displaced);
    std::uint8_t out[SealedLink::kSeal + 1] = {};
    EXPECT_FALSE(pair->client.seal(channel, Bytevec(1), out));
    for (const std::uint8_t byte : out) EXPECT_EQ(byte, 0);
  }
}

}  // namespace sealed_link_test
}  // namespace isostep::sealed
