// The scene of queries, and the queries of each frame.
// SPDX-License-Identifier: MIT
#include "queries.hpp"

#include <cmath>

#include "named.hpp"
#include "terrain.hpp"

namespace isostep::scenes {
namespace {

DrawnLine drawn_line(Draws& draws, double length) {
  const double x = draws.between(-20, 20), z = draws.between(-20, 20);
  const double y = hill_corner(x, z) + 1 + 8 * draws.unit();
  const double angle = draws.between(0, kTurn), e = draws.between(-1, 0.2);
  const SinCos<double> heading = sin_cos(angle);
  const double scale = length / std::sqrt(1 + e * e);
  return {{x, y, z}, {heading.cos * scale, e * scale, heading.sin * scale}};
}

}  // namespace

std::vector<DrawnQueries> drawn_queries(int frames) {
  Draws draws(9);
  std::vector<DrawnQueries> all(static_cast<std::size_t>(frames));
  for (DrawnQueries& queries : all) {
    for (int i = 0; i < 10000; ++i) queries.rays.push_back(drawn_line(draws, 40));
    for (int i = 0; i < 1000; ++i) queries.casts.push_back(drawn_line(draws, 20));
  }
  return all;
}

Scene scattered() {
  Scene scene = hills();
  scene.frames = 10;
  scene.gravity = {0, 0, 0};
  Draws draws(1414);
  for (int n = 0; n < 1000; ++n) {
    const double x = (n % 32 - 15.5) * 1.5, z = (n / 32 - 15.5) * 1.5;
    scene.bodies.push_back(drawn_body(n, {x, hill_corner(x, z) + 1.2, z}, draws, 1));
  }
  return scene;
}

}  // namespace isostep::scenes
