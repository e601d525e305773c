// isostep run: one scene, measured; and its recording, hashes, snapshot and last frame as files.
// SPDX-License-Identifier: MIT
#include <iostream>
#include <optional>
#include <utility>

#include "commands.hpp"
#include "files.hpp"
#include "games.hpp"
#include "goldens.hpp"
#include "particle_watch.hpp"
#include "run_watch.hpp"
#include "threads/tbb_runner.hpp"
#include "worlds.hpp"

namespace isostep::tool {
namespace {

template <class W> void load_snapshot(W& world, const RunOptions& options) {
  const std::vector<std::uint8_t> bytes = read_file(options.load);
  if (const Result<void> read = read_whole(world, bytes); !read) {
    throw ToolError(exit_status::kUsage, options.load + ": " + std::string(read.error().message.view()) + " (" +
                                             std::string(read.error().place.view()) + ")");
  }
  if (!is_as_asked(world.settings(), options.game))
    throw ToolError(exit_status::kUsage, options.load + ": a snapshot keeps its own hz, substeps and methods");
}

template <class Game> class Run {
 public:
  using World = typename Game::World;
  using Scene = typename Game::Scene;
  using Watch = decltype(watch_of(std::declval<const World&>()));

  Run(const RunOptions& options, const Scene& scene) : options_(options), scene_(scene), game_(scene, options.game) {
    if (!options.load.empty()) load_snapshot(game_.world, options);
    use_lanes(game_.world, simd_named(options.simd));
    if (options.threads > 1) use_threads(game_.world, threads_.emplace(options.threads).runner());
  }

  int run() {
    open_recording();
    const int frames = options_.frames >= 0 ? options_.frames : scene_.frames;
    watch_.emplace(watch_of(game_.world));
    for (int i = 0; i < frames && !interrupted(); ++i) step(i, i + 60 >= frames);
    finish(frames);
    return interrupted() ? exit_status::kInterrupted : exit_status::kOk;
  }

 private:
  void open_recording() {
    if (options_.record.empty()) return;
    file_.emplace(options_.record);
    recorder_.emplace(game_.world, file_->sink());
    expect_written(recorder_->begin(scene_.name));
  }

  void step(int frame, bool last_second) {
    game_.before_step(game_.world);
    const double before = now();
    const auto stepped = game_.world.step();
    ms_.push_back(now() - before);
    game_.after_step(game_.world);
    watch_->stepped(game_.world, stepped, frame, last_second);
    if (!recorder_ && options_.hashes.empty()) return;
    hashes_.push_back(game_.world.hash());
    if (recorder_) expect_written(recorder_->end_frame(hashes_.back()));
  }
  /// [ms] Of one thread its own time; what several save shows in real time alone.
  double now() const { return options_.threads > 1 ? real_milliseconds() : thread_milliseconds(); }

  void finish(int frames) {
    if (recorder_) {
      expect_written(recorder_->finish());
      file_->close();
    }
    if (!options_.hashes.empty()) write_file(options_.hashes, hash_lines(hashes_));
    if (!options_.dump.empty()) write_file(options_.dump, dump_of(game_.world));
    if (!options_.save.empty()) {
      std::vector<std::uint8_t> bytes;
      Writer writer(bytes);
      game_.world.write_portable(writer);
      write_file(options_.save, Bytes(bytes));
    }
    if (interrupted()) {
      std::cerr << "isostep: interrupted after " << ms_.size() << " of " << frames << " frames\n";
      return;
    }
    const auto report = complete_report();
    std::cout << (options_.json ? json_of(report) : table_of(report));
  }

  typename Watch::Report complete_report() {
    typename Watch::Report report = watch_->report(game_.world);
    report.scene = scene_.name;
    report.scalar = ScalarTraits<typename World::Scalar>::kName;
    report.threads = options_.threads;
    report.frames = static_cast<int>(ms_.size());
    report.hash = game_.world.hash();
    report.ms = summarise(ms_);
    return report;
  }

  const RunOptions& options_;
  std::optional<threads::TbbRunner> threads_;  // outlives the world
  const Scene& scene_;
  Game game_;
  std::optional<ReplayFile> file_;
  std::optional<TapeRecorder<World>> recorder_;
  std::optional<Watch> watch_;
  std::vector<double> ms_;
  std::vector<std::uint64_t> hashes_;
};

}  // namespace

int command_run(const RunOptions& options) {
  int status = exit_status::kSoftware;
  with_game(options.scene, options.scalar, [&](auto tag, const auto& scene) {
    std::optional<Run<typename decltype(tag)::Type>> run;
    try {
      run.emplace(options, scene);
    } catch (const scenes::SceneError& error) {
      fail_scene(options.scene, error);
    }
    status = run->run();
  });
  return status;
}

}  // namespace isostep::tool
