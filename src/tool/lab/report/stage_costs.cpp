// A clock read after each stage.
// SPDX-License-Identifier: MIT
#include "stage_costs.hpp"

#include "isostep/store/stages.hpp"
#include "scenes/build.hpp"
#include "scenes/named.hpp"
#include "scenes/script.hpp"
#include "tool/common/tool.hpp"
#include "tool/lab/median.hpp"
#include "tool/lab/progress.hpp"

namespace isostep::tool::lab {
namespace {

struct StageClock {
  double last = 0;  // [ms]
  std::vector<double> times[kStages];

  static void after(void* user, Stage stage, const StageView&) {
    StageClock& watch = *static_cast<StageClock*>(user);
    const double now = thread_milliseconds();
    watch.times[static_cast<std::size_t>(stage)].push_back(now - watch.last);
    watch.last = now;
  }
};

template <class S> void measure(const scenes::Scene& scene, int settling, int timed, std::vector<StageCost>& costs) {
  World<S> world(scenes::settings_of<S>(scene));
  scenes::build(scene, world);
  StageClock watch;
  for (int frame = 0; frame < settling + timed; ++frame) {
    stop_if_interrupted();
    scenes::before_step(scene.script, world);
    watch.last = thread_milliseconds();
    if (frame < settling) static_cast<void>(world.step());
    else static_cast<void>(world.step({StageClock::after, &watch}));
  }
  for (std::size_t stage = 0; stage < kStages; ++stage) {
    costs.push_back({scene.name, ScalarTraits<S>::kName, kStageNames[stage], 1e3 * median(watch.times[stage])});
  }
}

}  // namespace

std::vector<StageCost> measure_stages(int settling, int timed) {
  std::vector<StageCost> costs;
  Progress progress(true, 3, 3);
  for (const char* name : {"S3", "S4", "S7"}) {
    const scenes::Scene scene = *scenes::find_scene(name);
    any_scalar([&](auto tag) {
      measure<typename decltype(tag)::Type>(scene, settling, timed, costs);
      return false;
    });
    progress.done(1, std::string("stages of ") + name);
  }
  return costs;
}

}  // namespace isostep::tool::lab
