// Scenes from files.
// SPDX-License-Identifier: MIT
#include "scene_game.hpp"

#include <filesystem>

#include "files.hpp"
#include "scenes/scene_file.hpp"

namespace isostep::tool {
namespace {

bool looks_like_file(const std::string& name) {
  return name.find('/') != std::string::npos || name.find(".json") != std::string::npos;
}

}  // namespace

void fail_scene(const std::string& name_or_file, const scenes::SceneError& error) {
  throw ToolError(exit_status::kUsage, name_or_file + ":" + (error.place().empty() ? " " : "") + error.what());
}

scenes::Scene load_scene_file(const std::string& name_or_file) {
  if (!looks_like_file(name_or_file)) {
    if (std::filesystem::exists(name_or_file)) {
      throw ToolError(exit_status::kUsage,
                      name_or_file + ": neither a recording nor a scene, whose file ends in .json");
    }
    throw ToolError(exit_status::kUsage,
                    "no scene is named \"" + name_or_file + "\": `isostep scenes` lists them, a file ends in .json");
  }
  const std::vector<std::uint8_t> bytes = read_file(name_or_file);
  try {
    return scenes::read_scene(std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()),
                              std::filesystem::path(name_or_file).parent_path().string());
  } catch (const scenes::SceneError& error) {
    fail_scene(name_or_file, error);
  }
}

void require_built(const scenes::Scene& asked) {
  if (const char* why = scenes::left_out(asked)) throw ToolError(exit_status::kUsage, why);
}

void require_projection(const scenes::Scene& asked, const GameOptions& options) {
  if (!options.projection.empty() && asked.solver != SolverName::worst_first)
    throw ToolError(exit_status::kUsage, "--projection is for --solver worst_first: others have none");
}

void require_rigid_methods(const GameOptions& options) {
  if (!options.integrator.empty() || !options.stepping.empty())
    throw ToolError(exit_status::kUsage, "--integrator and --stepping are for scenes of particles");
}

}  // namespace isostep::tool
