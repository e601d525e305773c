// Trials of boxes that bear boxes: towers, heavy on light.
// SPDX-License-Identifier: MIT
#include "families.hpp"
#include "judges.hpp"
#include "scenes/named.hpp"
#include "scenes/shapes.hpp"

namespace isostep::scenes {
namespace {

Scene tower(int boxes, bool sleeps) {
  Scene scene = stack(boxes);
  scene.allow_sleep = sleeps;
  scene.frames = sleeps ? 600 : 3600;
  return scene;
}
Scene tall_stack() { return tower(20, false); }
Scene taller_stack() { return tower(50, false); }
Scene sleeping_stack() { return tower(20, true); }
Scene taller_sleeping_stack() { return tower(50, true); }

/// [s] The time until all of a tower sleeps for good; the whole run for a tower that fell first.
class Restlessness : public Judge {
 public:
  explicit Restlessness(const Scene& scene) : whole_(static_cast<double>(scene.frames) / scene.hz) {}
  void see(const Sight& sight) override {
    drift_.see(sight);
    for (const BodySight& body : sight.bodies) {
      if (body.dynamic && body.awake) last_ = sight.time;
    }
  }
  double figure() const override { return drift_.figure() < 50 ? last_ : whole_; }

 private:
  double whole_, last_ = 0;  // [s]
  Drift drift_;
};

Scene heavy_on_light(double ratio) {
  Scene scene = stack(2);
  scene.bodies.back().mass = ratio;
  return scene;
}
Scene hundredfold_on_light() { return heavy_on_light(100); }
Scene fourhundredfold_on_light() { return heavy_on_light(400); }

/// [%] The distance of the last body from its start now over a unit box's side, be it sunk in, thrown off or fallen.
class Sinking : public FromStart {
 public:
  double figure() const override { return 100 * way_; }

 private:
  void compare(const Sight& start, const Sight& now) override {
    way_ = length_of(way_of(start, now, start.bodies.size() - 1));
  }
  double way_ = 0;
};

/// Three walls of ten rows, side by side; pitch as in S2.
Scene heavy_tips() {
  constexpr int kRows = 10;
  constexpr double kPitch = 1.05, kApart = 14;  // [m]
  Scene scene = stack(0);
  for (int wall = 0; wall < 3; ++wall) {
    for (int row = 0; row < kRows; ++row) {
      for (int i = 0; i < kRows - row; ++i) {
        const double x = (wall - 1) * kApart + (i - (kRows - 1 - row) * 0.5) * kPitch;
        scene.bodies.push_back(body_of(box_part({0.5, 0.5, 0.5}), {x, 0.5 + row, 0}));
      }
    }
    scene.bodies.back().mass = 100 * (wall + 1);
  }
  return scene;
}

constexpr char kDrift[] = "largest way sideways, of a box";
constexpr char kSleep[] = "time until all sleep";
constexpr char kSinking[] = "way of the heavy box after 10 s, of the light one's size";

}  // namespace

std::span<const Trial> stacking_trials() {
  static const Trial trials[] = {
      {"tall_stack", "1", "20 unit boxes stacked, for a minute", kDrift, "%", 1, tall_stack, judge_of<Drift>},
      {"tall_stack_50", "1", "50 unit boxes stacked, for a minute", kDrift, "%", 1, taller_stack, judge_of<Drift>},
      {"sleeping_stack", "1", "20 unit boxes stacked, with sleep", kSleep, "s", 5, sleeping_stack,
       judge_of<Restlessness>},
      {"sleeping_stack_50", "1", "50 unit boxes stacked, with sleep", kSleep, "s", 5, taller_sleeping_stack,
       judge_of<Restlessness>},
      {"heavy_on_light_100", "3", "a box of 100 kg on one of 1 kg", kSinking, "%", 5, hundredfold_on_light,
       judge_of<Sinking>},
      {"heavy_on_light_400", "3", "a box of 400 kg on one of 1 kg", kSinking, "%", 20, fourhundredfold_on_light,
       judge_of<Sinking>},
      {"heavy_tips", "4", "walls of ten rows of 1 kg under tips of 100, 200 and 300 kg",
       "boxes displaced by more than half their size", "", 0, heavy_tips, displaced_by_half},
  };
  return trials;
}

}  // namespace isostep::scenes
