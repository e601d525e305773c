// Kinds of games, each by scenes that resemble it.
// SPDX-License-Identifier: MIT
#include "genres.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <set>

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
       {"S8", "S4", "sleeping_stack", "confined_crowd", "woken_crowd"}},
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
       "chains, loops and beams that hold to a fraction of a millimetre",
       Reach::aim,
       {"S6", "S6v", "chain_16_ball_1000", "four_bar", "parallelogram", "cantilever", "heavy_on_light_400"}},
      {"large worlds",
       "the same, 100 km from the origin",
       Reach::must,
       {"far_pyramid_100km", "far_stack_100km", "far_ragdoll_100km", "far_chain_100km"}},
  };
  return all;
}

constexpr int kNever = std::numeric_limits<int>::max();

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

/// The solver with which the fewest of the names are unmet, of those the cheapest in the first.
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
    const bool better = !best || choice.unmet.size() < best->unmet.size() ||
                        (choice.unmet.size() == best->unmet.size() && choice.ms < best->ms);
    if (better) best = std::move(choice);
  }
  if (!best) return "none";
  std::string text = setting_of(best->point) + ": " + short_number(best->ms) + " ms";
  for (const std::string& name : best->unmet) text += (name == best->unmet.front() ? "; but not " : ", ") + name;
  return text;
}

/// The trials that one setting of ours survives, whether by as many sub-steps or by fewer.
int survived_by(const RunsByName& runs, const ReportData& data, const std::string& scalar, const LabPoint& own) {
  return static_cast<int>(std::count_if(data.plan.trials.begin(), data.plan.trials.end(), [&](const std::string& name) {
    const auto found = runs.find(name);
    return found != runs.end() && fewest(found->second, scalar, own.solver, scenes::Reach::must) <= own.substeps;
  }));
}
int held_by(const RunsByName& runs, const ReportData& data, const std::string& scalar, const LabPoint& own) {
  return static_cast<int>(std::count_if(data.plan.scenes.begin(), data.plan.scenes.end(), [&](const std::string& name) {
    const auto found = runs.find(name);
    return found != runs.end() &&
           std::any_of(found->second.all.begin(), found->second.all.end(), [&](const LabResult* r) {
             return is_ours(*r, scalar, own.solver) && r->point.substeps == own.substeps &&
                    holds(*r, scenes::Reach::must);
           });
  }));
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

std::string best_peer_text(const ReportData& data) {
  std::map<std::string, std::set<std::string>> survived;
  for (const LabResult& r : data.results) {
    if (r.point.engine != kOwnEngine && fate_of(r) == Fate::survived)
      survived[engine_of(r.point.engine)].insert(r.point.scene);
  }
  const auto best = std::max_element(survived.begin(), survived.end(),
                                     [](const auto& a, const auto& b) { return a.second.size() < b.second.size(); });
  if (best == survived.end()) return {};
  return " Of the other engines " + full_name(best->first) + " survives most, " + std::to_string(best->second.size()) +
         ", by its defaults or its best settings.";
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
    text += std::string(" In ") + scalar + " they hold the bars of " +
            std::to_string(held_by(runs, data, scalar, own)) + " of " + std::to_string(data.plan.scenes.size()) +
            " scenes and survive " + std::to_string(survived_by(runs, data, scalar, own)) + " of " +
            std::to_string(data.plan.trials.size()) + " trials";
    const double times = times_of_float(runs, data, scalar, own);
    if (times > 0 && std::string(scalar) != "float")
      text += ", for " + short_number(times) + " times the time of float";
    text += ".";
  }
  return text + best_peer_text(data);
}

}  // namespace isostep::tool::lab
