// The settings of each kind of game, and why they are what they are.
// SPDX-License-Identifier: MIT
#include "isostep/session/preset.hpp"

namespace isostep {

SessionConfig preset(Genre genre, int players) {
  SessionConfig config;
  config.players = players;
  switch (genre) {
    case Genre::fighting:
      // Players learn the delay of a match: it hardly moves, and rollbacks take what the line has beyond it.
      config.window = 8;
      config.delay = config.least_delay = 2;
      config.most_delay = 4;
      config.deadline = 8;
      config.patience = 3 * kSecond;
      break;
    case Genre::brawler:
      config.window = 8;
      config.delay = config.least_delay = 1;
      config.most_delay = 6;
      config.deadline = 8;
      break;
    case Genre::racing:
      // Cars go where they went: a guess is seldom far off, so that half of a long window costs little to see.
      config.window = 12;
      config.delay = config.least_delay = 1;
      config.most_delay = 8;
      config.deadline = 12;
      break;
    case Genre::strategy:
      // An order is shown as taken at once and carried out later: 20 frames are a third of a second.
      config.mode = SessionMode::lockstep;
      config.delay = 6;
      config.least_delay = 4;
      config.most_delay = 20;
      config.deadline = 12;
      break;
    case Genre::sandbox:
      // Four frames of S4's thousand bodies fit a frame in float and in double; see bench/pages/sessions.md, Rollback.
      config.window = 4;
      config.delay = 3;
      config.least_delay = 2;
      config.most_delay = 12;
      break;
  }
  return config;
}

}  // namespace isostep
