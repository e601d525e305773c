// Peak memory, in a child of its own. Of an engine with a child itself, Node, the larger of the two is told.
// SPDX-License-Identifier: MIT
#include "memory.hpp"

#include "resident.hpp"

#if defined(__unix__) || defined(__APPLE__)
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#endif

namespace isostep::bench {

#if defined(__unix__) || defined(__APPLE__)

namespace {

int run(const scenes::Scene& scene, const Maker& maker, const EngineOptions& options, double patience) try {
  const std::unique_ptr<Engine> engine = maker.make(scene, options);
  double spent = 0;  // [ms]
  for (int frame = 0; frame < scene.frames && spent < 1e3 * patience; ++frame) {
    engine->before_step(frame);
    spent += engine->timed_steps(1);
  }
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 70;
}

}  // namespace

Memory measure_memory(const scenes::Scene& scene, const Maker& maker, const EngineOptions& options, double patience) {
  rusage own = {}, used = {};
  getrusage(RUSAGE_SELF, &own);
  const pid_t child = fork();
  if (child == 0) _exit(run(scene, maker, options, patience));
  int status = 0;
  if (child < 0 || wait4(child, &status, 0, &used) != child || status != 0) return {};
  return {peak_megabytes(own), peak_megabytes(used)};
}

#else

Memory measure_memory(const scenes::Scene&, const Maker&, const EngineOptions&, double) { return {}; }

#endif

}  // namespace isostep::bench
