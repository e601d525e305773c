// The level of `town`: 60 m by 60 m, x to the east and z to the south, grass at 0 but for a hill and a dell.
// SPDX-License-Identifier: MIT
#include <cmath>

#include "town_pieces.hpp"

namespace isostep::scenes {
namespace {

constexpr double kHalf = 30, kPitch = 0.9375;  // [m] of the ground
constexpr int kCells = 64;
constexpr double kStreetHalf = 3;  // [m]

/// A round rise that is level at its top and rim.
double rise(double x, double z, double height, double radius) {
  const double share = 1 - (x * x + z * z) / (radius * radius);
  return share > 0 ? height * share * share : 0;
}
double place(int i) { return kPitch * i - kHalf; }
double corner_height(int i, int k) {
  const double x = place(i), z = place(k);
  return on_lattice(rise(x - 17, z + 17, 5, 11.5) - rise(x + 16, z - 16, 3, 10));
}
Point corner(int i, int k) { return {place(i), corner_height(i, k), place(k)}; }
bool is_street(int i, int k) {
  const auto within = [](int c) { return std::abs(place(c) + kPitch / 2) < kStreetHalf; };
  return within(i) || within(k);
}

void add_ground(MeshBuilder& mesh) {
  for (int k = 0; k < kCells; ++k) {
    for (int i = 0; i < kCells; ++i) {
      mesh.use(is_street(i, k) ? kStreet : kGrass);
      mesh.quad(corner(i, k + 1), corner(i + 1, k + 1), corner(i + 1, k), corner(i, k));
    }
  }
}
/// The plane of a ground's triangle.
struct Slope {
  double height;      // [m]
  double by_x, by_z;  // [1]
};
/// Cells are cut from their corner of low x and high z to the opposite one: see MeshBuilder::quad.
Slope slope_at(double x, double z) {
  const double u = (x + kHalf) / kPitch, v = (z + kHalf) / kPitch;
  const int i = static_cast<int>(std::floor(u)), k = static_cast<int>(std::floor(v));
  const double s = u - i, t = v - k, east = corner_height(i + 1, k), south = corner_height(i, k + 1);
  if (s + t <= 1) {
    const double here = corner_height(i, k);
    return {here + s * (east - here) + t * (south - here), (east - here) / kPitch, (south - here) / kPitch};
  }
  const double far = corner_height(i + 1, k + 1);
  return {far + (1 - s) * (south - far) + (1 - t) * (east - far), (far - south) / kPitch, (far - east) / kPitch};
}

/// Tells spots of the ground, each in the middle of a triangle.
void tell_ground(std::vector<LevelSpot>& spots) {
  struct Place {
    const char* name;
    double x, z;
    int material;
  };
  constexpr Place kPlaces[] = {{"street to the west", -20, 0.5, kStreet},
                               {"street to the south", 0.5, 14, kStreet},
                               {"grass", 27.5, 4, kGrass},
                               {"hilltop", 17, -17, kGrass},
                               {"hill to the west", 12.5, -17, kGrass},
                               {"hill to the south", 17, -11, kGrass},
                               {"hill to the north", 20, -21, kGrass},
                               {"dell", -16, 11, kGrass},
                               {"dell to the west", -21, 12, kGrass},
                               {"dell to the south", -12, 21, kGrass}};
  for (const Place& p : kPlaces) {
    const double x = kPitch * (std::floor(p.x / kPitch) + 0.25), z = kPitch * (std::floor(p.z / kPitch) + 0.25);
    const Slope slope = slope_at(x, z);
    spots.push_back(
        {p.name, LevelSpot::Kind::top, {x, slope.height, z}, unit_of({-slope.by_x, 1, -slope.by_z}), p.material});
  }
}

}  // namespace

double town_ground(double x, double z) { return slope_at(x, z).height; }

Level town_level() {
  Level level;
  MeshBuilder mesh;
  TownPieces pieces(mesh, level.spots);
  add_ground(mesh);
  tell_ground(level.spots);
  pieces.add_border(29.25);
  for (const double x : {-21.0, -9.0}) {
    for (const double z : {-21.0, -9.0}) pieces.add_house({x, 0, z});
  }
  pieces.add_tall_house({11, 0, 17});
  pieces.add_grand_stairs({4.5, 0, 5});
  pieces.add_tower({24, 0, 16});
  pieces.add_bridge({-16, 0, 16});
  pieces.add_ramps({5, 0, 24});
  pieces.add_fountain({0, 0, 0});
  pieces.add_posts();
  level.scene.bodies.push_back(body_of(mesh.part(), {0, 0, 0}));
  level.scene.bodies.back().type = BodyType::static_;
  return level;
}

}  // namespace isostep::scenes
