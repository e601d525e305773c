// One scene, several engines in turn: times and measures.
// SPDX-License-Identifier: MIT
#pragma once

#include "memory.hpp"
#include "scenes/trials/trial.hpp"

namespace isostep::bench {

/// The run of one engine in one scene.
struct Row {
  std::string scene, engine, settings;
  bool ours = false;
  std::string refused;  // why there is nothing else: the engine cannot be given the scene, or takes too long in it
  // CPU time of the step, the lowest of the rounds.
  double ms = 0, p99 = 0, max = 0;  // [ms] over the second half; S9, and the peers' scenes: over the whole run
  double asleep_ms = -1;            // [ms] a step with everybody asleep; less than 0: never
  Memory memory;                    // where asked for
  // Measures, of the first round.
  int faults = 0;
  scenes::Overlap overlap;                // [m] at the end
  double kinetic = 0;                     // [J/kg] mean of the last 60 steps
  double energy_loss = 0;                 // [J/kg] from start to end
  double moved = 0, drift = 0, drop = 0;  // [m] largest: from the start; horizontally; downwards
  double top_error = 0;                   // [m] of the last body's height, against the start
  double reach_error = 0;                 // [m] last body from the first joint's anchor, against the start
  double joint_worst = 0, joint_end = 0;  // [m] over the run; at the end
  double limit_worst = 0, limit_end = 0;  // [rad] past joints' limits, over the run; at the end
  double energy_gain = 0;                 // [J/kg] most above the start, over the run; scenes with joints
  int outside = 0;                        // bodies that left the pit, the floor, the drum or the hills
  int through = -1;                       // bullets that passed what was in their way; less than 0: there are none
  double bump = -1;                       // [m/s] as scenes::Measure::bump; less than 0: not looked at
  const scenes::Trial* trial = nullptr;   // that the scene is
  double figure = 0;                      // of the trial, in its unit; not a number: it did not do what it is to do
  std::vector<double> speeds;             // [rad/s] of its bodies about z, mean of the run
  double asleep_at = -1;                  // [s] first frame with nobody awake; less than 0: never
  // The verdict by verdict.hpp.
  bool failed = false;
  std::string bar;  // "aim", "must", "misses" or "-"
};

struct RaceOptions {
  int rounds = 2;
  int block = 20;           // [frames] an engine runs before the next has its turn
  int frames = 0;           // of a run; 0: as many as the scene says
  bool from_start = false;  // times are of the whole run, not of its settled half
  double patience = 30;     // [s] CPU time of an engine's steps in a round: what takes longer is left, for others wait
  EngineOptions engine;
};

/// Rows in the order of the makers.
std::vector<Row> race(const scenes::Scene& scene, const std::vector<Maker>& makers, const RaceOptions& options);

}  // namespace isostep::bench
