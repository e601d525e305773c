// The errors that projections of the solver worst_first leave, their cost, and the cost of finding its worst row.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace isostep::bench {

struct ProjectionRow {
  std::string scene, scalar, projection;
  double worst = 0;       // [m] overlap, of all frames
  double mean = 0;        // [m] of the frames' worst
  double left = 0;        // [m] overlap at the end
  double kept = 0;        // [1] of the energy of the start, at the end
  double gained = 0;      // [1] of it, the greatest rise from one frame to a later one
  double ms = 0;          // a step, median
  std::uint64_t cut = 0;  // islands that a pass left with something to do
};
/// A stack that rests, an impact, a pile: every projection, in float and Q32.32.
std::vector<ProjectionRow> measure_projections();

struct QueueRow {
  std::string queue;
  int bodies = 0;
  std::uint32_t contacts = 0, points = 0;
  double us = 0;  // a step of the solver, the least of all rounds
};
/// One step of a pile of so many bodies, by each queue, in float. Throws where two do not leave the same bits.
std::vector<QueueRow> measure_queues(int bodies, int rounds);

}  // namespace isostep::bench
