// How every engine stood in the published tests: ours and the peers as they run here, the others as their authors say.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "scenes/published/published.hpp"
#include "tool/lab/result.hpp"

namespace isostep::tool::lab {

/// An engine in one test at one rate.
struct Standing {
  std::string engine;  // "isostep q32.32, soft_step, 8 sub-steps", "bullet", "RaiSim (2018)"
  bool ours = false;
  std::string scalar;            // of ours
  bool is_default = false;       // ours with the settings of a world that asks for none
  bool is_articulation = false;  // ours in joint coordinates
  bool published = false;        // the figure is the authors'; its seconds are of another machine and are not taken
  std::string state = kDone;
  bool ended = true;   // not so: left out, hung, refused, or without a number; `reason` says which
  double figure = 0;   // in the test's unit
  double seconds = 0;  // CPU time of a second of simulation
  std::string reason;
};

/// The standings of a test at a rate, the smallest error first; those that did not end come last. Of a test that
/// compares steps, the run that others are compared with does not stand.
std::vector<Standing> standings_of(const scenes::PublishedTest& test, int hz, const std::vector<LabResult>& results);
/// The place of the first that `chosen` accepts, from 1; equal figures share a place. 0: it did not end.
int place_of(const std::vector<Standing>& standings, bool (*chosen)(const Standing&));
/// "10 ms", "0.4 ms".
std::string step_text(int hz);

}  // namespace isostep::tool::lab
