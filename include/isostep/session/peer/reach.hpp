// Which lines a match covers: how long inputs wait at most, and what is too far away for that.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/session/config.hpp"
#include "isostep/session/pace/input_delay.hpp"

namespace isostep {

/// [frames] that may be stepped on guesses.
Frame window_of(const SessionConfig& config);
InputDelay::Settings delay_settings(const SessionConfig& config);
/// Returns true if no delay covers such a line: its player's inputs come after the deadline whatever its machine does.
/// `was`: the last result, which a round trip that is shorter by a sixteenth does not change.
bool is_out_of_reach(const SessionConfig& config, Time period, Time round_trip, bool was);

}  // namespace isostep
