// Peak memory, in a child of its own. Of an engine with a child itself, Rapier's Node, the larger of the two is told.
// SPDX-License-Identifier: MIT
#include "memory.hpp"

#if defined(__unix__) || defined(__APPLE__)
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#endif

namespace isostep::bench {

#if defined(__unix__) || defined(__APPLE__)

namespace {

int run(const scenes::Scene& scene, const Maker& maker, const EngineOptions& options) try {
  const std::unique_ptr<Engine> engine = maker.make(scene, options);
  for (int frame = 0; frame < scene.frames; ++frame) {
    engine->before_step(frame);
    engine->step();
  }
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 70;
}

double megabytes(const rusage& used) {
#if defined(__APPLE__)
  constexpr double kUnit = 1e-6;
#else
  constexpr double kUnit = 1.024e-3;  // of 1024 bytes
#endif
  return kUnit * static_cast<double>(used.ru_maxrss);
}

}  // namespace

Memory measure_memory(const scenes::Scene& scene, const Maker& maker, const EngineOptions& options) {
  rusage own = {}, used = {};
  getrusage(RUSAGE_SELF, &own);
  const pid_t child = fork();
  if (child == 0) _exit(run(scene, maker, options));
  int status = 0;
  if (child < 0 || wait4(child, &status, 0, &used) != child || status != 0) return {};
  return {megabytes(own), megabytes(used)};
}

#else

Memory measure_memory(const scenes::Scene&, const Maker&, const EngineOptions&) { return {}; }

#endif

}  // namespace isostep::bench
