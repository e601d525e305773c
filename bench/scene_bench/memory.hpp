// The most memory that an engine's run of a scene ever holds.
// SPDX-License-Identifier: MIT
#pragma once

#include "engine.hpp"

namespace isostep::bench {

/// Resident memory of a process that runs the scene and nothing else, program and libraries included [MB = 10^6 bytes];
/// less than 0 where the system does not tell.
struct Memory {
  double before = -1;  // with the scene read, but no world made of it
  double peak = -1;    // over the whole run, or as far as patience went
};
/// Ends after `patience` [s] of CPU time in steps. It is to be called before this process has grown, for the measured
/// one begins as its copy.
Memory measure_memory(const scenes::Scene& scene, const Maker& maker, const EngineOptions& options, double patience);

}  // namespace isostep::bench
