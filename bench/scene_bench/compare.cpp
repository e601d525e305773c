// The comparison.
// SPDX-License-Identifier: MIT
#include "compare.hpp"

#include <algorithm>

#include "clock.hpp"
#include "dated.hpp"
#include "text.hpp"

namespace isostep::bench {
namespace {

const Row* find(const std::vector<Row>& rows, std::string_view scene, std::string_view engine) {
  const auto found =
      std::find_if(rows.begin(), rows.end(), [&](const Row& r) { return r.scene == scene && r.engine == engine; });
  return found == rows.end() ? nullptr : &*found;
}

void keep_faster(std::optional<Fastest>& best, std::string_view engine, double ms) {
  if (ms > 0 && (!best || ms < best->ms)) best = Fastest{std::string(engine), ms};
}

/// The names in the order of their first row.
template <class Name> std::vector<std::string> names_of(const std::vector<Row>& rows, Name&& name) {
  std::vector<std::string> names;
  for (const Row& row : rows) {
    if (std::count(names.begin(), names.end(), name(row)) == 0) names.push_back(name(row));
  }
  return names;
}

std::string ms_text(double ms) { return print(ms < 0.01 ? "%.4f" : ms < 1 ? "%.3f" : "%.2f", ms); }

constexpr std::string_view kBest = "-best";
std::string_view plain(std::string_view engine) { return engine.substr(0, engine.size() - kBest.size()); }

std::string cell(const Row* row, const std::optional<Fastest>& fastest) {
  if (row == nullptr || !row->refused.empty()) return "-";
  const double ms = shown_ms(*row);
  if (ms < 0) return "never";
  std::string text = ms_text(ms);
  if (fastest && row->engine == fastest->engine) text = print("**%s**", text.c_str());
  if (row->failed) text += " x";
  if (row->ours && fastest) text += print(" (%.2f)", ms / fastest->ms);
  return text;
}
/// An engine's defaults and, behind a stroke, its best settings.
std::string both_cells(const std::vector<Row>& rows, const std::string& scene, const std::string& engine,
                       const std::optional<Fastest>& fastest) {
  const Row* const best = find(rows, scene, engine + "-best");
  const std::string text = cell(find(rows, scene, engine), fastest);
  if (best == nullptr || (text == "-" && !best->refused.empty())) return text;
  return text + " / " + cell(best, fastest);
}
/// kAnchor's time here over that of the dated run. In a scene that has no such figure, the median of all others.
std::optional<double> slower_than_then(const std::vector<Row>& rows, std::string_view scene) {
  std::vector<double> others;
  for (const Row& row : rows) {
    const std::optional<Dated> then = row.engine == kAnchor ? dated(kAnchor, row.scene) : std::nullopt;
    if (!then || !row.refused.empty() || shown_ms(row) <= 0) continue;
    if (row.scene == scene) return shown_ms(row) / then->ms;
    others.push_back(shown_ms(row) / then->ms);
  }
  if (others.empty() || dated(kAnchor, scene)) return std::nullopt;
  return median(others);
}

std::string dated_cell(const std::vector<Row>& rows, const std::string& scene, const char* engine,
                       const std::optional<Fastest>& fastest) {
  const std::optional<double> ms = estimated_ms(rows, scene, engine);
  if (!ms) return "-";
  std::string text = ms_text(*ms);
  if (fastest && fastest->engine == engine) text = print("**%s**", text.c_str());
  return dated(engine, scene)->lost ? text + " x" : text;
}

}  // namespace

bool is_best(std::string_view engine) { return engine.ends_with(kBest); }
double shown_ms(const Row& row) { return row.scene == "S8" ? row.asleep_ms : row.ms; }

std::string title_of(std::string_view engine) {
  if (is_best(engine)) return title_of(plain(engine)) + ", best";
  constexpr std::pair<std::string_view, const char*> kTitles[] = {{"float", "float"},
                                                                  {"double", "double"},
                                                                  {"q16.16", "q16.16"},
                                                                  {"q32.32", "q32.32"},
                                                                  {"rapier-simd", "Rapier SIMD"},
                                                                  {"rapier-det", "Rapier det."},
                                                                  {"havok", "Havok"},
                                                                  {"jolt", "Jolt"},
                                                                  {"physx-pgs", "PhysX PGS"},
                                                                  {"physx-tgs", "PhysX TGS"},
                                                                  {"mujoco", "MuJoCo"},
                                                                  {"bullet", "Bullet"},
                                                                  {"ode", "ODE"},
                                                                  {"dart", "DART"},
                                                                  {"box3d", "Box3D *"},
                                                                  {"jolt-native", "Jolt native *"}};
  for (const auto& [name, title] : kTitles) {
    if (name == engine) return title;
  }
  return "?";
}

std::optional<double> estimated_ms(const std::vector<Row>& rows, std::string_view scene, std::string_view engine) {
  const std::optional<double> slower = slower_than_then(rows, scene);
  const std::optional<Dated> then = dated(engine, scene);
  if (!slower || !then) return std::nullopt;
  return *slower * then->ms;
}

std::optional<Fastest> FastestPeers::of_all() const {
  if (!here || !dated) return here ? here : dated;
  return here->ms <= dated->ms ? here : dated;
}

FastestPeers fastest_peers(const std::vector<Row>& rows, std::string_view scene) {
  FastestPeers fastest;
  for (const Row& row : rows) {
    if (row.scene != scene || row.ours || row.failed || !row.refused.empty()) continue;
    keep_faster(fastest.here, row.engine, shown_ms(row));
    if (row.engine == kAnchor) keep_faster(fastest.dated, row.engine, estimated_ms(rows, scene, kAnchor).value_or(-1));
  }
  for (const char* engine : kDatedEngines) {
    const std::optional<double> ms = estimated_ms(rows, scene, engine);
    if (ms && !dated(engine, scene)->lost) keep_faster(fastest.dated, engine, *ms);
  }
  return fastest;
}

std::string anchor_since(const std::vector<Row>& rows) {
  std::string text;
  for (const Row& row : rows) {
    const std::optional<Dated> then = dated(row.engine, row.scene);
    if (!then || !row.refused.empty() || shown_ms(row) < 0) continue;
    text += print("%s%s %.2f", text.empty() ? "" : ", ", row.scene.c_str(), shown_ms(row) / then->ms);
  }
  return text;
}

std::string comparison(const std::vector<Row>& rows) {
  const std::vector<std::string> names = names_of(rows, [](const Row& row) { return row.engine; });
  std::vector<std::string> engines = names;
  std::erase_if(engines, [&](const std::string& name) {
    return is_best(name) && std::count(names.begin(), names.end(), plain(name)) != 0;
  });
  const bool anchored = std::count(engines.begin(), engines.end(), kAnchor) != 0;
  std::vector<std::vector<std::string>> cells(1, {"ms a step"});
  for (const std::string& engine : engines) cells[0].push_back(title_of(engine));
  if (anchored) {
    for (const char* engine : kDatedEngines) cells[0].push_back(title_of(engine));
  }
  for (const std::string& scene : names_of(rows, [](const Row& row) { return row.scene; })) {
    const std::optional<Fastest> fastest = fastest_peers(rows, scene).of_all();
    std::vector<std::string> line = {scene == "S8" ? "S8 asleep" : scene};
    for (const std::string& engine : engines) line.push_back(both_cells(rows, scene, engine, fastest));
    if (anchored) {
      for (const char* engine : kDatedEngines) line.push_back(dated_cell(rows, scene, engine, fastest));
    }
    cells.push_back(std::move(line));
  }
  return markdown(cells);
}

}  // namespace isostep::bench
