// Bars, and the judges of what only one scene is about.
// SPDX-License-Identifier: MIT
#include "bars.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "build.hpp"
#include "limits.hpp"
#include "named.hpp"
#include "terrain.hpp"
#include "trials/judges.hpp"

namespace isostep::scenes {
namespace {

constexpr double kAny = std::numeric_limits<double>::infinity();

constexpr Bar kBars[] = {
    {"S1", Measure::top, 0.12, 0.02},
    {"S1", Measure::drift, 0.01, 0.005},
    {"S1x10", Measure::top, 0.03, 0.01},
    {"S2", Measure::penetration, 0.004, 0.001},
    {"S2", Measure::unrest, 1e-8, 1e-9},
    {"S3", Measure::penetration, 0.004, 0.001},
    {"S3", Measure::unrest, 1e-8, 1e-9},
    {"S4", Measure::penetration, 0.04, 0.02},
    {"S4", Measure::penetration_mean, 0.0025, 0.0015},
    {"S4", Measure::unrest, kAny, 2e-5},
    {"S5", Measure::penetration, 0.03, 0.02},
    {"S5", Measure::penetration_mean, 0.0035, 0.0016},
    {"S6", Measure::joint_error, 0.15, 0.05},
    {"S6", Measure::energy_loss, kAny, 20},
    {"S6v", Measure::stretch, 0.7, 0.05},
    {"S7", Measure::joint_error, 0.12, 0.05},
    {"S7", Measure::joint_end, 0.005, 0.001},
    {"S8", Measure::asleep_at, 2, 1},
    {"S8", Measure::asleep_ms, 0.002, 0.001},
    {"S9", Measure::penetration, 0.03, 0.015},
    {"S10", Measure::penetration, 0.06, 0.03},
    {"S10", Measure::penetration_mean, 0.004, 0.002},
    {"S10", Measure::unrest, 1e-4, 1e-5},
    {"S11", Measure::penetration, 0.02, 0.004},
    {"S11", Measure::penetration_mean, 0.001, 0.0003},
    {"S12", Measure::penetration, 0.02, 0.004},
    {"S12", Measure::penetration_mean, 0.001, 0.0003},
    {"S13", Measure::through, 9, 1},
    {"S13m", Measure::through, 9, 1},
    {"S13d", Measure::through, 1, 1},
    {"S15", Measure::penetration, 0.015, 0.005},
    {"S15", Measure::unrest, 1e-3, 1e-3},
    {"S15h", Measure::penetration, 0.015, 0.005},
    {"S15h", Measure::unrest, 1e-3, 1e-3},
    {"S16", Measure::bump, 0.01, 0.002},
    {"S16h", Measure::bump, 0.01, 0.002},
    {"S20", Measure::joint_error, 0.05, 0.02},
    {"S20", Measure::joint_end, 0.005, 0.001},
    {"S20", Measure::limit_passed, 0.15, 0.05},
    {"S20", Measure::limit_end, 0.02, 0.005},
    {"S20", Measure::energy_gain, 0.001, 0.001},
    // After the peers' own benchmarks. Where one of them was measured, it must not be more accurate.
    {"large_pyramid", Measure::penetration, 0.02, 0.005},
    {"large_pyramid", Measure::penetration_mean, 0.0055, 0.0015},
    {"many_pyramids", Measure::penetration, 0.0017, 0.0005},
    {"many_pyramids", Measure::penetration_mean, 0.00061, 0.0002},
    {"jolt_pyramid", Measure::penetration, 0.02, 0.001},
    {"jolt_pyramid", Measure::penetration_mean, 0.0056, 0.0001},
    {"convex_pile", Measure::penetration, 0.363, 0.25},
    {"convex_pile", Measure::penetration_mean, 0.0062, 0.005},
    {"junkyard", Measure::penetration, 0.388, 0.1},
    {"junkyard", Measure::penetration_mean, 0.0041, 0.001},
    {"washer", Measure::penetration_mean, 0.003, 0.0015},
    {"crossers", Measure::penetration, 0.1, 0.05},
    {"convex_on_land", Measure::penetration, 0.059, 0.02},
    {"convex_on_land", Measure::penetration_mean, 0.008, 0.0003},
    {"joint_grid", Measure::joint_error, 0.01, 0.001},
    {"human_rain", Measure::joint_error, 0.097, 0.04},
    {"figures", Measure::joint_error, 0.3, 0.2},
    {"trees", Measure::penetration, 0.01, 0.003},
};
/// The bars of fixed point of 32 bits, which is for particles and small scenes alone.
constexpr Bar kSmallBars[] = {
    {"S1x10", Measure::top, 0.05, 0.025},
    {"S1x10", Measure::drift, 0.05, 0.025},
    {"S2", Measure::moved, 0.25, 0.125},
    {"S4s", Measure::penetration, 0.08, 0.04},
    {"S4s", Measure::penetration_mean, 0.008, 0.004},
};

bool starts_with(std::string_view name, std::string_view head) { return name.substr(0, head.size()) == head; }

bool is_on_hills(std::string_view scene) {
  return scene == "S11" || scene == "S12" || scene == "figures" || starts_with(scene, "S15");
}
/// Returns true if the scene's bodies hang, fall for ever, or cross land that is lower than zero too.
bool has_no_floor(std::string_view scene) {
  return starts_with(scene, "S6") || scene == "joint_grid" || scene == "max_bodies" || scene == "crossers";
}

/// Keeps the start and the last sight.
class OwnFigure : public Judge {
 public:
  explicit OwnFigure(const Scene& scene) : name_(scene.name), measure_(own_measure(scene.name)), limits_(scene) {
    if (scene.joints.empty()) return;
    const Vector& hook = scene.joints.front().anchor;
    hook_ = {value_of<double>(hook[0], ""), value_of<double>(hook[1], ""), value_of<double>(hook[2], "")};
  }
  void see(const Sight& sight) override {
    if (start_.empty()) start_ = sight.bodies;
    now_ = sight.bodies;
    joint_error_ = sight.joint_error;
    if (measure_ == Measure::bump && sight.time > 0.5) passed_ = worse(passed_, bump_of(now_));
    if (measure_ == Measure::limit_passed) passed_ = worse(passed_, limits_.passed(start_, now_));
  }
  double figure() const override {
    switch (measure_) {
      case Measure::top: return std::abs(now_.back().centre.y - start_.back().centre.y);
      case Measure::moved: return furthest();
      case Measure::stretch:
        return std::abs(length_of(now_.back().centre - hook_) - length_of(start_.back().centre - hook_));
      case Measure::joint_end: return joint_error_;
      case Measure::limit_passed:
      case Measure::bump: return passed_;
      case Measure::through: return count_through(name_, start_, now_).value_or(0);
      default: return count_outside(name_, now_);
    }
  }

