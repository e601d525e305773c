// isostep_peers: scenes and trials in Bullet, ODE and Rapier, as lines of the laboratory's results.
// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <fstream>

#include "peer_run.hpp"
#include "processes.hpp"
#include "scene_bench/program.hpp"
#include "scenes/named.hpp"
#include "scenes/trials/trial.hpp"

namespace isostep::bench {
namespace {

struct Arguments {
  std::vector<std::string> scenes;   // none: S1 to S9 and every trial
  std::vector<std::string> engines;  // none: all
  std::string out = "peers.jsonl";
  double limit = 20;
  int jobs = 1;
  bool fresh = false;
};

bool holds(const std::vector<std::string>& names, std::string_view name) {
  return std::count(names.begin(), names.end(), name) != 0;
}

std::vector<std::string> all_scenes() {
  std::vector<std::string> names = {"S1", "S1x10", "S2", "S3", "S4", "S4s", "S5", "S6", "S6v", "S7", "S8", "S9"};
  for (const scenes::Trial& trial : scenes::trials()) names.push_back(trial.name);
  return names;
}

std::vector<PeerJob> jobs_of(const Arguments& arguments) {
  const std::vector<Maker> makers = peer_makers();
  for (const std::string& name : arguments.engines) {
    const bool is_there = std::any_of(makers.begin(), makers.end(), [&](const Maker& m) { return m.name == name; });
    if (!is_there) throw CLI::ValidationError("--engines", "no engine " + name + " here");
  }
  std::vector<PeerJob> jobs;
  for (const std::string& scene : arguments.scenes.empty() ? all_scenes() : arguments.scenes) {
    if (!scenes::find_scene(scene)) throw CLI::ValidationError("--scenes", "no scene " + scene);
    for (const Maker& maker : makers) {
      if (arguments.engines.empty() || holds(arguments.engines, maker.name)) jobs.push_back({scene, maker});
    }
  }
  return jobs;
}

/// A record of the same scene, as it is now.
bool is_kept(const std::vector<LabRecord>& kept, const PeerJob& job) {
  const LabRecord empty = empty_record(job);
  return std::any_of(kept.begin(), kept.end(), [&](const LabRecord& record) {
    return record.result.point == empty.result.point && record.version == empty.version;
  });
}

/// A crash is what the engine made of the scene.
LabRecord record_of(const PeerJob& job, const ProcessEnd& end) {
  if (end.signal == 0 && !end.said.empty()) return tool::lab::from_line(end.said);
  LabRecord record = empty_record(job);
  if (end.out_of_time) {
    record.result.state = tool::lab::kSlow;
    return record;
  }
  record.result.reason = "the engine crashed, signal " + std::to_string(end.signal);
  record.result.judged = scenes::find_trial(job.scene) != nullptr;
  if (record.result.judged) record.result.state = tool::lab::kDone;
  return record;
}

void run(const Arguments& arguments) {
  std::vector<PeerJob> jobs = jobs_of(arguments);
  if (!arguments.fresh) {
    const std::vector<LabRecord> kept = tool::lab::read_records(arguments.out);
    std::erase_if(jobs, [&](const PeerJob& job) { return is_kept(kept, job); });
  }
  std::ofstream file(arguments.out, std::ios::binary | std::ios::app);
  std::size_t count = 0;
  Work work;
  work.count = jobs.size();
  work.jobs = arguments.jobs;
  work.cpu_limit = static_cast<int>(2 * arguments.limit) + 20;  // for building, measuring and Node's start too
  work.prepare = [&](std::size_t i) { prepare(jobs[i], 10 * arguments.limit); };
  work.run = [&](std::size_t i) { return to_line(run_peer(jobs[i], arguments.limit)); };
  work.done = [&](std::size_t i, const ProcessEnd& end) {
    const LabRecord record = record_of(jobs[i], end);
    file << to_line(record) << "\n" << std::flush;
    std::fprintf(stderr, "peers %zu/%zu: %s %s %s %s\n", ++count, jobs.size(), jobs[i].scene.c_str(),
                 jobs[i].maker.name, record.result.state.c_str(), record.result.reason.c_str());
  };
  in_processes(work);
  if (!file.flush()) throw std::runtime_error("cannot write " + arguments.out);
}

}  // namespace
}  // namespace isostep::bench

int main(int count, char** words) {
  isostep::bench::Arguments arguments;
  CLI::App app("Scenes and trials in Bullet, ODE and Rapier, as lines of the laboratory's results");
  app.add_option("--scenes", arguments.scenes, "Names, separated by commas; none: S1 to S9 and every trial")
      ->delimiter(',');
  app.add_option("--engines", arguments.engines, "rapier-simd, rapier-det, bullet, ode, separated by commas; none: all")
      ->delimiter(',');
  app.add_option("--out", arguments.out, "File to which lines are added; what it holds is not run again")
      ->capture_default_str();
  app.add_option("--limit", arguments.limit, "[s] CPU time of a run, then it is given up as slow")
      ->check(CLI::Range(0.1, 3600.0))
      ->capture_default_str();
  app.add_option("--jobs", arguments.jobs, "Runs at a time")->check(CLI::Range(1, 256))->capture_default_str();
  app.add_flag("--fresh", arguments.fresh, "Run again what the file holds");
  return isostep::bench::run_program(app, count, words, [&] { isostep::bench::run(arguments); });
}
