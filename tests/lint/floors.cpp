// Folders and their floors, read from the #include lines.
// SPDX-License-Identifier: MIT
#include "floors.hpp"

#include <map>
#include <optional>
#include <regex>
#include <string>
#include <utility>
#include <vector>

#include "source_tree.hpp"

namespace isostep_lint {
namespace {

namespace fs = std::filesystem;

/// Folders of the library by their names in include/isostep, whose sources in src/isostep are on the same floor; the
/// others by their paths in src/. A file directly in src/tool is of the folder "tool".
const std::map<std::string, int> kFloors = {
    {"scalar", 0},  // below core, for it is a target of its own
    {"core", 1},
    {"math", 2},
    {"state", 2},
    {"geometry", 3},
    {"particles", 3},
    {"session", 3},
    {"collision", 4},
    {"dynamics", 5},
    {"book", 6},   // the book's methods of collision and dynamics that the default does not use
    {"store", 7},  // what a world consists of
    {"query", 8},
    // What a step does, system by system; commands wake and put to sleep, characters and loads of joints give commands.
    {"systems/contacts", 8},
    {"systems/continuous", 8},
    {"systems/motion", 8},
    {"systems/sleep", 8},
    {"systems/vehicle", 9},
    {"systems/forces", 10},
    {"systems/mechanisms", 10},
    {"commands", 10},
    {"systems/character", 11},
    {"systems/events", 11},
    {"world", 12},
    {"articulation", 13},
    {"draw", 13},
    {"effects", 13},
    {"fracture", 13},
    {"replay", 13},
    {"instantiate", 14},
    // Programs, and what they share.
    {"programs", 14},
    {"scenes", 15},
    {"transport", 15},
    {"threads", 15},
    {"diagnostics", 15},
    {"c", 16},  // the C interface
    {"sealed", 16},
    {"prover", 16},
    {"examples", 17},
    {"csharp", 17},
    // The tool, see its page: what commands share, then commands that know nothing of each other.
    {"tool/common", 16},
    {"tool/page", 17},
    {"tool/run", 18},
    {"tool/bake", 18},
    {"tool/diff", 18},
    {"tool/verify", 18},
    {"tool/match", 18},
    {"tool/lab", 18},
    {"tool/demo", 19},
    {"tool", 20},  // main and the command line
};

/// Rooms of a folder in their order; session/README.md says what is in each. A file that is in no room stands beside
/// them by its own name.
const std::map<std::string, int> kRooms = {
    {"session/timeline", 0},  {"session/pace", 1},      {"session/protocol", 2}, {"session/config", 3},
    {"session/preset", 4},    {"session/agreement", 4}, {"session/peer", 5},     {"session/client", 6},
    {"session/host", 6},      {"session/solo", 6},      {"session/session", 7},  {"session/make_session", 8},
    {"session/observers", 8},
};

/// "" for what is in a folder without rooms.
std::string room_of(const std::string& path) {
  static const std::regex room("(?:include|src)/isostep/(session/[a-z_]+)[./].*");
  std::smatch match;
  return std::regex_match(path, match, room) ? match[1].str() : "";
}

/// "" for what has no folder; such files have no floor.
std::string folder_of(const std::string& path) {
  static const std::regex library("(?:include|scalar/include|src)/isostep/(systems/[a-z]+|[a-z]+)/.*");
  static const std::regex tool("src/(tool/[a-z]+)/.*");
  static const std::regex other("src/([a-z]+)/.*");
  std::smatch match;
  if (starts_with(path, "scalar/src/")) return "scalar";
  const bool found = std::regex_match(path, match, library) || std::regex_match(path, match, tool) ||
                     std::regex_match(path, match, other);
  return found ? match[1].str() : "";
}

/// The file that an #include names, from the root: beside the file, or in a folder that the compiler searches. Nothing
/// for one that is not ours or that the build writes.
std::optional<std::string> target_of(const fs::path& root, const std::string& from, const std::string& name) {
  const fs::path beside = (fs::path(from).parent_path() / name).lexically_normal();
  if (fs::exists(root / beside)) return beside.generic_string();
  for (const char* folder : {"include", "scalar/include", "src"}) {
    const fs::path path = (fs::path(folder) / name).lexically_normal();
    if (fs::exists(root / path)) return path.generic_string();
  }
  return std::nullopt;
}

using Graph = std::map<std::string, std::vector<std::string>>;

void check_arrow(const File& file, std::size_t line, const std::string& target) {
  const std::string from = folder_of(file.path), to = folder_of(target);
  if (kFloors.count(to) == 0) return report(file, line, target + " has no floor");
  if (from != to && kFloors.at(to) >= kFloors.at(from))
    report(file, line, from + " may not include " + to + ": that floor is not below");
  const std::string from_room = room_of(file.path), to_room = room_of(target);
  if (from == to && from_room != to_room && kRooms.at(to_room) >= kRooms.at(from_room))
    report(file, line, from_room + " may not include " + to_room + ": that room is not below");
  if (starts_with(target, "include/") && ends_with(file.path, ".hpp") && ends_with(target, ".inl"))
    report(file, line, "a header includes bodies: users would compile them with their own flags");
}

/// Checks that includes have an order inside a folder also.
void check_cycles(const Graph& includes) {
  std::map<std::string, int> state;  // 1 open, 2 done
  std::vector<std::pair<std::string, std::size_t>> stack;
  Graph graph = includes;  // a file that includes nothing has no row yet
  for (const auto& [start, unused] : includes) {
    if (state[start] != 0) continue;
    state[start] = 1;
    stack.push_back({start, 0});
    while (!stack.empty()) {
      const std::string node = stack.back().first;
      if (stack.back().second == graph[node].size()) {
        state[node] = 2;
        stack.pop_back();
        continue;
      }
      const std::string next = graph[node][stack.back().second++];
      if (state[next] == 1) report({node, {}, {}}, 0, "includes " + next + ", which leads back here");
      if (state[next] == 0) {
        state[next] = 1;
        stack.push_back({next, 0});
      }
    }
  }
}

}  // namespace

void check_floors(const fs::path& root) {
  static const std::regex include("^\\s*#include \"([^\"]+)\".*");
  Graph graph;
  for (const File& file : read_tree(root, {"scalar/include", "scalar/src", "include", "src"})) {
    if (file.path == "include/isostep/isostep.hpp") continue;  // all of it, for users alone: it has no floor
    if (kFloors.count(folder_of(file.path)) == 0) {
      report(file, 0, "the folder \"" + folder_of(file.path) + "\" has no floor");
      continue;
    }
    const std::string room = room_of(file.path);
    if (!room.empty() && kRooms.count(room) == 0) {
      report(file, 0, "the room \"" + room + "\" has no place among the others");
      continue;
    }
    for (std::size_t i = 0; i < file.lines.size(); ++i) {
      std::smatch match;
      if (!std::regex_match(file.lines[i], match, include)) continue;
      const std::optional<std::string> target = target_of(root, file.path, match[1]);
      if (!target) continue;
      graph[file.path].push_back(*target);
      check_arrow(file, i, *target);
    }
  }
  check_cycles(graph);
}

}  // namespace isostep_lint
