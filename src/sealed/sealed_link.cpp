// The handshake, and seals, by libsodium.
// SPDX-License-Identifier: MIT
#include "sealed/sealed_link.hpp"

#include <sodium.h>

#include <algorithm>
#include <cstring>

namespace isostep::sealed {
namespace {

constexpr std::uint8_t kHelloType = 1, kReplyType = 2;
constexpr std::uint8_t kVersion = 1;
constexpr std::size_t kCount = 4, kTag = 16, kCurve = 32;                           // [bytes]
constexpr std::size_t kIdAt = 2, kCurveAt = kIdAt + 8, kMacAt = kCurveAt + kCurve;  // in a hello
static_assert(SealedLink::kHello == kMacAt + kTag && SealedLink::kReply == 1 + kCurve + SealedLink::kSeal);
static_assert(SealedLink::kReply <= SealedLink::kHello, "who answers says no more than it heard");
static_assert(SealedLink::kSeal == kCount + kTag && kTag == crypto_aead_chacha20poly1305_ietf_ABYTES);
static_assert(kCurve == crypto_scalarmult_BYTES && kCurve == crypto_kdf_KEYBYTES);

using Nonce = std::array<std::uint8_t, crypto_aead_chacha20poly1305_ietf_NPUBBYTES>;
using Mac = std::array<std::uint8_t, kTag>;

void write_count(std::uint8_t* out, std::uint32_t count) {
  for (std::size_t i = 0; i < kCount; ++i) out[i] = static_cast<std::uint8_t>(count >> 8 * i);
}
std::uint32_t read_count(Bytes bytes) {
  std::uint32_t count = 0;
  for (std::size_t i = 0; i < kCount; ++i) count |= std::uint32_t{bytes[i]} << 8 * i;
  return count;
}
Nonce nonce_of(std::uint32_t count) {
  Nonce nonce{};
  write_count(nonce.data(), count);
  return nonce;
}

/// One use of the lobby's key: each begins with text that no other has.
class Digest {
 public:
  Digest(const char* use, const LobbyKey& key, std::size_t size) : size_(size) {
    crypto_generichash_init(&state_, key.secret.data(), key.secret.size(), size);
    crypto_generichash_update(&state_, reinterpret_cast<const unsigned char*>(use), std::strlen(use) + 1);
  }
  void add(Bytes bytes) { crypto_generichash_update(&state_, bytes.data(), bytes.size()); }
  void finish(std::uint8_t* out) { crypto_generichash_final(&state_, out, size_); }

