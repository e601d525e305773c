// Bodies of many sizes, near and far: what coarse structures are told apart by.
// SPDX-License-Identifier: MIT
#include "book.hpp"
#include "scenes/shapes.hpp"

namespace isostep::scenes {

/// A cluster that falls on the floor, and bodies far out. Every structure gives the same pairs, so the same bits.
Scene coarse(BroadPhaseName structure) {
  Scene scene;
  scene.frames = 240;
  scene.broad_phase = structure;
  scene.bodies.push_back(fixed_box({0, -1, 0}, {120, 1, 120}));
  Draws draws(31);
  for (int n = 0; n < 160; ++n) {
    const double scale = n % 16 == 0 ? 4 : n % 4 == 0 ? 1 : 0.5;
    const bool far = n % 5 == 0;
    const double x = draws.between(-1, 1), z = draws.between(-1, 1), reach = far ? 100 : 5;
    scene.bodies.push_back(drawn_body(n, {reach * x, far ? 2.5 : 3 + 0.25 * n, reach * z}, draws, scale));
  }
  return scene;
}

}  // namespace isostep::scenes
