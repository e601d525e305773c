// Datagrams: what host, client and relay write into datagrams alike, and what they read from each.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/session/pace/frame_clock.hpp"
#include "isostep/session/peer/peer_link.hpp"
#include "isostep/session/peer/session_core.hpp"
#include "isostep/session/timeline/hash_log.hpp"

namespace isostep {

/// Inputs of each player travel to a peer before this frame; 0: none.
struct SendEnds {
  Frame of[kMaxPlayers] = {};
};

/// In: bytes of a peer, and a header for it. Out: packets that were read, datagrams, and the peer's link, as it is now.
/// Keeps: the bytes of the last datagram.
class Datagrams {
 public:
  Datagrams(const SessionConfig& config, const std::vector<InputStream>& streams, const HashLog& hashes,
            const FrameClock& clock, SessionStats& stats)
      : config_(config), streams_(streams), hashes_(hashes), clock_(clock), stats_(stats) {}

  /// Counts, guards against floods, reads; false: to be ignored.
  bool accept(PeerLink& link, Bytes bytes, Time now, Packet& packet);
  bool accept_message(PeerLink& link, Bytes bytes, Time now);
  /// `is_after_pause`: of ours, so nobody knows when it arrived.
  void take_header(PeerLink& link, const PacketHeader& header, const SendEnds& ends, bool is_after_pause,
                   Time now) const;
  /// With at most `most` frames of a player; valid until the next. `present`: our next frame.
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