 private:
  crypto_generichash_state state_;
  std::size_t size_;
};

Mac mac_of_hello(const LobbyKey& key, Bytes body) {
  Mac mac{};
  Digest digest("isostep hello", key, mac.size());
  digest.add(body);
  digest.finish(mac.data());
  return mac;
}

bool is_hello(Bytes bytes) {
  return bytes.size() == SealedLink::kHello && bytes[0] == kHelloType && bytes[1] == kVersion;
}

}  // namespace

transport::PacketKey packet_key(const LobbyKey& key) {
  transport::PacketKey derived{};
  Digest digest("isostep packets", key, derived.size());
  digest.finish(derived.data());
  return derived;
}

// ---- the handshake

bool SealedLink::draw() {
  static const bool is_ready = sodium_init() >= 0;
  close();
  if (!is_ready) return false;
  randombytes_buf(secret_.data(), secret_.size());
  return crypto_scalarmult_base(public_.data(), secret_.data()) == 0;
}

void SealedLink::close() {
  sodium_memzero(secret_.data(), secret_.size());
  for (auto& way : ways_) {
    for (Way& channel : way) {
      sodium_memzero(channel.key.data(), channel.key.size());
      channel.count = 0;
    }
  }
  window_ = {};
  stage_ = Stage::none;
}

bool SealedLink::has_drawn(Bytes hello) const {
  return stage_ == Stage::greeted && is_hello(hello) &&
         std::equal(public_.begin(), public_.end(), hello.begin() + kCurveAt);
}

/// The keys of all ways. `is_first`: we connected.
bool SealedLink::derive(const LobbyKey& key, const std::uint8_t* theirs, bool is_first) {
  Key shared{}, master{};
  const bool is_point = crypto_scalarmult(shared.data(), secret_.data(), theirs) == 0;  // else one of low order
  Digest digest("isostep seal", key, master.size());
  const Bytes ours(public_), others(theirs, kCurve);
  std::uint8_t id[8];
  for (std::size_t i = 0; i < sizeof id; ++i) id[i] = static_cast<std::uint8_t>(key.id >> 8 * i);
  digest.add({&kVersion, 1});
  digest.add(id);
  digest.add(is_first ? ours : others);
  digest.add(is_first ? others : ours);
  digest.add(shared);
  digest.finish(master.data());
  std::uint64_t number = 0;
  for (const std::size_t way : {is_first ? kOut : kIn, is_first ? kIn : kOut}) {
    for (Way& channel : ways_[way]) {
      crypto_kdf_derive_from_key(channel.key.data(), channel.key.size(), number++, "isostep", master.data());
      channel.count = 0;
    }
  }
  key_id_ = key.id;
  sodium_memzero(shared.data(), shared.size());
  sodium_memzero(master.data(), master.size());
  sodium_memzero(secret_.data(), secret_.size());
  return is_point;
}

bool SealedLink::begin(const LobbyKey& key, std::span<std::uint8_t, kHello> hello) {
  if (!draw()) return false;
  hello[0] = kHelloType;
  hello[1] = kVersion;
  for (std::size_t i = 0; i < 8; ++i) hello[kIdAt + i] = static_cast<std::uint8_t>(key.id >> 8 * i);
  std::copy(public_.begin(), public_.end(), hello.begin() + kCurveAt);
  const Mac mac = mac_of_hello(key, hello.first<kMacAt>());
  std::copy(mac.begin(), mac.end(), hello.begin() + kMacAt);
  key_id_ = key.id;
  stage_ = Stage::greeted;
  return true;
}

bool SealedLink::read_key_id(Bytes hello, std::uint64_t& id) {
  if (!is_hello(hello)) return false;
  id = 0;
  for (std::size_t i = 0; i < 8; ++i) id |= std::uint64_t{hello[kIdAt + i]} << 8 * i;
  return true;
}

bool SealedLink::answer(const LobbyKey& key, Bytes hello, std::span<std::uint8_t, kReply> reply) {
  if (!is_hello(hello)) return false;
  const Mac mac = mac_of_hello(key, hello.first(kMacAt));
  if (sodium_memcmp(mac.data(), hello.data() + kMacAt, mac.size()) != 0) return false;
  if (!draw()) return false;
  reply[0] = kReplyType;
  std::copy(public_.begin(), public_.end(), reply.begin() + 1);
  if (!derive(key, hello.data() + kCurveAt, false)) {
    close();
    return false;
  }
  stage_ = Stage::answered;
  return seal(Channel::reliable, {}, reply.data() + 1 + kCurve);
}

bool SealedLink::take_reply(const LobbyKey& key, Bytes reply) {
  if (stage_ != Stage::greeted || reply.size() != kReply || reply[0] != kReplyType) return false;
  const bool is_point = derive(key, reply.data() + 1, true);
  stage_ = Stage::open;
  if (is_point && open(Channel::reliable, reply.subspan(1 + kCurve), nullptr) == Opened::good) return true;
  close();
  return false;
}

bool SealedLink::take_confirm(Bytes confirm) {
  if (stage_ != Stage::answered || confirm.size() != kSeal) return false;
  if (open(Channel::reliable, confirm, nullptr) != Opened::good) return false;
  stage_ = Stage::open;
  return true;
}

// ---- seals

bool SealedLink::seal(Channel channel, Bytes bytes, std::uint8_t* out) {
  Way& way = ways_[kOut][index_of(channel)];
  if (way.count == kLastCount) return false;
  write_count(out, way.count);
  const Nonce nonce = nonce_of(way.count++);
  crypto_aead_chacha20poly1305_ietf_encrypt(out + kCount, nullptr, bytes.data(), bytes.size(), nullptr, 0, nullptr,
                                            nonce.data(), way.key.data());
  return true;
}

Opened SealedLink::open(Channel channel, Bytes sealed, std::uint8_t* out) {
  if (sealed.size() < kSeal) return Opened::truncated;
  Way& way = ways_[kIn][index_of(channel)];
  const std::uint32_t count = read_count(sealed);
  const bool is_datagram = channel == Channel::datagram;
  if (is_datagram ? !window_.is_fresh(count) : count < way.count) return Opened::replayed;
  const Bytes cipher = sealed.subspan(kCount);
  const Nonce nonce = nonce_of(count);
  if (crypto_aead_chacha20poly1305_ietf_decrypt(out, nullptr, nullptr, cipher.data(), cipher.size(), nullptr, 0,
                                                nonce.data(), way.key.data()) != 0) {
    return Opened::forged;
  }
  if (is_datagram) {
    window_.mark(count);
  } else {
    if (count != way.count) return Opened::displaced;
    ++way.count;
  }
  return Opened::good;
}

}  // namespace isostep::sealed
