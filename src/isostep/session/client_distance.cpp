// How far a client is from its host.
// SPDX-License-Identifier: MIT
#include "isostep/session/client_distance.hpp"

namespace isostep {
namespace {

constexpr Frame kBeforeBlock = 2;  // [frames] of a rollback window that are kept free of lateness that is usual
// By what we run later our own inputs come later, and our delay grows by as much. Beyond a third of what it may grow
// by, the others are asked to wait as well, so that a very bad line does not use up all delay there is.
constexpr Frame kLagShare = 3;

InputDelay::Settings lag_settings(const SessionConfig& config) {
  const Frame most = (config.most_delay - config.least_delay) / kLagShare;
  const bool rolls_back = config.mode == SessionMode::rollback && config.window > kBeforeBlock;
  return {.start = 0, .least = 0, .most = most, .wanted_slack = rolls_back ? kBeforeBlock - config.window : 0};
}

}  // namespace

Distance::Distance(const SessionConfig& config, const PeerLink& host, FrameClock& clock)
    : config_(config), host_(host), clock_(clock), lag_(lag_settings(config)) {}

void Distance::restart() {
  clock_.forget_lean();
  lag_ = InputDelay(lag_settings(config_));
  is_far_ = knows_way_ = false;
}

void Distance::hear(bool is_far) {
  if (is_far_ && !is_far) lag_ = InputDelay(lag_settings(config_));
  is_far_ = is_far;
}

Frame Distance::find_way(bool is_over_host) {
  if (knows_way_ || host_.round_trip == 0) return 0;
  knows_way_ = true;
  const Time way = is_over_host ? host_.round_trip : host_.round_trip / 2;
  return static_cast<Frame>(way / clock_.period()) + 1;
}

Frame Distance::observe(Frame slack) {
  if (!is_far_ || slack == RecentLeast::kNothing) return 0;
  const Frame before = lag_.frames();
  lag_.observe(slack);
  return lag_.frames() > before ? lag_.frames() - before : 0;
}

std::int64_t Distance::host_position(Time now) const {
  const auto way = static_cast<std::int64_t>(host_.round_trip / 2 * 256 / clock_.period());
  return host_.position.at(now, clock_.period()) + way - std::int64_t{config_.broadcast_delay} * 256;
}

void Distance::lean(Time now, Frame present) {
  const Time until = clock_.until_due(now);
  const Time done = until < clock_.period() ? clock_.period() - until : 0;
  const std::int64_t ours = std::int64_t{present} * 256 + static_cast<std::int64_t>(done * 256 / clock_.period());
  const std::int64_t ahead = ours + std::int64_t{lag_.frames()} * 256 - host_position(now);
  constexpr std::int64_t kCap = 256 * 64;  // [1/256 frame]
  clock_.lean(static_cast<std::int32_t>(ahead < -kCap ? -kCap : ahead > kCap ? kCap : ahead));
}

}  // namespace isostep
