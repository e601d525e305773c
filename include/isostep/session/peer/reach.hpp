// Which lines a match covers: how long inputs wait at most, and what is too far away for that.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/session/config.hpp"
#include "isostep/session/pace/input_delay.hpp"

namespace isostep {

/// [frames] that may be stepped on guesses.
Frame window_of(const SessionConfig& config);
InputDelay::Settings delay_settings(const SessionConfig& config);
/// No delay covers such a line: a player's inputs come after the deadline whatever its machine does. `was`: that was
/// said of it, and a sixteenth less does not change it again.
bool is_out_of_reach(const SessionConfig& config, Time period, Time round_trip, bool was);

}  // namespace isostep
