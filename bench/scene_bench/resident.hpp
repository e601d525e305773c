// The memory that this process has, as its system tells it. MB are 10^6 bytes.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdio>

#if defined(__GLIBC__)
#include <malloc.h>
#endif
#if defined(__unix__) || defined(__APPLE__)
#include <sys/resource.h>
#include <unistd.h>
#endif

namespace isostep::bench {

/// [MB] now; 0 where nobody tells.
inline double resident_megabytes() {
#if defined(__linux__)
  std::FILE* file = std::fopen("/proc/self/statm", "r");
  if (file == nullptr) return 0;
  unsigned long long all = 0, resident = 0;
  const int read = std::fscanf(file, "%llu %llu", &all, &resident);
  std::fclose(file);
  return read == 2 ? 1e-6 * static_cast<double>(resident) * static_cast<double>(sysconf(_SC_PAGESIZE)) : 0;
#else
  return 0;
#endif
}

/// Else what was freed before would be used again, and hide what is taken now.
inline void return_freed_memory() {
#if defined(__GLIBC__)
  malloc_trim(0);
#endif
}

#if defined(__unix__) || defined(__APPLE__)
/// [MB] at most, since the process began.
inline double peak_megabytes(const rusage& used) {
#if defined(__APPLE__)
  constexpr double kUnit = 1e-6;
#else
  constexpr double kUnit = 1.024e-3;  // of 1024 bytes
#endif
  return kUnit * static_cast<double>(used.ru_maxrss);
}
#endif

/// [MB] at most, since the process or begin_peak() began; 0 where nobody tells.
inline double peak_megabytes() {
#if defined(__unix__) || defined(__APPLE__)
  rusage used = {};
  getrusage(RUSAGE_SELF, &used);
  return peak_megabytes(used);
#else
  return 0;
#endif
}

/// Returns what resident_megabytes() is [MB], and begins the peak anew there where the system lets it: else what was
/// freed before counts as peak. A process begins with all that its parent had.
inline double begin_peak() {
  return_freed_memory();
#if defined(__linux__)
  if (std::FILE* file = std::fopen("/proc/self/clear_refs", "w")) {
    std::fputs("5", file);
    std::fclose(file);
  }
#endif
  return resident_megabytes();
}

}  // namespace isostep::bench
