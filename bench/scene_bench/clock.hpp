// CPU time of this thread, and order statistics of times.
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <ctime>
#include <vector>

namespace isostep::bench {

/// [ms]
inline double thread_milliseconds() {
#if defined(CLOCK_THREAD_CPUTIME_ID)
  timespec now = {};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
#else
  return 1e3 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
#endif
}

/// The quantile of a copy, nearest rank; 0 of nothing.
inline double quantile(std::vector<double> values, double q) {
  if (values.empty()) return 0;
  const std::size_t rank =
      std::min(values.size() - 1, static_cast<std::size_t>(q * static_cast<double>(values.size())));
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(rank), values.end());
  return values[rank];
}
inline double median(std::vector<double> values) { return quantile(std::move(values), 0.5); }

/// [ms] median of `runs` calls, each preceded by an untimed `before()`.
template <class Before, class Timed> double median_milliseconds(int runs, Before&& before, Timed&& timed) {
  std::vector<double> times;
  for (int i = 0; i < runs; ++i) {
    before();
    const double start = thread_milliseconds();
    timed();
    times.push_back(thread_milliseconds() - start);
  }
  return median(std::move(times));
}

}  // namespace isostep::bench
