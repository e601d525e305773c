// ClientParts: what most components of a client look at.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/session/client/entry.hpp"
#include "isostep/session/client/own_seats.hpp"
#include "isostep/session/client/partings.hpp"
#include "isostep/session/pace/frame_clock.hpp"
#include "isostep/session/peer/session_core.hpp"

namespace isostep {

/// The standing of this client at the host to which it connected last.
enum class Standing : std::uint8_t {
  unknown,
  greeted,  // it has welcomed us
  runs      // and the match runs
};

struct ClientParts {
  const SessionConfig& config;
  const InputRules& rules;
  std::vector<InputStream>& streams;
  Timeline& timeline;
  const FrameClock& clock;
  const Frame& catches_up_to;  // see PeerCore
  SessionStats& stats;
  EventQueue& events;
  SessionPhase& phase;
  PeerLink& host;
  const Standing& standing;
  OwnSeats& own;
  const Entry& entry;
  Partings& partings;

  Frame present() const { return catches_up_to > timeline.current() ? catches_up_to : timeline.current(); }
  bool is_greeted() const { return standing != Standing::unknown; }
  void tell_of(SessionEvent::Kind kind) const { events.tell({.kind = kind, .frame = timeline.current()}); }
  /// Reports that the host, or our place at it, is gone, and enters the phase `now`.
  void fail(SessionEvent::Kind kind, SessionPhase now) const {
    phase = now;
    tell_of(kind);
  }
};

}  // namespace isostep
