// Tags and cookies by SipHash-2-4.
// SPDX-License-Identifier: MIT
#include "transport/line_guard.hpp"

#include <algorithm>

namespace isostep::transport {
namespace {

constexpr std::uint8_t kAsk = 0x81, kChallenge = 0x82, kOpening = 0x83;
constexpr std::uint8_t kVersion = 1;
constexpr std::size_t kNonceAt = 1, kCookieAt = 9;           // in a challenge and an open
constexpr std::size_t kSigned = Doorkeeper::kWord - 8;       // [bytes] before a word's tag
constexpr std::uint64_t kTagMask = ~std::uint64_t{0} >> 16;  // 48 bits
constexpr std::uint64_t kNumbers = 1 << 15;                  // that a packet tells apart
static_assert(kCookieAt + std::tuple_size_v<Doorkeeper::Cookie> == kSigned && kSigned == Doorkeeper::kOpen);

SipKey key_of(const PacketKey& key) {
  return {load_le<std::uint64_t>(key.data()), load_le<std::uint64_t>(key.data() + 8)};
}

/// Derives the key of one direction. `use` is unlike the first byte of any word.
SipKey derive(const PacketKey& key, std::uint64_t nonce, std::uint8_t use) {
  std::uint8_t text[9] = {use};
  store_le(text + 1, nonce);
  const std::uint64_t low = siphash_2_4(key_of(key), text);
  ++text[0];
  return {low, siphash_2_4(key_of(key), text)};
}

/// The number with these low bits that is nearest to what comes next.
std::uint64_t whole_number(std::uint64_t low, std::uint64_t next) {
  const std::uint64_t number = (next & ~(kNumbers - 1)) | low;
  if (number + kNumbers / 2 < next) return number + kNumbers;
  if (number >= next + kNumbers / 2 && number >= kNumbers) return number - kNumbers;
  return number;
}

}  // namespace

// ---- packets

LineTags::LineTags(const PacketKey& key, std::uint64_t nonce, bool connects)
    : out_(derive(key, nonce, connects ? 0 : 2)), in_(derive(key, nonce, connects ? 2 : 0)) {}

void LineTags::seal(std::span<std::uint8_t> packet) {
  const std::uint64_t number = sent_++;
  store_le(packet.data(), number);  // whole, under the tag
  const std::uint64_t tag = siphash_2_4(out_, packet) & kTagMask;
  const std::uint64_t low = number % kNumbers;
  store_le(packet.data(), tag << 16 | (low & 0xff) << 8 | low >> 8);
}

bool LineTags::open(std::span<std::uint8_t> packet) {
  if (packet.size() < kSize) return false;
  const std::uint64_t word = load_le<std::uint64_t>(packet.data());
  const std::uint64_t number = whole_number((word & 0x7f) << 8 | (word >> 8 & 0xff), window_.end());
  if (!window_.is_fresh(number)) return false;
  store_le(packet.data(), number);
  if ((siphash_2_4(in_, packet) & kTagMask) != word >> 16) return false;
  window_.mark(number);
  return true;
}

// ---- words

void Doorkeeper::sign(Word& word) const {
  store_le(word.data() + kSigned, siphash_2_4(key_of(key_), Bytes(word).first(kSigned)));
}
bool Doorkeeper::is_signed(Bytes word) const {
  return word.size() == kWord &&
         load_le<std::uint64_t>(word.data() + kSigned) == siphash_2_4(key_of(key_), word.first(kSigned));
}
std::uint64_t Doorkeeper::proof(const Source& source, std::uint64_t nonce, std::uint32_t time) const {
  std::uint8_t text[18];
  store_le(text, source.host);
  store_le(text + 4, source.port);
  store_le(text + 6, nonce);
  store_le(text + 14, time);
  return siphash_2_4(secret_, text);
}

Doorkeeper::Word Doorkeeper::ask(std::uint64_t nonce) const {
  Word word = {kAsk, kVersion};
  store_le(word.data() + 2, nonce);
  sign(word);
  return word;
}

std::optional<Doorkeeper::Word> Doorkeeper::answer(Bytes ask, const Source& source, std::uint32_t now) const {
  if (!is_signed(ask) || ask[0] != kAsk || ask[1] != kVersion) return std::nullopt;
  const std::uint64_t nonce = load_le<std::uint64_t>(ask.data() + 2);
  Word word = {kChallenge};
  store_le(word.data() + kNonceAt, nonce);
  store_le(word.data() + kCookieAt, now);
  store_le(word.data() + kCookieAt + 4, proof(source, nonce, now));
  sign(word);
  return word;
}

std::optional<Doorkeeper::Cookie> Doorkeeper::take_challenge(Bytes challenge, std::uint64_t nonce) const {
  if (!is_signed(challenge) || challenge[0] != kChallenge) return std::nullopt;
  if (load_le<std::uint64_t>(challenge.data() + kNonceAt) != nonce) return std::nullopt;
  Cookie cookie;
  std::copy_n(challenge.begin() + kCookieAt, cookie.size(), cookie.begin());
  return cookie;
}

void Doorkeeper::write_open(std::uint64_t nonce, const Cookie& cookie, std::span<std::uint8_t, kOpen> out) {
  out[0] = kOpening;
  store_le(out.data() + kNonceAt, nonce);
  std::copy(cookie.begin(), cookie.end(), out.begin() + kCookieAt);
}

std::optional<std::uint64_t> Doorkeeper::take_open(Bytes open, const Source& source, std::uint32_t now) const {
  if (open.size() < kOpen || open[0] != kOpening) return std::nullopt;
  const std::uint64_t nonce = load_le<std::uint64_t>(open.data() + kNonceAt);
  const std::uint32_t time = load_le<std::uint32_t>(open.data() + kCookieAt);
  if (now - time > kLife) return std::nullopt;
  if (load_le<std::uint64_t>(open.data() + kCookieAt + 4) != proof(source, nonce, time)) return std::nullopt;
  return nonce;
}

}  // namespace isostep::transport
