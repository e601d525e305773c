// isostep scenes: lists the named scenes, or writes them as files.
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "files.hpp"
#include "games.hpp"
#include "scenes/scene_file.hpp"

namespace isostep::tool {
namespace {

/// Those that a file can hold: the rigid ones.
void write_all(const std::string& directory) {
  std::error_code error;
  std::filesystem::create_directories(directory, error);
  if (error) throw ToolError(exit_status::kOutput, directory + ": " + error.message());
  for (const scenes::NamedScene& entry : scenes::named_scenes()) {
    stop_if_interrupted();
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

void print_json() {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const SceneRow& row : scene_rows()) {
    nlohmann::ordered_json json = {{"name", row.name}, {"frames", row.frames}};
    for (int i = 0; i < 2; ++i) json[row.counted[i]] = row.counts[i];
    json["description"] = row.description;
    list.push_back(json);
  }
  std::cout << nlohmann::ordered_json{{"scenes", list}}.dump(1) << "\n";
}

}  // namespace

int command_scenes(const ScenesOptions& options) {
  if (!options.write.empty()) write_all(options.write);
  if (options.json) print_json();
  else if (options.write.empty()) print_table();
  return exit_status::kOk;
}

}  // namespace isostep::tool
