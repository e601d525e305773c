// isostep scenes: lists the named scenes, the trials and the published tests, or writes them as files.
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "scenes/published/published.hpp"
#include "scenes/scene_file.hpp"
#include "scenes/trials/trial.hpp"
#include "tool/common/files.hpp"
#include "tool/common/games.hpp"

namespace isostep::tool {
namespace {

/// Those that a file can hold: the rigid ones.
void write_all(const std::string& directory) {
  std::error_code error;
  std::filesystem::create_directories(directory, error);
  if (error) throw ToolError(exit_status::kOutput, directory + ": " + error.message());
  for (const scenes::NamedScene& entry : scenes::named_scenes()) {
    stop_if_interrupted();
    if (entry.left_out != nullptr) continue;
    write_file(directory + "/" + entry.name + ".json", scenes::write_scene(*scenes::find_scene(entry.name)));
  }
}

void print_table() {
  const std::vector<SceneRow> rows = scene_rows();
  std::size_t width = 0;
  for (const SceneRow& row : rows) width = std::max(width, row.name.size());
  const char* counted = "";
  for (const SceneRow& row : rows) {
    if (std::string_view(counted) != row.counted[0]) {
      std::printf("%-*s %6s %9s %7s  %s\n", static_cast<int>(width), "scene", "frames", row.counted[0], row.counted[1],
                  "what");
    }
    counted = row.counted[0];
    std::printf("%-*s %6d %9zu %7zu  %s\n", static_cast<int>(width), row.name.c_str(), row.frames, row.counts[0],
                row.counts[1], row.description.c_str());
  }
}

/// Trials, and the published tests, which are trials too.
std::vector<scenes::Trial> published_trials() {
  std::vector<scenes::Trial> list;
  for (const scenes::PublishedTest& test : scenes::published_tests()) list.push_back(test.trial);
  return list;
}
void print_trials(const char* title, std::span<const scenes::Trial> trials) {
  std::size_t width = 0;
  for (const scenes::Trial& trial : trials) width = std::max(width, std::string_view(trial.name).size());
  std::printf("\n%-*s %6s %6s %7s %7s %9s  %s\n", static_cast<int>(width), title, "number", "frames", "bodies",
              "joints", "bar", "what, and what is measured");
  for (const scenes::Trial& trial : trials) {
    const SceneRow row = RigidGames::row(trial.name, trial.description);
    char bar[32];
    std::snprintf(bar, sizeof bar, "%.3g %s", trial.bar, trial.unit);
    std::printf("%-*s %6s %6d %7zu %7zu %9s  %s: %s\n", static_cast<int>(width), trial.name, trial.number, row.frames,
                row.counts[0], row.counts[1], bar, trial.description, trial.measure);
  }
}

nlohmann::ordered_json json_of(const SceneRow& row) {
  nlohmann::ordered_json json = {{"name", row.name}, {"frames", row.frames}};
  for (int i = 0; i < 2; ++i) json[row.counted[i]] = row.counts[i];
  json["description"] = row.description;
  return json;
}
nlohmann::ordered_json json_of(std::span<const scenes::Trial> trials) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const scenes::Trial& trial : trials) {
    nlohmann::ordered_json json = json_of(RigidGames::row(trial.name, trial.description));
    json.update(nlohmann::ordered_json{
        {"number", trial.number}, {"measure", trial.measure}, {"unit", trial.unit}, {"bar", trial.bar}});
    list.push_back(json);
  }
  return list;
}
void print_json() {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const SceneRow& row : scene_rows()) list.push_back(json_of(row));
  std::cout << nlohmann::ordered_json{{"scenes", list},
                                      {"trials", json_of(scenes::trials())},
                                      {"published", json_of(published_trials())}}
                   .dump(1)
            << "\n";
}

}  // namespace

int command_scenes(const ScenesOptions& options) {
  if (!options.write.empty()) write_all(options.write);
  if (options.json) print_json();
  else if (options.write.empty()) {
    print_table();
    print_trials("trial", scenes::trials());
    print_trials("published", published_trials());
  }
  return exit_status::kOk;
}

}  // namespace isostep::tool
