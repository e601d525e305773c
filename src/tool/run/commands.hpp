// The commands scenes and run: the options of each; each returns an exit status.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "tool/common/game_options.hpp"

namespace isostep::tool {

struct ScenesOptions {
  bool json = false;
  std::string write;  // directory, or empty
};
int command_scenes(const ScenesOptions& options);

struct RunOptions {
  std::string scene;  // named, or a scene's file, or a recording to watch
  std::string scalar = "float";
  int frames = -1;  // -1: the scene's
  GameOptions game;
  int threads = 1;
  std::string simd = "best";
  std::string broad_phase = "box_tree";          // of rigid worlds
  std::string load, save, record, hashes, dump;  // files, or empty
  std::string html;                              // a page that plays the run, or empty
  int html_every = 1;                            // steps from one frame of the page to the next
  std::string beside;                            // a scalar whose run the page plays as well, or empty
  double beside_tolerance = 0.01;                // [m] beyond which the two have parted
  bool json = false;
};
int command_run(const RunOptions& options);

}  // namespace isostep::tool
