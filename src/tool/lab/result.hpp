// The laboratory's record: what was run, what it cost and how wrong it was; one object a line of results.jsonl.
// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace isostep::tool::lab {

inline constexpr const char* kOwnEngine = "isostep";

/// The setting of a run.
struct LabPoint {
  std::string scene;                // a name or a file
  std::string engine = kOwnEngine;  // "isostep", "bullet", "ode", "rapier-simd", "rapier-det"
  std::string scalar, solver;       // of ours; peers: empty
  std::string model = "rigid";      // "rigid", "spheres", "particles", "articulation"
  int hz = 60, substeps = 8;        // peers: sub-steps 0

  friend bool operator==(const LabPoint&, const LabPoint&) = default;
};

/// `substeps` are passes over one step of integration.
bool counts_passes(const LabPoint& point);
/// "S1 q32.32 direct 2x60 rigid": unique, for keys and progress.
std::string name_of(const LabPoint& point);

/// The statuses; all but the first have a `reason`. done: it ran to its end. left_out: it would be too long, and never
/// began. hung: a peer did not end within the time that guards against processes that never do, which says nothing of
/// how it would have fared. refused: it never began, or had to stop.
inline constexpr const char* kDone = "done";
inline constexpr const char* kLeftOut = "left_out";
inline constexpr const char* kHung = "hung";
inline constexpr const char* kRefused = "refused";

/// A measure that was not taken: null in JSON.
inline constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

struct LabResult {
  LabPoint point;
  std::string state = kDone;
  std::string reason;
  int frames = 0;                         // of 1/hz
  double ms = 0;                          // [ms] CPU time for 1/60 s of simulation, median over the run's second half
  double ms_mean = 0;                     // [ms] the same, mean over the whole run
  double penetration = 0;                 // [m] at the end, worst pair
  double penetration_mean = 0;            // [m] at the end, over the pairs closer than 1 cm
  double joint_error = 0;                 // [m] worst over the run
  double energy_gain = 0;                 // [J/kg] largest rise of total energy above the start over the run
  double energy_loss = 0;                 // [J/kg] start less end
  double unrest = 0;                      // [J/kg] kinetic, mean of the last second
  double signorini = kUnknown;            // [m/s] scenes::ContactResiduals at the end; of rigid bodies of ours
  double coulomb = kUnknown;              // [m/s]
  double dissipation = kUnknown;          // [m/s]
  double deviation = -1;                  // [m] of bodies from the reference after 1 s, root mean square; < 0: unknown
  int faults = 0;                         // numbers that had to be mended
  bool judged = false, survived = false;  // of trials
  double figure = 0;                      // in the trial's unit; of a benchmark scene its own_measure
  std::vector<double> outcome;            // of scenes::Judge
  bool stood = true;  // no body that hardly moves in the reference had gone by 0.4 of its radius in the end
};

/// A result, and what it is a result of: see `version_of`. Peers have versions of their own.
struct LabRecord {
  LabResult result;
  std::string version;
};

/// One line of JSON without its end. Keys are the names above, the point's among them, and "version"; a number that is
/// none becomes null. Every number reads back as it was.
std::string to_line(const LabRecord& record);
/// Throws std::runtime_error, which says what is wrong with the line.
LabRecord from_line(std::string_view line);

/// The records of a file; of several of one point the last counts, in the place of the first. A last line that was cut
/// is not there; none for a file that is not there. Throws ToolError 64, which names file and line, or 66.
std::vector<LabRecord> read_records(const std::string& path);

/// The results as a table: a header, and a line each.
std::string csv_of(const std::vector<LabResult>& results);

}  // namespace isostep::tool::lab
