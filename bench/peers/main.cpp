// isostep_peers: scenes, trials and published tests in other engines, as lines of the laboratory's results.
// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>
#include <algorithm>
#include <fstream>

#include "peer_run.hpp"
#include "processes.hpp"
#include "scene_bench/program.hpp"
#include "scenes/named.hpp"
#include "scenes/published/published.hpp"
#include "scenes/trials/trial.hpp"
#include "tool/lab/progress.hpp"

namespace isostep::bench {
namespace {

struct Arguments {
  std::vector<std::string> scenes;   // none: S1 to S9 and every trial
  std::vector<std::string> engines;  // none: all
  std::vector<int> rates;            // [1/s] none: those of the scene
  int most_hz = 10000;               // [1/s] higher ones are left out
  bool published = false;
  std::string out = "peers.jsonl";
  int guard = 300;  // [s] the slowest that ends at all takes some four minutes for the published tower
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

std::vector<std::string> scenes_of(const Arguments& arguments) {
  if (arguments.scenes.empty() && !arguments.published) return all_scenes();
  std::vector<std::string> names = arguments.scenes;
  if (!arguments.published) return names;
  for (const scenes::PublishedTest& test : scenes::published_tests()) names.push_back(test.trial.name);
  return names;
}

/// A published test has the rates of its publication, what is ours the rate of games.
std::vector<int> rates_of(const Arguments& arguments, const std::string& scene) {
  if (!arguments.rates.empty()) return arguments.rates;
  const scenes::PublishedTest* published = scenes::find_published_test(scene);
  if (published == nullptr) return {60};
  return {published->rates.begin(), published->rates.end()};
}

std::vector<PeerJob> jobs_of(const Arguments& arguments) {
  const std::vector<Maker> makers = peer_makers();
  for (const std::string& name : arguments.engines) {
    const bool is_there = std::any_of(makers.begin(), makers.end(), [&](const Maker& m) { return m.name == name; });
    if (!is_there) throw CLI::ValidationError("--engines", "no engine " + name + " here");
  }
  std::vector<PeerJob> jobs;
  for (const std::string& scene : scenes_of(arguments)) {
    if (!scenes::find_scene(scene)) throw CLI::ValidationError("--scenes", "no scene " + scene);
    for (const int hz : rates_of(arguments, scene)) {
      if (hz > arguments.most_hz) continue;
      for (const Maker& maker : makers) {
        if (arguments.engines.empty() || holds(arguments.engines, maker.name)) jobs.push_back({scene, maker, hz});
      }
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
LabRecord record_of(const PeerJob& job, const ProcessEnd& end, int guard) {
  if (end.signal == 0 && !end.said.empty()) return tool::lab::from_line(end.said);
  if (!end.hung) return lost_record(job, "the engine crashed, signal " + std::to_string(end.signal));
  LabRecord record = empty_record(job);
  record.result.state = tool::lab::kHung;
  record.result.reason = "no end within " + std::to_string(guard) + " s";
  return record;
}

void run(const Arguments& arguments) {
  std::vector<PeerJob> jobs = jobs_of(arguments);
  if (!arguments.fresh) {
    const std::vector<LabRecord> kept = tool::lab::read_records(arguments.out);
    std::erase_if(jobs, [&](const PeerJob& job) { return is_kept(kept, job); });
  }
  std::ofstream file(arguments.out, std::ios::binary | std::ios::app);
  double all = 0;
  for (const PeerJob& job : jobs) all += work_of(job);
  tool::lab::Progress progress(true, jobs.size(), all);
  Work work;
  work.count = jobs.size();
  work.jobs = arguments.jobs;
  work.guard = arguments.guard;
  work.prepare = [&](std::size_t i) { prepare(jobs[i]); };
  work.run = [&](std::size_t i) { return to_line(run_peer(jobs[i])); };
  work.done = [&](std::size_t i, const ProcessEnd& end) {
    const LabRecord record = record_of(jobs[i], end, arguments.guard);
    file << to_line(record) << "\n" << std::flush;
    progress.done(work_of(jobs[i]), name_of(record.result.point) + " " + record.result.state);
  };
  in_processes(work);
  if (!file.flush()) throw std::runtime_error("cannot write " + arguments.out);
}

}  // namespace
}  // namespace isostep::bench

int main(int count, char** words) {
  isostep::bench::Arguments arguments;
  CLI::App app("Scenes, trials and published tests in other engines, as lines of the laboratory's results");
  std::string engines;
  for (const auto& maker : isostep::bench::peer_makers()) engines += maker.name + std::string(", ");
  app.add_option("--scenes", arguments.scenes, "Names, separated by commas; none: S1 to S9 and every trial")
      ->delimiter(',');
  app.add_flag("--published", arguments.published, "Every published test, beside --scenes");
  app.add_option("--engines", arguments.engines, engines + "separated by commas; none: all")->delimiter(',');
  app.add_option("--hz", arguments.rates, "[1/s] Rates of steps, separated by commas; none: 60, a published test's own")
      ->delimiter(',')
      ->check(CLI::Range(10, 10000));
  app.add_option("--most-hz", arguments.most_hz, "[1/s] Higher rates are left out")->check(CLI::Range(10, 10000));
  app.add_option("--out", arguments.out, "File to which lines are added; what it holds is not run again")
      ->capture_default_str();
  app.add_option("--guard", arguments.guard, "[s] of a run, then its process is ended as one that hangs")
      ->check(CLI::Range(1, 86400))
      ->capture_default_str();
  app.add_option("--jobs", arguments.jobs, "Runs at a time")->check(CLI::Range(1, 256))->capture_default_str();
  app.add_flag("--fresh", arguments.fresh, "Run again what the file holds");
  return isostep::bench::run_program(app, count, words, [&] { isostep::bench::run(arguments); });
}
