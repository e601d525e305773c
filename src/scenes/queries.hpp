// S14: what is asked of a thousand bodies over the hills, frame by frame.
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "shapes.hpp"

namespace isostep::scenes {

/// A line through S14, and for a cast the shape that goes along it upright.
struct DrawnLine {
  Point from;  // [m]
  Point way;   // [m]
};
struct DrawnQueries {
  std::vector<DrawnLine> rays;   // 10 000 of 40 m
  std::vector<DrawnLine> casts;  // 1000 of 20 m: even ones a sphere, odd ones a box
};
/// The queries of frames 0 to frames - 1.
std::vector<DrawnQueries> drawn_queries(int frames);

inline constexpr double kCastRadius = 0.3, kOverlapRadius = 1;  // [m]
inline constexpr Point kCastHalf = {0.2, 0.3, 0.2};             // [m]

}  // namespace isostep::scenes
