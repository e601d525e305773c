// Fronts and advice.
// SPDX-License-Identifier: MIT
#include "advice.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace isostep::tool::lab {
namespace {

using Place = std::optional<std::size_t>;

std::string ms_text(double ms) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g ms", ms);
  return text;
}

/// The least by `before` of those that `counts`.
template <class Counts, class Before>
Place least(const std::vector<LabResult>& results, const Counts& counts, const Before& before) {
  Place best;
  for (std::size_t i = 0; i < results.size(); ++i) {
    if (counts(results[i]) && (!best || before(results[i], results[*best]))) best = i;
  }
  return best;
}

/// The deviation of another model than bodies of that shape. Empty for bodies.
std::string model_text(const LabResult& result) {
  if (result.point.model == "rigid" || result.deviation < 0) return "";
  return ", " + quantity_text(Quantity::deviation, result.deviation) + " from the bodies after 1 s";
}

/// "the default (float, soft_step, 8 sub-steps at 60 Hz) takes 0.18 ms and misses joint = 1 mm by 3 mm".
std::string default_text(const LabResult& own, const Tolerance& tolerance) {
  const std::string name = "the default (" + setting_text(own.point) + ")";
  if (own.state != kDone) return name + " is " + (own.state == kRefused ? "refused" : "left out") + ": " + own.reason;
  const std::string miss = miss_of(own, tolerance);
  return name + " takes " + ms_text(own.ms) + (miss.empty() ? " and holds it too" : " and misses " + miss);
}

}  // namespace

std::string setting_text(const LabPoint& point) {
  const bool passes = counts_passes(point);
  std::string text = point.scalar + ", " + point.solver + ", " + std::to_string(point.substeps) +
                     (passes ? " pass" : " sub-step") +
                     (point.substeps == 1 ? ""
                      : passes            ? "es"
                                          : "s") +
                     " at " + std::to_string(point.hz) + " Hz";
  if (point.model != "rigid") text += ", as " + point.model;
  return text;
}

std::vector<std::size_t> front_of(const std::vector<LabResult>& results, const Tolerance& tolerance) {
  std::vector<std::size_t> order;
  std::vector<double> excess;
  for (std::size_t i = 0; i < results.size(); ++i) {
    excess.push_back(excess_of(results[i], tolerance));
    if (std::isfinite(excess[i])) order.push_back(i);
  }
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return results[a].ms != results[b].ms ? results[a].ms < results[b].ms : excess[a] < excess[b];
  });
  std::vector<std::size_t> front;
  double least_wrong = std::numeric_limits<double>::infinity();
  for (const std::size_t i : order) {
    if (!(excess[i] < least_wrong)) continue;
    least_wrong = excess[i];
    front.push_back(i);
  }
  return front;
}

Advice advise(const std::vector<LabResult>& results, const Tolerance& tolerance, const LabPoint& own,
              const std::string& scalar) {
  const auto asked = [&](const LabResult& r) { return scalar.empty() || r.point.scalar == scalar; };
  const auto closer = [&](const LabResult& a, const LabResult& b) {
    return excess_of(a, tolerance) < excess_of(b, tolerance);
  };
  const auto cheaper = [&](const LabResult& a, const LabResult& b) {
    return a.ms < b.ms || (a.ms == b.ms && closer(a, b));
  };
  Advice advice;
  advice.best = least(
      results, [&](const LabResult& r) { return asked(r) && excess_of(r, tolerance) <= 1; }, cheaper);
  advice.holds = advice.best.has_value();
  if (!advice.holds)
    advice.best = least(
        results, [&](const LabResult& r) { return asked(r) && std::isfinite(excess_of(r, tolerance)); }, closer);
  if (!advice.best) {
    advice.text = "no run holds " + tolerance.text + ", and none comes near it";
    const auto first = std::find_if(results.begin(), results.end(), asked);
    const auto ran = [&](const LabResult& r) { return asked(r) && r.state == kDone; };
    if (first != results.end() && std::none_of(first, results.end(), ran))
      advice.text = "none, for nothing was run: " + first->reason;
    return advice;
  }
  const LabResult& best = results[*advice.best];
  LabPoint default_point = own;
  default_point.scalar = best.point.scalar;
  advice.own = least(
      results, [&](const LabResult& r) { return r.point == default_point; }, cheaper);
  if (advice.holds) advice.text = setting_text(best.point) + ": " + ms_text(best.ms) + model_text(best);
  else
    advice.text = "no run holds " + tolerance.text + ". Closest is " + setting_text(best.point) + ": " +
                  ms_text(best.ms) + model_text(best) + ", misses " + miss_of(best, tolerance);
  if (advice.own == advice.best) advice.text += "; that is the default";
  else if (advice.own) advice.text += "; " + default_text(results[*advice.own], tolerance);
  return advice;
}

}  // namespace isostep::tool::lab
