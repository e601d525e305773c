// Levels: static geometry made by formula or by draws, and the places of it that tests visit.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "scenes/shapes.hpp"

namespace isostep::scenes {

/// A part of a level, told by the builder that put it there.
struct LevelSpot {
  enum class Kind {
    top,     // what lies on it is carried, or slides down; nothing is less than 1 m above it
    wall,    // upright; nothing is less than 1 m in front of it
    doorway  // free along `outward` for 1.5 m to both sides, 1 m wide and 2 m high
  };
  std::string name;
  Kind kind;
  Point at;           // [m] on the surface; of a doorway the middle of its foot
  Point outward;      // [1] of the surface; of a doorway the way through
  int material = -1;  // of its triangles; -1: it has none
};

struct Level {
  Scene scene;  // what does not move
  std::vector<LevelSpot> spots;
};

/// [m] The coordinates of vertices: multiples of 1/1024, so that every scalar has one geometry.
double on_lattice(double metres);
Point on_lattice(Point p);
Point unit_of(Point v);

/// A town on one mesh: streets, houses, stairs, ramps, a bridge over a dell, a tower and a hill.
Level town_level();
/// Materials of its triangles.
enum TownMaterial : int { kGrass, kStreet, kWall, kRoof, kStairs, kRamp, kTower, kBridge };
/// [m] The height of its ground.
double town_ground(double x, double z);

/// A yard of hulls: a seeded choice of walls, gates, stairs, ramps, columns, boulders and mounds.
Level yard_level();

}  // namespace isostep::scenes
