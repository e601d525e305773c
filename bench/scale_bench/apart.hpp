// A measurement in a process of its own: what it takes is given back, and the peak of its memory is its own.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdio>
#include <exception>
#include <stdexcept>
#include <type_traits>

#if defined(__unix__) || defined(__APPLE__)
#include <sys/wait.h>
#include <unistd.h>
#endif

namespace isostep::bench {

#if defined(__unix__) || defined(__APPLE__)

/// In the child: returns what the process exits with.
template <class Row, class Measure> int tell(int pipe_end, const Measure& measure) try {
  const Row row = measure();
  return write(pipe_end, &row, sizeof row) == static_cast<ssize_t>(sizeof row) ? 0 : 74;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 70;
}

/// What `measure()` returns there; throws where it does not. Elsewhere than on Unix it is called here.
template <class Row, class Measure> Row measure_apart(const Measure& measure) {
  static_assert(std::is_trivially_copyable_v<Row>);
  int ends[2];
  if (pipe(ends) != 0) throw std::runtime_error("no pipe to a process of its own");
  std::fflush(nullptr);
  const pid_t child = fork();
  if (child == 0) _exit(tell<Row>(ends[1], measure));
  close(ends[1]);
  Row row = {};
  const bool told = child > 0 && read(ends[0], &row, sizeof row) == static_cast<ssize_t>(sizeof row);
  close(ends[0]);
  int status = 0;
  if (child < 0 || waitpid(child, &status, 0) != child || status != 0 || !told) {
    throw std::runtime_error("a measurement did not end");
  }
  return row;
}

#else

template <class Row, class Measure> Row measure_apart(const Measure& measure) { return measure(); }

#endif

}  // namespace isostep::bench
