// The times of a run's steps, as figures.
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

namespace isostep::tool {

/// CPU time of the step calls alone [ms].
struct StepTimes {
  double median = 0, mean = 0, p99 = 0, max = 0;
  double median_settled = 0;  // over the second half of the run
};
/// Percentiles by nearest rank; of an even count the median is the lower middle.
StepTimes summarise(std::vector<double> milliseconds);

}  // namespace isostep::tool
