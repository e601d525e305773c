// isostep_rollback_bench: a rollback of eight frames that steps all, and one that steps what differs.
// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "isostep/core/scalar_names.hpp"
#include "isostep/store/state.hpp"
#include "scene_bench/clock.hpp"
#include "scenes/build.hpp"
#include "scenes/named.hpp"
#include "scenes/script.hpp"
#include "scenes/shapes.hpp"

namespace isostep::bench {
namespace {

constexpr std::size_t kFrames = 8;

struct Arguments {
  std::vector<std::string> scenes = {"field", "S4", "S9", "street"}, scalars = scalar_names();
  std::vector<int> pushed = {1, 10, 100, 1000};
  int bodies = 1000, rounds = 41, settle = 60;
  bool json = false;
  std::string results;
};

/// Boxes on a floor, two metres apart, that never sleep: an island each.
scenes::Scene field_of(int bodies) {
  scenes::Scene scene;
  scene.name = "field";
  scene.allow_sleep = false;
  const int across = static_cast<int>(std::ceil(std::sqrt(bodies)));
  scene.bodies.push_back(scenes::fixed_box({0, -1, 0}, {across + 10.0, 1, across + 10.0}));
  for (int i = 0; i < bodies; ++i) {
    const double x = 2.0 * (i % across) - across, z = 2.0 * (i / across) - across;
    scene.bodies.push_back(scenes::body_of(scenes::box_part({0.5, 0.5, 0.5}), {x, 0.5, z}));
  }
  return scene;
}

struct Row {
  std::string scene, scalar;
  std::uint32_t awake = 0;
  int pushed = 0;
  double whole_ms = 0, part_ms = 0;        // of the rollback, medians
  double forward_ms = 0, remember_ms = 0;  // of a step that is new, without and with memory, medians
  double stepped = 0;                      // [1] of the awake bodies
  std::uint64_t whole_steps = 0;           // of those that memory was asked for
  bool same = true;
};

/// A world that plays eight frames, is told what came late, and plays them again.
template <class S> class Lane {
 public:
  Lane(const scenes::Scene& scene, bool remembers) : script_(scene.script), world(scenes::settings_of<S>(scene)) {
    scenes::build(scene, world);
    if (remembers) world.remember_steps(kFrames);
  }
  void settle(int frames) {
    for (int i = 0; i < frames; ++i) step();
  }
  void play() {
    for (auto& snapshot : ring_) {
      world.save(snapshot);
      const double start = thread_milliseconds();
      step();
      forward.push_back(thread_milliseconds() - start);
    }
  }
  /// Other bodies in each round, so that what came late differs from what was there.
  void roll_back(int pushed, int round) {
    const double start = thread_milliseconds();
    world.load(ring_[0]);
    movers_.clear();
    for (const BodyState<S>& body : world.state().awake.states) {
      const BodyId id = world.state().body_slots.template id_of<BodyId>(body.slot);
      if (world.type(id) == BodyType::dynamic) movers_.push_back(id);
    }
    const std::size_t count = std::min(movers_.size(), static_cast<std::size_t>(pushed));
    for (std::size_t i = 0; i < count; ++i) {
      const BodyId body = movers_[(i * 7919 + static_cast<std::size_t>(round)) % movers_.size()];
      world.apply_impulse(body, {S(0), S(0), from_double<S>(0.125 + 0.0625 * (round % 8))});
    }
    for (std::size_t i = 0; i < kFrames; ++i) {
      step();
      if (i + 1 < kFrames) world.save(ring_[i + 1]);
      hashes ^= world.hash();
    }
    times.push_back(thread_milliseconds() - start);
  }

 private:
  void step() {
    scenes::before_step(script_, world);
    world.step();
  }

  scenes::Script script_;
  std::vector<BodyId> movers_;
  std::array<typename World<S>::Snapshot, kFrames> ring_;

 public:
  World<S> world;
  std::vector<double> times, forward;  // [ms]
  std::uint64_t hashes = 0;
};

template <class S> Row measure(const scenes::Scene& scene, int pushed, const Arguments& arguments) {
  Lane<S> plain(scene, false), remembering(scene, true);
  plain.settle(arguments.settle);
  remembering.settle(arguments.settle);
  for (int round = 0; round < arguments.rounds; ++round) {
    Lane<S>*first = &plain, *second = &remembering;
    if (round % 2 == 1) std::swap(first, second);
    for (Lane<S>* lane : {first, second}) lane->play();
    for (Lane<S>* lane : {first, second}) lane->roll_back(pushed, round);
  }
  const Resimulation r = remembering.world.resimulation();
  Row row;
  row.scene = scene.name;
  row.scalar = ScalarTraits<S>::kName;
  row.awake = plain.world.counts().awake;
  row.pushed = pushed;
  row.whole_ms = median(plain.times);
  row.part_ms = median(remembering.times);
  row.forward_ms = median(plain.forward);
  row.remember_ms = median(remembering.forward);
  row.stepped = r.bodies == 0 ? 1 : static_cast<double>(r.stepped) / static_cast<double>(r.bodies);
  row.whole_steps = r.whole;
  row.same = plain.hashes == remembering.hashes && plain.world.hash() == remembering.world.hash();
  return row;
}

void print(const Row& row) {
  std::printf("| %s | %s | %u | %d | %.3f | %.3f | %.3f | %.1f %% | %llu | %.3f | %.3f | %s |\n", row.scene.c_str(),
              row.scalar.c_str(), row.awake, row.pushed, row.whole_ms, row.part_ms, row.part_ms / row.whole_ms,
              100 * row.stepped, static_cast<unsigned long long>(row.whole_steps), row.forward_ms, row.remember_ms,
              row.same ? "equal" : "DIFFER");
  std::fflush(stdout);
}
nlohmann::json json_of(const Row& row) {
  return {{"scene", row.scene},        {"scalar", row.scalar},
          {"awake", row.awake},        {"pushed", row.pushed},
          {"whole_ms", row.whole_ms},  {"part_ms", row.part_ms},
          {"stepped", row.stepped},    {"whole_steps", row.whole_steps},
          {"step_ms", row.forward_ms}, {"remembered_step_ms", row.remember_ms},
          {"equal", row.same}};
}

int run(const Arguments& arguments) {
  if (!arguments.json) {
    std::puts(
        "Milliseconds of a rollback of eight frames, load, step, save and hash: stepping all, and what differs.\n\n"
        "| scene | scalar | awake | pushed | all ms | differing ms | ratio | stepped | whole steps | a new step ms | "
        "remembered | hashes |\n|---|---|---|---|---|---|---|---|---|---|---|---|");
  }
  nlohmann::json rows = nlohmann::json::array();
  bool same = true;
  for (const std::string& name : arguments.scenes) {
    const std::optional<scenes::Scene> scene = name == "field" ? field_of(arguments.bodies) : scenes::find_scene(name);
    if (!scene) return std::fprintf(stderr, "no scene %s\n", name.c_str()), 64;
    for (const int pushed : arguments.pushed) {
      if (name != "field" && pushed != arguments.pushed.front()) continue;
      for (const std::string& scalar : arguments.scalars) {
        if (name != "field" && !scenes::is_in_range(name, scalar)) continue;
#define ISO_MEASURE(S)                                     \
  if (scalar == ScalarTraits<S>::kName) {                  \
    const Row row = measure<S>(*scene, pushed, arguments); \
    same = same && row.same;                               \
    if (arguments.json) rows.push_back(json_of(row));      \
    else print(row);                                       \
  }
        ISO_FOR_EACH_SCALAR(ISO_MEASURE)
#undef ISO_MEASURE
      }
    }
  }
  if (arguments.json) std::puts(rows.dump(2).c_str());
  return same ? 0 : 1;
}

}  // namespace
}  // namespace isostep::bench

int main(int count, char** words) {
  isostep::bench::Arguments arguments;
  CLI::App app("A rollback of eight frames: all stepped again, and what differs");
  app.add_option("--scenes", arguments.scenes, "field, or names of scenes, separated by commas")->delimiter(',');
  app.add_option("--scalars", arguments.scalars, "Separated by commas")
      ->delimiter(',')
      ->check(CLI::IsMember(isostep::scalar_names()));
  app.add_option("--pushed", arguments.pushed, "Bodies whose impulse comes late; the first of them in named scenes")
      ->delimiter(',')
      ->check(CLI::Range(0, 100000));
  app.add_option("--bodies", arguments.bodies, "Of the field")->check(CLI::Range(1, 100000));
  app.add_option("--rounds", arguments.rounds, "Rollbacks of each; times are medians")->check(CLI::Range(1, 10000));
  app.add_option("--settle", arguments.settle, "Frames before the first")->check(CLI::Range(0, 100000));
  app.add_flag("--json", arguments.json, "One list of objects");
  app.add_option("--results", arguments.results, "Ignored: this benchmark leaves no file");
  CLI11_PARSE(app, count, words);
  return isostep::bench::run(arguments);
}
