// The set of the self-check: every part of both engines, briefly.
// SPDX-License-Identifier: MIT
#include "selfcheck_set.hpp"

#include "isostep/replay/replay_check.hpp"
#include "tool/common/files.hpp"
#include "tool/common/games.hpp"
#include "tool/common/recorded_game.hpp"

namespace isostep::tool {
namespace {

struct Row {
  const char* name;
  const char* scene;
  int frames;
  const char *solver = "", *integrator = "", *stepping = "";  // empty: the scene's
};
/// The frames last until the scene has said what it has to say. A frame by `direct` costs ten others.
const Row kRows[] = {
    {"medley", "medley", 180},
    {"medley_pgs", "medley", 40, "pgs"},
    {"medley_worst_first", "medley", 40, "worst_first"},
    {"medley_direct", "medley", 30, "direct"},
    {"medley_avbd", "medley", 30, "avbd"},
    {"medley_admm", "medley", 30, "admm"},
    {"patchwork", "patchwork", 120},
    {"patchwork_implicit_euler", "patchwork", 40, "", "implicit_euler"},
    {"patchwork_time_division", "patchwork", 60, "worst_first", "", "time_division"},
    {"springs", "springs", 260},
    {"elements", "elements", 150},
};

/// The replay with a header that does not tell where it was made.
std::vector<std::uint8_t> without_origin(const std::vector<std::uint8_t>& bytes) {
  const ReplayReader replay(bytes);
  ReplayHeader header;
  for (std::size_t i = 0; i < replay.header().size(); ++i) {
    const ReplayField& field = replay.header()[i];
    const std::string_view key = field.key.view();
    if (key != "compiler" && key != "architecture") header.set(key, field.value.view(), field.required);
  }
  std::vector<std::uint8_t> out;
  ReplayWriter writer(sink_to(out));
  expect_written(writer.begin(header, replay.state(), replay.state_hash()));
  for (std::uint64_t i = 0; i < replay.frame_count(); ++i) {
    const ReplayFrame frame = replay.frame(i);
    expect_written(writer.frame(frame.input, frame.hash));
  }
  expect_written(writer.finish());
  return out;
}

template <class Game> std::vector<std::uint8_t> recording_of(const Row& row, const typename Game::Scene& scene) {
  GameOptions options;
  options.solver = row.solver;
  options.integrator = row.integrator;
  options.stepping = row.stepping;
  std::vector<std::uint8_t> bytes;
  RecordedGame<Game> recorded(scene, options, sink_to(bytes));
  for (int i = 0; i < row.frames; ++i) {
    stop_if_interrupted();
    recorded.game->advance();
    expect_written(recorded.recorder->end_frame());
  }
  expect_written(recorded.recorder->finish());
  return without_origin(bytes);
}

}  // namespace

void record_selfcheck(const std::function<void(const std::string& name, const std::vector<std::uint8_t>& bytes)>& put) {
  for (const Row& row : kRows) {
    for (const std::string& scalar : scalar_names()) {
      const std::string name = std::string(row.name) + "." + scalar + ".replay";
      with_named_game(row.scene, scalar, [&](auto tag, const auto& scene) {
        const std::vector<std::uint8_t> bytes = recording_of<typename decltype(tag)::Type>(row, scene);
        const CheckedReplay checked = check_replay(bytes, {.simd = Simd::scalar});
        if (checked.result.outcome != VerifyOutcome::verified)
          throw ToolError(exit_status::kSoftware, name + " by one lane: " + describe(checked.result));
        put(name, bytes);
      });
    }
  }
}

}  // namespace isostep::tool
