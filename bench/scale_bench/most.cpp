// The cost of ever more bodies in time and in memory, up to half a million that fall in rows.
// SPDX-License-Identifier: MIT
#include <cstdio>

#include "apart.hpp"
#include "isostep/world/world.hpp"
#include "scale.hpp"
#include "scene_bench/clock.hpp"
#include "scene_bench/resident.hpp"
#include "scenes/build.hpp"
#include "scenes/peers/peers.hpp"

namespace isostep::bench {
namespace {

template <class S> MostRow measure(int bodies, const ScaleOptions& options) {
  const scenes::Scene scene = scenes::max_bodies_of(bodies);
  const double before = begin_peak();
  World<S> world(scenes::settings_of<S>(scene));
  scenes::build(scene, world);
  const auto nothing = [] {};
  const auto step = [&] { world.step(); };
  MostRow row;
  row.first_us = 1e3 * median_milliseconds(1, nothing, step);
  row.step_us = 1e3 * median_milliseconds(options.frames, nothing, step);
  row.peak_megabytes = peak_megabytes() - before;
  const WorldCounts counts = world.counts();
  row.bodies = counts.awake;
  row.contacts = counts.contacts;
  return row;
}

}  // namespace

std::vector<MostRow> measure_most(const ScaleOptions& options) {
  std::vector<MostRow> rows;
  for (const int bodies : options.most) {
#define ISO_MEASURE(S)                          \
  if (options.scalar == ScalarTraits<S>::kName) \
    rows.push_back(measure_apart<MostRow>([&] { return measure<S>(bodies, options); }));
    ISO_FOR_EACH_SCALAR(ISO_MEASURE)
#undef ISO_MEASURE
    std::fprintf(stderr, "%d fall\n", bodies);
  }
  return rows;
}

std::string table_of(const std::vector<MostRow>& rows) {
  std::string text =
      "| bodies | contacts | first step ms | step ms | ns a body | peak MB | bytes a body |\n"
      "|---|---|---|---|---|---|---|\n";
  for (const MostRow& row : rows) {
    const double bodies = std::max(1u, row.bodies);
    char line[160];
    std::snprintf(line, sizeof line, "| %u | %u | %.1f | %.1f | %.0f | %.0f | %.0f |\n", row.bodies, row.contacts,
                  1e-3 * row.first_us, 1e-3 * row.step_us, 1e3 * row.step_us / bodies, row.peak_megabytes,
                  1e6 * row.peak_megabytes / bodies);
    text += line;
  }
  return text;
}

}  // namespace isostep::bench
