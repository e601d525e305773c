// The level of `yard`: 6 by 6 plots of 6 m on a slab, on each what a seed draws, all of hulls.
// SPDX-License-Identifier: MIT
#include "level.hpp"
#include "scenes/hull_recipes.hpp"

namespace isostep::scenes {
namespace {

using Kind = LevelSpot::Kind;

constexpr int kPlots = 6;
constexpr double kPlot = 6;  // [m]

double drawn(Draws& draws, double low, double high) { return on_lattice(draws.between(low, high)); }

/// A plot's hulls are parts of one body about its middle; everything is turned by quarters.
class Plot {
 public:
  Plot(std::vector<LevelSpot>& spots, std::string name, Point at, int quarters)
      : spots_(spots), name_(std::move(name)), at_(at), quarters_(quarters) {}

  /// The parts of its body.
  std::vector<ScenePart> parts;

  void add(std::vector<Point> points) {
    for (Point& p : points) p = on_lattice(turned(p));
    parts.push_back(hull_part(points));
  }
  /// Adds a box between two corners.
  void add_box(Point low, Point high) {
    std::vector<Point> points;
    for (const double x : {low.x, high.x}) {
      for (const double y : {low.y, high.y}) {
        for (const double z : {low.z, high.z}) points.push_back({x, y, z});
      }
    }
    add(points);
  }
  void add_rings(const std::vector<std::pair<double, double>>& radius_and_height, int corners, Point foot) {
    std::vector<Point> points;
    for (const auto& [radius, height] : radius_and_height) {
      for (int i = 0; i < corners; ++i) {
        const SinCos<double> angle = sin_cos(kTurn * i / corners);
        points.push_back({foot.x + radius * angle.cos, height, foot.z + radius * angle.sin});
      }
    }
    add(points);
  }
  void tell(const std::string& what, Kind kind, Point at, Point outward) {
    const Point p = turned(at);
    spots_.push_back({name_ + ", " + what, kind, {at_.x + p.x, at_.y + p.y, at_.z + p.z}, turned(outward)});
  }
  void tell_top(const std::string& what, Point at) { tell(what, Kind::top, at, {0, 1, 0}); }

 private:
  Point turned(Point p) const {
    for (int i = 0; i < quarters_; ++i) p = {p.z, p.y, -p.x};
    return p;
  }

