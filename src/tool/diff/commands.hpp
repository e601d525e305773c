// The commands diff and selftest: the options of each; each returns an exit status.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "tool/common/game_options.hpp"

namespace isostep::tool {

struct DiffOptions {
  std::string a, b;                // with `stages` b may be empty: a again
  bool stages = false;             // what every stage left, scratch too
  std::string prover_a, prover_b;  // command lines that play a and b instead; of `stages`
  std::string html;                // a page that plays both recordings side by side, or empty
};
int command_diff(const DiffOptions& options);
int diff_stages(const DiffOptions& options);

struct SelftestOptions {
  std::string scene;
  std::string scalar = "float";
  GameOptions game;
  int frames = -1;
  int rollback = 10;
  int every = 1;
};
int command_selftest(const SelftestOptions& options);

}  // namespace isostep::tool
