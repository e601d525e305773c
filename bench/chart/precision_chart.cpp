// isostep_precision_chart: cost and error of each scalar at each sub-step count, in scenes without chaos, as TSV.
// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>

#include "../scene_bench/clock.hpp"
#include "scenes/build.hpp"
#include "scenes/named.hpp"
#include "scenes/shapes.hpp"

namespace isostep::bench {
namespace {

using Path = std::vector<Vec3<double>>;  // [m] centre of one body, frame by frame

constexpr int kReferenceSubsteps = 64;
constexpr int kSubsteps[] = {2, 4, 8, 16};
constexpr int kFramesTimed = 10;  // at once: a small scene's step is too short for the clock
constexpr double kFloor = 1e-10;  // [m] what a logarithmic axis shows for no error at all

double length(Vec3<double> v) { return std::sqrt(dot(v, v)); }

/// How far a run is from what it should be.
enum class Error { path, end, height };

struct Probe {
  const char* name;
  scenes::Scene scene;
  Error error;
};

/// A rod of 2 m on a ball joint, let go at the horizontal: 4 s, some 2.5 swings.
scenes::Scene pendulum() {
  scenes::Scene scene;
  scene.allow_sleep = false;
  scene.frames = 240;
  scenes::SceneBody rod = scenes::body_of(scenes::box_part({1, 0.05, 0.05}), {1, 3, 0});
  rod.mass = 1;
  scene.bodies.push_back(rod);
  scenes::SceneJoint joint;
  joint.b = 0;
  joint.anchor = {0, 3, 0};
  scene.joints.push_back(joint);
  return scene;
}

/// A disc's worth of box, 0.4 m above its tip, tilted by 30 degrees about x and spun at 30 rad/s: it precesses for 4 s.
scenes::Scene top() {
  scenes::Scene scene;
  scene.allow_sleep = false;
  scene.frames = 240;
  const double tilt = scenes::kTurn / 12, spin = 30;
  const SinCos<double> whole = sin_cos(tilt), half = sin_cos(tilt / 2);
  const scenes::Point axis = {0, whole.cos, whole.sin};
  scenes::SceneBody disc = scenes::body_of(scenes::box_part({0.4, 0.08, 0.4}), {0, 2 + 0.4 * axis.y, 0.4 * axis.z});
  disc.orientation = {half.sin, 0, 0, half.cos};
  disc.angular_velocity = {0, spin * axis.y, spin * axis.z};
  disc.mass = 1;
  scene.bodies.push_back(disc);
  scenes::SceneJoint joint;
  joint.b = 0;
  joint.anchor = {0, 2, 0};
  scene.joints.push_back(joint);
  return scene;
}

/// A box pushed down a slope of 20 degrees at 3 m/s: friction 0.5 stops it after 3.5 m.
scenes::Scene slope() {
  scenes::Scene scene;
  scene.allow_sleep = false;
  scene.frames = 240;
  const double angle = -scenes::kTurn / 18;
  const SinCos<double> whole = sin_cos(angle), half = sin_cos(angle / 2);
  const auto along = [&](double x, double y) {
    return scenes::Point{x * whole.cos - y * whole.sin, x * whole.sin + y * whole.cos, 0};
  };
  scenes::SceneBody ramp = scenes::fixed_box(along(0, -1), {20, 1, 5});
  ramp.orientation = {0, 0, half.sin, half.cos};
  scenes::SceneBody box = scenes::body_of(scenes::box_part({0.5, 0.25, 0.5}), along(0, 0.25));
  box.orientation = ramp.orientation;
  box.velocity = {3 * whole.cos, 3 * whole.sin, 0};
  scene.bodies = {ramp, box};
  return scene;
}

/// Cost, and the last body's path.
struct Run {
  Path path;
  double us = 0;  // [us] a step
};

template <class S> Run run(const scenes::Scene& scene, int substeps) {
  World<S> world(scenes::settings_of<S>(scene, 60, substeps));
  const BodyId body = scenes::build(scene, world).bodies.back();
  Run result;
  std::vector<double> times;
  for (int frame = 0; frame < scene.frames; frame += kFramesTimed) {
    Vec3<S> centres[kFramesTimed];
    const double start = thread_milliseconds();
    for (Vec3<S>& centre : centres) {
      world.step();
      centre = world.centre(body);
    }
    times.push_back(1e3 * (thread_milliseconds() - start) / kFramesTimed);
    for (const Vec3<S>& c : centres) result.path.push_back({to_double(c.x), to_double(c.y), to_double(c.z)});
  }
  result.us = median(std::vector<double>(times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2), times.end()));
  return result;
}

double error_of(const Path& path, const Path& reference, const Probe& probe) {
  if (probe.error == Error::height) {
    const double ideal = scenes::value_of<double>(probe.scene.bodies.back().position[1], probe.name);
    return std::abs(path.back().y - ideal);
  }
  if (probe.error == Error::end) return length(path.back() - reference.back());
  double squares = 0;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const Vec3<double> off = path[i] - reference[i];
    squares += dot(off, off);
  }
  return std::sqrt(squares / static_cast<double>(path.size()));
}

