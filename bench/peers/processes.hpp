// Work in processes of its own, some at a time: what crashes or never ends takes nothing else along.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace isostep::bench {

/// The end of a process.
struct ProcessEnd {
  std::string said;  // what `work` returned; empty where it did not come to that
  int signal = 0;    // that ended it; 0: none
  bool hung = false;
};

struct Work {
  std::size_t count = 0;
  int jobs = 1;                                 // at a time
  int guard = 300;                              // [s] of each, by the clock on the wall
  std::function<void(std::size_t)> prepare;     // here, before the process begins
  std::function<std::string(std::size_t)> run;  // in the process; not more than 64 KiB
  std::function<void(std::size_t, const ProcessEnd&)> done;
};
/// Runs every i < count, begun in order. `run` may not throw.
void in_processes(const Work& work);

}  // namespace isostep::bench
