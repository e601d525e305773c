// isostep regenerate: the golden hashes anew, each scene run again with one lane before they are written; and the
// recordings of the self-check, which carry the behaviour version that the goldens make.
// SPDX-License-Identifier: MIT
#include <cstdio>
#include <filesystem>

#include "checked_file.hpp"
#include "commands.hpp"
#include "goldens.hpp"
#include "selfcheck_set.hpp"
#include "tool/common/files.hpp"
#include "tool/common/games.hpp"

namespace isostep::tool {
namespace {

/// The scene's line, which one lane must verify.
template <class Game> std::string regenerated_line(const char* scalar, const typename Game::Scene& scene) {
  Game game(scene);
  const std::string line = text_of(golden_of(scene.name, scalar, hashes_of(game, golden_frames(scene.name))));
  const CheckedFile checked = check_golden(line, Simd::scalar);
  if (status_of(checked) != exit_status::kOk) {
    throw ToolError(exit_status::kSoftware, std::string(scene.name) + " in " + scalar +
                                                ": the widest lanes and one lane disagree: " + text_of(checked));
  }
  return line;
}

/// The file as it is now; empty when there is none.
std::string present(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) return {};
  const std::vector<std::uint8_t> bytes = read_file(path);
  return {bytes.begin(), bytes.end()};
}

/// Files that are rewritten only where they differ.
class Directory {
 public:
  explicit Directory(const std::string& path) : path_(path) {
    std::error_code error;
    std::filesystem::create_directories(path, error);
    if (error) throw ToolError(exit_status::kOutput, path + ": " + error.message());
  }
  std::string content_of(const std::string& name) const { return present(path_ + "/" + name); }
  void put(const std::string& name, std::string_view content) {
    ++files_;
    if (content_of(name) == content) return;
    ++changed_;
    write_file(path_ + "/" + name, content);
  }
  void tell(const char* what) const {
    std::printf("%d of %d %s changed in %s\n", changed_, files_, what, path_.c_str());
  }
  bool is_changed() const { return changed_ != 0; }

 private:
  std::string path_;
  int files_ = 0, changed_ = 0;
};

/// The goldens of all scenes. Tells which of them are not among the lines of `before`.
std::string regenerate_all(const std::string& before) {
  std::string file;
  std::size_t lines = 0, changed = 0;
  const std::string known = "\n" + before;
  for (const SceneRow& row : scene_rows()) {
    with_every_scalar(row, [&](const char* scalar, auto tag, const auto& scene) {
      const std::string line = regenerated_line<typename decltype(tag)::Type>(scalar, scene) + "\n";
      const bool is_new = known.find("\n" + line) == std::string::npos;
      changed += is_new ? 1 : 0;
      ++lines;
      std::printf("%s %s%s\n", row.name.c_str(), scalar, is_new ? ": changed" : "");
      std::fflush(stdout);
      file += line;
    });
  }
  std::printf("%zu of %zu goldens changed\n", changed, lines);
  return file;
}

int record(const RegenerateOptions& options) {
  Directory directory(options.directory.empty() ? ISOSTEP_REPLAYS_DIR "/selfcheck" : options.directory);
  std::vector<std::pair<std::string, std::string>> all;  // or nothing: half a set renewed is none
  record_selfcheck([&](const std::string& name, const std::vector<std::uint8_t>& bytes) {
    all.emplace_back(name, std::string(bytes.begin(), bytes.end()));
  });
  for (const auto& [name, bytes] : all) directory.put(name, bytes);
  directory.tell("recordings");
  return exit_status::kOk;
}

}  // namespace

int command_regenerate(const RegenerateOptions& options) {
  if (const char* why = left_out(SolverName::worst_first)) throw ToolError(exit_status::kUsage, why);
  if (options.record) return record(options);
  Directory directory(options.directory.empty() ? ISOSTEP_REPLAYS_DIR : options.directory);
  directory.put("goldens.txt", regenerate_all(directory.content_of("goldens.txt")));  // all or nothing
  if (directory.is_changed())
    std::printf("Commit them with their recordings and nothing else: CONTRIBUTING.md says how.\n");
  return exit_status::kOk;
}

}  // namespace isostep::tool
