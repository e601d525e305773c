// The way from iso_session_config to SessionConfig, and what is wrong with one or with a game.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/session/config.hpp"
#include "session_game.hpp"
#include "status.hpp"

namespace isostep::c {

/// The problem of a caller's struct: a status, and for ISO_REFUSED and ISO_BAD_ENUM the field and the values that it
/// may have. A struct may have any size; members that it does not hold keep their defaults.
struct Problem {
  iso_status status = ISO_OK;
  const char* text = "";
};
inline iso_status refuse(const Problem& problem, const char* call, const char* what) {
  return refuse(problem.status, call, what, problem.text);
}
Problem read_config(const iso_session_config* from, iso_session_config& to);
Problem read_game(const iso_game* from, iso_game& to);

/// Converts a configuration without a problem. The identity is still to be set.
SessionConfig to_session_config(const iso_session_config& config);
/// The identity of a game. `world` is null where the game has none.
Result<ReplayHeader> identity_of_game(const iso_game& game, const SessionWorld* world, const char* name);

}  // namespace isostep::c
