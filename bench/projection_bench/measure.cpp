// Scenes under every projection: measure.hpp.
// SPDX-License-Identifier: MIT
#include "projection_bench/measure.hpp"

#include <algorithm>
#include <chrono>

#include "isostep/dynamics/projection.hpp"
#include "scenes/build.hpp"
#include "scenes/measure.hpp"
#include "scenes/named.hpp"

namespace isostep::bench {

namespace {

constexpr int kSubsteps = 4;

/// A box of 4 kg meets, on ground without friction, five of 1 kg that stand in a row, at 8 m/s: it is 6.7 cm deep in
/// the first when the step that finds it there begins.
template <class S> void add_impact(World<S>& world) {
  BodyDefinition<S> d;
  d.type = BodyType::static_;
  d.shape = world.add_shape(HalfSpace<Literal>{{0, 1, 0}, 0});
  d.material.friction = S(0);
  world.create(d);
  d.type = BodyType::dynamic;
  d.shape = world.add_shape(Box<Literal>{{0.5, 0.5, 0.5}});
  d.material.restitution = S(0.5);
  d.mass = S(1);
  for (int i = 0; i < 5; ++i) {
    d.position = {S(i + 4), S(0.5), S(0)};
    world.create(d);
  }
  d.position = {S(0), S(0.5), S(0)};
  d.velocity = {S(8), S(0), S(0)};
  d.mass = S(4);
  world.create(d);
}

template <class S> ProjectionRow measure(World<S>& world, int frames) {
  ProjectionRow row;
  row.scalar = ScalarTraits<S>::kName;
  row.projection = kProjectionNames[static_cast<std::uint32_t>(world.settings().projection)];
  const double start = scenes::measure_energy(world).total();
  double least = start;
  std::vector<double> times;
  for (int i = 0; i < frames; ++i) {
    const auto before = std::chrono::steady_clock::now();
    row.cut += world.step().unsolved;
    times.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - before).count());
    row.left = scenes::measure_overlap(world).worst;
    row.worst = std::max(row.worst, row.left);
    row.mean += row.left / frames;
    const double energy = scenes::measure_energy(world).total();
    row.gained = std::max(row.gained, (energy - least) / start);
    least = std::min(least, energy);
    row.kept = energy / start;
  }
  std::nth_element(times.begin(), times.begin() + frames / 2, times.end());
  row.ms = times[static_cast<std::size_t>(frames / 2)];
  return row;
}

template <class S> void measure_scalar(std::vector<ProjectionRow>& rows) {
  const struct {
    const char* name;
    const char* scene;
    int frames;
  } kRuns[] = {{"stack of 10", "S1x10", 600}, {"impact", nullptr, 60}, {"pile of 200", "S4s", 300}};
  for (const auto& run : kRuns) {
    for (std::uint32_t i = 0; i < kProjections; ++i) {
      scenes::Scene scene;
      if (run.scene != nullptr) scene = *scenes::find_scene(run.scene);
      scene.allow_sleep = false;
      scene.substeps = kSubsteps;
      scene.solver = SolverName::worst_first;
      scene.projection = static_cast<Projection>(i);
      World<S> world(scenes::settings_of<S>(scene));
      if (run.scene != nullptr) scenes::build(scene, world);
      else add_impact(world);
      rows.push_back(measure(world, run.frames));
      rows.back().scene = run.name;
    }
  }
}

}  // namespace

std::vector<ProjectionRow> measure_projections() {
  std::vector<ProjectionRow> rows;
  measure_scalar<float>(rows);
  measure_scalar<Q32_32>(rows);
  return rows;
}

}  // namespace isostep::bench
