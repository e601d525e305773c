// Delays and windows of a configuration.
// SPDX-License-Identifier: MIT
#include "isostep/session/peer/reach.hpp"

namespace isostep {
namespace {

/// [frames] an input waits at most. Who would lose its inputs to the deadline waits up to half a second for them.
Frame longest_delay(const SessionConfig& config) {
  const bool is_fixed = config.least_delay == config.most_delay;
  const Frame half = config.hz / 2 < kMostDelay ? config.hz / 2 : kMostDelay;
  return config.deadline == 0 || is_fixed || half < config.most_delay ? config.most_delay : half;
}

}  // namespace

Frame window_of(const SessionConfig& config) { return config.mode == SessionMode::rollback ? config.window : 0; }

InputDelay::Settings delay_settings(const SessionConfig& config) {
  InputDelay::Settings settings{config.delay, config.least_delay, config.most_delay};
  // Half the window is a rollback that every frame affords; the other half is for what the network does at its worst.
  const Frame window = window_of(config);
  settings.wanted_slack = -(window / 2);
  settings.latest_slack = -window;
  settings.limit = config.host ? config.most_delay : longest_delay(config);
  // Who waits longer for what others do than the window steps without it falls behind until its inputs are replaced.
  if (config.deadline > 0 && settings.latest_slack < -config.deadline) settings.latest_slack = -config.deadline;
  if (settings.wanted_slack < settings.latest_slack) settings.wanted_slack = settings.latest_slack;
  return settings;
}

bool is_out_of_reach(const SessionConfig& config, Time period, Time round_trip, bool was) {
  if (config.deadline == 0) return false;
  const Time trip = was ? round_trip + round_trip / 16 : round_trip;
  // Others' inputs of a frame come a whole round trip after ours of it are sent.
  const Time delay = static_cast<Time>(longest_delay(config)), window = static_cast<Time>(window_of(config));
  const Time deadline = static_cast<Time>(config.deadline);
  return trip > (delay + window) * period || trip / 2 > (delay + deadline) * period;
}

}  // namespace isostep
