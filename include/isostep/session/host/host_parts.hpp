// HostParts: what most components of a host look at.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/session/host/guests.hpp"
#include "isostep/session/host/seats.hpp"
#include "isostep/session/peer/session_core.hpp"

namespace isostep {

struct HostParts {
  const SessionConfig& config;
  Seats& seats;
  Guests& guests;
  const Timeline& timeline;
  SessionStats& stats;
  EventQueue& events;
  const bool& has_begun;  // the match runs
  const Time& now;        // [us] of the last frame of time
};

}  // namespace isostep