 private:
  static double bump_of(const std::vector<BodySight>& bodies) {
    constexpr double kArm = 0.5;  // [m]
    double worst = 0;
    for (const BodySight& body : bodies) {
      if (!body.dynamic) continue;
      worst = worse(worst, worse(std::abs(body.velocity.y), kArm * length_of(body.angular_velocity)));
    }
    return worst;
  }
  double furthest() const {
    double most = 0;
    for (std::size_t i = 0; i < now_.size(); ++i) {
      const double way = length_of(now_[i].centre - start_[i].centre);
      if (now_[i].dynamic && !(way <= most)) most = way;  // what is no number stays
    }
    return most;
  }

  std::string name_;
  Measure measure_;
  Vec3<double> hook_ = {0, 0, 0};  // [m]
  std::vector<BodySight> start_, now_;
  double joint_error_ = 0;
  JointLimits limits_;
  double passed_ = 0;  // [rad], or [m/s] of bumps
};

}  // namespace

const char* name_of(Measure measure) {
  constexpr const char* kNames[] = {
      "height of the top", "drift",         "furthest way",  "stretch",          "bodies outside",  "worst overlap",
      "mean overlap",      "unrest",        "worst joint",   "joint at the end", "limits passed",   "limits at the end",
      "energy lost",       "energy gained", "time to sleep", "step asleep",      "bullets through", "bumps"};
  return kNames[static_cast<int>(measure)];
}

std::vector<Bar> bars_of(std::string_view scene, bool small) {
  std::vector<Bar> bars;
  const std::span<const Bar> all = small ? std::span<const Bar>(kSmallBars) : std::span<const Bar>(kBars);
  for (const Bar& bar : all) {
    if (scene == bar.scene) bars.push_back(bar);
  }
  return bars;
}

int count_outside(std::string_view scene, const std::vector<BodySight>& bodies) {
  int outside = 0;
  const bool pit =
      starts_with(scene, "S4") || starts_with(scene, "S10") || scene == "S5" || scene == "S7" || scene == "S20";
  const bool drum = scene == "S9", floor = !drum && !has_no_floor(scene);
  if (starts_with(scene, "S13")) return 0;  // where they come back to is free
  const bool hills = is_on_hills(scene);
  for (const BodySight& body : bodies) {
    if (!body.dynamic) continue;
    const Vec3<double> c = body.centre;
    bool in = !floor || c.y > 0;
    if (hills) in = std::abs(c.x) < 25 && std::abs(c.z) < 25 && c.y > hill_height(c.x, c.z) - 0.02;
    if (pit) in = in && std::abs(c.x) < 5 && std::abs(c.z) < 5;
    if (drum) in = std::hypot(c.x, c.y - 6) < 4.5 && std::abs(c.z) < 4;
    outside += in ? 0 : 1;
  }
  return outside;
}

std::optional<int> count_through(std::string_view scene, const std::vector<BodySight>& start,
                                 const std::vector<BodySight>& now) {
  constexpr double kFarFace = 0.01, kPlate = 1;  // [m] x, [kg]
  if (!starts_with(scene, "S13") || start.size() != now.size()) return std::nullopt;
  int through = 0;
  for (std::size_t i = 1; i < now.size(); ++i) {
    if (scene != "S13d") through += now[i].centre.x > kFarFace ? 1 : 0;
    else if (i % 2 == 1) {  // after its plate
      const double mass = bullet_mass(static_cast<int>(i / 2)), full = start[i].velocity.x * mass / (kPlate + mass);
      through += length_of(now[i - 1].velocity) < 0.1 * full ? 1 : 0;
    }
  }
  return through;
}

Measure own_measure(std::string_view scene) {
  if (starts_with(scene, "S13")) return Measure::through;
  if (starts_with(scene, "S16")) return Measure::bump;
  if (starts_with(scene, "S10") || is_on_hills(scene)) return Measure::outside;
  if (starts_with(scene, "S1")) return Measure::top;
  if (scene == "S2" || scene == "S3" || scene == "S8") return Measure::moved;
  if (starts_with(scene, "S6")) return Measure::stretch;
  if (scene == "S20") return Measure::limit_passed;
  return scene == "S7" ? Measure::joint_end : Measure::outside;
}

bool is_benchmark(std::string_view scene) {
  constexpr std::string_view kScenes[] = {"S1",   "S1x5", "S1x10", "S1s",  "S2",  "S3",   "S4",  "S4s", "S5",
                                          "S6",   "S6v",  "S7",    "S8",   "S9",  "S10",  "S11", "S12", "S13",
                                          "S13m", "S13d", "S15",   "S15h", "S16", "S16h", "S20"};
  return std::find(std::begin(kScenes), std::end(kScenes), scene) != std::end(kScenes);
}

std::unique_ptr<Judge> benchmark_judge(const Scene& scene) {
  if (!is_benchmark(scene.name)) return nullptr;
  return std::make_unique<OwnFigure>(scene);
}

}  // namespace isostep::scenes
