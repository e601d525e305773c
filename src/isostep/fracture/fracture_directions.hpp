// Directions of planes as integers: a frame about an axis, and the directions around it by angle.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/geometry/baked/grid_point.hpp"

namespace isostep::detail {

inline constexpr std::int32_t kSpokeLength = 1 << 16;  // of directions below, to their last digit
inline constexpr std::uint32_t kQuarterCircle = 1u << 30, kHalfCircle = 1u << 31;  // [2^-32 turns]

/// Three directions at right angles, of kSpokeLength; along x t is y, as right hands count.
struct Frame3 {
  GridVector axis, t, u;

  /// The direction across the axis at an angle [2^-32 turns] from t towards u.
  GridVector spoke(std::uint32_t turn) const;
  /// (a axis + b t + c u) / kSpokeLength, each component to nearest.
  GridVector combined(std::int64_t a, std::int64_t b, std::int64_t c) const;
};
/// The frame along any direction but zero, whose components are below 2^21.
Frame3 frame_along(GridVector direction);

}  // namespace isostep::detail
