// SealedLink: the keys of one connection: how both sides get them, and what is sealed and opened with them.
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "isostep/core/bytes.hpp"
#include "isostep/session/timeline/frame.hpp"
#include "transport/line_guard.hpp"
#include "transport/replay_window.hpp"

namespace isostep::sealed {

/// A key that the game's lobby gives the machines of a match: one for all of them, or one for each two. A machine that
/// has it is a member; it is 32 bytes from a source of random numbers, and never the same in two matches.
struct LobbyKey {
  std::uint64_t id = 0;  // travels in the clear; who is connected to looks the key up by it
  std::array<std::uint8_t, 32> secret{};
};

/// The key for EnetSettings::key: packets without a tag by the lobby's key are none, ENet's own words included. Where
/// each two machines have a key, the lobby gives one more to all of them for this.
transport::PacketKey packet_key(const LobbyKey& key);

enum class Opened : std::uint8_t {
  good,
  truncated,  // shorter than a seal
  forged,     // of another connection or key, altered, or never sealed
  replayed,   // it came before, or is too old to tell
  displaced   // a reliable message of this connection, but one before it never came
};

/// A handshake of three messages, all on the reliable channel; `e` are X25519 keys drawn for this connection alone.
///     hello    1, version, key id, e of who connects, MAC of these by the lobby's key      58 bytes
///     reply    2, e of who is connected to, sealed nothing                                 53 bytes
///     confirm  sealed nothing                                                              20 bytes
/// Seals are ChaCha20-Poly1305 (RFC 8439) with the count of the sealed as the nonce; each direction and channel has a
/// key of its own, from both `e`, their shared secret and the lobby's key. So other members cannot read along, nobody
/// can later with the lobby's key, and no nonce comes twice under a key.
/// Source:  The Noise protocol framework, pattern NNpsk0.
/// Differs: BLAKE2b once over the whole handshake; a MAC in the hello, so that a stranger's costs no curve.
class SealedLink {
 public:
  static constexpr std::size_t kHello = 58, kReply = 53;  // [bytes]
  static constexpr std::size_t kSeal = 20;                // [bytes] count and tag around what is sealed
  static constexpr std::uint32_t kLastCount = ~std::uint32_t{0};

  enum class Stage : std::uint8_t { none, greeted, answered, open };

  /// Writes the hello of the side that connects. False: the system gives no random numbers.
  bool begin(const LobbyKey& key, std::span<std::uint8_t, kHello> hello);
  /// Takes the reply on the side that connects. False: the sender has not got the key. Else the link is open, and a
  /// confirm is due.
  bool take_reply(const LobbyKey& key, Bytes reply);
  /// Reads on the side that is connected to which key a hello names; false: it is none.
  static bool read_key_id(Bytes hello, std::uint64_t& id);
  /// Answers a hello on the side that is connected to. False: the sender has not got the key.
  bool answer(const LobbyKey& key, Bytes hello, std::span<std::uint8_t, kReply> reply);
  /// Takes the confirm on the side that is connected to. False: it is not from the sender of the hello. Else the link
  /// is open.
  bool take_confirm(Bytes confirm);

  /// Seals into `out`, kSeal bytes longer than `bytes`. False: no counts are left, the connection has to end.
  bool seal(Channel channel, Bytes bytes, std::uint8_t* out);
  /// Opens into `out`, kSeal bytes shorter. Bytes that are not good change nothing.
  Opened open(Channel channel, Bytes sealed, std::uint8_t* out);

  Stage stage() const { return stage_; }
  std::uint64_t key_id() const { return key_id_; }
  /// That we drew: a hello with it is our own, sent back to us.
  bool has_drawn(Bytes hello) const;
  /// Forgets all keys.
  void close();
  /// Counts, for tests, as if so many had been sealed.
  void skip_to(Channel channel, std::uint32_t count) { ways_[kOut][index_of(channel)].count = count; }

 private:
  using Key = std::array<std::uint8_t, 32>;
  struct Way {
    Key key{};
    std::uint32_t count = 0;  // next to be sealed, or of reliable messages opened
  };
  static constexpr std::size_t kIn = 0, kOut = 1;
  static std::size_t index_of(Channel channel) { return static_cast<std::size_t>(channel); }

  bool draw();
  bool derive(const LobbyKey& key, const std::uint8_t* theirs, bool is_first);

  Stage stage_ = Stage::none;
  std::uint64_t key_id_ = 0;
  Key secret_{}, public_{};  // drawn for this connection
  Way ways_[2][2];           // in and out, by channel
  transport::ReplayWindow window_;
};

}  // namespace isostep::sealed