struct Point {
  const char* scalar;
  int substeps;
  std::vector<double> us;  // one a round
  Path path;
};

template <class S> void visit_scalar(const Probe& probe, std::vector<Point>& points) {
  for (const int substeps : kSubsteps) {
    Run made = run<S>(probe.scene, substeps);
    const char* name = ScalarTraits<S>::kName;
    Point* point = nullptr;
    for (Point& known : points) {
      if (std::string_view(known.scalar) == name && known.substeps == substeps) point = &known;
    }
    if (point == nullptr) point = &points.emplace_back(Point{name, substeps, {}, {}});
    point->us.push_back(made.us);
    point->path = std::move(made.path);
  }
}

const Point& find(const std::vector<Point>& points, std::string_view scalar, int substeps) {
  for (const Point& point : points) {
    if (point.scalar == scalar && point.substeps == substeps) return point;
  }
  return points.front();
}

/// What the scalar alone does: against double with as many sub-steps.
double rounding_of(const Point& point, const Path& in_double, const Probe& probe) {
  if (probe.error == Error::height) return std::abs(point.path.back().y - in_double.back().y);
  return error_of(point.path, in_double, probe);
}

/// Costs also against float at 4 sub-steps, which is steadier than time.
void write(const Probe& probe, const Path& reference, const std::vector<Point>& points, std::FILE* file) {
  const double unit = median(find(points, "float", 4).us);
  for (const Point& point : points) {
    const double us = median(point.us);
    const double error = std::max(error_of(point.path, reference, probe), kFloor);
    const double rounding = std::max(rounding_of(point, find(points, "double", point.substeps).path, probe), kFloor);
    std::fprintf(file, "%s\t%s\t%d\t%.4g\t%.4g\t%.4g\t%.4g\n", probe.name, point.scalar, point.substeps, us, us / unit,
                 1e3 * error, 1e3 * rounding);
  }
}

void chart(int rounds, std::FILE* file) {
  const Probe probes[] = {{"pendulum", pendulum(), Error::path},
                          {"top", top(), Error::path},
                          {"slope", slope(), Error::end},
                          {"stack", scenes::stack(20), Error::height}};
  std::fputs("scene\tscalar\tsubsteps\tus_per_step\tratio_to_float_4\terror_mm\trounding_mm\n", file);
  for (const Probe& probe : probes) {
    std::fprintf(stderr, "%s\n", probe.name);
    const Path reference = run<double>(probe.scene, kReferenceSubsteps).path;
    std::vector<Point> points;
    for (int round = 0; round < rounds; ++round) {
#define ISO_VISIT(S) visit_scalar<S>(probe, points);
      ISO_FOR_EACH_SCALAR(ISO_VISIT)
#undef ISO_VISIT
    }
    write(probe, reference, points, file);
  }
}

}  // namespace
}  // namespace isostep::bench

int main(int count, char** words) {
  int rounds = 5;
  std::string out;
  CLI::App app("Cost and error of each scalar at 2, 4, 8 and 16 sub-steps");
  app.add_option("--rounds", rounds, "Runs of each; times are medians over them")->check(CLI::Range(1, 99));
  app.add_option("--out", out, "TSV file; none: stdout");
  CLI11_PARSE(app, count, words);
  std::FILE* file = out.empty() ? stdout : std::fopen(out.c_str(), "wb");
  if (file == nullptr) {
    std::fprintf(stderr, "cannot write %s\n", out.c_str());
    return 74;
  }
  try {
    isostep::bench::chart(rounds, file);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 70;
  }
  return std::fclose(file) == 0 ? 0 : 74;
}
