// isostep_session_bench: what sessions cost: time in a frame, bytes on a link, rollbacks, kept states.
// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>

#include "isostep/core/scalar_names.hpp"
#include "parts.hpp"
#include "scene_bench/rollback.hpp"

namespace isostep::bench {
namespace {

void report_rollbacks(const SessionBenchOptions& options) {
  std::vector<RollbackRow> rows;
  for (const char* scene : {"S4", "S9"}) {
    const std::vector<RollbackRow> here = measure_rollback(scene, options.scalars);
    rows.insert(rows.end(), here.begin(), here.end());
  }
  std::printf("\nRollback, S4 and S9 as they are after the frames of a run:\n\n%s", table_of(rows).c_str());
  std::fflush(stdout);
}

struct Part {
  const char* name;
  void (*report)(const SessionBenchOptions& options);
};
constexpr Part kParts[] = {{"overhead", report_overhead},   {"crowd", report_crowds},
                           {"bandwidth", report_bandwidth}, {"genres", report_genres},
                           {"rollback", report_rollbacks},  {"drive", report_drives},
#ifdef ISOSTEP_BENCH_SEALED
                           {"sealing", report_sealing},
#endif
                           {"kept", report_kept_states}};

}  // namespace
}  // namespace isostep::bench

int main(int count, char** words) {
  using namespace isostep::bench;
  SessionBenchOptions options;
  options.scalars = isostep::scalar_names();
  std::vector<std::string> parts;
  for (const Part& part : kParts) parts.push_back(part.name);
  CLI::App app("What sessions cost: time in a frame, bytes on a link, rollbacks, kept states");
  app.add_option("--parts", parts,
                 "overhead, crowd, bandwidth, genres, rollback, drive, sealing, kept, separated by commas")
      ->delimiter(',')
      ->check(CLI::IsMember(parts));
  app.add_option("--players", options.players, "Of overhead and bandwidth")->delimiter(',')->check(CLI::Range(2, 8));
  app.add_option("--scalars", options.scalars, "Of rollback, drive and kept")
      ->delimiter(',')
      ->check(CLI::IsMember(isostep::scalar_names()));
  app.add_option("--frames", options.frames, "Of a match of overhead and crowd")->check(CLI::Range(400, 100000));
  app.add_option("--repeats", options.repeats, "Of the same match; times are the least of them")
      ->check(CLI::Range(1, 99));
  CLI11_PARSE(app, count, words);
  try {
    for (const Part& part : kParts) {
      if (std::find(parts.begin(), parts.end(), part.name) != parts.end()) part.report(options);
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 70;
  }
  return 0;
}
