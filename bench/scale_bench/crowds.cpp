// Makers of crowds.hpp.
// SPDX-License-Identifier: MIT
#include "crowds.hpp"

#include <algorithm>
#include <cmath>

#include "scenes/shapes.hpp"

namespace isostep::bench {
namespace {

using namespace scenes;

constexpr double kPitch = 1.05;   // [m] no contact between neighbours
constexpr double kSpacing = 1.4;  // [m] of the pile's lattice, as in S4
constexpr double kLayer = 1.1;    // [m] higher than any body but the longest
constexpr int kDeep = 21;         // layers: S4 has 1000 bodies in 49 columns
constexpr double kApart = 2;      // [m] between columns

void add_floor_of(Scene& scene, double half) { scene.bodies.push_back(fixed_box({0, -1, 0}, {half, 1, half})); }

void add_column(Scene& scene, int first_cell, int across, int boxes, bool sleeps) {
  const double x = (first_cell % across - across * 0.5) * kApart, z = (first_cell / across - across * 0.5) * kApart;
  for (int i = 0; i < boxes; ++i) {
    SceneBody box = body_of(box_part({0.5, 0.5, 0.5}), {x, 0.5 + i, z});
    box.allow_sleep = sleeps;
    scene.bodies.push_back(box);
  }
}

}  // namespace

Scene pyramid_of(int bodies) {
  const auto boxes = [](int n) { return n * (n + 1) * (2 * n + 1) / 6; };
  int base = 1;
  while (boxes(base) < bodies) ++base;
  if (bodies - boxes(base - 1) < boxes(base) - bodies) --base;
  Scene scene;
  scene.allow_sleep = false;
  add_floor_of(scene, std::max(50.0, base * kPitch));
  for (int layer = 0; layer < base; ++layer) {
    const int n = base - layer;
    for (int i = 0; i < n * n; ++i) {
      const double x = (i / n - (n - 1) * 0.5) * kPitch, z = (i % n - (n - 1) * 0.5) * kPitch;
      scene.bodies.push_back(body_of(box_part({0.5, 0.5, 0.5}), {x, 0.5 + layer, z}));
    }
  }
  return scene;
}

Scene pile_of(int bodies) {
  int across = std::max(2, static_cast<int>(std::lround(std::sqrt(bodies / static_cast<double>(kDeep)))));
  if (across % 3 == 0) ++across;  // else a column would be of one shape, and stand
  const double inner = across * kSpacing + 0.2;
  Scene scene;
  scene.allow_sleep = false;
  add_pit(scene, inner);
  scene.bodies.front() = fixed_box({0, -1, 0}, {inner, 1, inner});
  Draws draws(12345);
  for (int n = 0; n < bodies; ++n) {
    const int layer = n / (across * across), column = n % (across * across);
    const Point at = {(column % across - (across - 1) * 0.5) * kSpacing, 0.6 + kLayer * layer,
                      (column / across - (across - 1) * 0.5) * kSpacing};
    scene.bodies.push_back(drawn_body(n, at, draws, 1));
  }
  return scene;
}

Scene sleepers(int awake, int sleeping, int column) {
  constexpr int kAwakeColumn = 5;
  const int columns = awake / kAwakeColumn + sleeping / column;
  const int across = static_cast<int>(std::ceil(std::sqrt(columns)));
  Scene scene;
  add_floor_of(scene, across * kApart);
  for (int i = 0; i < awake / kAwakeColumn; ++i) add_column(scene, i, across, kAwakeColumn, false);
  for (int i = awake / kAwakeColumn; i < columns; ++i) add_column(scene, i, across, column, true);
  return scene;
}

Scene field(int boxes) {
  constexpr int kColumn = 2;
  const int columns = boxes / kColumn;
  const int across = static_cast<int>(std::ceil(std::sqrt(columns)));
  Scene scene;
  add_floor_of(scene, across * kApart);
  SceneBody player = body_of(sphere_part(0.75), {-0.5 * kApart * (across + 2), 0.75, 0});
  player.density = 20;  // 35 boxes
  player.allow_sleep = false;
  scene.bodies.push_back(player);
  for (int i = 0; i < columns; ++i) add_column(scene, i, across, kColumn, true);
  return scene;
}

}  // namespace isostep::bench
