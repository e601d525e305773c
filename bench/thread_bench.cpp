// isostep_thread_bench: the real time of a step on one thread and on several, in one run.
// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>
#include <optional>
#include <thread>

#include "isostep/core/scalar_names.hpp"
#include "scenes/build.hpp"
#include "scenes/named.hpp"
#include "threads/tbb_runner.hpp"

namespace isostep::bench {
namespace {

struct Arguments {
  std::vector<std::string> scenes = {"S3", "S4", "S5", "S7", "large_pyramid", "convex_pile", "human_rain"},
                           scalars = scalar_names();
  std::vector<int> threads;
  int frames = 400, block = 20;
  std::string results;
};

/// One world of the scene and the threads that step it.
template <class S> struct Lane {
  Lane(const scenes::Scene& scene, int thread_count) : world(scenes::settings_of<S>(scene)) {
    scenes::build(scene, world);
    if (thread_count > 1) world.use_threads(pool.emplace(thread_count).runner());
  }
  void run(int frames) {
    for (int i = 0; i < frames; ++i) {
      const auto start = std::chrono::steady_clock::now();
      world.step();
      const std::chrono::duration<double, std::milli> taken = std::chrono::steady_clock::now() - start;
      times.push_back(taken.count());
    }
  }
  /// [ms] the value that this share of the second half's steps do not exceed.
  double quantile(double share) const {
    std::vector<double> settled(times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2), times.end());
    std::sort(settled.begin(), settled.end());
    return settled[static_cast<std::size_t>(share * static_cast<double>(settled.size() - 1))];
  }

  std::optional<threads::TbbRunner> pool;  // outlives the world
  World<S> world;
  std::vector<double> times;  // [ms]
};

/// Returns the part of a step that one thread does alone, by Amdahl's law: the gain of n threads is
/// 1 / (serial + (1 - serial) / n). What threads cost each other counts as serial.
double serial_part(double gain, int threads) {
  return threads > 1 ? std::clamp((threads / gain - 1) / (threads - 1), 0.0, 1.0) : 1;
}

template <class S> bool measure(const std::string& name, const scenes::Scene& scene, const Arguments& arguments) {
  std::vector<std::unique_ptr<Lane<S>>> lanes;
  for (const int threads : arguments.threads) lanes.push_back(std::make_unique<Lane<S>>(scene, threads));
  for (int frame = 0; frame < arguments.frames; frame += arguments.block) {
    for (auto& lane : lanes) lane->run(arguments.block);
  }
  std::printf("| %s | %s |", name.c_str(), ScalarTraits<S>::kName);
  bool same = true;
  for (const auto& lane : lanes) {
    std::printf(" %.3f", lane->quantile(0.5));
    if (lane != lanes[0]) std::printf(" (%.2fx)", lanes[0]->quantile(0.5) / lane->quantile(0.5));
    std::printf(" |");
    same = same && lane->world.hash() == lanes[0]->world.hash();
  }
  const double gain = lanes[0]->quantile(0.1) / lanes.back()->quantile(0.1);
  const double serial = serial_part(gain, arguments.threads.back());
  std::printf(" %.2fx | %.0f %% | %.1fx | %s |\n", gain, 100 * serial, 1 / (serial + (1 - serial) / 16),
              same ? "equal" : "DIFFER");
  std::fflush(stdout);
  return same;
}

int run(const Arguments& arguments) {
  std::printf(
      "Real milliseconds a step, median of the settled half, and the gain over one thread; the gain in the best\n"
      "tenth of the steps, which other work on the machine disturbs least; by that the part of a step that one thread\n"
      "does alone, and the gain that 16 threads would have (Amdahl's law, not measured).\n\n| scene | scalar |");
  for (const int threads : arguments.threads) std::printf(" %d thread%s |", threads, threads > 1 ? "s" : "");
  std::printf(" best tenth | serial | of 16 | hashes |\n|---|---|");
  for (std::size_t i = 0; i < arguments.threads.size() + 4; ++i) std::printf("---|");
  std::puts("");
  bool same = true;
  for (const std::string& name : arguments.scenes) {
    const std::optional<scenes::Scene> scene = scenes::find_scene(name);
    if (!scene) return std::fprintf(stderr, "no scene %s\n", name.c_str()), 64;
    for (const std::string& scalar : arguments.scalars) {
      if (!scenes::is_in_range(name, scalar)) continue;
#define ISO_MEASURE(S) \
  if (scalar == ScalarTraits<S>::kName) same = measure<S>(name, *scene, arguments) && same;
      ISO_FOR_EACH_SCALAR(ISO_MEASURE)
#undef ISO_MEASURE
    }
  }
  return same ? 0 : 1;
}

}  // namespace
}  // namespace isostep::bench

int main(int count, char** words) {
  isostep::bench::Arguments arguments;
  const auto cores = static_cast<int>(std::max(2u, std::thread::hardware_concurrency()));
  for (int threads = 1; threads < cores; threads *= 2) arguments.threads.push_back(threads);
  arguments.threads.push_back(cores);
  CLI::App app("The real time of a step on one thread and on several");
  app.add_option("--scenes", arguments.scenes, "Names, separated by commas")->delimiter(',');
  app.add_option("--scalars", arguments.scalars, "Separated by commas")
      ->delimiter(',')
      ->check(CLI::IsMember(isostep::scalar_names()));
  app.add_option("--threads", arguments.threads, "Numbers of threads, separated by commas; the first is the measure")
      ->delimiter(',')
      ->check(CLI::Range(1, 64));
  app.add_option("--frames", arguments.frames, "Steps of each")->check(CLI::Range(20, 100000));
  app.add_option("--results", arguments.results, "Ignored: this benchmark leaves no file");
  CLI11_PARSE(app, count, words);
  return isostep::bench::run(arguments);
}
