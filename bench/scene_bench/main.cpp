// isostep_scene_bench: the benchmark scenes in every scalar, beside the peers that are there, in one run.
// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <map>

#include "compare.hpp"
#include "program.hpp"
#include "report.hpp"
#include "scenes/named.hpp"

namespace isostep::bench {
namespace {

struct Arguments {
  bool theirs = false;               // the scenes after the peers' own benchmarks
  std::vector<std::string> scenes;   // none: all of the set
  std::vector<std::string> engines;  // none: all
  std::vector<std::string> memory = {"S5"};
  std::string results;
  bool rollback = false;
  RaceOptions race;

  bool whole() const { return scenes.empty() && engines.empty() && race.engine.substeps == 0 && race.frames == 0; }
};

bool holds(const std::vector<std::string>& names, const std::string& name) {
  return std::count(names.begin(), names.end(), name) != 0;
}

bool holds(const std::vector<Maker>& makers, const std::string& name) {
  return std::any_of(makers.begin(), makers.end(), [&](const Maker& maker) { return name == maker.name; });
}

std::vector<Maker> chosen_makers(const Arguments& arguments) {
  const std::vector<Maker> all = makers();
  std::vector<Maker> chosen;
  for (const std::string& name : arguments.engines) {
    if (!holds(all, name)) throw CLI::ValidationError("--engines", "no engine " + name + " here");
  }
  for (const Maker& maker : all) {
    const bool asked =
        arguments.engines.empty() ? !(arguments.theirs && is_best(maker.name)) : holds(arguments.engines, maker.name);
    if (asked) chosen.push_back(maker);
  }
  return chosen;
}

/// S2 to S4 and S7 tell how fast this machine is: of those the anchor of dated.hpp has a figure.
std::vector<std::string> their_scenes() {
  return {
      "large_pyramid",  "many_pyramids", "jolt_pyramid", "convex_pile", "junkyard", "washer", "max_bodies", "crossers",
      "joint_grid",     "human_rain",    "figures",      "trees",       "S2",       "S3",     "S4",         "S7",
      "convex_on_land", "large_world"};
}
std::vector<std::string> chosen_scenes(const Arguments& arguments) {
  if (!arguments.scenes.empty()) return arguments.scenes;
  if (arguments.theirs) return their_scenes();
  return {"S1",  "S1x10", "S2",           "S3",           "S4",  "S4s",  "S5",  "S6",  "S6v",
          "S7",  "S20",   "slider_crank", "braked_gears", "S8",  "S9",   "S10", "S11", "S12",
          "S13", "S13m",  "S13d",         "S14",          "S15", "S15h", "S16", "S16h"};
}
void check_name(const std::string& name) {
  if (!scenes::find_scene(name)) throw CLI::ValidationError("--scenes", "no scene " + name);
}
scenes::Scene scene_of(const std::string& name, const Arguments& arguments) {
  std::optional<scenes::Scene> scene = scenes::find_scene(name);
  if (arguments.race.frames > 0) scene->frames = arguments.race.frames;
  return std::move(*scene);
}

void say_absent_peers() {
  const std::vector<Maker> all = makers();
  for (const char* name :
       {"rapier-simd", "rapier-det", "havok", "jolt", "physx-pgs", "mujoco", "bullet", "ode", "dart"}) {
    if (!holds(all, name)) std::fprintf(stderr, "%s is not there, left out\n", title_of(name).c_str());
  }
}

std::string today() {
  const std::time_t now = std::time(nullptr);
  char text[16] = {};
  std::strftime(text, sizeof text, "%Y-%m-%d", std::gmtime(&now));
  return text;
}
std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
  }
  return "unknown";
}

void write(const std::string& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  if (!file.flush()) throw std::runtime_error("cannot write " + path);
}
/// Writes the results of a whole run. A run that is not finished, or of some scenes or engines, overwrites no run of
/// all, and has no chart.
void write_results(const Arguments& arguments, const Report& report, bool finished) {
  if (arguments.results.empty()) return;
  const bool whole = finished && arguments.whole();
  const std::string set = arguments.results + (arguments.theirs ? "/theirs" : "/scenes");
  const std::string scenes = set + (whole ? "" : "-part");
  write(scenes + ".json", json_of(report));
  write(scenes + ".md", tables_of(report));
  if (!whole) return;
  write(arguments.results + (arguments.theirs ? "/theirs.tsv" : "/speed_accuracy.tsv"), chart_points(report));
}

