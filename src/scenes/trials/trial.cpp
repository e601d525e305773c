// The list of trials, and their verdicts.
// SPDX-License-Identifier: MIT
#include "trial.hpp"

#include <cmath>
#include <vector>

#include "families.hpp"
#include "scenes/published/published.hpp"

namespace isostep::scenes {

double distance_of(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.empty() || a.size() != b.size()) return std::nan("");
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(3 * sum / static_cast<double>(a.size()));
}

std::span<const Trial> trials() {
  static const std::vector<Trial> all = [] {
    std::vector<Trial> list;
    for (const std::span<const Trial> family : trial_families()) list.insert(list.end(), family.begin(), family.end());
    return list;
  }();
  return all;
}

const Trial* find_trial(std::string_view name) {
  for (const Trial& trial : trials()) {
    if (name == trial.name) return &trial;
  }
  const PublishedTest* const published = find_published_test(name);
  return published == nullptr ? nullptr : &published->trial;
}

bool is_over(const Scene& scene, const Sight& sight) {
  const double whole = static_cast<double>(scene.frames) / scene.hz;  // [s]
  return sight.time > whole - 1e-6;
}

Verdict verdict_of(const Trial& trial, const Judge& judge, const Sight& end) {
  const double figure = judge.figure();
  bool finite = std::isfinite(figure) && std::isfinite(end.energy.total());
  for (const BodySight& body : end.bodies) {
    for (const double x : {body.centre.x, body.centre.y, body.centre.z}) finite = finite && std::isfinite(x);
  }
  return {finite && end.faults == 0 && figure <= trial.bar, figure};
}

}  // namespace isostep::scenes
