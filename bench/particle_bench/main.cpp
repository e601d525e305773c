// isostep_particle_bench: free flight beside a plain loop, cloth, named scenes, a pile, and what states cost.
// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <string>

#include "crowds.hpp"
#include "isostep/core/scalar_names.hpp"
#include "isostep/particles/particle_state.hpp"
#include "plain_flight.hpp"
#include "scene_bench/clock.hpp"
#include "scenes/particles/particle_game.hpp"

namespace isostep::bench {
namespace {

struct Arguments {
  std::vector<std::string> parts = {"flight", "cloth", "small", "pile", "state"};
  std::vector<std::string> scalars = scalar_names();
  int repeats = 41;
};

/// visit(S{}, name) for each scalar asked for that this build has.
template <class Visit> void each_scalar(const Arguments& arguments, Visit&& visit) {
#define ISO_VISIT(S)                                                                            \
  for (const std::string& scalar : arguments.scalars) {                                         \
    if (scalar == ScalarTraits<S>::kName) visit.template operator()<S>(ScalarTraits<S>::kName); \
  }
  ISO_FOR_EACH_SCALAR(ISO_VISIT)
#undef ISO_VISIT
  std::fflush(stdout);
}

/// [ns] a step, the median of `repeats` times the mean of `batch` steps.
template <class Step> double step_ns(int repeats, int batch, Step&& step) {
  return 1e6 / batch *
         median_milliseconds(
             repeats, [] {},
             [&] {
               for (int i = 0; i < batch; ++i) step();
             });
}

// ---- free flight

constexpr int kFree = 100000;
struct Drag {
  const char* name;
  double linear, quadratic;
};
constexpr Drag kDrags[] = {{"none", 0, 0}, {"k1", 0.05, 0}, {"k1 and k2", 0.05, 0.01}};

/// The plain loop's arrays, with what make_flight gives the engine.
struct PlainCrowd {
  explicit PlainCrowd(const Drag& drag) {
    const ParticleWorld<float> world = make_flight<float>(kFree, drag.linear, drag.quadratic);
    position = world.state().position;
    velocity = world.state().velocity;
    inverse_mass = world.state().inverse_mass;
    flight = {position.x.data(),
              position.y.data(),
              position.z.data(),
              velocity.x.data(),
              velocity.y.data(),
              velocity.z.data(),
              inverse_mass.data(),
              kFree,
              4,
              1.0f / 240,
              -10,
              static_cast<float>(drag.linear),
              static_cast<float>(drag.quadratic),
              0.99956109f};
  }
  Axes<float> position, velocity;
  std::vector<float> inverse_mass;
  PlainFlight flight;
};

/// All in turn, a few steps each, so that what slows the machine slows all; the median of each.
void measure_flight(const Arguments& arguments) {
  std::printf(
      "## %d free particles, 4 sub-steps: ns a particle and step\n\n"
      "| drag | scalar | ns | of the fast loop | of the exact loop |\n|---|---|---|---|---|\n",
      kFree);
  for (const Drag& drag : kDrags) {
    PlainCrowd fast(drag), exact(drag);
    std::vector<double> fast_ns, exact_ns;
    const auto plain = [&] {
      fast_ns.push_back(step_ns(1, 2, [&] { step_fast(fast.flight); }) / kFree);
      exact_ns.push_back(step_ns(1, 2, [&] { step_exact(exact.flight); }) / kFree);
    };
    for (int i = 0; i < arguments.repeats; ++i) plain();
    std::printf("| %s | the fast loop | %.2f | 1.00 | %.2f |\n| %s | the exact loop | %.2f | %.2f | 1.00 |\n",
                drag.name, median(fast_ns), median(fast_ns) / median(exact_ns), drag.name, median(exact_ns),
                median(exact_ns) / median(fast_ns));
    each_scalar(arguments, [&]<class S>(const char* name) {
      ParticleWorld<S> world = make_flight<S>(kFree, drag.linear, drag.quadratic);
      std::vector<double> ours;
      fast_ns.clear();
      exact_ns.clear();
      for (int i = 0; i < arguments.repeats; ++i) {
        plain();
        ours.push_back(step_ns(1, 2, [&] { world.step(); }) / kFree);
      }
      const double ns = median(ours);
      std::printf("| %s | %s (%s) | %.2f | %.2f | %.2f |\n", drag.name, name, world.simd_name(), ns,
                  ns / median(fast_ns), ns / median(exact_ns));
    });
  }
  std::printf("\n");
}

// ---- what is joined

void measure_cloth(const Arguments& arguments) {
  std::printf(
      "## Cloth of 10 000 particles, 59 002 springs, 4 sub-steps\n\n"
      "| scalar | ms a step | ns a spring and sub-step |\n|---|---|---|\n");
  each_scalar(arguments, [&]<class S>(const char* name) {
    ParticleWorld<S> world = make_cloth<S>(100);
    for (int i = 0; i < 10; ++i) world.step();
    const double ns = step_ns(arguments.repeats, 1, [&] { world.step(); });
    std::printf("| %s | %.3f | %.2f |\n", name, ns / 1e6, ns / world.counts().springs / 4);
  });
  std::printf("\n");
}

template <class S> void measure_scene(const Arguments& arguments, const char* name, const char* scalar) {
  scenes::ParticleGame<S> game(*scenes::find_particle_scene(name));
  for (int i = 0; i < 60; ++i) game.advance();
  const ParticleCounts counts = game.world.counts();
  const double ns = step_ns(arguments.repeats, 10, [&] { game.advance(); });
  std::printf("| %s | %u | %u | %u | %s | %.2f |\n", name, counts.particles, counts.springs, counts.links, scalar,
              ns / 1e3);
}
void measure_small(const Arguments& arguments) {
  std::printf(
      "## Named scenes after a second, with their scripts: us a step\n\n"
      "| scene | particles | springs | links | scalar | us |\n|---|---|---|---|---|---|\n");
  for (const char* name : {"bridge", "blob", "platform", "rope", "cloth", "soft_box"}) {
    each_scalar(arguments, [&]<class S>(const char* scalar) { measure_scene<S>(arguments, name, scalar); });
  }
  std::printf("\n");
}

void measure_pile(const Arguments& arguments) {
  std::printf(
      "## A pile of 5000 colliding particles after 3 s, 4 sub-steps\n\n"
      "| scalar | contacts | ms a step | ns a contact |\n|---|---|---|---|\n");
  each_scalar(arguments, [&]<class S>(const char* name) {
    ParticleWorld<S> world = make_pile<S>(5000);
    for (int i = 0; i < 180; ++i) world.step();
    const double ns = step_ns(std::min(arguments.repeats, 21), 1, [&] { world.step(); });
    const std::uint32_t contacts = world.counts().contacts;
    std::printf("| %s | %u | %.3f | %.0f |\n", name, contacts, ns / 1e6, ns / contacts);
  });
  std::printf("\n");
}

// ---- states

/// Save, load and hash with a step between any two, as sessions call them.
template <class S>
void measure_state(const Arguments& arguments, const char* scalar, const char* crowd, ParticleWorld<S> world) {
  typename ParticleWorld<S>::Snapshot snapshot;
  for (int i = 0; i < 30; ++i) world.step();
  world.save(snapshot);
  const int repeats = std::min(arguments.repeats, 21);
  const double save = median_milliseconds(
      repeats, [&] { world.step(); }, [&] { world.save(snapshot); });
  const double load = median_milliseconds(
      repeats, [&] { world.step(); }, [&] { world.load(snapshot); });
  std::uint64_t sum = 0;
  const double hash = median_milliseconds(
      repeats, [&] { world.step(); }, [&] { sum += world.hash(); });
  const std::uint32_t count = world.counts().particles;
  std::printf("| %s | %s | %.1f | %.1f | %.1f | %zu | %.1f |%s\n", crowd, scalar, 1e3 * save, 1e3 * load, 1e3 * hash,
              snapshot.bytes(), static_cast<double>(snapshot.bytes()) / count, sum == 0 ? " no hash" : "");
}
void measure_states(const Arguments& arguments) {
  std::printf(
      "## States: us, and bytes of a snapshot with its slots\n\n"
      "| crowd | scalar | save | load | hash | bytes | a particle |\n|---|---|---|---|---|---|---|\n");
  each_scalar(arguments, [&]<class S>(const char* name) {
    measure_state<S>(arguments, name, "100 000 free", make_flight<S>(kFree, 0.05, 0.01));
    measure_state<S>(arguments, name, "cloth of 10 000", make_cloth<S>(100));
    measure_state<S>(arguments, name, "pile of 1000", make_pile<S>(1000));
  });
  std::printf("\n");
}

int run(const Arguments& arguments) {
  const auto asked = [&](const char* part) {
    return std::find(arguments.parts.begin(), arguments.parts.end(), part) != arguments.parts.end();
  };
  if (asked("flight")) measure_flight(arguments);
  if (asked("cloth")) measure_cloth(arguments);
  if (asked("small")) measure_small(arguments);
  if (asked("pile")) measure_pile(arguments);
  if (asked("state")) measure_states(arguments);
  return 0;
}

}  // namespace
}  // namespace isostep::bench

int main(int count, char** words) {
  isostep::bench::Arguments arguments;
  CLI::App app("What particles cost: CPU time, medians");
  app.add_option("--parts", arguments.parts, "flight, cloth, small, pile, state, separated by commas")
      ->delimiter(',')
      ->check(CLI::IsMember({"flight", "cloth", "small", "pile", "state"}));
  app.add_option("--scalars", arguments.scalars, "Separated by commas")
      ->delimiter(',')
      ->check(CLI::IsMember(isostep::scalar_names()));
  app.add_option("--repeats", arguments.repeats, "Times are medians of so many")->check(CLI::Range(1, 100000));
  std::string results;
  app.add_option("--results", results, "Ignored: this benchmark leaves no file");
  CLI11_PARSE(app, count, words);
  return isostep::bench::run(arguments);
}
