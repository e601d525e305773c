// EnetLines: stands between an ENet host and its socket, so that ENet hears only who proved its address and has tags.
// SPDX-License-Identifier: MIT
#pragma once

#include <enet/enet.h>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "transport/enet_guard.hpp"
#include "transport/line_guard.hpp"

namespace isostep::transport {

/// It works by ENet's two hooks: `intercept` has every packet that came before ENet reads it, `checksum` every packet
/// that goes before it is sent. The four bytes that ENet keeps for a checksum are not sent.
class EnetLines {
 public:
  /// `accepts`: connections that others ask for.
  EnetLines(const Doorkeeper& door, bool accepts) : door_(door), accepts_(accepts) {}
  EnetLines(const EnetLines&) = delete;
  EnetLines& operator=(const EnetLines&) = delete;

  /// Sets the hooks, and outlives the host.
  void guard(ENetHost* host);
  /// Begins the connection that was just asked for: what ENet sends as its CONNECT waits for the other side's
  /// challenge.
  void begin(ENetPeer* peer, std::uint64_t nonce);

  std::uint64_t refused() const { return refused_; }
  /// The traffic since the last call, beside what ENet sent itself.
  struct Sent {
    std::uint64_t packets = 0, bytes = 0;
  };
  Sent take_sent();

 private:
  static int ENET_CALLBACK intercept(ENetHost* host, ENetEvent* event);
  static enet_uint32 ENET_CALLBACK before_sending(const ENetBuffer* buffers, size_t count);

  bool take(std::span<std::uint8_t> packet);
  bool take_packet(std::span<std::uint8_t> packet);
  bool take_open(std::span<std::uint8_t> open);
  ENetPeer* place_for(const ENetAddress& address, std::uint32_t connect_id) const;
  bool take_challenge(Bytes challenge);
  bool answer(Bytes ask);
  bool show(std::span<std::uint8_t> packet);
  void send(const ENetAddress& to, Bytes bytes);
  void seal();
  LineTags* tags_to(std::uint32_t connect_id, std::uint32_t peer_there);

  Doorkeeper door_;
  bool accepts_ = false;
  ENetHost* host_ = nullptr;
  std::vector<LineTags> tags_;  // by ENet's index of the peer
  /// Nonces of the opens that were let in last: each opens once, also within the life of its cookie.
  std::array<std::uint64_t, 256> opened_ = {};
  std::size_t next_opened_ = 0;
  std::uint64_t refused_ = 0;
  Sent sent_;

  // The connection that we asked for last.
  ENetPeer* asked_ = nullptr;
  std::uint64_t nonce_ = 0;
  bool awaits_challenge_ = false;  // one for each ask
  Doorkeeper::Word ask_ = {};
  std::uint8_t connect_[Doorkeeper::kOpen + kPacketCap];  // an open around ENet's CONNECT
  std::size_t connect_size_ = 0;

  std::uint8_t out_[kPacketCap];  // the packet that goes
};

}  // namespace isostep::transport
