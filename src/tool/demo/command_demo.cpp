// isostep demo: a match of two processes over a bad line and a few scenes, in every scalar; all replays verified.
// SPDX-License-Identifier: MIT
#include <cstdio>
#include <filesystem>

#include "commands.hpp"
#include "demo_match.hpp"
#include "isostep/core/version.hpp"
#include "tool/common/files.hpp"
#include "tool/common/games.hpp"
#include "tool/common/recorded_game.hpp"
#include "tool/common/step_times.hpp"
#include "tool/verify/checked_file.hpp"

namespace isostep::tool {
namespace {

struct DemoScene {
  const char* name;
  int frames;
};
constexpr DemoScene kDemoScenes[] = {{"S1x5", 120}, {"S6", 120}, {"S4s", 180}, {"mixed", 240}, {"bridge", 240}};

constexpr int kMatchFrames = 300;

struct Recording {
  std::vector<std::uint8_t> bytes;
  std::uint64_t hash = 0;
  double milliseconds = 0;  // median of a step
  const char* simd = "";
};

template <class Game> Recording record(const DemoScene& demo, const typename Game::Scene& scene) {
  Recording recording;
  RecordedGame<Game> recorded(scene, GameOptions{}, sink_to(recording.bytes));
  Game& game = *recorded.game;
  std::vector<double> ms;
  for (int i = 0; i < demo.frames; ++i) {
    stop_if_interrupted();
    game.before_step(game.world);
    const double before = thread_milliseconds();
    game.world.step();
    ms.push_back(thread_milliseconds() - before);
    game.after_step(game.world);
    recording.hash = game.world.hash();
    expect_written(recorded.recorder->end_frame(recording.hash));
  }
  expect_written(recorded.recorder->finish());
  recording.milliseconds = summarise(ms).median;
  recording.simd = game.world.simd_name();
  return recording;
}

bool show(const DemoScene& demo, const std::string& scalar, const std::string& out) {
  std::printf("%-6s %-7s %6d  ", demo.name, scalar.c_str(), demo.frames);
  std::fflush(stdout);
  Recording recording;
  with_named_game(demo.name, scalar,
                  [&](auto tag, const auto& scene) { recording = record<typename decltype(tag)::Type>(demo, scene); });
  const std::string path = out + "/" + demo.name + "." + scalar + ".replay";
  write_file(path, Bytes(recording.bytes));
  recording.bytes = read_file(path);
  const CheckedReplay checked = check_replay(recording.bytes, {.simd = Simd::scalar});
  std::printf("%9.4f %8.1f  %s  %-7s %s\n", recording.milliseconds, static_cast<double>(recording.bytes.size()) / 1024,
              hex(recording.hash).c_str(), recording.simd, describe(checked.result).c_str());
  std::fflush(stdout);
  return checked.result.outcome == VerifyOutcome::verified;
}

}  // namespace

int command_demo(const DemoOptions& options) {
  const std::string out =
      options.out.empty() ? (std::filesystem::temp_directory_path() / "isostep-demo").string() : options.out;
  std::error_code error;
  std::filesystem::create_directories(out, error);
  if (error) throw ToolError(exit_status::kOutput, out + ": " + error.message());

  std::vector<DemoMatch> matches;  // they play in the background
  any_scalar([&](auto tag) {
    matches.emplace_back(ScalarTraits<typename decltype(tag)::Type>::kName, kMatchFrames, out);
    return false;
  });
  std::printf(
      "Each scene is recorded with the widest lanes of this build, then replayed from its file with one lane:\n"
      "every frame's hash must come out the same.\n\n");
  std::printf("%-6s %-7s %6s  %9s %8s  %-16s  %-7s %s\n", "scene", "scalar", "frames", "ms/step", "KB", "last hash",
              "lanes", "replayed");
  int shown = 0, good = 0;
  for (const DemoScene& demo : kDemoScenes) {
    any_scalar([&](auto tag) {
      ++shown;
      good += show(demo, ScalarTraits<typename decltype(tag)::Type>::kName, out) ? 1 : 0;
      return false;
    });
  }
  std::printf(
      "\nMeanwhile a match in each scalar: a host and a client, two processes over UDP, 100 ms +-30 each way, 5 %% "
      "lost.\n"
      "Each guesses the other's inputs and rolls back; the hashes of all frames must be equal, and both recordings "
      "hold.\n\n");
  std::printf("%s", DemoMatch::header().c_str());
  for (DemoMatch& match : matches) {
    ++shown;
    good += match.show() ? 1 : 0;
    std::fflush(stdout);
  }
  std::printf("\n%d of %d as promised. Behaviour version %s.\n", good, shown, hex(behaviour_version()).c_str());
  std::printf("The recordings are in %s: try `./isostep verify %s`.\n", out.c_str(), out.c_str());
  return good == shown ? exit_status::kOk : exit_status::kDifferent;
}

}  // namespace isostep::tool
