// Kinds of games, each by scenes that resemble it.
// SPDX-License-Identifier: MIT
#include "genres.hpp"

#include <algorithm>
#include <limits>
#include <map>

#include "engines.hpp"
#include "html.hpp"
#include "tool/lab/median.hpp"

namespace isostep::tool::lab {
namespace {

/// A game's kind in the words of session/CHOOSING.md, what it asks of physics, and what has that: the first is timed.
struct Genre {
  const char *game, *asks;
  scenes::Reach reach;  // of the bars of benchmark scenes
  std::vector<const char*> names;
};
const std::vector<Genre>& genres() {
  using scenes::Reach;
  static const std::vector<Genre> all = {
      {"strategy in lockstep",
       "crowds that come to rest and sleep",
       Reach::must,
       {"S4", "S8", "sleeping_stack", "confined_crowd", "woken_crowd"}},
      {"fighting, brawl, shooter with rollback",
       "a cheap step, for it is repeated; nothing bursts or creeps",
       Reach::must,
       {"S2", "S7", "overlapped_pairs", "resting_slope", "dominoes"}},
      {"racing, vehicles, machines",
       "slopes, belts, cranks, gears and lifts",
       Reach::must,
       {"slider_crank", "gear_train", "loaded_lift", "conveyor", "sliding_slope"}},
      {"ragdolls",
       "many small trees of joints, with limits",
       Reach::must,
       {"S7", "ragdolls_with_limits", "ragdoll_from_every_tilt"}},
      {"physics sandbox",
       "towers, piles, heavy on light",
       Reach::must,
       {"S3", "S1", "S4", "tall_stack", "heavy_on_light_100", "card_house", "arch", "overlapped_pile"}},
      {"robots, precision",
       "chains, loops and beams under load; scenes reach their aim",
       Reach::aim,
       {"S6", "S6v", "chain_16_ball_1000", "four_bar", "parallelogram", "cantilever", "heavy_on_light_400"}},
      {"large worlds",
       "stacks, pyramids, ragdolls and chains, 100 km from the origin",
       Reach::must,
       {"far_pyramid_100km", "far_stack_100km", "far_ragdoll_100km", "far_chain_100km"}},
  };
  return all;
}

constexpr int kNever = std::numeric_limits<int>::max();
constexpr double kFrame = 1000.0 / 60;  // [ms] a game that takes longer is not played

bool is_ours(const LabResult& r, const std::string& scalar, const std::string& solver) {
  return r.point.engine == kOwnEngine && r.point.scalar == scalar && r.point.solver == solver;
}
/// Holds its bars as far as asked, or survives.
bool holds(const LabResult& r, scenes::Reach reach) {
  return find_view(r.point.scene) != nullptr ? reach_of(r) >= reach : fate_of(r) == Fate::survived;
}

/// All runs of a scene or trial, and the rate at which it is meant to run: the least.
struct Runs {
  std::vector<const LabResult*> all;
  int hz = kNever;
};
using RunsByName = std::map<std::string, Runs>;
RunsByName runs_by_name(const std::vector<LabResult>& results) {
  RunsByName runs;
  for (const LabResult& r : results) {
    Runs& of = runs[r.point.scene];
    of.all.push_back(&r);
    if (r.point.engine == kOwnEngine) of.hz = std::min(of.hz, r.point.hz);
  }
  return runs;
}

/// The fewest sub-steps that hold at the scene's own rate: more were run of trials only where fewer failed.
int fewest(const Runs& runs, const std::string& scalar, const std::string& solver, scenes::Reach reach) {
  int least = kNever;
  for (const LabResult* r : runs.all) {
    if (is_ours(*r, scalar, solver) && r->point.hz == runs.hz && holds(*r, reach))
      least = std::min(least, r->point.substeps);
  }
  return least;
}
/// [ms] of the run with so many sub-steps, or the next that there is.
double time_of(const Runs& runs, const std::string& scalar, const std::string& solver, int substeps) {
  const LabResult* best = nullptr;
  for (const LabResult* r : runs.all) {
    if (!is_ours(*r, scalar, solver) || r->point.hz != runs.hz || r->point.substeps < substeps) continue;
    if (r->state == kDone && (best == nullptr || r->point.substeps < best->point.substeps)) best = r;
  }
  return best == nullptr ? std::numeric_limits<double>::quiet_NaN() : best->ms;
}

struct Choice {
  LabPoint point;
  double ms = 0;
  std::vector<std::string> unmet;
};

/// The solver with which the fewest of the names are unmet, of those the cheapest in the first; none that takes longer
/// than a frame there.
std::string choice_text(const RunsByName& runs, const std::vector<std::string>& names, const Genre& genre,
                        const std::string& scalar, const std::vector<std::string>& solvers) {
  std::optional<Choice> best;
  for (const std::string& solver : solvers) {
    Choice choice;
    choice.point.solver = solver;
    choice.point.substeps = 0;
    for (const std::string& name : names) {
      const int needs = fewest(runs.at(name), scalar, solver, genre.reach);
      if (needs == kNever) choice.unmet.push_back(name);
      else choice.point.substeps = std::max(choice.point.substeps, needs);
    }
    if (choice.unmet.size() == names.size()) continue;
    choice.ms = time_of(runs.at(names.front()), scalar, solver, choice.point.substeps);
    if (choice.ms > kFrame) continue;
    const bool better = !best || choice.unmet.size() < best->unmet.size() ||
                        (choice.unmet.size() == best->unmet.size() && choice.ms < best->ms);
    if (better) best = std::move(choice);
  }
  if (!best) return "none";
  std::string text = setting_of(best->point) + ": " + short_number(best->ms) + " ms";
  for (const std::string& name : best->unmet) text += (name == best->unmet.front() ? "; but not " : ", ") + name;
  return text;
}

/// "of 77 trials they survive 71 and fail 5 (too long: 1)".
std::string trials_text(const RunsByName& runs, const ReportData& data, LabPoint own) {
  std::map<Fate, int> count;
  for (const std::string& name : data.plan.trials) {
    const auto found = runs.find(name);
    if (found == runs.end()) continue;
    own.scene = name;
    own.hz = found->second.hz;
    ++count[fate_within(data.results, own)];
  }
  std::string apart;
  if (count[Fate::refused] > 0) apart = "beyond its range: " + std::to_string(count[Fate::refused]);
  if (count[Fate::open] > 0)
    apart += (apart.empty() ? "too long: " : "; too long: ") + std::to_string(count[Fate::open]);
  return "of " + std::to_string(data.plan.trials.size()) + " trials they survive " +
         std::to_string(count[Fate::survived]) + " and fail " + std::to_string(count[Fate::failed]) +
         (apart.empty() ? "" : " (" + apart + ")");
}
/// "the bars of 11 of 11 scenes": of those that have bars for the scalar.
std::string scenes_text(const RunsByName& runs, const ReportData& data, LabPoint own) {
  int barred = 0, held = 0;
  for (const std::string& name : data.plan.scenes) {
    if (scenes::bars_of(name, own.scalar == "q16.16").empty()) continue;
    ++barred;
    const auto found = runs.find(name);
    if (found == runs.end()) continue;
    own.scene = name;
    own.hz = found->second.hz;
    held += std::any_of(found->second.all.begin(), found->second.all.end(),
                        [&](const LabResult* r) { return r->point == own && holds(*r, scenes::Reach::must); });
  }
  return "the bars of " + std::to_string(held) + " of " + std::to_string(barred) + " scenes";
}
/// How many times the time of float a scalar takes: the median over scenes; 0: unknown.
double times_of_float(const RunsByName& runs, const ReportData& data, const std::string& scalar, const LabPoint& own) {
  std::vector<double> ratios;
  for (const std::string& name : data.plan.scenes) {
    const auto found = runs.find(name);
    if (found == runs.end()) continue;
    const double ratio = time_of(found->second, scalar, own.solver, own.substeps) /
                         time_of(found->second, "float", own.solver, own.substeps);
    if (ratio > 0) ratios.push_back(ratio);
  }
  return median(ratios);
}

/// " Of the other engines ... survives most: 35 of the 63 trials that it ended": and what is missing of them.
std::string best_peer_text(const Matrix& matrix) {
  int most = 0, ended_by_best = 0, missing = 0, all = 0;
  std::string best;
  for (std::size_t c = 0; c < matrix.columns.size(); ++c) {
    if (matrix.columns[c].is_ours()) continue;
    int survived = 0, ended = 0;
    for (const MatrixRow& row : matrix.rows) {
      const Fate fate = row.cells[c].fate;
      survived += fate == Fate::survived ? 1 : 0;
      ended += fate == Fate::survived || fate == Fate::failed ? 1 : 0;
      missing += fate == Fate::untried ? 1 : 0;
      ++all;
    }
    if (survived <= most) continue;
    most = survived;
    ended_by_best = ended;
    best = matrix.columns[c].engine;
  }
  if (best.empty()) return {};
  std::string text = " Of the other engines " + full_name(best) + " survives most: " + std::to_string(most) +
                     " of the " + std::to_string(ended_by_best) +
                     " trials that it ended, by its defaults or its best settings.";
  if (missing > 0)
    text += " The runs of other engines are incomplete: " + std::to_string(missing) + " of " + std::to_string(all) +
            " are not there.";
  return text;
}

}  // namespace

std::vector<std::vector<std::string>> genre_cells(const ReportData& data) {
  const RunsByName runs = runs_by_name(data.results);
  std::vector<std::vector<std::string>> cells(1, {"game", "asks for", "held by, survived by; timed"});
  for (const std::string& scalar : data.plan.scalars) cells[0].push_back(scalar);
  for (const Genre& genre : genres()) {
    std::vector<std::string> names;
    for (const char* name : genre.names) {
      if (runs.count(name) != 0) names.push_back(name);
    }
    if (names.empty()) continue;
    std::string listed;
    for (const std::string& name : names) listed += (listed.empty() ? "" : ", ") + name;
    std::vector<std::string> line = {genre.game, genre.asks, listed};
    for (const std::string& scalar : data.plan.scalars) {
      line.push_back(choice_text(runs, names, genre, scalar, data.plan.solvers));
    }
    cells.push_back(std::move(line));
  }
  return cells;
}

std::string advice_sentence(const ReportData& data) {
  const RunsByName runs = runs_by_name(data.results);
  const scenes::Scene plain;
  LabPoint own;
  own.solver = kSolverNames[static_cast<std::uint32_t>(plain.solver)];
  own.substeps = plain.substeps;
  std::string text = "Begin with " + own.solver + " and " + std::to_string(own.substeps) +
                     " sub-steps at 60 steps a second, the settings of a world that asks for none.";
  for (const char* scalar : {"float", "double", "q32.32"}) {
    if (std::count(data.plan.scalars.begin(), data.plan.scalars.end(), scalar) == 0) continue;
    own.scalar = scalar;
    text += std::string(" In ") + scalar + " they hold " + scenes_text(runs, data, own) + "; " +
            trials_text(runs, data, own);
    const double times = times_of_float(runs, data, scalar, own);
    if (times > 0 && std::string(scalar) != "float")
      text += ". They take " + short_number(times) + " times the time of float";
    text += ".";
  }
  return text + best_peer_text(data.matrix);
}

}  // namespace isostep::tool::lab
