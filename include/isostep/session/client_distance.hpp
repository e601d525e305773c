// Distance: how far a client is from its host: where that is by now, and how much later the client runs.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/session/config.hpp"
#include "isostep/session/frame_clock.hpp"
#include "isostep/session/input_delay.hpp"
#include "isostep/session/peer_link.hpp"

namespace isostep {

/// In: what the link measures, and what the host says of our line. Out: frames that we are behind or lag, and a clock
/// that leans. Keeps: the lag, by which we run behind the host when our line is so much worse than the others' that
/// they do not wait for it: their inputs are in time for who runs later.
class Distance {
 public:
  Distance(const SessionConfig& config, const PeerLink& host, FrameClock& clock);

  /// Behind another host, or from another state on.
  void restart();
  /// As the host says: the others do not wait for our line.
  void hear(bool is_far);
  /// [frames] that an input needs to who waits for it, once, when that is known first; 0: not now.
  Frame find_way(bool is_over_host);
  Frame lag() const { return lag_.frames(); }
  bool may_lag_more() const { return is_far_ && !lag_.is_at_most(); }
  /// By how many frames we run later from now on, where others' latest input came with this slack.
  Frame observe(Frame slack);
  Frame behind(Time now, Frame present) const { return static_cast<Frame>(host_position(now) / 256 - present); }
  void lean(Time now, Frame present);

 private:
  /// [1/256 frame] the host's next frame, as we estimate it; less the broadcast delay of a relay.
  std::int64_t host_position(Time now) const;

  const SessionConfig& config_;
  const PeerLink& host_;
  FrameClock& clock_;
  InputDelay lag_;
  bool is_far_ = false, knows_way_ = false;
};

}  // namespace isostep
