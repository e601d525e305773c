// The race: blocks of frames in turn, so that what slows the machine for a while slows all engines.
// SPDX-License-Identifier: MIT
#include "race.hpp"

#include <cmath>
#include <cstdio>
#include <limits>

#include "scenes/bars.hpp"
#include "scenes/limits.hpp"
#include "scenes/named.hpp"
#include "scenes/shapes.hpp"
#include "text.hpp"
#include "verdict.hpp"

namespace isostep::bench {
namespace {

constexpr int kEnergyFrames = 60;

/// One engine's run, and what is noted beside it.
struct Lane {
  std::unique_ptr<Engine> engine;        // none: refused
  std::string refused;                   // and why; or why it was left on its way
  std::unique_ptr<scenes::Judge> judge;  // of scenes whose figure is taken over the whole run
  std::vector<scenes::BodySight> start;
  scenes::Energy energy_start;
  std::vector<double> times;  // [ms] a frame
  double spent = 0;           // [ms] their sum
  double kinetic = 0, joint_worst = 0, limit_worst = 0, limit_end = 0, energy_most = 0;
  int asleep_at = -1;
  std::vector<double> turned;  // [rad] of a trial's bodies about z
};

bool is_trial(const scenes::Scene& scene) { return scenes::find_trial(scene.name) != nullptr; }
double square_across(Vec3<double> v) { return v.x * v.x + v.z * v.z; }

/// Scripts move bodies to other places of the list: their joints' limits are not looked at.
void watch_joints(Lane& lane, const scenes::Scene& scene, const scenes::JointLimits& limits) {
  const scenes::Sight sight = lane.engine->sight();
  lane.joint_worst = std::max(lane.joint_worst, sight.joint_error);
  if (scene.script != scenes::Script::none) return;
  lane.limit_end = limits.passed(lane.start, sight.bodies);
  lane.limit_worst = std::max(lane.limit_worst, lane.limit_end);
  lane.energy_most = std::max(lane.energy_most, sight.energy.total() - lane.energy_start.total());
}

/// Turns are counted from frame to frame.
void watch_turns(Lane& lane, const scenes::Sight& before, const scenes::Sight& now) {
  lane.turned.resize(now.bodies.size());
  for (std::size_t i = 0; i < now.bodies.size(); ++i) {
    const Quat<double> p = before.bodies[i].orientation, q = now.bodies[i].orientation;
    lane.turned[i] += std::remainder(2 * (std::atan2(q.z, q.w) - std::atan2(p.z, p.w)), scenes::kTurn);
  }
}

/// Ends after the step with which the engine has spent more than `patience` [ms]. Returns the frames that it has run.
int run_frames(Lane& lane, const scenes::Scene& scene, int from, int to, double patience) {
  const scenes::JointLimits limits(scene);
  int frame = from;
  while (frame < to && lane.spent <= patience) {
    const scenes::Sight before = is_trial(scene) ? lane.engine->sight() : scenes::Sight{};
    lane.engine->before_step(frame);
    lane.times.push_back(lane.engine->timed_steps(1));
    lane.spent += lane.times.back();
    if (!scene.joints.empty()) watch_joints(lane, scene, limits);
    if (lane.judge) lane.judge->see(lane.engine->sight());
    if (is_trial(scene)) watch_turns(lane, before, lane.engine->sight());
    if (scene.allow_sleep && lane.asleep_at < 0 && lane.engine->all_asleep()) lane.asleep_at = frame + 1;
    if (frame++ < scene.frames - kEnergyFrames) continue;
    const scenes::Energy energy = lane.engine->sight().energy;
    lane.kinetic += energy.kinetic / energy.mass / kEnergyFrames;
  }
  return frame;
}

/// Reach: from the world's end of the first joint to the last body, straight chains only.
void measure_places(const Lane& lane, const scenes::Scene& scene, Row& row) {
  const std::vector<scenes::BodySight> now = lane.engine->sight().bodies;
  if (!is_trial(scene)) row.outside = scenes::count_outside(scene.name, now);
  row.through = scenes::count_through(scene.name, lane.start, now).value_or(-1);
  if (scene.script != scenes::Script::none) return;
  for (std::size_t i = 0; i < now.size(); ++i) {
    if (!now[i].dynamic) continue;
    const Vec3<double> by = now[i].centre - lane.start[i].centre;
    row.moved = std::max(row.moved, std::sqrt(dot(by, by)));
    row.drift = std::max(row.drift, std::sqrt(square_across(by)));
    row.drop = std::max(row.drop, -by.y);
  }
  row.top_error = now.back().centre.y - lane.start.back().centre.y;
  if (scene.joints.empty()) return;
  const Vec3<double> top = {0, 30, 0}, before = lane.start.back().centre - top, after = now.back().centre - top;
  row.reach_error = std::sqrt(dot(after, after)) - std::sqrt(dot(before, before));
}

/// Too short for a clock, so a thousand at once.
double time_asleep(Engine& engine) {
  constexpr int kSteps = 1000;
  std::vector<double> times;
  for (int i = 0; i < 5; ++i) times.push_back(engine.timed_steps(kSteps) / kSteps);
  return median(times);
}

/// Bodies may be where no world of ours takes them.
scenes::Overlap overlap_of(const Engine& engine) {
  try {
    return engine.overlap();
  } catch (const scenes::SceneError&) {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    return {kNone, kNone, kNone, 0, 0};
  }
}

void measure(Lane& lane, const scenes::Scene& scene, Row& row) {
  measure_places(lane, scene, row);
  const scenes::Sight end = lane.engine->sight();
  row.settings = lane.engine->settings();
  row.faults = lane.engine->faults();
  row.overlap = overlap_of(*lane.engine);
  row.trial = scenes::find_trial(scene.name);
  if (row.trial != nullptr) {
    row.figure = scenes::verdict_of(*row.trial, *lane.judge, end).figure;
    for (const double angle : lane.turned) row.speeds.push_back(angle / end.time);
  } else if (lane.judge) {
    row.bump = lane.judge->figure();
  }
  row.kinetic = lane.kinetic;
  row.energy_loss = (lane.energy_start.total() - end.energy.total()) / end.energy.mass;
  row.joint_worst = lane.joint_worst;
  row.joint_end = end.joint_error;
  row.limit_worst = lane.limit_worst;
  row.limit_end = lane.limit_end;
  row.energy_gain = lane.energy_most / end.energy.mass;
  row.asleep_at = lane.asleep_at < 0 ? -1 : lane.asleep_at / 60.0;
}

struct Times {
  std::vector<double> ms, p99, max, asleep;
};

void note_times(Lane& lane, const scenes::Scene& scene, bool from_start, Times& times) {
  const std::ptrdiff_t skipped = scene.script == scenes::Script::none && !from_start ? scene.frames / 2 : 0;
  const std::vector<double> counted(lane.times.begin() + skipped, lane.times.end());
  times.ms.push_back(median(counted));
  times.p99.push_back(quantile(counted, 0.99));
  times.max.push_back(quantile(counted, 1));
  if (lane.asleep_at >= 0) times.asleep.push_back(time_asleep(*lane.engine));
}

Lane start_lane(const scenes::Scene& scene, const Maker& maker, const EngineOptions& options) try {
  Lane lane;
  if (!scenes::is_in_range(scene.name, maker.name))
    throw scenes::SceneError("", "the scene is beyond the format's range");
  lane.engine = maker.make(scene, options);
  const scenes::Sight start = lane.engine->sight();
  lane.start = start.bodies;
  lane.energy_start = start.energy;
  if (const scenes::Trial* trial = scenes::find_trial(scene.name)) lane.judge = trial->judge(scene);
  else if (scenes::own_measure(scene.name) == scenes::Measure::bump) lane.judge = scenes::benchmark_judge(scene);
  if (lane.judge) lane.judge->see(start);
  return lane;
} catch (const scenes::SceneError& error) {
  Lane lane;
  lane.refused = error.what();
  return lane;
}

/// Leaves out an engine that had no figures in the first round.
std::vector<Lane> start_lanes(const scenes::Scene& scene, const std::vector<Maker>& makers,
                              const std::vector<Row>& rows, const EngineOptions& options) {
  std::vector<Lane> lanes;
  for (std::size_t i = 0; i < makers.size(); ++i) {
    if (rows[i].refused.empty()) lanes.push_back(start_lane(scene, makers[i], options));
    else lanes.emplace_back().refused = rows[i].refused;
  }
  return lanes;
}

void name(Row& row, const scenes::Scene& scene, const Maker& maker) {
  row.scene = scene.name;
  row.engine = maker.name;
  row.ours = maker.ours;
}

void leave(Lane& lane, const std::string& reason) {
  lane.engine.reset();
  lane.refused = reason;
}
/// An engine that fails on its way, or takes too long, keeps no other from the end.
void run_block(Lane& lane, const scenes::Scene& scene, int from, int to, double patience) try {
  const int done = run_frames(lane, scene, from, to, 1e3 * patience);
  if (done < scene.frames && lane.spent > 1e3 * patience)
    leave(lane, print("%d of %d steps took %.0f s", done, scene.frames, 1e-3 * lane.spent));
} catch (const scenes::SceneError& error) {
  leave(lane, error.what());
}

void run_round(std::vector<Lane>& lanes, const scenes::Scene& scene, const RaceOptions& options) {
  for (int from = 0; from < scene.frames; from += options.block) {
    const int to = std::min(from + options.block, scene.frames);
    for (Lane& lane : lanes) {
      if (lane.engine) run_block(lane, scene, from, to, options.patience);
    }
  }
}

}  // namespace

std::vector<Row> race(const scenes::Scene& scene, const std::vector<Maker>& makers, const RaceOptions& options) {
  std::vector<Row> rows(makers.size());
  std::vector<Times> times(makers.size());
  for (std::size_t i = 0; i < makers.size(); ++i) name(rows[i], scene, makers[i]);
  for (int round = 0; round < options.rounds; ++round) {
    std::fprintf(stderr, "%s: round %d of %d\n", scene.name.c_str(), round + 1, options.rounds);
    std::vector<Lane> lanes = start_lanes(scene, makers, rows, options.engine);
    run_round(lanes, scene, options);
    for (std::size_t i = 0; i < lanes.size(); ++i) {
      rows[i].refused = lanes[i].refused;
      if (!lanes[i].engine) continue;
      if (round == 0) measure(lanes[i], scene, rows[i]);
      note_times(lanes[i], scene, options.from_start, times[i]);
    }
  }
  for (std::size_t i = 0; i < makers.size(); ++i) {
    Row& row = rows[i];
    if (!row.refused.empty()) continue;
    row.ms = quantile(times[i].ms, 0);
    row.p99 = quantile(times[i].p99, 0);
    row.max = quantile(times[i].max, 0);
    if (!times[i].asleep.empty()) row.asleep_ms = quantile(times[i].asleep, 0);
    judge(row);
  }
  return rows;
}

}  // namespace isostep::bench
