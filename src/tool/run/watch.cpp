// The playing of recordings.
// SPDX-License-Identifier: MIT
#include "watch.hpp"

#include <cstdint>
#include <filesystem>
#include <fstream>

#include "isostep/state/replay_format.hpp"
#include "tool/common/tool.hpp"
#include "tool/page/film.hpp"

namespace isostep::tool {
namespace {

/// Some option belongs to a scene that is run, and not to what was run already.
bool asks_for_a_run(const RunOptions& options) {
  const RunOptions standard;
  const std::string files = options.load + options.save + options.record + options.hashes + options.dump;
  const GameOptions& game = options.game;
  const bool methods = game.hz != standard.game.hz || game.substeps != standard.game.substeps ||
                       game.solver != standard.game.solver || game.projection != standard.game.projection ||
                       game.integrator != standard.game.integrator || game.stepping != standard.game.stepping;
  return methods || !files.empty() || !options.beside.empty() || options.scalar != standard.scalar || options.json;
}

}  // namespace

bool is_recording(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return false;
  std::uint8_t bytes[sizeof kReplayMagic] = {};
  std::ifstream(path, std::ios::binary).read(reinterpret_cast<char*>(bytes), sizeof bytes);
  return has_replay_magic(bytes);
}

int watch(const RunOptions& options) {
  if (options.html.empty() || asks_for_a_run(options)) {
    throw ToolError(exit_status::kUsage, options.scene +
                                             ": a recording is watched as it was recorded, with --html and " +
                                             "no options of a run but --frames; `isostep verify` checks it");
  }
  film_recording(options.scene, options.frames, options.html_every, options.html);
  return exit_status::kOk;
}

}  // namespace isostep::tool
