// isostep regenerate: the golden hashes anew, each list run again with one lane before it is written; and the
// recordings of the self-check, which carry the behaviour version that the lists make.
// SPDX-License-Identifier: MIT
#include <cstdio>
#include <filesystem>

#include "checked_file.hpp"
#include "commands.hpp"
#include "goldens.hpp"
#include "selfcheck_set.hpp"
#include "tool/common/files.hpp"
#include "tool/common/games.hpp"
#include "tool/common/hash_lines.hpp"

namespace isostep::tool {
namespace {

/// Frames of each scene's list: past the first contacts and the wake of impacts, in a few seconds for all together.
int golden_frames(const std::string& scene) {
  struct Row {
    const char* scene;
    int frames;
  };
  constexpr Row kRows[] = {{"S1s", 240},       {"S3", 30},         {"S5", 60},      {"S8", 120},
                           {"S9", 100},        {"mixed", 300},     {"medley", 180}, {"bridge", 300},
                           {"ballistic", 240}, {"fireworks", 240}, {"springs", 300}, {"S18c", 360}};
  for (const Row& row : kRows) {
    if (scene == row.scene) return row.frames;
  }
  return 120;
}

struct Regenerated {
  std::string name, text;  // of a recording its bytes
};

template <class Game> Regenerated regenerate(const typename Game::Scene& scene) {
  Game game(scene);
  const Regenerated file = {golden_name(scene.name, ScalarTraits<typename Game::World::Scalar>::kName),
                            hash_lines(hashes_of(game, golden_frames(scene.name)))};
  const CheckedFile checked = check_golden(file.name, file.text, Simd::scalar);
  if (status_of(checked) != exit_status::kOk) {
    throw ToolError(exit_status::kSoftware,
                    file.name + ": the widest lanes and one lane disagree: " + text_of(checked));
  }
  return file;
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
  void put(const std::string& name, std::string_view content) {
    ++files_;
    const std::string path = path_ + "/" + name;
    if (present(path) == content) return;
    ++changed_;
    write_file(path, content);
  }
  void tell(const char* what) const {
    std::printf("%d of %d %s changed in %s\n", changed_, files_, what, path_.c_str());
  }
  bool is_changed() const { return changed_ != 0; }

 private:
  std::string path_;
  int files_ = 0, changed_ = 0;
};

std::vector<Regenerated> regenerate_all() {
  std::vector<Regenerated> all;
  for (const SceneRow& row : scene_rows()) {
    any_scalar([&](auto scalar) {
      using S = typename decltype(scalar)::Type;
      const char* name = ScalarTraits<S>::kName;
      if (!row.narrow && std::is_same_v<S, Q16_16>) return false;
      std::printf("%s\n", golden_name(row.name, name).c_str());
      std::fflush(stdout);
      with_named_game(row.name, name, [&](auto tag, const auto& scene) {
        all.push_back(regenerate<typename decltype(tag)::Type>(scene));
      });
      return false;
    });
  }
  return all;
}

int record(const RegenerateOptions& options) {
  Directory directory(options.directory.empty() ? ISOSTEP_SELFCHECK_DIR : options.directory);
  std::vector<Regenerated> all;  // or nothing: half a set renewed is none
  record_selfcheck([&](const std::string& name, const std::vector<std::uint8_t>& bytes) {
    all.push_back({name, {bytes.begin(), bytes.end()}});
  });
  for (const Regenerated& file : all) directory.put(file.name, file.text);
  directory.tell("recordings");
  return exit_status::kOk;
}

}  // namespace

int command_regenerate(const RegenerateOptions& options) {
  if (options.record) return record(options);
  Directory directory(options.directory.empty() ? ISOSTEP_GOLDENS_DIR : options.directory);
  const std::vector<Regenerated> all = regenerate_all();  // all or nothing
  for (const Regenerated& file : all) directory.put(file.name, file.text);
  directory.tell("lists");
  if (directory.is_changed())
    std::printf("Commit them with their recordings and nothing else, and with a RESULT line in CHANGELOG.\n");
  return exit_status::kOk;
}

}  // namespace isostep::tool
