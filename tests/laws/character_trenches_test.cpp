// Characters between slopes that are too steep one by one: they stand, walk along and jump out.
// SPDX-License-Identifier: MIT
#include "isostep/geometry/baked/triangle_mesh.hpp"
#include "laws/characters.hpp"

namespace isostep::test {
namespace character_trenches_test {

template <class S> class CharacterTrenches : public Characters<S> {
 protected:
  static double tangent(double degrees) {
    return isostep::sin(degrees * kPi / 180) / isostep::cos(degrees * kPi / 180);
  }
  void mesh(const std::vector<D3>& points, const std::vector<MeshTriangle>& triangles) {
    this->w.create(still<S>(this->w.add_shape(mesh_blob(points, triangles).value())));
  }
  /// Along z, 16 m long; `rise` [m] over its length.
  void trench(double left, double right, double rise = 0) {
    const double l = 2 * tangent(left), r = 2 * tangent(right);
    mesh({{0, 0, -8}, {0, rise, 8}, {2, r, -8}, {2, r + rise, 8}, {-2, l, -8}, {-2, l + rise, 8}},
         {{{0, 1, 2}}, {{2, 1, 3}}, {{0, 4, 1}}, {{4, 5, 1}}});
  }
  /// A pit of so many walls.
  void funnel(int walls, double degrees) {
    std::vector<D3> points = {{0, 0, 0}};
    std::vector<MeshTriangle> triangles;
    for (int i = 0; i < walls; ++i) {
      const double turn = 2 * kPi * i / walls, out = 2 / isostep::cos(kPi / walls);
      points.push_back({out * isostep::cos(turn), 2 * tangent(degrees), out * isostep::sin(turn)});
    }
    for (int i = 0; i < walls; ++i) {
      const auto a = static_cast<std::uint32_t>(1 + i), b = static_cast<std::uint32_t>(1 + (i + 1) % walls);
      triangles.push_back({{0, b, a}});
    }
    mesh(points, triangles);
  }
  CharacterId fallen(D3 from, int steps = 300) {
    const CharacterId id = this->walker(from);
    for (int i = 0; i < steps; ++i) this->w.step();
    return id;
  }
  double height(CharacterId id) { return this->foot(id).y; }
  /// [m] The height to which a jump of 6 m/s lifts it.
  double jumps(CharacterId id) {
    const double from = height(id);
    double most = 0;
    this->ask(id, {0, 0, 0}, 6);
    for (int i = 0; i < 90; ++i) {
      this->w.step();
      most = std::max(most, height(id) - from);
    }
    return most;
  }
};
TYPED_TEST_SUITE(CharacterTrenches, AllScalars);

TYPED_TEST(CharacterTrenches, are_stood_in_walked_along_and_jumped_out_of) {
  for (const auto& [left, right] : {std::pair{50.0, 50.0}, {60.0, 60.0}, {75.0, 75.0}, {50.0, 75.0}, {30.0, 80.0}}) {
    this->w = World<TypeParam>(settings<TypeParam>());
    this->capsule_ = {};
    this->trench(left, right);
    const CharacterId id = this->fallen({0.1, 2, 0.2});
    const std::string what = std::to_string(left) + ", " + std::to_string(right);
    EXPECT_EQ(this->footing(id), Footing::floor) << what;
    EXPECT_LT(length(real(this->w.state(id)->velocity)), 0.01) << what;
    const D3 from = this->foot(id);
    EXPECT_TRUE(this->walk(id, {0, 0, 2}, 60)) << what;
    EXPECT_NEAR(this->foot(id).z - from.z, 2, 0.05) << what;
    EXPECT_NEAR(this->foot(id).y, from.y, 0.05) << what;
    EXPECT_NEAR(this->jumps(id), 1.75, 0.1) << what;
    for (int i = 0; i < 120; ++i) this->w.step();
    EXPECT_EQ(this->footing(id), Footing::floor) << what;
  }
}

TYPED_TEST(CharacterTrenches, pits_of_three_and_more_walls_are_stood_in) {
  for (const int walls : {3, 4, 5, 8}) {
    this->w = World<TypeParam>(settings<TypeParam>());
    this->capsule_ = {};
    this->funnel(walls, 60);
    const CharacterId id = this->fallen({0.1, 2, 0.15});
    EXPECT_EQ(this->footing(id), Footing::floor) << walls;
    EXPECT_NEAR(this->jumps(id), 1.75, 0.1) << walls;
  }
}

/// As one plane whose slope is the trench's own: nobody stands in a gutter that is too steep.
TYPED_TEST(CharacterTrenches, that_run_downhill_hold_as_one_slope_would) {
  for (const double slope : {20.0, 40.0, 50.0, 60.0}) {
    this->w = World<TypeParam>(settings<TypeParam>());
    this->capsule_ = {};
    this->trench(70, 70, 16 * this->tangent(slope));
    const CharacterId id = this->fallen({0, 8 * this->tangent(slope) + 1, 0}, 90);
    const double before = this->height(id);
    for (int i = 0; i < 30; ++i) this->w.step();
    if (slope < 45) {
      EXPECT_EQ(this->footing(id), Footing::floor) << slope;
      EXPECT_NEAR(this->height(id), before, 0.01) << slope;
    } else {
      EXPECT_NE(this->footing(id), Footing::floor) << slope;
      EXPECT_LT(this->height(id), before - 0.5) << slope;
    }
  }
}

TYPED_TEST(CharacterTrenches, one_steep_slope_alone_or_beside_a_wall_above_holds_nobody) {
  this->box({0.5, 8, 4}, {-2.5, 0, 0});                                                        // behind and above
  this->mesh({{4, -8, -4}, {4, -8, 4}, {-2, 4, -4}, {-2, 4, 4}}, {{{0, 2, 1}}, {{2, 3, 1}}});  // down along x
  const CharacterId id = this->walker({-1.2, 3.2, 0});
  for (int i = 0; i < 40; ++i) {
    this->ask(id, {-2, 0, 0});
    this->w.step();
    if (i > 2) {
      EXPECT_NE(this->footing(id), Footing::floor) << i;
    }
  }
  EXPECT_LT(this->height(id), 2.5);
}

}  // namespace character_trenches_test
}  // namespace isostep::test
