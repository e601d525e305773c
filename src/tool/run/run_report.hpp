// The report of a run by `run`: one set of figures for people and for programs.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "isostep/particles/particle_world.hpp"
#include "isostep/state/hash.hpp"
#include "scenes/residuals.hpp"
#include "scenes/trials/trial.hpp"
#include "tool/common/step_times.hpp"

namespace isostep::tool {

/// The report of a run of any kind of world.
struct AnyRunReport {
  std::string scene, scalar, solver, simd;
  int substeps = 0, threads = 1, frames = 0;
  std::uint64_t hash = 0;
  StepTimes ms;
  double penetration_max = 0;               // [m] at the end
  double energy_start = 0, energy_end = 0;  // [J] kinetic, of gravity, of springs; of all that forces move
  std::uint64_t faults = 0;                 // all that the step reports named
};

/// The report of a run of a trial's scene from its start.
struct TrialReport {
  const scenes::Trial* trial;
  scenes::Verdict verdict;
  bool over;  // false: the run was shorter than the trial, which has no verdict yet
};

/// A hull, mesh or height field of the world at the end.
struct BlobReport {
  const char* shape;
  ContentId id;
  std::size_t bytes;   // as a file holds it
  std::size_t memory;  // [bytes] of its content in the world's scalar
  std::uint32_t uses;  // by parts of shapes
};

struct RunReport : AnyRunReport {
  std::string projection;                                         // of worst_first; else empty
  std::uint32_t contacts = 0, points = 0, bodies = 0, awake = 0;  // at the end
  double joint_error_max = 0;                                     // [m] over the run
  int asleep_at = -1;  // first frame, from 0, that ends with nobody awake; -1: none
  scenes::ContactResiduals residuals;  // at the end
  std::optional<TrialReport> trial;
  std::optional<int> lost;     // bodies that are not where a benchmark scene keeps them, at the end
  std::optional<int> through;  // bullets that passed what was in their way, of scenes that are about them
  std::vector<BlobReport> blobs;

  // These are for people alone.
  double penetration_mean = 0;  // [m] over pairs closer than 1 cm
  double unrest = 0;            // [J/kg] kinetic energy, mean of the last 60 frames
};

/// The report of a world of particles; `faults` is without what is unresolved.
struct ParticleRunReport : AnyRunReport {
  std::string integrator, stepping;
  ParticleCounts counts = {};    // at the end
  double speed_max = 0;          // [m/s] at the end
  double link_error_max = 0;     // [m] over the run
  std::uint64_t unresolved = 0;  // rows that worst_first left over, of all steps
};

/// One JSON object each, its members in a fixed order.
std::string json_of(const RunReport& report);
std::string table_of(const RunReport& report);
std::string json_of(const ParticleRunReport& report);
std::string table_of(const ParticleRunReport& report);

}  // namespace isostep::tool
