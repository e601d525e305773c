// MatchPeer: what its session is told, what it says of it, and what it leaves behind.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdio>
#include <nlohmann/json.hpp>
#include <random>

#include "isostep/store/state.hpp"
#include "match_peer.hpp"
#include "network.hpp"

namespace isostep::tool {

inline constexpr Time kTryAgain = kSecond / 2;   // [us] between attempts to reach a host
inline constexpr Time kPatience = 20 * kSecond;  // [us] without a host, or that a host that is done stays for others

/// A seed from the system: nobody else can know it.
inline std::uint64_t secret_seed() {
  std::random_device random;
  std::uint64_t seed = 0;
  while (seed == 0) seed = std::uint64_t{random()} << 32 | random();
  return seed;
}

inline Time patience_of(const PeerOptions& options) {
  return options.patience == 0 ? kPatience : static_cast<Time>(options.patience) * kSecond;
}

inline const char* name_of(SessionEvent::Kind kind) {
  switch (kind) {
    case SessionEvent::Kind::started: return "started";
    case SessionEvent::Kind::joined: return "joined";
    case SessionEvent::Kind::left: return "left";
    case SessionEvent::Kind::waiting_for: return "waiting";
    case SessionEvent::Kind::resumed: return "resumed";
    case SessionEvent::Kind::replaced: return "inputs replaced";
    case SessionEvent::Kind::too_far: return "too far away";
    case SessionEvent::Kind::paused: return "paused";
    case SessionEvent::Kind::unpaused: return "no longer paused";
    case SessionEvent::Kind::speed_changed: return "speed changed";
    case SessionEvent::Kind::asks_pause: return "asks for a pause";
    case SessionEvent::Kind::asks_unpause: return "asks to go on";
    case SessionEvent::Kind::asks_speed: return "asks for a speed";
    case SessionEvent::Kind::vote: return "vote";
    case SessionEvent::Kind::vote_passed: return "vote passed";
    case SessionEvent::Kind::vote_failed: return "vote failed";
    case SessionEvent::Kind::slowed_by: return "slowed by";
    case SessionEvent::Kind::full_speed: return "full speed";
    case SessionEvent::Kind::refused: return "refused";
    case SessionEvent::Kind::lost_host: return "lost the host";
    case SessionEvent::Kind::desync: return "DESYNC";
    case SessionEvent::Kind::outvoted: return "outvoted";
    case SessionEvent::Kind::undecided: return "undecided";
    case SessionEvent::Kind::repaired: return "repaired";
    case SessionEvent::Kind::bad_snapshot: return "bad snapshot";
    case SessionEvent::Kind::misuse: return "misuse";
    case SessionEvent::Kind::unhashed: return "unhashed state";
    case SessionEvent::Kind::seeks_host: return "host gone, seeking another";
    case SessionEvent::Kind::new_host: return "new host";
    case SessionEvent::Kind::deposed: return "no longer the host";
  }
  return "?";
}

template <class S>
SessionConfig MatchPeer<S>::config_of(const PeerOptions& options, const Address& own_address, const Game& game) {
  SessionConfig config;
  config.mode = options.spectate   ? SessionMode::spectator
                : options.lockstep ? SessionMode::lockstep
                                   : SessionMode::rollback;
  config.host = options.connect.empty();
  config.players = options.players;
  config.local_players = config.host && !options.spectate ? 1 : 0;
  if (config.host && options.spectate) config.mode = options.lockstep ? SessionMode::lockstep : SessionMode::rollback;
  config.window = options.window;
  config.delay = options.delay;
  if (options.patience != 0) config.silence = config.patience = patience_of(options);
  if (options.reservation >= 0) config.reservation = static_cast<Time>(options.reservation) * kSecond;
  if (options.replayed >= 0) config.most_replayed = options.replayed;
  config.migration = static_cast<Time>(options.migration) * kSecond;
  config.address = own_address;
  config.seed = secret_seed();
  config.identity = match_identity(game);
  if (const char* problem = problem_of(config)) throw ToolError(exit_status::kUsage, problem);
  return config;
}

template <class S> void MatchPeer<S>::take(const transport::Arrival& arrival, Time now) {
  switch (arrival.kind) {
    case transport::ArrivalKind::connected:
      has_met_ = true;
      session_.connected(arrival.peer, now, arrival.incoming);
      break;
    case transport::ArrivalKind::disconnected:
      session_.disconnected(arrival.peer, now);
      if (!is_host()) reconnect_at_ = now + kTryAgain;
      break;
    case transport::ArrivalKind::message: session_.receive(arrival.peer, arrival.channel, arrival.bytes, now); break;
  }
}

template <class S> void MatchPeer<S>::reconnect(Time now) {
  if (is_host()) return;
  if (must_reconnect_) reconnect_at_ = now + kTryAgain;
  must_reconnect_ = false;
  if (session_.stats().peers > 0 || alone_since_ == 0) alone_since_ = now;
  if (now > alone_since_ + patience_of(options_)) gave_up_ = true;
  if (reconnect_at_ == 0 || now < reconnect_at_) return;
  reconnect_at_ = 0;
  // It may have another host by now, or be on the way to one.
  const SessionPhase phase = session_.phase();
  const bool is_alone = phase == SessionPhase::waiting || phase == SessionPhase::lost || phase == SessionPhase::refused;
  if (is_alone) static_cast<void>(transport_.connect_again().ok());
}

template <class S> scenes::MatchInput MatchPeer<S>::input_of(int player) const {
  const Frame frame = session_.current();
  if (options_.inputs.empty()) return scenes::bot_input(options_.bot, player, frame);
  const auto i = static_cast<std::size_t>(frame);
  return i < inputs_.size() ? inputs_[i] : scenes::MatchInput{};
}

template <class S> void MatchPeer<S>::report(const SessionEvent& event) {
  std::string line = "frame " + std::to_string(session_.current()) + ": " + name_of(event.kind);
  if (event.kind == SessionEvent::Kind::refused) {
    line += ": " + std::string(event.field.key.view()) + " is \"" + std::string(event.field.in_file.view()) +
            "\" on the client, \"" + std::string(event.field.here.view()) + "\" on the host";
    // A seat becomes free when the host gives up its player, or no longer keeps it; nothing else changes by waiting.
    must_reconnect_ = event.field.key.view() == "seats";
    if (!is_host() && !must_reconnect_) gave_up_ = true;
  } else if (event.kind == SessionEvent::Kind::waiting_for) {
    line += " for player";
    for (int p = 0; p < options_.players; ++p) {
      if ((event.players >> p & 1) != 0) line += " " + std::to_string(p);
    }
  } else if (event.kind == SessionEvent::Kind::outvoted) {
    line += ": most machines have other states than " +
            (event.player == 0xff ? std::string("the host") : "player " + std::to_string(event.player));
  } else if (event.kind == SessionEvent::Kind::desync) {
    line += ": " + (event.player == 0xff ? std::string("the host") : "player " + std::to_string(event.player)) +
            " has another history: alike up to state " + std::to_string(event.agreed) + ", not at state " +
            std::to_string(event.frame);
    desynced_ = true;
  } else if (event.player != 0xff) {
    line += ": player " + std::to_string(event.player) + " from frame " + std::to_string(event.frame);
  }
  must_reconnect_ = must_reconnect_ || event.kind == SessionEvent::Kind::lost_host;
  has_new_host_ = has_new_host_ || event.kind == SessionEvent::Kind::new_host;
  say(line);
  if (event.kind == SessionEvent::Kind::desync) write_desync_bundle(event);
}

template <class S> void MatchPeer<S>::report_progress() {
  const SnapshotProgress progress = session_.snapshot_progress();
  if (!is_host() && progress.size > 0) {
    const auto tenths = static_cast<std::uint32_t>(std::uint64_t{progress.arrived} * 10 / progress.size) + 1;
    if (tenths != told_tenths_) {
      say("snapshot: " + std::to_string(progress.arrived) + " of " + std::to_string(progress.size) + " bytes");
    }
    told_tenths_ = tenths;
  } else {
    told_tenths_ = 0;
  }
  const int machines = session_.stats().machines;
  if (machines != told_machines_) say("machines that can decide about another host: " + std::to_string(machines));
  told_machines_ = machines;
}

/// "host", "player 1" or "client": several peers may write to one terminal.
template <class S> std::string MatchPeer<S>::name() const {
  if (is_host()) return "host";
  return session_.local_player() < 0 ? "client" : "player " + std::to_string(session_.local_player());
}

template <class S> void MatchPeer<S>::say(const std::string& line) const {
  std::fprintf(stderr, "isostep peer %s: %s\n", name().c_str(), line.c_str());
}

template <class S> void MatchPeer<S>::write_desync_bundle(const SessionEvent& event) {
  if (options_.bundle.empty()) return;
  ReplayFile file(options_.bundle);
  const std::uint32_t player = session_.local_player() < 0 ? 0xff : static_cast<std::uint32_t>(session_.local_player());
  // The state after which the peers part is one of these, however far apart two reports came.
  const auto states = static_cast<std::uint32_t>(event.frame - event.agreed);
  file.check(
      write_bundle(file.sink(), history_, kMatchScene, {.player = player, .agreed = event.agreed, .states = states}));
  file.close();
  say("wrote " + options_.bundle + "; compare it with the other peer's: isostep diff A B");
  options_.bundle.clear();
}

/// Turns, as a memory fault does, the lowest bit of a position behind the world's back. Of a velocity, friction may
/// take it back within the step.
template <class S> void MatchPeer<S>::flip_a_bit() {
  auto& states = const_cast<WorldState<S>&>(game_.world().state()).awake.states;
  if (states.empty()) return;
  auto& x = states[states.size() / 2].centre.x;
  x = from_bits<std::remove_reference_t<decltype(x)>>(to_bits(x) ^ 1u);
}

template <class S> bool MatchPeer<S>::is_over(Time now) {
  if (gave_up_) return true;
  if (session_.confirmed() < first_ || session_.confirmed() < options_.frames) return false;
  if (!is_host()) return true;
  if (done_at_ == 0) done_at_ = now;
  return session_.stats().peers == 0 || now > done_at_ + patience_of(options_);
}

template <class S> void MatchPeer<S>::write_files() {
  if (!options_.hashes.empty()) {
    std::string text;
    for (std::size_t i = 0; i < hashes_.size(); ++i) {
      text += std::to_string(first_ + static_cast<Frame>(i)) + " " + hex(hashes_[i]) + "\n";
    }
    write_file(options_.hashes, text);
  }
  if (!recorder_) return;
  file_->check(recorder_->finish());
  file_->close();
}

template <class S> void MatchPeer<S>::print_summary(Time played) const {
  const SessionStats& stats = session_.stats();
  const double seconds = static_cast<double>(played) / 1e6;
  std::uint64_t rollbacks = 0, deepest = 0;
  for (std::uint64_t depth = 0; depth < 65; ++depth) {
    rollbacks += stats.rollbacks[depth];
    if (stats.rollbacks[depth] != 0) deepest = depth;
  }
  const double kb = static_cast<double>(stats.bytes_out) / 1000 / seconds;
  const double ms_per_step = step_ms_ / static_cast<double>(stats.steps);
  if (!options_.json) {
    std::printf("%zu frames final, last hash %s; %llu rollbacks, deepest %llu; %.1f KB/s sent; %.3f ms a step%s\n",
                hashes_.size(), hex(hashes_.back()).c_str(), static_cast<unsigned long long>(rollbacks),
                static_cast<unsigned long long>(deepest), kb, ms_per_step, desynced_ ? "; DESYNC" : "");
    return;
  }
  const nlohmann::ordered_json json = {{"scalar", ScalarTraits<S>::kName},
                                       {"player", session_.local_player()},
                                       {"first", first_},
                                       {"frames", hashes_.size()},
                                       {"hash", hex(hashes_.back())},
                                       {"rollbacks", rollbacks},
                                       {"deepest", deepest},
                                       {"depths", std::vector<std::uint64_t>(stats.rollbacks, stats.rollbacks + 65)},
                                       {"steps", stats.steps},
                                       {"waits", stats.waits},
                                       {"round_trip_ms", static_cast<double>(stats.round_trip) / 1000},
                                       {"delay", stats.delay},
                                       {"kb_per_s", kb},
                                       {"ms_per_step", ms_per_step},
                                       {"events_confirmed", sounds_confirmed_},
                                       {"events_retracted", sounds_retracted_},
                                       {"desync", desynced_},
                                       {"seconds", seconds}};
  std::printf("%s\n", json.dump().c_str());
}

template <class S> int MatchPeer<S>::finish(Time played) {
  if (!hashes_.empty()) {
    write_files();
    print_summary(played);
  }
  if (desynced_) return exit_status::kDifferent;
  if (!gave_up_) return interrupted() ? exit_status::kInterrupted : exit_status::kOk;
  const bool refused = session_.phase() == SessionPhase::refused;
  throw ToolError(exit_status::kNoInput, refused    ? "the host refused this peer"
                                         : has_met_ ? "the host is gone"
                                                    : "no host answers");
}

}  // namespace isostep::tool
