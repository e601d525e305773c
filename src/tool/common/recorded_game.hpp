// A game recorded from the empty world on: its settings are the start, and frame 0's commands build the scene.
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "files.hpp"
#include "game_options.hpp"
#include "isostep/state/command_recorder.hpp"

namespace isostep::tool {

template <class Game> struct RecordedGame {
  std::optional<Game> game;
  std::optional<CommandRecorder<typename Game::World>> recorder;  // goes before the world that it listens to

  /// `sink`: to memory.
  RecordedGame(const typename Game::Scene& scene, const GameOptions& options, const ReplaySink& sink) {
    game.emplace(scene, options, [&](typename Game::World& empty) {
      recorder.emplace(empty, sink);
      expect_written(recorder->begin(scene.name));
    });
  }
};

}  // namespace isostep::tool