using Memories = std::map<std::pair<std::string, std::string>, Memory>;  // by scene and engine

/// It is called before anything else, while this process is small.
Memories measure_memories(const Arguments& arguments, const std::vector<Maker>& engines) {
  Memories memories;
  for (const std::string& name : chosen_scenes(arguments)) {
    if (!holds(arguments.memory, name)) continue;
    std::fprintf(stderr, "%s: memory\n", name.c_str());
    const scenes::Scene scene = scene_of(name, arguments);
    for (const Maker& maker : engines) {
      memories[{name, maker.name}] = measure_memory(scene, maker, arguments.race.engine, arguments.race.patience);
    }
  }
  return memories;
}

void run(const Arguments& arguments) {
  const std::vector<Maker> engines = chosen_makers(arguments);
  for (const std::string& name : chosen_scenes(arguments)) check_name(name);
  say_absent_peers();
  Memories memories = measure_memories(arguments, engines);
  Report report = {today(), processor(), arguments.race, {}, {}, {}};
  for (const std::string& name : chosen_scenes(arguments)) {
    if (name == "S14") {
      report.queries = race_queries(scene_of(name, arguments), engines, arguments.race);
      write_results(arguments, report, false);
      continue;
    }
    for (Row& row : race(scene_of(name, arguments), engines, arguments.race)) {
      row.memory = memories[{row.scene, row.engine}];
      report.rows.push_back(std::move(row));
    }
    write_results(arguments, report, false);
  }
  if (arguments.rollback) {
    std::vector<std::string> scalars;
    for (const Maker& maker : engines) scalars.push_back(maker.name);
    for (const char* name : {"S4", "S9"}) {
      for (RollbackRow& row : measure_rollback(name, scalars)) report.rollback.push_back(std::move(row));
    }
  }
  write_results(arguments, report, true);
  std::fputs(tables_of(report).c_str(), stdout);
}

}  // namespace
}  // namespace isostep::bench

int main(int count, char** words) {
  isostep::bench::Arguments arguments;
  CLI::App app("The benchmark scenes in every scalar, beside other engines");
  app.add_flag("--theirs", arguments.theirs,
               "The scenes after the peers' own benchmarks in place of ours, every engine at its defaults");
  app.add_option("--scenes", arguments.scenes, "Names, separated by commas")->delimiter(',');
  app.add_option("--engines", arguments.engines,
                 "Scalars and other engines as the tables name them, separated by commas; none: all")
      ->delimiter(',');
  app.add_option("--rounds", arguments.race.rounds, "Runs of each scene; times are the lowest of them")
      ->check(CLI::Range(1, 99));
  app.add_option("--frames", arguments.race.frames, "Of a run; 0: as many as the scene says")
      ->check(CLI::Range(0, 100000));
  app.add_option("--patience", arguments.race.patience, "[s] CPU time of an engine's steps of a round; then it is left")
      ->check(CLI::Range(0.01, 86400.0))
      ->capture_default_str();
  app.add_option("--block", arguments.race.block, "Frames an engine runs before the next has its turn")
      ->check(CLI::Range(1, 1000));
  app.add_option("--substeps", arguments.race.engine.substeps, "Of ours; 0: the default")->check(CLI::Range(0, 64));
  app.add_option("--memory", arguments.memory, "Scenes whose peak memory is measured too")->delimiter(',');
  app.add_flag("--rollback", arguments.rollback, "The rollback table too");
  app.add_option("--results", arguments.results, "Directory for scenes.json, scenes.md and the points of the chart")
      ->check(CLI::ExistingDirectory);
  return isostep::bench::run_program(app, count, words, [&] {
    arguments.race.from_start = arguments.theirs;
    isostep::bench::run(arguments);
  });
}
