// isostep_scene_bench: the benchmark scenes in every scalar, beside Bullet and ODE where installed, in one run.
// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>

#include "report.hpp"
#include "scenes/named.hpp"

namespace isostep::bench {
namespace {

struct Arguments {
  std::vector<std::string> scenes = {"S1", "S1x10", "S2", "S3", "S4", "S4s", "S5", "S6", "S6v", "S7", "S8", "S9"};
  std::vector<std::string> engines;  // none: all
  std::string json;
  bool no_rollback = false;
  RaceOptions race;
};

std::vector<Maker> chosen_makers(const Arguments& arguments) {
  std::vector<Maker> chosen;
  for (const Maker& maker : makers()) {
    const auto& names = arguments.engines;
    if (names.empty() || std::count(names.begin(), names.end(), std::string(maker.name)) != 0) chosen.push_back(maker);
  }
  return chosen;
}

void say_absent_peers() {
#if !defined(ISOSTEP_BENCH_BULLET)
  std::puts("Bullet: not built in (libbullet-dev was not found), left out.\n");
#endif
#if !defined(ISOSTEP_BENCH_ODE)
  std::puts("ODE: not built in (libode-dev was not found), left out.\n");
#endif
}

int write_json(const Arguments& arguments, const std::string& text) {
  if (arguments.json.empty()) return 0;
  std::FILE* file = std::fopen(arguments.json.c_str(), "wb");
  const bool written = file != nullptr && std::fputs(text.c_str(), file) >= 0;
  if (file == nullptr || std::fclose(file) != 0 || !written) {
    std::fprintf(stderr, "cannot write %s\n", arguments.json.c_str());
    return 74;
  }
  return 0;
}

int run(const Arguments& arguments) {
  const std::vector<Maker> engines = chosen_makers(arguments);
  std::vector<Row> rows;
  say_absent_peers();
  std::fputs(heading().c_str(), stdout);
  for (const std::string& name : arguments.scenes) {
    const std::optional<scenes::Scene> scene = scenes::find_scene(name);
    if (!scene) {
      std::fprintf(stderr, "no scene %s\n", name.c_str());
      return 64;
    }
    const std::vector<Row> here = race(*scene, engines, arguments.race);
    std::fputs(table_of(here).c_str(), stdout);
    std::fflush(stdout);
    rows.insert(rows.end(), here.begin(), here.end());
  }
  std::vector<RollbackRow> rollback;
  if (!arguments.no_rollback) {
    std::vector<std::string> scalars;
    for (const Maker& maker : engines) scalars.push_back(maker.name);
    for (const char* name : {"S4", "S9"}) {
      const std::vector<RollbackRow> here = measure_rollback(name, scalars);
      rollback.insert(rollback.end(), here.begin(), here.end());
    }
    std::printf("\nRollback, S4 and S9 as they are after the frames of a run:\n\n%s", table_of(rollback).c_str());
  }
  return write_json(arguments, json_of(rows, rollback, arguments.race));
}

}  // namespace
}  // namespace isostep::bench

int main(int count, char** words) {
  isostep::bench::Arguments arguments;
  CLI::App app("The benchmark scenes in every scalar, beside Bullet and ODE");
  app.add_option("--scenes", arguments.scenes, "Names, separated by commas")->delimiter(',');
  app.add_option("--engines", arguments.engines, "Scalars, bullet, ode, separated by commas; none: all")
      ->delimiter(',');
  app.add_option("--rounds", arguments.race.rounds, "Runs of each scene; times are medians over them")
      ->check(CLI::Range(1, 99));
  app.add_option("--block", arguments.race.block, "Frames an engine runs before the next has its turn")
      ->check(CLI::Range(1, 1000));
  app.add_option("--substeps", arguments.race.engine.substeps, "Of ours; 0: the default")->check(CLI::Range(0, 64));
  app.add_flag("--no-rollback", arguments.no_rollback, "Leave the rollback table out");
  app.add_option("--json", arguments.json, "Write every figure to this file");
  CLI11_PARSE(app, count, words);
  try {
    return isostep::bench::run(arguments);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 70;
  }
}
