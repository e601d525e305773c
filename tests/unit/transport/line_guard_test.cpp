// Cookies and tags: who proves an address, what is opened, and that no answer is longer than its question. No clock.
// SPDX-License-Identifier: MIT
#include "transport/line_guard.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "isostep/core/random.hpp"
#include "transport/enet_guard.hpp"

namespace isostep::transport {
namespace line_guard_test {

using Bytevec = std::vector<std::uint8_t>;
constexpr std::uint64_t kNonce = 0x1122334455667788u;
constexpr Source kClient = {0x0100007f, 4001};

PacketKey key_of(std::uint8_t byte) {
  PacketKey key;
  key.fill(byte);
  return key;
}
Doorkeeper host() { return {key_of(7), {1, 2}}; }
Doorkeeper client() { return {key_of(7), {3, 4}}; }

Bytevec open_of(const Doorkeeper::Cookie& cookie, std::uint64_t nonce = kNonce, std::size_t more = 60) {
  Bytevec open(Doorkeeper::kOpen + more);
  Doorkeeper::write_open(nonce, cookie, std::span(open).first<Doorkeeper::kOpen>());
  return open;
}
Doorkeeper::Cookie cookie_at(std::uint32_t now) {
  const auto challenge = host().answer(client().ask(kNonce), kClient, now);
  EXPECT_TRUE(challenge.has_value());
  const auto cookie = client().take_challenge(*challenge, kNonce);
  EXPECT_TRUE(cookie.has_value());
  return cookie.value_or(Doorkeeper::Cookie{});
}

TEST(Doorkeeper, LetsInWhoHearsWhatIsSentToItsAddress) {
  EXPECT_EQ(host().take_open(open_of(cookie_at(1000)), kClient, 1080), kNonce);
  EXPECT_EQ(host().take_open(open_of(cookie_at(0xffffff00u)), kClient, 50), kNonce) << "the clock wraps";
}

TEST(Doorkeeper, ACookieIsOfOneAddressOneNonceAndAShortTime) {
  const Doorkeeper::Cookie cookie = cookie_at(1000);
  EXPECT_TRUE(host().take_open(open_of(cookie), kClient, 1000 + Doorkeeper::kLife));
  EXPECT_FALSE(host().take_open(open_of(cookie), kClient, 1001 + Doorkeeper::kLife)) << "an old one";
  EXPECT_FALSE(host().take_open(open_of(cookie), kClient, 999)) << "of a time that has not come";
  EXPECT_FALSE(host().take_open(open_of(cookie), {kClient.host, 4002}, 1000));
  EXPECT_FALSE(host().take_open(open_of(cookie), {kClient.host + 1, kClient.port}, 1000));
  EXPECT_FALSE(host().take_open(open_of(cookie, kNonce + 1), kClient, 1000));
  const Doorkeeper other(key_of(7), {1, 3});
  EXPECT_FALSE(other.take_open(open_of(cookie), kClient, 1000)) << "of another host";
  Doorkeeper::Cookie younger = cookie;
  ++younger[0];
  EXPECT_FALSE(host().take_open(open_of(younger), kClient, 1001)) << "its time is under the hash";
}

TEST(Doorkeeper, AChallengeIsOnlyTakenByWhoAsked) {
  const auto challenge = host().answer(client().ask(kNonce), kClient, 5);
  EXPECT_FALSE(client().take_challenge(*challenge, kNonce + 1));
  EXPECT_FALSE(Doorkeeper(key_of(8), {3, 4}).take_challenge(*challenge, kNonce));
  for (std::size_t bit = 0; bit < 8 * Doorkeeper::kWord; ++bit) {
    Doorkeeper::Word altered = *challenge;
    altered[bit / 8] = static_cast<std::uint8_t>(altered[bit / 8] ^ 1 << bit % 8);
    EXPECT_FALSE(client().take_challenge(altered, kNonce)) << bit;
  }
}

TEST(Doorkeeper, AStrangerWithoutTheKeyIsNotAnswered) {
  EXPECT_FALSE(host().answer(Doorkeeper(key_of(8), {3, 4}).ask(kNonce), kClient, 5));
  EXPECT_FALSE(host().answer(Doorkeeper({}, {3, 4}).ask(kNonce), kClient, 5));
}

TEST(Doorkeeper, SaysNoMoreThanItHeardToAnyPacketOfAnUnprovedAddress) {
  Pcg32 random = Pcg32::seeded(3);
  std::uint64_t heard = 0, said = 0, answers = 0;
  const auto hear = [&](Bytes bytes) {
    const auto word = host().answer(bytes, kClient, 5);
    heard += bytes.size();
    if (!word) return;
    ++answers;
    said += word->size();
    ASSERT_LE(word->size(), bytes.size());
  };
  const Doorkeeper::Word ask = client().ask(kNonce), challenge = *host().answer(ask, kClient, 5);
  const Bytevec open = open_of(cookie_at(5));
  for (const Bytes whole : {Bytes(ask), Bytes(challenge), Bytes(open)}) {
    for (std::size_t size = 0; size <= whole.size(); ++size) hear(whole.first(size));
    Bytevec longer(whole.begin(), whole.end());
    for (; longer.size() < kPacketCap; longer.push_back(0)) hear(longer);
    for (int i = 0; i < 20000; ++i) {
      Bytevec altered(whole.begin(), whole.end());
      for (std::uint32_t changes = 1 + random_below(random, 4); changes > 0; --changes) {
        altered[random_below(random, static_cast<std::uint32_t>(altered.size()))] =
            static_cast<std::uint8_t>(random.next());
      }
      hear(altered);
    }
  }
  for (int i = 0; i < 100000; ++i) {
    Bytevec bytes(random_below(random, 64));
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random.next());
    hear(bytes);
  }
  EXPECT_GE(answers, 1u);  // the ask itself, and mutants that change nothing
  EXPECT_LE(said, heard);
}

// ---- tags

struct Ends {
  LineTags client = Doorkeeper(key_of(7), {}).tags(kNonce, true), host = Doorkeeper(key_of(7), {}).tags(kNonce, false);
};
Bytevec packet_of(LineTags& tags, std::uint8_t fill, std::size_t size = 40) {
  Bytevec packet(LineTags::kSize + size, fill);
  tags.seal(packet);
  return packet;
}

TEST(LineTags, EachSideOpensWhatTheOtherSealsOnce) {
  Ends ends;
  for (int i = 0; i < 100000; ++i) {  // the numbers on the line wrap three times
    const Bytevec sealed = packet_of(i % 2 != 0 ? ends.client : ends.host, 9);
    LineTags& other = i % 2 != 0 ? ends.host : ends.client;
    Bytevec packet = sealed;
    EXPECT_FALSE(Doorkeeper::is_word(packet));
    ASSERT_TRUE(other.open(packet)) << i;
    EXPECT_EQ(packet.back(), 9);
    packet = sealed;
    ASSERT_FALSE(other.open(packet)) << "again";
    packet = sealed;
    ASSERT_FALSE((i % 2 != 0 ? ends.client : ends.host).open(packet)) << "sent back";
  }
}

TEST(LineTags, PacketsMayBeLostAndOvertakeEachOther) {
  Ends ends;
  Pcg32 random = Pcg32::seeded(5);
  std::vector<Bytevec> under_way;
  int opened = 0, lost = 0;
  for (int i = 0; i < 20000; ++i) {
    under_way.push_back(packet_of(ends.client, 1));
    if (under_way.size() < 100) continue;
    const std::uint32_t at = random_below(random, 50);
    if (random_below(random, 3) == 0) {
      ++lost;
    } else {
      opened += ends.host.open(under_way[at]) ? 1 : 0;
    }
    under_way.erase(under_way.begin() + at);
  }
  EXPECT_EQ(opened + lost, 20000 - 99);
  // A line that loses ten thousand in a row goes on.
  for (int i = 0; i < 10000; ++i) packet_of(ends.client, 1);
  Bytevec next = packet_of(ends.client, 1);
  EXPECT_TRUE(ends.host.open(next));
}

TEST(LineTags, OpenNothingThatIsAlteredCutOrOfAnotherLine) {
  Ends ends;
  for (int i = 0; i < 40; ++i) {
    Bytevec before = packet_of(ends.client, 2);
    ASSERT_TRUE(ends.host.open(before));
  }
  const Bytevec sealed = packet_of(ends.client, 3);
  for (std::size_t bit = 0; bit < 8 * sealed.size(); ++bit) {
    Bytevec altered = sealed;
    altered[bit / 8] = static_cast<std::uint8_t>(altered[bit / 8] ^ 1 << bit % 8);
    if (bit == 7) continue;  // that makes a word of it
    ASSERT_FALSE(ends.host.open(altered)) << bit;
  }
  for (std::size_t size = 0; size < sealed.size(); ++size) {
    Bytevec cut(sealed.begin(), sealed.begin() + static_cast<std::ptrdiff_t>(size));
    ASSERT_FALSE(ends.host.open(cut)) << size;
  }
  for (const std::uint64_t nonce : {kNonce + 1, std::uint64_t{0}}) {
    LineTags other = Doorkeeper(key_of(7), {}).tags(nonce, true);
    Bytevec packet = packet_of(other, 3);
    EXPECT_FALSE(ends.host.open(packet));
  }
  LineTags keyless = Doorkeeper({}, {}).tags(kNonce, true);
  Bytevec packet = packet_of(keyless, 3);
  EXPECT_FALSE(ends.host.open(packet)) << "without the match's key";
  Bytevec good = sealed;
  EXPECT_TRUE(ends.host.open(good)) << "nothing of it counted";
}

}  // namespace line_guard_test
}  // namespace isostep::transport
