// The pieces that a town is built of: each closed, its foot in the ground, with the places that tests visit.
// SPDX-License-Identifier: MIT
#pragma once

#include "mesh_builder.hpp"

namespace isostep::scenes {

/// Pieces overlap where they meet and share no edge. Places are the middle of a piece's foot unless told otherwise.
class TownPieces {
 public:
  TownPieces(MeshBuilder& mesh, std::vector<LevelSpot>& spots) : mesh_(mesh), spots_(spots) {}

  /// A wall around a square.
  void add_border(double half);
  /// 8 m by 6 m with doors to north and south, windows all around and a gable roof.
  void add_house(Point at);
  /// 10 m by 8 m and 5 m high, with a parapet around a flat roof and outer stairs up to it from the north.
  void add_tall_house(Point at);
  /// Stairs from the corner `at` eastward: 14 steps, a terrace, a ramp down.
  void add_grand_stairs(Point at);
  /// Round, open above, with a doorway to the south and 20 steps about a column.
  void add_tower(Point at);
  /// An arch of 24 m from west to east, with rails, on two pillars.
  void add_bridge(Point at);
  /// Ramps from the corner `at` eastward, in a row to the south: two straight, and a round one.
  void add_ramps(Point at);
  /// A round basin.
  void add_fountain(Point at);
  /// Posts along the streets.
  void add_posts();

 private:
  void add_roof(Point at);
  void add_ramp(const std::string& name, Point at, double length, double width, double height);
  void tell(std::string name, LevelSpot::Kind kind, Point at, Point outward, int material);
  void tell_top(std::string name, Point at, int material) { tell(name, LevelSpot::Kind::top, at, {0, 1, 0}, material); }
  void tell_wall(std::string name, Point at, Point outward, int material) {
    tell(name, LevelSpot::Kind::wall, at, outward, material);
  }

  MeshBuilder& mesh_;
  std::vector<LevelSpot>& spots_;
};

}  // namespace isostep::scenes