  std::vector<LevelSpot>& spots_;
  std::string name_;
  Point at_;
  int quarters_;
};

void add_wall(Plot& plot, Draws& draws) {
  const double half = drawn(draws, 1, 2.5), height = drawn(draws, 1.25, 3), thick = drawn(draws, 0.125, 0.5);
  plot.add_box({-half, 0, -thick}, {half, height, thick});
  plot.tell("front", Kind::wall, {0.25, 0.75, thick}, {0, 0, 1});
  plot.tell("back", Kind::wall, {-0.25, 0.75, -thick}, {0, 0, -1});
  plot.tell_top("top", {0.25, height, 0});
}
void add_gate(Plot& plot, Draws& draws) {
  const double height = drawn(draws, 2.25, 2.75), half = drawn(draws, 0.625, 1), thick = drawn(draws, 0.25, 0.5);
  for (const double side : {-1.0, 1.0}) {
    const double near = side * half, far = side * (half + 0.75);
    plot.add_box({near < far ? near : far, 0, -thick}, {near < far ? far : near, height, thick});
    plot.tell(side < 0 ? "left post" : "right post", Kind::wall, {near + 0.375 * side, 1, thick}, {0, 0, 1});
  }
  plot.add_box({-half - 0.875, height, -thick}, {half + 0.875, height + 0.5, thick});
  plot.tell("opening", Kind::doorway, {0, 0, 0}, {0, 0, 1});
  plot.tell_top("lintel", {0.25, height + 0.5, 0});
  plot.tell("lintel's front", Kind::wall, {0.25, height + 0.25, thick}, {0, 0, 1});
}
void add_stairs(Plot& plot, Draws& draws) {
  const int steps = 5 + static_cast<int>(4 * draws.unit());
  const double rise = drawn(draws, 0.125, 0.3125), run = drawn(draws, 0.3125, 0.5), half = drawn(draws, 0.75, 2);
  for (int i = 0; i < steps; ++i) {
    const double low = run * (i - steps / 2);
    plot.add_box({low, 0, -half}, {low + run, rise * (i + 1), half});
    plot.tell_top("step " + std::to_string(i), {low + run / 2, rise * (i + 1), 0.25});
  }
}
void add_ramp(Plot& plot, Draws& draws) {
  const double length = drawn(draws, 3, 5), height = drawn(draws, 0.5, 2.5), half = drawn(draws, 0.75, 2);
  const double low = -length / 2, high = length / 2;
  std::vector<Point> points;
  for (const double z : {-half, half}) {
    for (const Point p : {Point{low, 0, z}, Point{high, 0, z}, Point{high, height, z}}) points.push_back(p);
  }
  plot.add(points);
  for (const double share : {0.25, 0.75}) {
    plot.tell(share < 0.5 ? "slope, low" : "slope, high", Kind::top, {low + share * length, share * height, 0.25},
              unit_of({-height / length, 1, 0}));
  }
  plot.tell("back", Kind::wall, {high, height / 2, 0.25}, {1, 0, 0});
}
void add_columns(Plot& plot, Draws& draws) {
  for (const double x : {-1.5, 1.5}) {
    for (const double z : {-1.5, 1.5}) {
      const double radius = drawn(draws, 0.25, 0.625), height = drawn(draws, 1, 4);
      plot.add_rings({{radius, 0}, {radius, height}}, 12, {x, 0, z});
      plot.tell_top(
          "column at " + std::to_string(static_cast<int>(2 * x)) + " " + std::to_string(static_cast<int>(2 * z)),
          {x, height, z});
    }
  }
}
/// Round stones with a flat top.
void add_boulders(Plot& plot, Draws& draws) {
  for (int n = 0; n < 3; ++n) {
    const double radius = drawn(draws, 0.5, 1.125), height = drawn(draws, 0.5, 1.5);
    const Point foot = {1.75 * (n - 1), 0, drawn(draws, -1.5, 1.5)};
    plot.add_rings({{0.75 * radius, -0.25}, {radius, 0.5 * height}, {0.5 * radius, height}}, 7 + n, foot);
    plot.tell_top("boulder " + std::to_string(n), {foot.x, height, foot.z});
  }
}
void add_mound(Plot& plot, Draws& draws) {
  const double foot = drawn(draws, 2, 2.75), top = drawn(draws, 0.5, 1.25), height = drawn(draws, 0.5, 2);
  std::vector<Point> points;
  for (const double x : {-1.0, 1.0}) {
    for (const double z : {-1.0, 1.0}) {
      points.push_back({foot * x, 0, foot * z});
      points.push_back({top * x, height, top * z});
    }
  }
  plot.add(points);
  plot.tell_top("top", {0.125, height, 0.125});
  const double middle = (foot + top) / 2;
  plot.tell("east side", Kind::top, {middle, height / 2, 0.25}, unit_of({height, foot - top, 0}));
  plot.tell("south side", Kind::top, {0.25, height / 2, middle}, unit_of({0, foot - top, height}));
}

struct Sort {
  const char* name;
  void (*add)(Plot& plot, Draws& draws);
};
constexpr Sort kSorts[] = {{"wall", add_wall},  {"gate", add_gate},       {"stairs", add_stairs},
                           {"ramp", add_ramp},  {"columns", add_columns}, {"boulders", add_boulders},
                           {"mound", add_mound}};
constexpr int kSortCount = sizeof kSorts / sizeof kSorts[0];

void add_slab(Level& level) {
  Plot plot(level.spots, "slab", {0, 0, 0}, 0);
  plot.add_box({-20, -1, -20}, {20, 0, 20});
  plot.tell_top("corner", {-19, 0, -19});
  plot.tell_top("edge", {19.5, 0, 0.5});
  for (const double side : {-1.0, 1.0}) {  // what keeps bodies on it
    const double near = side * 19.75, far = side * 20.25;
    const double low = near < far ? near : far, high = near < far ? far : near;
    plot.add_box({low, -0.5, -20.25}, {high, 1.25, 20.25});
    plot.add_box({-20.25, -0.5, low}, {20.25, 1.25, high});
  }
  plot.tell("border to the east", Kind::wall, {19.75, 0.75, 1}, {-1, 0, 0});
  plot.tell("border to the north", Kind::wall, {1, 0.75, -19.75}, {0, 0, 1});
  SceneBody body;
  body.type = BodyType::static_;
  body.parts = plot.parts;
  level.scene.bodies.push_back(body);
}

}  // namespace

Level yard_level() {
  Level level;
  add_slab(level);
  Draws draws(90125);
  for (int n = 0; n < kPlots * kPlots; ++n) {
    const Point at = {kPlot * (n % kPlots - 2.5), 0, kPlot * (n / kPlots - 2.5)};
    const int quarters = static_cast<int>(4 * draws.unit());
    const Sort& sort = n < kSortCount ? kSorts[n] : kSorts[static_cast<int>(kSortCount * draws.unit())];
    Plot plot(level.spots, std::string(sort.name) + " " + std::to_string(n), at, quarters);
    sort.add(plot, draws);
    SceneBody body;
    body.type = BodyType::static_;
    body.parts = plot.parts;
    body.position = vector_of(at);
    level.scene.bodies.push_back(body);
  }
  return level;
}

}  // namespace isostep::scenes
