// Trials: scenes where methods are known to fail, each with the one figure that tells, and its bar.
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "scenes/scene.hpp"
#include "scenes/sight.hpp"

namespace isostep::scenes {

/// Watches one run, frame by frame, and says how far from right it went. Knows nothing of the engine.
class Judge {
 public:
  Judge() = default;
  Judge(const Judge&) = delete;
  Judge& operator=(const Judge&) = delete;
  virtual ~Judge() = default;

  /// The start, then after every frame.
  virtual void see(const Sight& sight) = 0;
  /// The figure in the trial's unit: survived at or below its bar. Not a number: failed.
  virtual double figure() const = 0;
  /// The numbers by which the run is compared with one of other steps, if it is [m].
  virtual std::vector<double> outcome() const { return {}; }
};
/// [m] The root mean square over bodies of the distance between two outcomes, three numbers a body; not a number where
/// they have not the same bodies, or none.
double distance_of(const std::vector<double>& a, const std::vector<double>& b);

struct Trial {
  const char* name;         // of the scene
  const char* number;       // "5", its row in the list of failure scenes; "f2": of those for fixed point
  const char* description;  // what is there
  const char* measure;      // what the figure is: "peak stretch over a link's length"
  const char* unit;         // "mm", "%", "rad", "" for a plain number
  double bar;               // the most that survives
  Scene (*make)();
  std::unique_ptr<Judge> (*judge)(const Scene& scene);
};

/// Every trial, family after family.
std::span<const Trial> trials();
/// Finds one of these, or of the published tests (published/published.hpp). Returns null for a name that neither has.
const Trial* find_trial(std::string_view name);

/// A run that looks so has been through all of a trial, whatever the rate of its steps.
bool is_over(const Scene& scene, const Sight& sight);

/// A run that mended numbers, or has no number to show, has failed whatever the figure.
struct Verdict {
  bool survived;
  double figure;
};
Verdict verdict_of(const Trial& trial, const Judge& judge, const Sight& end);

}  // namespace isostep::scenes
