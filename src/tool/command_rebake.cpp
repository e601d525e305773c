// isostep rebake: the golden hashes anew, each list run again with one lane before it is written.
// SPDX-License-Identifier: MIT
#include <cstdio>
#include <filesystem>

#include "commands.hpp"
#include "files.hpp"
#include "games.hpp"
#include "goldens.hpp"
#include "replay_check.hpp"

namespace isostep::tool {
namespace {

/// Frames of each scene's list: past the first contacts and the wake of impacts, in a few seconds for all together.
int golden_frames(const std::string& scene) {
  struct Row {
    const char* scene;
    int frames;
  };
  constexpr Row kRows[] = {{"S1s", 240},   {"S3", 30},      {"S5", 60},         {"S8", 120},        {"S9", 100},
                           {"mixed", 300}, {"bridge", 300}, {"ballistic", 240}, {"fireworks", 240}, {"springs", 300}};
  for (const Row& row : kRows) {
    if (scene == row.scene) return row.frames;
  }
  return 120;
}

struct Baked {
  std::string name, text;
};

template <class Game> Baked bake(const typename Game::Scene& scene) {
  Game game(scene);
  const Baked baked = {golden_name(scene.name, ScalarTraits<typename Game::World::Scalar>::kName),
                       hash_lines(hashes_of(game, golden_frames(scene.name)))};
  const CheckedFile checked = check_golden(baked.name, baked.text, Simd::scalar);
  if (status_of(checked) != exit_status::kOk) {
    throw ToolError(exit_status::kSoftware,
                    baked.name + ": the widest lanes and one lane disagree: " + text_of(checked));
  }
  return baked;
}

/// The file as it is now; empty when there is none.
std::string present(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) return {};
  const std::vector<std::uint8_t> bytes = read_file(path);
  return {bytes.begin(), bytes.end()};
}

}  // namespace

int command_rebake(const RebakeOptions& options) {
  std::vector<Baked> all;
  for (const SceneRow& row : scene_rows()) {
    any_scalar([&](auto scalar) {
      const char* name = ScalarTraits<typename decltype(scalar)::Type>::kName;
      std::printf("%s\n", golden_name(row.name, name).c_str());
      std::fflush(stdout);
      with_named_game(row.name, name,
                      [&](auto tag, const auto& scene) { all.push_back(bake<typename decltype(tag)::Type>(scene)); });
      return false;
    });
  }
  std::error_code error;
  std::filesystem::create_directories(options.directory, error);
  if (error) throw ToolError(exit_status::kOutput, options.directory + ": " + error.message());
  int changed = 0;
  for (const Baked& baked : all) {
    const std::string path = options.directory + "/" + baked.name;
    if (present(path) == baked.text) continue;
    ++changed;
    write_file(path, baked.text);
  }
  std::printf("%d of %zu lists changed in %s\n", changed, all.size(), options.directory.c_str());
  if (changed != 0)
    std::printf(
        "Build again: the behaviour version is their digest. Commit them by themselves, with a RESULT line in "
        "CHANGELOG.\n");
  return exit_status::kOk;
}

}  // namespace isostep::tool
