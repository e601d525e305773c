// FracturePattern: how a convex solid breaks: a closed list of patterns, each with the numbers that it needs.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <variant>

#include "isostep/geometry/baked/grid_point.hpp"

namespace isostep {

/// The place and direction of the blow, in the frame of the solid's grid.
struct FractureImpact {
  GridPoint point = {0, 0, 0};       // [steps] may lie outside of the solid
  GridVector direction = {0, 0, 0};  // [1] of the blow, of any length; 0: none, where the pattern needs none
};

/// Three planes along the grid's axes through the point of impact: eight boxes of a box.
/// Source:  Millington, Game Physics Engine Development, 2nd ed., demo "fracture": where the blow has a direction, the
///          point is moved along it to the middle of the solid, so a blow on a face cuts no flat pieces.
struct EightBoxes {};

/// Wood: planes that hold the grain, all parallel, at seeded distances; each board is cut across the grain at seeded
/// places and angles of up to 1 in 8, halfway between even places and the point of impact.
struct GrainPlanes {
  GridVector grain = {0, 1, 0};  // [1] of any length but 0
  std::uint32_t along = 3;       // [1] planes that hold the grain, 0 to kMost
  std::uint32_t across = 1;      // [1] cuts of each board, 0 to kMost

  static constexpr std::uint32_t kMost = 64;
};

/// Glass: sectors about the line along the blow through the point of impact, at seeded angles, and chords across them
/// at distances that grow like squares.
struct RadialCracks {
  std::uint32_t sectors = 8;  // [1] 2 to kMost
  std::uint32_t rings = 2;    // [1] chords of each sector, 0 to kMost

  static constexpr std::uint32_t kMost = 64;
};

/// Stone: the cells of seeded points in the solid, each cell what is nearer to its point than to any other.
struct VoronoiCells {
  std::uint32_t cells = 16;     // [1] 1 to FractureLimits::kMostPieces
  std::uint32_t gathering = 0;  // [1/256] 0 to 256: each point moves towards the impact by a seeded share up to this
};

using FracturePattern = std::variant<EightBoxes, GrainPlanes, RadialCracks, VoronoiCells>;

struct FractureLimits {
  static constexpr std::uint32_t kMostPieces = 256;

  std::uint32_t most_pieces = 64;  // [1] 1 to kMostPieces; patterns that may make more are refused
  /// [steps] A piece is at least as wide, along each axis of the grid and from each of its faces. 0: 1/32 m, the least
  /// that all scalars take, or 7/8 of the solid's own least width where that is less.
  std::int64_t least_width = 0;
};

}  // namespace isostep
