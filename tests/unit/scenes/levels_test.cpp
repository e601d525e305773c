// The levels as geometry: on a lattice, closed, of the size that they say, and every part told once.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "scenes/build.hpp"
#include "scenes/levels/level.hpp"

namespace isostep::scenes {
namespace levels_test {

double number(const Number& n) { return value_of<double>(n, ""); }
Vec3<double> vector(const Vector& v) { return {number(v[0]), number(v[1]), number(v[2])}; }

TEST(Levels, HaveTheirVerticesOnALattice) {
  std::size_t seen = 0;
  const auto check = [&](const std::vector<Vector>& points) {
    for (const Vector& v : points) {
      for (const Number& x : v) {
        const double steps = 1024 * number(x);
        ASSERT_EQ(steps, std::floor(steps));
        ++seen;
      }
    }
  };
  for (const Level& level : {town_level(), yard_level()}) {
    for (const SceneBody& body : level.scene.bodies) {
      check({body.position});
      for (const ScenePart& part : body.parts) check(part.vertices), check(part.points), check({part.position});
    }
  }
  EXPECT_GT(seen, 30000u);
}

TEST(Levels, TellEveryPartOnce) {
  for (const Level& level : {town_level(), yard_level()}) {
    std::set<std::string> names;
    std::map<LevelSpot::Kind, int> kinds;
    for (const LevelSpot& spot : level.spots) {
      EXPECT_TRUE(names.insert(spot.name).second) << spot.name;
      ++kinds[spot.kind];
      const Point n = spot.outward;
      EXPECT_NEAR(n.x * n.x + n.y * n.y + n.z * n.z, 1, 1e-12) << spot.name;
    }
    EXPECT_GE(kinds[LevelSpot::Kind::top], 60);
    EXPECT_GE(kinds[LevelSpot::Kind::wall], 20);
    EXPECT_GE(kinds[LevelSpot::Kind::doorway], 3);
  }
}

TEST(Town, HasTwentyThousandTrianglesOfAllMaterials) {
  const Level level = town_level();
  ASSERT_EQ(level.scene.bodies.size(), 1u);
  const ScenePart& mesh = level.scene.bodies[0].parts[0];
  EXPECT_NEAR(static_cast<double>(mesh.triangles.size()), 20000, 500);
  ASSERT_EQ(mesh.materials.size(), mesh.triangles.size());
  std::set<int> materials;
  for (const Number& m : mesh.materials) materials.insert(static_cast<int>(number(m)));
  EXPECT_EQ(materials.size(), static_cast<std::size_t>(kBridge) + 1);
}

/// Edges without a neighbour are the ground's rim; no triangle is a line.
TEST(Town, IsClosedButForTheGround) {
  const ScenePart mesh = town_level().scene.bodies[0].parts[0];
  std::vector<Vec3<double>> vertices;
  for (const Vector& v : mesh.vertices) vertices.push_back(vector(v));
  std::set<std::pair<std::size_t, std::size_t>> edges;
  for (const Vector& t : mesh.triangles) {
    std::size_t corners[3];
    for (std::size_t i = 0; i < 3; ++i) corners[i] = static_cast<std::size_t>(number(t[i]));
    const Vec3<double> a = vertices[corners[0]], b = vertices[corners[1]], c = vertices[corners[2]];
    EXPECT_GT(length(cross(b - a, c - a)), 1e-4);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_TRUE(edges.insert({corners[i], corners[(i + 1) % 3]}).second);
  }
  std::size_t rim = 0;
  for (const auto& [from, to] : edges) {
    if (edges.count({to, from}) != 0) continue;
    ++rim;
    const Vec3<double> a = vertices[from], b = vertices[to];
    EXPECT_TRUE((a.x == b.x && std::fabs(a.x) == 30) || (a.z == b.z && std::fabs(a.z) == 30));
  }
  EXPECT_EQ(rim, 4u * 64u);
}

TEST(Yard, IsTheSameWhoeverBuildsIt) {
  const Level a = yard_level(), b = yard_level();
  ASSERT_EQ(a.scene.bodies.size(), 37u);
  std::size_t hulls = 0;
  for (std::size_t i = 0; i < a.scene.bodies.size(); ++i) {
    ASSERT_EQ(a.scene.bodies[i].parts.size(), b.scene.bodies[i].parts.size());
    for (std::size_t k = 0; k < a.scene.bodies[i].parts.size(); ++k) {
      EXPECT_EQ(a.scene.bodies[i].parts[k].type, ShapeType::hull);
      EXPECT_EQ(a.scene.bodies[i].parts[k].points, b.scene.bodies[i].parts[k].points);
      ++hulls;
    }
  }
  EXPECT_GT(hulls, 100u);
}

}  // namespace levels_test
}  // namespace isostep::scenes
