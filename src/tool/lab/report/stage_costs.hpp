// The cost of each stage of a step, scalar by scalar.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace isostep::tool::lab {

struct StageCost {
  std::string scene, scalar, stage;
  double us;  // [us] CPU time a step, median
};

/// Measures S3, S4 and S7, by soft step at their own sub-steps, after `settling` frames, over `timed` more.
std::vector<StageCost> measure_stages(int settling, int timed);

}  // namespace isostep::tool::lab
