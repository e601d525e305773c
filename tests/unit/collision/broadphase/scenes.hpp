// Five scenes of boxes for coarse structures, frame by frame.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/core/random.hpp"
#include "isostep/geometry/limits.hpp"
#include "isostep/math/aabb.hpp"
#include "unit/collision/broadphase_model.hpp"

namespace isostep::test {

enum class CoarseScene : std::uint32_t { spread, clustered, mixed, moving, come_and_go };
inline constexpr std::uint32_t kSceneSlots = 100;

template <class S> struct Body {
  bool present = false;
  Aabb<S> box{};
  Vec3<S> step{};  // [m] a frame
};

/// Sides of a quarter of a metre to 64 m, small ones more often than large ones.
template <class S> S random_side(Pcg32& random) {
  const std::uint32_t doublings = random_below(random, 9);
  const std::uint32_t fewer = random_below(random, 9);
  S side = S(0.25);
  for (std::uint32_t i = 0; i < doublings && i < fewer; ++i) side = side + side;
  return side;
}

template <class S> Aabb<S> drawn_box(Pcg32& random, CoarseScene scene, std::uint32_t slot) {
  if (scene == CoarseScene::clustered) {
    const std::uint32_t cluster = random_below(random, 5);
    Aabb<S> box = random_box<S>(random, 8);
    const S x = S(static_cast<int>(cluster) * 25 - 50), z = S(static_cast<int>(cluster * cluster) - 10);
    return {box.low + Vec3<S>{x, S(0), z}, box.high + Vec3<S>{x, S(0), z}};
  }
  if (scene == CoarseScene::mixed) {
    const S edge = Limits<S>::position() + Limits<S>::position();
    if (slot == 11) return {{-edge, -edge, -edge}, {edge, quarters<S>(random, -60, 0), edge}};
    const Vec3<S> low = random_point<S>(random, 120);
    const S x = random_side<S>(random);
    const S y = random_side<S>(random);
    const S z = random_side<S>(random);
    return {low, low + (slot % 9 == 4 ? Vec3<S>::zero() : Vec3<S>{x, y, z})};
  }
  return random_box<S>(random, scene == CoarseScene::spread ? 24 : 18);
}

/// Moves all boxes on by a frame. A part of those of `spread`, `clustered` and `mixed` is drawn anew; `moving` goes on,
/// and turns at walls; boxes of `come_and_go` do, and small steps in between.
template <class S> void advance(Pcg32& random, CoarseScene scene, int frame, std::vector<Body<S>>& bodies) {
  const S wall = S(4);
  for (std::uint32_t slot = 0; slot < bodies.size(); ++slot) {
    Body<S>& body = bodies[slot];
    const std::uint32_t what = random_below(random, 8);
    if (frame == 0 || (scene == CoarseScene::come_and_go && !body.present && what < 2)) {
      body.present = true;
      body.box = drawn_box<S>(random, scene, slot);
      body.step = random_point<S>(random, 1) * S(0.25);
      continue;
    }
    if (!body.present) continue;
    if (scene == CoarseScene::come_and_go && what == 0) body.present = false;
    if (scene != CoarseScene::moving && scene != CoarseScene::come_and_go) {
      if (what < 2) body.box = drawn_box<S>(random, scene, slot);
      continue;
    }
    for (int axis = 0; axis < 3; ++axis) {
      const bool beyond = body.step[axis] < S(0) ? body.box.low[axis] < -wall : wall < body.box.high[axis];
      if (beyond) body.step[axis] = -body.step[axis];
    }
    body.box = {body.box.low + body.step, body.box.high + body.step};
  }
}

}  // namespace isostep::test
