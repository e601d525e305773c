// News: what the caller was told of how the match goes on, so that each change is one event.
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "isostep/session/peer/events.hpp"

namespace isostep {

/// In: the situation in the frame `current`. Out: an event if it differs from what was told. Keeps: what was told.
class News {
 public:
  /// Reports that the match runs: once, whoever hosts it and however often we come back to it.
  std::optional<SessionEvent> started(Frame current) {
    if (is_start_told_) return std::nullopt;
    is_start_told_ = true;
    return SessionEvent{.kind = SessionEvent::Kind::started, .frame = current};
  }
  /// Reports that all frames last longer for `player`'s machine, or no longer do.
  std::optional<SessionEvent> pace(bool was_slow, bool is_slow, int player, Frame current) {
    if (was_slow == is_slow && (!is_slow || player == slowest_)) return std::nullopt;
    slowest_ = player;
    if (!is_slow) return SessionEvent{.kind = SessionEvent::Kind::full_speed, .frame = current};
    return SessionEvent{
        .kind = SessionEvent::Kind::slowed_by, .player = static_cast<std::uint8_t>(player), .frame = current};
  }
  int slowest() const { return slowest_; }
  /// Reports that the match waits for these players (a bit each), or for the host's machine.
  std::optional<SessionEvent> stands_for(std::uint32_t players, Frame current) {
    if (stands_ && players == waits_for_) return std::nullopt;
    stands_ = true;
    waits_for_ = players;
    return SessionEvent{.kind = SessionEvent::Kind::waiting_for, .frame = current, .players = players};
  }
  std::optional<SessionEvent> goes_on(Frame current) {
    if (!stands_) return std::nullopt;
    stands_ = false;
    return SessionEvent{.kind = SessionEvent::Kind::resumed, .frame = current};
  }
  /// The players for whom the match waits, as last told; 0: nobody.
  std::uint32_t waits_for() const { return stands_ ? waits_for_ : 0; }
  /// Reports that the player joined or left, if its presence in this final frame has changed.
  std::optional<SessionEvent> plays(int player, bool is_present, Frame frame) {
    const std::uint32_t bit = 1u << player;
    if (((present_ & bit) != 0) == is_present) return std::nullopt;
    present_ ^= bit;
    const SessionEvent::Kind kind = is_present ? SessionEvent::Kind::joined : SessionEvent::Kind::left;
    return SessionEvent{.kind = kind, .player = static_cast<std::uint8_t>(player), .frame = frame};
  }

 private:
  bool is_start_told_ = false, stands_ = false;
  int slowest_ = 0xff;
  std::uint32_t waits_for_ = 0, present_ = 0;  // players, a bit each
};

}  // namespace isostep
