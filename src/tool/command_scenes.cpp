// isostep scenes: lists the named scenes, or writes them as files.
// SPDX-License-Identifier: MIT
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "files.hpp"
#include "scenes/named.hpp"
#include "scenes/scene_file.hpp"
#include "tool.hpp"

namespace isostep::tool {
namespace {

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
  std::printf("%-6s %6s %7s %7s  %s\n", "scene", "frames", "bodies", "joints", "what");
  for (const scenes::NamedScene& entry : scenes::named_scenes()) {
    const scenes::Scene scene = *scenes::find_scene(entry.name);
    std::printf("%-6s %6d %7zu %7zu  %s\n", entry.name, scene.frames, scene.bodies.size(), scene.joints.size(),
                entry.description);
  }
}

void print_json() {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const scenes::NamedScene& entry : scenes::named_scenes()) {
    const scenes::Scene scene = *scenes::find_scene(entry.name);
    list.push_back({{"name", entry.name},
                    {"frames", scene.frames},
                    {"bodies", scene.bodies.size()},
                    {"joints", scene.joints.size()},
                    {"description", entry.description}});
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
