// S1, S2, S3: unit boxes that touch and should stand.
// SPDX-License-Identifier: MIT
#include "named.hpp"
#include "shapes.hpp"

namespace isostep::scenes {
namespace {

constexpr double kBoxPitch = 1.05;  // [m] no contact between neighbours
constexpr Point kUnitBox = {0.5, 0.5, 0.5};

Scene on_floor(int frames) {
  Scene scene;
  scene.allow_sleep = false;
  scene.frames = frames;
  add_floor(scene);
  return scene;
}

}  // namespace

Scene stack(int boxes) {
  Scene scene = on_floor(600);
  for (int i = 0; i < boxes; ++i) scene.bodies.push_back(body_of(box_part(kUnitBox), {0, 0.5 + i, 0}));
  return scene;
}

Scene wall() {
  Scene scene = on_floor(600);
  for (int row = 0; row < 20; ++row) {
    for (int i = 0; i < 20 - row; ++i) {
      const double x = (i - (19 - row) * 0.5) * kBoxPitch;
      scene.bodies.push_back(body_of(box_part(kUnitBox), {x, 0.5 + row, 0}));
    }
  }
  return scene;
}

Scene pyramid() {
  Scene scene = on_floor(300);
  for (int layer = 0; layer < 15; ++layer) {
    const int n = 15 - layer;
    for (int i = 0; i < n; ++i) {
      for (int k = 0; k < n; ++k) {
        const double x = (i - (n - 1) * 0.5) * kBoxPitch, z = (k - (n - 1) * 0.5) * kBoxPitch;
        scene.bodies.push_back(body_of(box_part(kUnitBox), {x, 0.5 + layer, z}));
      }
    }
  }
  return scene;
}

}  // namespace isostep::scenes
