// Percentiles of step times.
// SPDX-License-Identifier: MIT
#include "step_times.hpp"

#include <algorithm>
#include <cstddef>

namespace isostep::tool {
namespace {

/// The smallest of ascending values that at least `percent` of them do not exceed.
double percentile(const std::vector<double>& sorted, std::size_t percent) {
  if (sorted.empty()) return 0;
  const std::size_t rank = (sorted.size() * percent + 99) / 100;
  return sorted[std::max<std::size_t>(rank, 1) - 1];
}

}  // namespace

StepTimes summarise(std::vector<double> ms) {
  StepTimes times;
  if (ms.empty()) return times;
  std::vector<double> settled(ms.begin() + static_cast<std::ptrdiff_t>(ms.size() / 2), ms.end());
  std::sort(ms.begin(), ms.end());
  std::sort(settled.begin(), settled.end());
  for (const double t : ms) times.mean += t / static_cast<double>(ms.size());
  times.median = percentile(ms, 50);
  times.p99 = percentile(ms, 99);
  times.max = ms.back();
  times.median_settled = percentile(settled, 50);
  return times;
}

}  // namespace isostep::tool
