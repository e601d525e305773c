// Views: what a world shows of itself by value, a body, a pose for drawing, counts.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "isostep/core/id.hpp"
#include "isostep/dynamics/body.hpp"
#include "isostep/geometry/shape.hpp"

namespace isostep {

/// A body as the world keeps it, for effects that meet shapes themselves. Valid until the next command, step or load.
template <class S> struct BodyView {
  const BodyState<S>* state = nullptr;  // null: a stale id
  const BodyProperties<S>* properties = nullptr;
  std::span<const Child<S>> children;  // in the body's frame
  Contents<S> contents;                // of the blobs that they name
  Pose<S> pose = Pose<S>::identity();  // of the body's origin
};
/// A pose for drawing, in float for every scalar: interpolated, never state.
struct RenderPose {
  BodyId body;
  float position[3];     // [m] of the body's origin
  float orientation[4];  // x y z w
};

/// Counts of the present state, for reports.
struct WorldCounts {
  std::uint32_t bodies, static_bodies, awake, asleep, contacts, points, joints, shapes;
};

}  // namespace isostep
