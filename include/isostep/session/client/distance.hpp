// Distance: how far a client is from its host: where that is by now, and how much later the client runs.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/session/config.hpp"
#include "isostep/session/pace/frame_clock.hpp"
#include "isostep/session/pace/input_delay.hpp"
#include "isostep/session/peer/peer_link.hpp"

namespace isostep {

/// In: what the link measures, and what the host says of our line. Out: how many frames we are behind or lag, and a
/// clock that leans. Keeps: the lag, by which we run behind the host if our line is so much worse than the others' that
/// they do not wait for it. Whoever runs later gets their inputs in time.
class Distance {
 public:
  Distance(const SessionConfig& config, const PeerLink& host, FrameClock& clock)
      : config_(config), host_(host), clock_(clock) {}

  /// Begins anew behind another host, or from another state.
  void restart() {
    clock_.forget_lean();
    lag_ = InputDelay(lag_settings(config_));
    is_far_ = knows_way_ = false;
  }
  /// `is_far`: the host says that the others do not wait for our line.
  void hear(bool is_far) {
    if (is_far_ && !is_far) lag_ = InputDelay(lag_settings(config_));
    is_far_ = is_far;
  }
  /// Returns how many frames an input travels to those who wait for it: once, when it is first known; else 0.
  Frame find_way(bool is_over_host) {
    if (knows_way_ || host_.round_trip == 0) return 0;
    knows_way_ = true;
    return static_cast<Frame>((is_over_host ? host_.round_trip : host_.round_trip / 2) / clock_.period()) + 1;
  }
  Frame lag() const { return lag_.frames(); }
  bool may_lag_more() const { return is_far_ && !lag_.is_at_most(); }
  /// Takes the slack of the others' latest input. Returns by how many frames we run later from now on.
  Frame observe(Frame slack) {
    if (!is_far_ || slack == RecentLeast::kNothing) return 0;
    const Frame before = lag();
    lag_.observe(slack);
    return lag() > before ? lag() - before : 0;
  }
  Frame behind(Time now, Frame present) const { return static_cast<Frame>(host_position(now) / 256 - present); }
  void lean(Time now, Frame present) {
    const Time until = clock_.until_due(now);
    const Time done = until < clock_.period() ? clock_.period() - until : 0;
    const std::int64_t ours = std::int64_t{present} * 256 + static_cast<std::int64_t>(done * 256 / clock_.period());
    const std::int64_t ahead = ours + std::int64_t{lag()} * 256 - host_position(now);
    constexpr std::int64_t kCap = 256 * 64;  // [1/256 frame] beyond it the clock leans no more
    clock_.lean(static_cast<std::int32_t>(ahead < -kCap ? -kCap : ahead > kCap ? kCap : ahead));
  }

 private:
  static constexpr Frame kBeforeBlock = 2;  // [frames] of a rollback window that are kept free of usual lateness
  // By what we run later our own inputs come later, and our delay grows by as much. Beyond a third of what it may grow
  // by, the others are asked to wait as well, so that a very bad line does not use up all delay there is.
  static constexpr Frame kLagShare = 3;

  static InputDelay::Settings lag_settings(const SessionConfig& config) {
    const Frame most = (config.most_delay - config.least_delay) / kLagShare;
    const bool rolls_back = config.mode == SessionMode::rollback && config.window > kBeforeBlock;
    return {.start = 0, .least = 0, .most = most, .wanted_slack = rolls_back ? kBeforeBlock - config.window : 0};
  }
  /// [1/256 frame] The estimate of the host's next frame, less the broadcast delay of a relay.
  std::int64_t host_position(Time now) const {
    const auto way = static_cast<std::int64_t>(host_.round_trip / 2 * 256 / clock_.period());
    return host_.position.at(now, clock_.period()) + way - std::int64_t{config_.broadcast_delay} * 256;
  }

  const SessionConfig& config_;
  const PeerLink& host_;
  FrameClock& clock_;
  InputDelay lag_{lag_settings(config_)};
  bool is_far_ = false, knows_way_ = false;
};

}  // namespace isostep
