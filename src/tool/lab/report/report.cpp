// The report, piece by piece: what is kept of this version is taken as it is.
// SPDX-License-Identifier: MIT
#include "report.hpp"

#include <algorithm>
#include <ctime>
#include <filesystem>
#include <iostream>

#include "charts.hpp"
#include "isostep/core/version.hpp"
#include "page.hpp"
#include "peer_program.hpp"
#include "tool/common/files.hpp"
#include "tool/common/tool.hpp"
#include "tool/lab/commands.hpp"
#include "tool/lab/gnuplot.hpp"

namespace isostep::tool::lab {
namespace {

namespace fs = std::filesystem;

std::string text_of(const std::string& path) {
  std::error_code error;
  if (!fs::exists(path, error)) return {};
  const std::vector<std::uint8_t> bytes = read_file(path);
  return {bytes.begin(), bytes.end()};
}

class ReportWriter {
 public:
  explicit ReportWriter(const ReportOptions& options) : options_(options) {
    data_.is_short = options.is_short;
    data_.plan = options.is_short ? short_plan() : whole_plan();
    open_report(options, "report.html");
    forget_other_versions();
  }

  int run() {
    sweep_all();
    const Peers peers = run_peers();
    measure_the_rest();
    draw_all();
    write_file(in("report.html"), page_of(data_));
    const std::string summary = summary_of(data_) + "\n" + stamp();
    write_file(in("lab.md"), summary);
    if (!options_.is_short) renew_repository(summary);
    std::cout << in("report.html") << "\n";
    return status_of(peers, options_);
  }

 private:
  std::string in(const std::string& name) const { return options_.out + "/" + name; }

  /// Tables that carry no version themselves go with a file that does.
  void forget_other_versions() {
    const std::string version = hex(behaviour_version()) + (options_.is_short ? " short" : " whole") + "\n";
    if (!options_.fresh && text_of(in("report.version")) == version) return;
    for (const char* name : {"lab_growth.tsv", "lab_stages.tsv", "springs.tsv", "springs.svg"}) {
      std::error_code ignored;
      fs::remove(in(name), ignored);
    }
    write_file(in("report.version"), version);
  }

  /// The parts are the scenes, an effort each, peers, and the rest.
  void begin_part(const std::string& what) {
    std::cerr << "lab, part " << ++part_ << " of " << data_.plan.trial_efforts.size() + 3 << ": " << what << "\n";
  }
  std::vector<LabResult> swept(const std::vector<LabPoint>& points, const std::string& what) {
    begin_part(std::to_string(points.size()) + " runs of " + what);
    return sweep(points, sweep_options_of(options_));
  }
  void add(std::vector<LabResult> results) {
    data_.results.insert(data_.results.end(), std::make_move_iterator(results.begin()),
                         std::make_move_iterator(results.end()));
  }

  void sweep_all() {
    add(swept(scene_points(data_.plan), "scenes"));
    for (std::size_t n = 0; n < data_.plan.trial_efforts.size(); ++n) {
      const Effort effort = data_.plan.trial_efforts[n];
      const std::string rate = effort.rate == 1 ? "" : ", " + std::to_string(effort.rate) + " times the steps";
      add(swept(trial_points(data_.plan, n, data_.results),
                "trials with " + std::to_string(effort.substeps) + " sub-steps" + rate));
    }
  }

  /// The program resumes by itself; its lines are read whether it was there or not.
  Peers run_peers() {
    begin_part("other engines");
    Peers peers = peers_of(options_, {"peers.jsonl", "", [this](const std::string& scene) { return is_asked(scene); }});
    add(peers.results);
    data_.matrix = matrix_of(data_.plan.trials, data_.plan.scalars, data_.plan.solvers, data_.results);
    return peers;
  }

  bool is_asked(const std::string& scene) const {
    const auto holds = [&](const std::vector<std::string>& names) {
      return std::find(names.begin(), names.end(), scene) != names.end();
    };
    return holds(data_.plan.scenes) || holds(data_.plan.trials);
  }

  void measure_the_rest() {
    begin_part("error growth, stages, springs");
    if (text_of(in("lab_growth.tsv")).empty()) {
      write_file(in("lab_growth.tsv"), growth_tsv(measure_growth(options_.is_short ? 120 : 600)));
    }
    if (text_of(in("lab_stages.tsv")).empty()) {
      const bool quick = options_.is_short;
      write_file(in("lab_stages.tsv"), stages_tsv(measure_stages(quick ? 30 : 120, quick ? 10 : 60)));
    }
    data_.stages = stages_of(text_of(in("lab_stages.tsv")));
    if (text_of(in("springs.tsv")).empty()) {
      LabSpringsOptions springs;
      springs.quick = true;
      springs.out = options_.out;
      springs.quiet = true;
      command_lab_springs(springs);
    }
  }

  void draw_all() {
    write_file(in("lab_accuracy.tsv"), accuracy_tsv(data_.results));
    write_file(in("lab_survival.svg"), survival_svg(data_.matrix));
    data_.accuracy = drawn("lab_accuracy");
    data_.growth = drawn("lab_growth");
    data_.stage_chart = drawn("lab_stages");
    data_.springs = text_of(in("springs.svg"));
  }
  std::string drawn(const std::string& name) {
    return draw_chart(options_.out, name) ? text_of(in(name + ".svg")) : "";
  }

  /// The pictures of bench/pages/laboratory.md, and the table that people read in the repository.
  void renew_repository(const std::string& summary) {
    const fs::path bench = fs::path(ISOSTEP_CHART_DIR).parent_path();
    if (!fs::is_directory(bench / "charts") || !fs::is_directory(bench / "results")) return;
    if (!data_.accuracy.empty()) rasterise(in("lab_accuracy.svg"), (bench / "charts/lab_accuracy.png").string());
    rasterise(in("lab_survival.svg"), (bench / "charts/lab_survival.png").string());
    write_file((bench / "results/lab.md").string(), summary);
    std::cerr << "lab: renewed charts/lab_*.png and results/lab.md in " << bench.string() << "\n";
  }

  const ReportOptions& options_;
  ReportData data_;
  std::size_t part_ = 0;
};

}  // namespace

SweepOptions sweep_options_of(const ReportOptions& options) {
  SweepOptions sweep_options;
  sweep_options.out = options.out;
  sweep_options.jobs = options.jobs;
  sweep_options.limit = options.limit;
  sweep_options.fresh = options.fresh;
  return sweep_options;
}

void open_report(const ReportOptions& options, const std::string& page) {
  std::error_code error;
  fs::create_directories(options.out, error);
  if (error) throw ToolError(exit_status::kOutput, options.out + ": " + error.message());
  expect_writable(options.out + "/" + page);
  expect_peers(options);
}

std::string stamp() {
  const std::time_t now = std::time(nullptr);
  char day[16];
  std::strftime(day, sizeof day, "%Y-%m-%d", std::gmtime(&now));
  return std::string(day) + ", isostep " + kVersionText + ", behaviour " + hex(behaviour_version()) + ".\n";
}

int write_lab_report(const ReportOptions& options) { return ReportWriter(options).run(); }

}  // namespace isostep::tool::lab
