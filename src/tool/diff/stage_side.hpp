// One of the two that `isostep diff --stages` compares: a recording, played here or by a prover of another build.
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "diagnostics/staged_replay.hpp"
#include "field_list.hpp"
#include "tool/common/recorded_file.hpp"

namespace isostep::tool {

/// The hash of what was left at a point.
struct TracePoint {
  StagePoint at;
  std::uint64_t hash;
};

class StageSide {
 public:
  virtual ~StageSide() = default;
  virtual std::vector<TracePoint> trace() const = 0;
  virtual FieldList fields_at(const StagePoint& at) const = 0;
};

/// Plays in this process.
std::unique_ptr<StageSide> played_here(const Input& input, const StagedReplay& how = {});
/// `prover`: a command line of a shell.
std::unique_ptr<StageSide> played_by(const std::string& prover, const Input& input);

/// Prints where two sides part and what differs there, or that they do not; an exit status.
int print_first_difference(const Input& input_a, const StageSide& a, const Input& input_b, const StageSide& b);

}  // namespace isostep::tool
