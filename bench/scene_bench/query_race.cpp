// The race of queries: a kind of a frame is asked of one engine after another.
// SPDX-License-Identifier: MIT
#include "query_race.hpp"

#include <cstdio>

#include "compare.hpp"
#include "text.hpp"

namespace isostep::bench {
namespace {

/// The numbers of hits of ten frames' queries, by brute force and in the engines that were measured with them.
constexpr int kFrames = 10;
constexpr std::array<std::int64_t, kQueryKinds> kHits = {75892, 75892, 7305, 7305, 4045, 4297};

struct Lane {
  std::unique_ptr<Engine> engine;
  std::array<std::vector<double>, kQueryKinds> us;  // by frame
  std::array<std::int64_t, kQueryKinds> hits;
};

std::size_t asked_of(const scenes::DrawnQueries& drawn, Query query) {
  switch (query) {
    case Query::ray:
    case Query::rays: return drawn.rays.size();
    case Query::all_hits: return std::min(kListRays, drawn.rays.size());
    default: return drawn.casts.size();
  }
}

void ask(Lane& lane, const scenes::DrawnQueries& drawn, Query query) {
  const auto kind = static_cast<std::size_t>(query);
  const std::optional<Answered> answered = lane.engine->ask(query);
  if (!answered) {
    lane.hits[kind] = -1;
    return;
  }
  lane.us[kind].push_back(1e3 * answered->ms / static_cast<double>(asked_of(drawn, query)));
  lane.hits[kind] += static_cast<std::int64_t>(answered->hits);
}

/// Nobody moves, but a step makes an engine's trees ready for queries.
void run_frame(std::vector<Lane>& lanes, const scenes::DrawnQueries& drawn, int frame) {
  for (Lane& lane : lanes) {
    if (!lane.engine) continue;
    lane.engine->before_step(frame);
    lane.engine->step();
    lane.engine->take(drawn);
  }
  for (std::size_t kind = 0; kind < kQueryKinds; ++kind) {
    for (Lane& lane : lanes) {
      if (lane.engine) ask(lane, drawn, static_cast<Query>(kind));
    }
  }
}

std::vector<Lane> start_lanes(const scenes::Scene& scene, const std::vector<Maker>& makers,
                              const EngineOptions& options) {
  std::vector<Lane> lanes(makers.size());
  for (std::size_t i = 0; i < makers.size(); ++i) {
    lanes[i].hits.fill(0);
    try {
      lanes[i].engine = makers[i].make(scene, options);
    } catch (const scenes::SceneError& error) {
      std::fprintf(stderr, "S14: %s is refused: %s\n", makers[i].name, error.what());
    }
  }
  return lanes;
}

void note(const Lane& lane, bool first, QueryRow& row) {
  for (std::size_t kind = 0; kind < kQueryKinds; ++kind) {
    if (lane.us[kind].empty()) continue;
    const double us = median(lane.us[kind]);
    row.us[kind] = first ? us : std::min(row.us[kind], us);
  }
  row.hits = lane.hits;
}

/// Every hit is that of brute force: tests compare them one by one, here their number speaks for them. To be aimed at:
/// 32.32 within two and a half times the time of float.
void judge(QueryRow& row, const QueryRow* in_float, int frames) {
  if (!row.ours || frames != kFrames) return;
  row.reach = row.hits == kHits ? scenes::Reach::must : scenes::Reach::misses;
  if (row.reach == scenes::Reach::misses || row.engine != "q32.32" || in_float == nullptr) return;
  bool quick = true;
  for (const Query query : {Query::rays, Query::casts, Query::overlap, Query::all_hits}) {
    const auto kind = static_cast<std::size_t>(query);
    quick = quick && row.us[kind] <= 2.5 * in_float->us[kind];
  }
  if (quick) row.reach = scenes::Reach::aim;
}

}  // namespace

std::vector<QueryRow> race_queries(const scenes::Scene& scene, const std::vector<Maker>& makers,
                                   const RaceOptions& options) {
  const int frames = std::min(scene.frames, kFrames);
  const std::vector<scenes::DrawnQueries> drawn = scenes::drawn_queries(frames);
  std::vector<QueryRow> all(makers.size());
  for (int round = 0; round < options.rounds; ++round) {
    std::fprintf(stderr, "%s: round %d of %d\n", scene.name.c_str(), round + 1, options.rounds);
    std::vector<Lane> lanes = start_lanes(scene, makers, options.engine);
    for (int frame = 0; frame < frames; ++frame) {
      run_frame(lanes, drawn[static_cast<std::size_t>(frame)], frame);
    }
    for (std::size_t i = 0; i < lanes.size(); ++i) {
      if (round == 0) all[i].us.fill(-1);
      note(lanes[i], round == 0, all[i]);
    }
  }
  std::vector<QueryRow> rows;
  for (std::size_t i = 0; i < makers.size(); ++i) {
    QueryRow& row = all[i];
    row.engine = makers[i].name;
    row.ours = makers[i].ours;
    if (row.us[0] >= 0) rows.push_back(row);
  }
  const QueryRow* in_float = nullptr;
  for (const QueryRow& row : rows) {
    if (row.engine == "float") in_float = &row;
  }
  for (QueryRow& row : rows) judge(row, in_float, frames);
  return rows;
}

std::string table_of(const std::vector<QueryRow>& rows) {
  std::vector<std::vector<std::string>> cells = {{"us a query", "ray", "rays at once", "cast", "casts at once",
                                                  "overlap", "all hits", "rays hit", "casts hit", "overlaps",
                                                  "all hits found", "bar"}};
  for (const QueryRow& row : rows) {
    std::vector<std::string> line = {title_of(row.engine)};
    for (const double us : row.us) line.push_back(us < 0 ? "-" : print("%.3f", us));
    for (const Query query : {Query::ray, Query::cast, Query::overlap, Query::all_hits}) {
      const std::int64_t hits = row.hits[static_cast<std::size_t>(query)];
      line.push_back(hits < 0 ? "-" : print("%lld", static_cast<long long>(hits)));
    }
    line.push_back(scenes::kReachNames[static_cast<int>(row.reach)]);
    cells.push_back(std::move(line));
  }
  return markdown(cells);
}

}  // namespace isostep::bench
