// What a configuration may be.
// SPDX-License-Identifier: MIT
#include "isostep/session/config.hpp"

#include "isostep/session/protocol/message.hpp"

namespace isostep {

constexpr Time kDay = 24 * 3600 * kSecond;  // [us] sums with it stay in range

const char* problem_of(const SessionConfig& config) {
  if (config.players < 1 || config.players > static_cast<int>(kMaxPlayers)) return "players: 1 to 32";
  if (config.local_players < 0 || config.local_players > config.players) return "local_players: 0 to players";
  if (config.hz < 1 || config.hz > 1000) return "hz: 1 to 1000";
  if (config.window < 0 || config.window > 60) return "window: 0 to 60 frames";
  if (config.least_delay < 0 || config.most_delay < config.least_delay || config.most_delay > kMostDelay) {
    return "least_delay, most_delay: 0 to 60 frames, in order";
  }
  if (config.delay < config.least_delay || config.delay > config.most_delay) {
    return "delay: from least_delay to most_delay";
  }
  if (config.deadline < 0 || config.deadline > kMostDeadline) return "deadline: 0 to 60 frames";
  // A player who is cut off has stepped at most two windows and the host's delay beyond its last accepted input.
  if (config.kept < 2 * config.window + config.most_delay + 4 || config.kept > 4096) {
    return "kept: 2 * window + most_delay + 4 states or more, up to 4096";
  }
  if (config.history < 2 * config.kept || config.history > 1 << 20) return "history: 2 * kept frames or more";
  if (config.most_replayed < 0) return "most_replayed: 0 frames or more";
  if (config.max_peers < 1 || config.max_peers > 256) return "max_peers: 1 to 256";
  if (config.max_strangers < 0 || config.max_strangers > 1024) return "max_strangers: 0 to 1024";
  if (config.relays && (config.mode != SessionMode::spectator || config.host)) return "relays: of a spectator";
  if (config.broadcast_delay < 0 || config.broadcast_delay > config.history / 2 - config.kept) {
    return "broadcast_delay: 0 to history / 2 - kept frames";
  }
  if (config.broadcast_delay > 0 && !config.relays) return "broadcast_delay: of a relay";
  if (config.seat < -1 || config.seat >= config.players) return "seat: below players, or -1";
  if (config.credential.size() > kCredentialCap) return "credential: 256 bytes or fewer";
  if (config.most_packets < 2 * static_cast<std::uint32_t>(config.hz)) return "most_packets: 2 * hz or more";
  if (config.migration > kDay || (config.migration > 0 && config.migration < kSecond / 4)) {
    return "migration: a quarter of a second to a day, or 0";
  }
  if (config.migration > 0 && !config.address.view().empty() && config.seed == 0) {
    return "seed: of who may become the host, a random number other than 0";
  }
  const bool is_match = config.mode != SessionMode::sync_test && config.mode != SessionMode::replay;
  if (config.host && is_match && config.seed == 0) return "seed: of a host, a random number other than 0";
  if (config.mode == SessionMode::sync_test && config.window < 1)
    return "window: a sync test rolls back 1 or more frames";
  if (!config.saved_match.empty() && (!config.host || !is_match)) return "saved_match: of a host";
  return nullptr;
}

}  // namespace isostep
