// preset: the settings of a session for five kinds of games. A start: a game may change any field of them.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/session/config.hpp"

namespace isostep {

/// What a game asks of its session. CHOOSING.md has what each of these gives on good and on bad lines.
enum class Genre : std::uint8_t {
  fighting,  // two players; a frame of delay is felt
  brawler,   // a few players on one small stage
  racing,    // many players; a step is cheap, and others' cars may be corrected
  strategy,  // orders now and then; nothing that is shown may be taken back
  sandbox    // a thousand awake bodies: a step is dear, and a rollback of many frames takes longer than a frame
};

/// Mode, window, delays and deadline of `genre`, for so many players. Who hosts, the seed, `migration` and the game's
/// identity are still to be set.
SessionConfig preset(Genre genre, int players);

}  // namespace isostep
