// One scene, trial or published test in one peer, as a record of the laboratory.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "scene_bench/engine.hpp"
#include "tool/lab/result.hpp"

namespace isostep::bench {

using tool::lab::LabRecord;

struct PeerJob {
  std::string scene;  // a named scene's, a trial's or a published test's
  Maker maker;
  int hz;  // [1/s] rate of steps
};
/// A record with point and version, of a run that never began: it is written when a process does not come back.
LabRecord empty_record(const PeerJob& job);
/// The same of a run whose engine lost the scene on its way. Trials are failed by that.
LabRecord lost_record(const PeerJob& job, const std::string& reason);

/// [body steps] For the time that is left of many.
double work_of(const PeerJob& job);
/// Prepares what all engines' runs of the scene need and is the same for them: before their processes begin.
void prepare(const PeerJob& job);
/// Steps of 1/hz s for as long as the scene runs.
LabRecord run_peer(const PeerJob& job);

}  // namespace isostep::bench
