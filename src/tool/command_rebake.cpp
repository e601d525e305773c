// isostep rebake: the golden hashes anew, each list run again with one lane before it is written.
// SPDX-License-Identifier: MIT
#include <cstdio>
#include <filesystem>

#include "commands.hpp"
#include "files.hpp"
#include "replay_check.hpp"
#include "scene_game.hpp"
#include "scenes/named.hpp"

namespace isostep::tool {
namespace {

/// Frames of each scene's list: past the first contacts and the wake of impacts, in a few seconds for all together.
int golden_frames(const std::string& scene) {
  struct Row {
    const char* scene;
    int frames;
  };
  constexpr Row kRows[] = {{"S1s", 240}, {"S3", 30}, {"S5", 60}, {"S8", 120}, {"S9", 100}, {"mixed", 300}};
  for (const Row& row : kRows) {
    if (scene == row.scene) return row.frames;
  }
  return 120;
}

struct Baked {
  std::string name, text;
};

template <class S> Baked bake(const char* scene_name) {
  SceneGame<S> game(*scenes::find_scene(scene_name));
  const Baked baked = {golden_name(scene_name, ScalarTraits<S>::kName),
                       hash_lines(hashes_of(game, golden_frames(scene_name)))};
  const CheckedFile checked = check_golden(baked.name, baked.text, Simd::scalar);
  if (status_of(checked) != exit_status::kOk) {
    throw ToolError(exit_status::kSoftware,
                    baked.name + ": " + game.world.simd_name() + " and one lane disagree: " + text_of(checked));
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
  for (const scenes::NamedScene& entry : scenes::named_scenes()) {
    any_scalar([&](auto tag) {
      std::printf("%s\n", golden_name(entry.name, ScalarTraits<typename decltype(tag)::Type>::kName).c_str());
      std::fflush(stdout);
      all.push_back(bake<typename decltype(tag)::Type>(entry.name));
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
