// Guards of UDP lines, before ENet's packets and around them: the proof of an address, and a tag on each packet.
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "isostep/core/bytes.hpp"
#include "isostep/session/protocol/siphash.hpp"
#include "transport/replay_window.hpp"

namespace isostep::transport {

/// That the machines of a match share and nobody else has; all zeros: they share none.
using PacketKey = std::array<std::uint8_t, 16>;

/// The sender of a packet, in any order of bytes that is always the same.
struct Source {
  std::uint32_t host = 0;
  std::uint16_t port = 0;
};

/// The tags of one connection. Each direction has a key of its own, from the match's and what the connecting side drew,
/// and numbers its packets: what is forged, altered, sent back or sent again is not opened.
///     packet   number, 15 bits below a zero; 48 bits of its tag; ENet's packet
/// Source:  RFC 3711 sec. 3.3.1 (numbers of which the packet has the low bits), SipHash-2-4 (the tag).
class LineTags {
 public:
  static constexpr std::size_t kSize = 8;  // [bytes] before the packet

  LineTags() = default;
  LineTags(const PacketKey& key, std::uint64_t nonce, bool connects);
  /// Writes the first kSize bytes of what will be sent.
  void seal(std::span<std::uint8_t> packet);
  /// Opens a packet. Returns false where it is not the other side's, or came before. Overwrites the first kSize bytes.
  bool open(std::span<std::uint8_t> packet);

 private:
  SipKey out_ = {0, 0}, in_ = {0, 0};
  std::uint64_t sent_ = 0;
  ReplayWindow window_;
};

/// The words by which who connects proves that it hears what is sent to its address. Who is connected to keeps nothing
/// until then, and says no more than it heard.
///     ask        0x81, version, nonce, zeros, tag           29 bytes; again until it is answered
///     challenge  0x82, nonce, cookie, tag                   29 bytes
///     open       0x83, nonce, cookie, packet with LineTags  81 bytes with ENet's CONNECT
/// Tags here are 64 bits by the match's key. The cookie is the time and its hash with address and nonce, by a secret
/// that who made it shares with nobody.
/// Source:  RFC 9147 sec. 5.1 (the cookie of DTLS).
/// Differs: a tag on the first word too, so that a stranger without the match's key is not answered at all.
class Doorkeeper {
 public:
  static constexpr std::size_t kWord = 29;          // [bytes] of an ask or a challenge
  static constexpr std::size_t kOpen = 1 + 8 + 12;  // [bytes] before an open's packet
  /// [ms] A cookie holds for so long: a slow line's round trip, and little for who heard it on the way.
  static constexpr std::uint32_t kLife = 4000;

  using Word = std::array<std::uint8_t, kWord>;
  using Cookie = std::array<std::uint8_t, 12>;

  Doorkeeper() = default;
  Doorkeeper(const PacketKey& key, const SipKey& secret) : key_(key), secret_(secret) {}

  /// These bytes are no packet with LineTags.
  static bool is_word(Bytes bytes) { return !bytes.empty() && (bytes[0] & 0x80) != 0; }
  LineTags tags(std::uint64_t nonce, bool connects) const { return {key_, nonce, connects}; }

  // These are of the side that connects.
  Word ask(std::uint64_t nonce) const;
  std::optional<Cookie> take_challenge(Bytes challenge, std::uint64_t nonce) const;
  static void write_open(std::uint64_t nonce, const Cookie& cookie, std::span<std::uint8_t, kOpen> out);

  // These are of the side that is connected to. Times are in ms and may wrap.
  std::optional<Word> answer(Bytes ask, const Source& source, std::uint32_t now) const;
  /// The nonce of an open whose sender has proved its address.
  std::optional<std::uint64_t> take_open(Bytes open, const Source& source, std::uint32_t now) const;

 private:
  void sign(Word& word) const;
  bool is_signed(Bytes word) const;
  std::uint64_t proof(const Source& source, std::uint64_t nonce, std::uint32_t time) const;

  PacketKey key_ = {};
  SipKey secret_ = {0, 0};
};

}  // namespace isostep::transport
