// What the scene benchmark asks of an engine that has a scene under way, ours or a peer.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "clock.hpp"
#include "isostep/math/vec3.hpp"
#include "scenes/measure.hpp"
#include "scenes/scene.hpp"

namespace isostep::bench {

/// A body of the scene as it is now.
struct Place {
  Vec3<double> centre;  // [m]
  bool dynamic;
};

/// Built by a Maker, then before_step and a step once a frame; only steps are timed. Measures are in double and cheap
/// but for `overlap`, which is asked for once, at the end.
class Engine {
 public:
  Engine() = default;
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;
  virtual ~Engine() = default;

  /// What happens between frames: kinematic bodies move on, and where `script` is set the scene's script acts.
  virtual void before_step(int frame, bool script) = 0;
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
  /// In the order of the scene.
  virtual std::vector<Place> places() const = 0;
  virtual double joint_error() const = 0;  // [m] largest separation of anchors
  virtual scenes::Energy energy() const = 0;
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

std::unique_ptr<Engine> make_bullet(const scenes::Scene& scene, const EngineOptions& options);
std::unique_ptr<Engine> make_ode(const scenes::Scene& scene, const EngineOptions& options);
/// Of the packages that npm has brought.
std::vector<Maker> rapier_makers();

}  // namespace isostep::bench
