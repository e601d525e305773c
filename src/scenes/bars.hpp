// The figures that the benchmark scenes are to reach, as data, and how a run is held against them.
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "sight.hpp"
#include "trials/trial.hpp"

namespace isostep::scenes {

/// Less is better, of all of them; of signed ones the size counts.
enum class Measure {
  top,               // [m] height of the last body, against the start
  drift,             // [m] furthest horizontal way of a body
  moved,             // [m] furthest way of a body
  stretch,           // [m] last body from the first joint's anchor, against the start
  outside,           // [1] bodies that are not where the scene keeps them
  penetration,       // [m] at the end, worst
  penetration_mean,  // [m]
  unrest,            // [J/kg] kinetic, mean of the last second
  joint_error,       // [m] worst over the run
  joint_end,         // [m] at the end
  limit_passed,      // [rad] of joints, worst over the run
  limit_end,         // [rad] at the end
  energy_loss,       // [J/kg] start less end
  energy_gain,       // [J/kg] most above the start, over the run
  asleep_at,         // [s] simulated, until nobody is awake
  asleep_ms,         // [ms] of a step after that
  through,           // [1] bullets that passed what was in their way
  bump               // [m/s] greatest vertical speed, or spin times 0.5 m, after half a second
};
const char* name_of(Measure measure);

/// Every bar of a scene is to be held: `must` by all scalars but those for particles and small scenes, which have
/// bars of their own; `aim` is where more accuracy stops to matter.
struct Bar {
  const char* scene;
  Measure measure;
  double must, aim;
};
/// `small`: of q16.16.
std::vector<Bar> bars_of(std::string_view scene, bool small);

enum class Reach { no_bar, misses, must, aim };
inline constexpr const char* kReachNames[] = {"-", "misses", "must", "aim"};
/// value_of(Measure): an std::optional<double>; measures that nobody took hold nothing up.
template <class ValueOf> Reach reach_of(const std::vector<Bar>& bars, ValueOf&& value_of) {
  Reach reach = bars.empty() ? Reach::no_bar : Reach::aim;
  for (const Bar& bar : bars) {
    const std::optional<double> value = value_of(bar.measure);
    if (!value) continue;
    const double size = *value < 0 ? -*value : *value;
    const Reach here = size < bar.aim ? Reach::aim : size < bar.must ? Reach::must : Reach::misses;
    if (here < reach) reach = here;
  }
  return reach;
}

/// Dynamic bodies whose centre is not where the scene keeps them: in the pit, above the floor, in the drum.
int count_outside(std::string_view scene, const std::vector<BodySight>& bodies);
/// The bullets of such a scene that are past their wall, or left their plate less than a tenth of the speed that they
/// would share with it. Nothing for other scenes.
std::optional<int> count_through(std::string_view scene, const std::vector<BodySight>& start,
                                 const std::vector<BodySight>& now);

/// The measure that a benchmark scene is about beside overlap, joints and energy, for they are measured anyway.
Measure own_measure(std::string_view scene);
bool is_benchmark(std::string_view scene);
/// Its figure is that measure, at the end. Null for what is no benchmark scene.
std::unique_ptr<Judge> benchmark_judge(const Scene& scene);

}  // namespace isostep::scenes
