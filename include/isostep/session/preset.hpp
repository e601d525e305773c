// preset: the settings of a session for five kinds of games. A start: a game may change any field of them.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/session/config.hpp"

namespace isostep {

/// A kind of game, by what it asks of its session. CHOOSING.md shows what each preset gives on good and bad lines.
enum class Genre : std::uint8_t {
  fighting,  // two players; a frame of delay is felt
  brawler,   // a few players on one small stage
  racing,    // many players; a step is cheap, and others' cars may be corrected
  strategy,  // orders now and then; nothing that is shown may be taken back
  sandbox    // a thousand awake bodies: a step is dear, and a rollback of many frames takes longer than a frame
};

/// Returns the mode, window, delays and deadline for `genre` and so many players. The game still sets who hosts, the
/// seed, `migration` and its identity.
SessionConfig preset(Genre genre, int players);

}  // namespace isostep
