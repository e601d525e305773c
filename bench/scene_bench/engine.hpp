// What the scene benchmark asks of an engine that has a scene under way, ours or a peer.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "clock.hpp"
#include "scenes/measure.hpp"
#include "scenes/scene.hpp"
#include "scenes/sight.hpp"

namespace isostep::bench {

/// Built by a Maker, then before_step and a step once a frame; only steps are timed. Measures are in double and cheap
/// but for `overlap`, which is asked for once, at the end.
class Engine {
 public:
  Engine() = default;
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;
  virtual ~Engine() = default;

  /// What happens between frames: kinematic bodies move on, and the scene's script acts.
  virtual void before_step(int frame) = 0;
  virtual void step() = 0;
  /// Takes steps and says the CPU time [ms] of all of them: this thread's, or that of the process where they are taken.
  virtual double timed_steps(int count) {
    const double start = thread_milliseconds();
    for (int i = 0; i < count; ++i) step();
    return thread_milliseconds() - start;
  }

  virtual bool all_asleep() const = 0;
  /// Steps so far that had to mend something, or whose numbers are no numbers.
  virtual int faults() const = 0;
  virtual scenes::Sight sight() const = 0;
  virtual scenes::Overlap overlap() const = 0;
  virtual std::string settings() const = 0;  // for the report: "avx2, 8 sub-steps"
};

struct EngineOptions {
  int substeps = 0;  // of ours; 0: the engine's default
};

struct Maker {
  const char* name;  // a scalar's name, "bullet", "rapier-simd"
  bool ours;
  std::unique_ptr<Engine> (*make)(const scenes::Scene& scene, const EngineOptions& options);
};
/// Every engine that can be run: our scalars, then peers.
std::vector<Maker> makers();

/// Those that are not ours.
std::vector<Maker> peer_makers();

std::unique_ptr<Engine> make_bullet(const scenes::Scene& scene, const EngineOptions& options);
std::unique_ptr<Engine> make_ode(const scenes::Scene& scene, const EngineOptions& options);
/// Of the packages that npm has brought.
std::vector<Maker> rapier_makers();

}  // namespace isostep::bench
