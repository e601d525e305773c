// Runs side by side with double.
// SPDX-License-Identifier: MIT
#include "growth.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scenes/build.hpp"
#include "scenes/named.hpp"
#include "scenes/script.hpp"
#include "scenes/shapes.hpp"
#include "tool/common/tool.hpp"
#include "tool/lab/progress.hpp"

namespace isostep::tool::lab {
namespace {

/// [frames] early ones all, later ones more and more apart: charts are logarithmic.
bool is_sampled(int frame) { return frame <= 10 || (frame <= 60 && frame % 3 == 0) || frame % 10 == 0; }

template <class S> std::vector<scenes::Sight> sights_of(const scenes::Scene& scene, int frames) {
  World<S> world(scenes::settings_of<S>(scene));
  scenes::build(scene, world);
  std::vector<scenes::Sight> sights;
  for (int frame = 1; frame <= frames; ++frame) {
    stop_if_interrupted();
    scenes::before_step(scene.script, world);
    world.step();
    if (is_sampled(frame)) sights.push_back(scenes::sight_of(world, 0));
  }
  return sights;
}

std::vector<scenes::Scene> grown_scenes() {
  std::vector<scenes::Scene> list;
  for (const char* name : {"S6v", "S6", "S4s"}) list.push_back(*scenes::find_scene(name));
  list.insert(list.begin() + 2, spinner());
  return list;
}

}  // namespace

double distance_between(const scenes::Sight& a, const scenes::Sight& b) {
  constexpr double kReach = 0.5;  // [m] of the points
  if (a.bodies.size() != b.bodies.size()) return std::numeric_limits<double>::quiet_NaN();
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < a.bodies.size(); ++i) {
    if (!b.bodies[i].dynamic) continue;
    const Vec3<double> way = a.bodies[i].centre - b.bodies[i].centre;
    const Mat3<double> axes_a = to_matrix(a.bodies[i].orientation), axes_b = to_matrix(b.bodies[i].orientation);
    sum += dot(way, way);
    for (int k = 0; k < 3; ++k) {
      const Vec3<double> apart = axes_a.column(k) - axes_b.column(k);
      sum += kReach * kReach / 3 * dot(apart, apart);
    }
    count += 1;
  }
  return count > 0 ? std::sqrt(sum / count) : 0;
}

scenes::Scene spinner() {
  scenes::Scene scene;
  scene.name = "spinner";
  scene.gravity = scenes::zero_vector();
  scene.allow_sleep = false;
  scene.bodies.push_back(scenes::body_of(scenes::box_part({0.5, 0.3, 0.1}), {0, 0, 0}));
  scene.bodies.back().angular_velocity = {0.01, 5, 0.02};
  return scene;
}

std::vector<GrowthSample> measure_growth(int frames) {
  std::vector<GrowthSample> samples;
  const std::vector<scenes::Scene> all = grown_scenes();
  Progress progress(true, all.size(), static_cast<double>(all.size()));
  for (const scenes::Scene& scene : all) {
    const int count = std::min(frames, scene.frames);
    const std::vector<scenes::Sight> exact = sights_of<double>(scene, count);
    any_scalar([&](auto tag) {
      using S = typename decltype(tag)::Type;
      if (std::is_same_v<S, double>) return false;
      const std::vector<scenes::Sight> sights = sights_of<S>(scene, count);
      for (std::size_t i = 0; i < sights.size(); ++i) {
        samples.push_back({scene.name, ScalarTraits<S>::kName, sights[i].time, distance_between(sights[i], exact[i])});
      }
      return false;
    });
    progress.done(1, "growth in " + scene.name);
  }
  return samples;
}

}  // namespace isostep::tool::lab
