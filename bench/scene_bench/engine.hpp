// The interface of an engine that has a scene of the benchmark under way, ours or a peer.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "clock.hpp"
#include "scenes/measure.hpp"
#include "scenes/queries.hpp"
#include "scenes/scene.hpp"
#include "scenes/sight.hpp"

namespace isostep::bench {

/// The queries of S14: the first hit of a ray or of a shape that is cast, one by one or all in one call; the bodies
/// that a sphere overlaps; all bodies along a ray.
enum class Query { ray, rays, cast, casts, overlap, all_hits };
inline constexpr const char* kQueryNames[] = {"ray", "rays", "cast", "casts", "overlap", "all_hits"};
/// The terrain is not asked for by the last two, and those have as many rays.
inline constexpr std::size_t kListRays = 1000;

struct Answered {
  double ms;           // CPU time of all of a frame
  std::uint64_t hits;  // of all of them
};

/// An engine that gave no answer in time, which says nothing of what it would have done.
struct NoAnswer : scenes::SceneError {
  using SceneError::SceneError;
};

/// An engine is built by a Maker, then before_step and a step follow once a frame; only steps are timed. Measures are
/// in double and cheap but for `overlap`, which is asked for once, at the end.
class Engine {
 public:
  Engine() = default;
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;
  virtual ~Engine() = default;

  /// Moves kinematic bodies on and lets the scene's script act, between frames.
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

  /// The queries of a frame, before they are asked: what happens here is not timed.
  virtual void take(const scenes::DrawnQueries&) {}
  /// Asks all of one kind. Nothing: this engine has no such query, or is not asked.
  virtual std::optional<Answered> ask(Query) { return std::nullopt; }
};

struct EngineOptions {
  int substeps = 0;  // of ours; 0: the engine's default
};

/// An engine made of the scene what it cannot go on with.
class Lost : public scenes::SceneError {
 public:
  explicit Lost(const std::string& reason) : SceneError("", reason) {}
};

struct Maker {
  const char* name;  // a scalar's name, "bullet", "rapier-simd"
  bool ours;
  std::unique_ptr<Engine> (*make)(const scenes::Scene& scene, const EngineOptions& options);
};
/// Every engine that can be run: our scalars, then peers.
std::vector<Maker> makers();
/// Those that are not ours; an engine's most careful settings, NAME-best, come behind it.
std::vector<Maker> peer_makers();

std::unique_ptr<Engine> make_bullet(const scenes::Scene& scene, const EngineOptions& options);
std::unique_ptr<Engine> make_bullet_best(const scenes::Scene& scene, const EngineOptions& options);
std::unique_ptr<Engine> make_ode(const scenes::Scene& scene, const EngineOptions& options);
std::unique_ptr<Engine> make_ode_best(const scenes::Scene& scene, const EngineOptions& options);
std::unique_ptr<Engine> make_dart(const scenes::Scene& scene, const EngineOptions& options);
/// The makers of the packages that npm has brought.
std::vector<Maker> node_makers();

}  // namespace isostep::bench
