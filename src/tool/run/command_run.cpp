// isostep run: one scene, measured; and its recording, hashes, snapshot and last frame as files.
// SPDX-License-Identifier: MIT
#include <cstdio>
#include <iostream>
#include <optional>
#include <type_traits>
#include <utility>

#include "commands.hpp"
#include "isostep/replay/world_kinds.hpp"
#include "isostep/state/command_recorder.hpp"
#include "particle_watch.hpp"
#include "run_watch.hpp"
#include "threads/tbb_runner.hpp"
#include "tool/common/files.hpp"
#include "tool/common/games.hpp"
#include "tool/common/hash_lines.hpp"
#include "tool/page/camera.hpp"
#include "tool/page/film.hpp"
#include "tool/page/page.hpp"
#include "watch.hpp"

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

template <class Scene> int frames_of(const RunOptions& options, const Scene& scene) {
  return options.frames >= 0 ? options.frames : scene.frames;
}

template <class Game> class Run {
 public:
  using World = typename Game::World;
  using Scene = typename Game::Scene;
  using Watch = decltype(watch_of(std::declval<const World&>()));

  Run(const RunOptions& options, const Scene& scene) : options_(options), scene_(scene) {
    if (!options.record.empty() && frames_of(options, scene) == 0)
      throw ToolError(exit_status::kUsage, "--record: a recording needs a frame");
    build();
    if (options.load.empty()) return;
    load_snapshot(game_->world, options);
    open_recording(game_->world);
  }

  /// `camera`: for a page, or null.
  int run(page::Camera* camera) {
    const int frames = frames_of(options_, scene_);
    watch_.emplace(watch_of(game_->world));
    if (options_.load.empty()) judge();
    if (camera != nullptr) camera->begin(game_->world);
    for (int i = 0; i < frames && !interrupted(); ++i) {
      step(i, i + 60 >= frames);
      if (camera != nullptr) camera->stepped(game_->world, i + 1, i + 1 == frames);
    }
    finish(frames);
    return interrupted() ? exit_status::kInterrupted : exit_status::kOk;
  }

 private:
  /// Trials and benchmarks are of rigid bodies, and named: no file's scene is one.
  void judge() {
    if constexpr (std::is_same_v<Scene, scenes::Scene>) {
      const scenes::Trial* const trial = scenes::find_trial(options_.scene);
      if (trial != nullptr) watch_->judge(*trial, scene_, game_->world);
      if (scenes::is_benchmark(options_.scene)) watch_->count_lost(options_.scene, game_->world);
    }
  }

  /// A recording begins with the empty world, so that whoever verifies it builds the scene as well; or with what is
  /// loaded.
  void build() {
    const bool recorded_empty = !options_.record.empty() && options_.load.empty();
    if (recorded_empty) static_cast<void>(Game(scene_, options_.game));  // a scene that is refused leaves no file
    game_.emplace(scene_, options_.game, [&](World& empty) {
      use_lanes(empty, simd_named(options_.simd).value());
      if constexpr (requires { empty.broad_phase(); }) {
        const BroadPhaseName name = broad_phase_named(options_.broad_phase).value();
        if (const char* why = left_out(name)) throw ToolError(exit_status::kUsage, why);
        empty.use_broad_phase(name);
      }
      if (options_.threads > 1) use_threads(empty, threads_.emplace(options_.threads).runner());
      if (recorded_empty) open_recording(empty);
    });
  }

  void open_recording(World& world) {
    if (options_.record.empty()) return;
    file_.emplace(options_.record);
    recorder_.emplace(world, file_->sink());
    file_->check(recorder_->begin(scene_.name));
  }

  void step(int frame, bool last_second) {
    game_->before_step(game_->world);
    const double before = now();
    const auto stepped = game_->world.step();
    ms_.push_back(now() - before);
    game_->after_step(game_->world);
    watch_->stepped(game_->world, stepped, frame, last_second);
    if (!recorder_ && options_.hashes.empty()) return;
    hashes_.push_back(game_->world.hash());
    if (recorder_) file_->check(recorder_->end_frame(hashes_.back()));
  }
  /// [ms] The time: a single thread's own; with several threads, which save real time alone, the real time.
  double now() const { return options_.threads > 1 ? real_milliseconds() : thread_milliseconds(); }

  void finish(int frames) {
    if (recorder_) {
      if (!ms_.empty()) file_->check(recorder_->keyframe());  // none when interrupted before the first frame
      file_->check(recorder_->finish());
      file_->close();
    }
    if (!options_.hashes.empty()) write_file(options_.hashes, hash_lines(hashes_));
    if (!options_.dump.empty()) write_file(options_.dump, dump_of(game_->world));
    if (!options_.save.empty()) {
      std::vector<std::uint8_t> bytes;
      Writer writer(bytes);
      game_->world.write_portable(writer);
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
    typename Watch::Report report = watch_->report(game_->world);
    report.scene = scene_.name;
    report.scalar = ScalarTraits<typename World::Scalar>::kName;
    report.threads = options_.threads;
    report.frames = static_cast<int>(ms_.size());
    report.hash = game_->world.hash();
    report.ms = summarise(ms_);
    return report;
  }

  const RunOptions& options_;
  std::optional<threads::TbbRunner> threads_;  // outlives the world
  const Scene& scene_;
  std::optional<Game> game_;
  std::optional<ReplayFile> file_;
  std::optional<CommandRecorder<World>> recorder_;
  std::optional<Watch> watch_;
  std::vector<double> ms_;
  std::vector<std::uint64_t> hashes_;
};

/// Films the run in another scalar, for the page alone.
template <class Game> void film(const RunOptions& options, const typename Game::Scene& scene, page::Camera& camera) {
  Game game(scene, options.game);
  camera.begin(game.world);
  const int frames = frames_of(options, scene);
  for (int i = 0; i < frames; ++i) {
    stop_if_interrupted();
    game.before_step(game.world);
    game.world.step();
    game.after_step(game.world);
    camera.stepped(game.world, i + 1, i + 1 == frames);
  }
}

void require_page(const RunOptions& options) {
  require_pages();
  if (!options.beside.empty() && !options.load.empty())
    throw ToolError(exit_status::kUsage, "--beside begins both runs anew: not with --load");
}

/// The text about the run beside it.
std::string told_of(const page::Film& film, const RunOptions& options) {
  if (options.beside.empty()) return "";
  char text[160];
  const page::Divergence& apart = film.divergence;
  if (apart.frame == page::Divergence::kNever) {
    std::snprintf(text, sizeof text, "; %s stays within %g mm of it", options.beside.c_str(), 1e3 * film.tolerance);
  } else {
    const auto frame = static_cast<std::size_t>(apart.frame);
    std::snprintf(text, sizeof text, "; %s parts from it at frame %llu, body %u by %.3g mm", options.beside.c_str(),
                  static_cast<unsigned long long>(film.run.frames[frame].tick), apart.slot, 1e3 * apart.distance);
  }
  return text;
}

void finish_page(page::Film& film, const RunOptions& options) {
  film.every = options.html_every;
  film.tolerance = options.beside_tolerance;
  if (!options.beside.empty()) film.divergence = page::compare(film.run, film.beside, film.tolerance);
  write_page(film, options.html, !options.json, told_of(film, options));
}

}  // namespace

int command_run(const RunOptions& options) {
  if (is_recording(options.scene)) return watch(options);
  std::optional<page::Film> shot;
  if (!options.html.empty()) {
    require_page(options);
    shot.emplace();
  }
  for (const std::string& path : {options.hashes, options.dump, options.save, options.html}) expect_writable(path);
  int status = exit_status::kSoftware;
  with_game(options.scene, options.scalar, [&](auto tag, const auto& scene) {
    std::optional<Run<typename decltype(tag)::Type>> run;
    std::optional<page::Camera> camera;
    try {
      run.emplace(options, scene);
    } catch (const scenes::SceneError& error) {
      fail_scene(options.scene, error);
    }
    if (shot) {
      shot->scene = scene.name;
      camera.emplace(shot->run, options.html_every);
    }
    status = run->run(camera ? &*camera : nullptr);
  });
  if (!shot || status != exit_status::kOk) return status;
  if (!options.beside.empty()) {
    with_game(options.scene, options.beside, [&](auto tag, const auto& scene) {
      page::Camera camera(shot->beside, options.html_every);
      film<typename decltype(tag)::Type>(options, scene, camera);
    });
  }
  finish_page(*shot, options);
  return status;
}

}  // namespace isostep::tool
