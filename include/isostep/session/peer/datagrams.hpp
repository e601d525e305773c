// Datagrams: what host, client and relay write into datagrams alike, and what they read from each.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/session/pace/frame_clock.hpp"
#include "isostep/session/peer/peer_link.hpp"
#include "isostep/session/peer/session_core.hpp"
#include "isostep/session/timeline/hash_log.hpp"

namespace isostep {

/// The ends of the inputs that a peer is sent, by player; 0: none are sent.
struct SendEnds {
  Frame of[kMaxPlayers] = {};
};

/// In: bytes of a peer, and a header for it. Out: packets that were read, datagrams, and the updated link of the peer.
/// Keeps: the bytes of the last datagram.
class Datagrams {
 public:
  Datagrams(const SessionConfig& config, const std::vector<InputStream>& streams, const HashLog& hashes,
            const FrameClock& clock, SessionStats& stats)
      : config_(config), streams_(streams), hashes_(hashes), clock_(clock), stats_(stats) {}

  /// Counts a datagram, guards against floods, and reads it. Returns false if it is to be ignored.
  bool accept(PeerLink& link, Bytes bytes, Time now, Packet& packet);
  bool accept_message(PeerLink& link, Bytes bytes, Time now);
  /// `is_after_pause`: this machine paused, so the time of arrival is unknown.
  void take_header(PeerLink& link, const PacketHeader& header, const SendEnds& ends, bool is_after_pause,
                   Time now) const;
  /// Writes a datagram with at most `most` frames of a player, valid until the next call. `present`: our next frame.
  Bytes compose(PeerLink& link, PacketHeader header, const SendEnds& ends, Frame present, Frame most, Time now);

 private:
  const SessionConfig& config_;
  const std::vector<InputStream>& streams_;
  const HashLog& hashes_;
  const FrameClock& clock_;
  SessionStats& stats_;
  std::uint8_t buffer_[kDatagramCap];
};

}  // namespace isostep
