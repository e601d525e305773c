// Drawing of shapes whose surface is a blob: the triangles of a house-shaped hull, whose volume a child can work out.
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <map>
#include <span>

#include "isostep/draw/debug_draw.hpp"
#include "isostep/geometry/baked/hull_blob.hpp"
#include "unit/world/worlds.hpp"

namespace isostep::test {
namespace debug_draw_triangles_test {

using Corner = std::array<float, 3>;
using Triangle = std::array<Corner, 3>;

/// Asks for each content once.
struct Asks : DebugDraw {
  struct Told {
    DrawnPart part;
    std::vector<Triangle> triangles;
  };

  void part(const DrawnBody&, const DrawnPart& part) override { parts.push_back({part, {}}); }
  void line(const DrawnLine& drawn) override { lines.push_back(drawn); }
  bool wants_triangles(const DrawnPart& part) override {
    EXPECT_EQ(part.content, parts.back().part.content);
    const bool fresh = std::find(known.begin(), known.end(), part.content) == known.end();
    if (fresh) known.push_back(part.content);
    return fresh;
  }
  void triangle(const DrawnTriangle& drawn) override {
    Triangle triangle;
    for (std::size_t i = 0; i < 3; ++i) std::copy(drawn.corners[i], drawn.corners[i] + 3, triangle[i].begin());
    parts.back().triangles.push_back(triangle);
  }

  std::vector<Told> parts;
  std::vector<ContentId> known;
  std::vector<DrawnLine> lines;
};

/// Fails if it is told what it did not ask for.
struct DoesNotAsk : DebugDraw {
  void triangle(const DrawnTriangle&) override { ADD_FAILURE(); }
};

D3 real(const Corner& v) { return {v[0], v[1], v[2]}; }
D3 real(const float (&v)[3]) { return {v[0], v[1], v[2]}; }

/// A point of a part's frame in the world's.
D3 placed(const DrawnPose& pose, D3 point) {
  const float(&q)[4] = pose.orientation;
  return rotated<double>({q[0], q[1], q[2], q[3]}, point) + real(pose.position);
}
/// [m] The distance from a point to the nearest end of a line.
double gap_to_ends(std::span<const DrawnLine> lines, D3 point) {
  double least = length(point - real(lines[0].from));
  for (const DrawnLine& line : lines)
    least = std::min({least, length(point - real(line.from)), length(point - real(line.to))});
  return least;
}

/// Walls of 2 x 1 x 1.5 m, a roof of half a metre above them with its ridge along x: 3 m^3 and 0.75 m^3.
constexpr double kHouse = 3.75;
BlobRef house() {
  std::vector<GridPoint> quarters = {{-4, 4, 0}, {4, 4, 0}};  // of a metre
  for (const int x : {-4, 4}) {
    for (const int y : {-2, 2}) {
      for (const int z : {-3, 3}) quarters.push_back({x, y, z});
    }
  }
  return hull_blob(quarters, 2).value();
}
template <class S> Child<S> house_at(const Pose<S>& pose) { return {Hull<S>{1}.primitive(), pose}; }
template <class S> ShapeId add(World<S>& world, const Child<S>& child, const BlobRef& blob) {
  return world.add_shape(std::span<const Child<S>>(&child, 1), std::span<const BlobRef>(&blob, 1));
}

/// A house as a body's whole shape, one as a turned part of another's, and a box.
template <class S> struct Village {
  Village() : world(settings<S>(0)) {
    const BlobRef blob = house();
    content = blob->id();
    world.create(moving<S>(add(world, house_at(Pose<S>::identity()), blob), {4, 5, 6}));
    const Child<S> part = house_at(Pose<S>{vec<S>(0.5, 0, 0), turn<S>({0, 1, 0}, kPi / 2)});
    BodyDefinition<S> other = moving<S>(add(world, part, blob), {-4, 3, 0});
    other.orientation = turn<S>({0, 0, 1}, kPi / 3);
    world.create(other);
    world.create(moving<S>(add_box(world, 1, 1, 1), {0, 9, 0}));
  }
  World<S> world;
  ContentId content;
};

template <class S> class DebugDrawsTriangles : public ::testing::Test {};
TYPED_TEST_SUITE(DebugDrawsTriangles, AllScalars);

TYPED_TEST(DebugDrawsTriangles, OfEachContentOnceToWhoAsksOnce) {
  const Village<TypeParam> village;
  Asks asks;
  draw(village.world, asks);
  ASSERT_EQ(asks.parts.size(), 3u);
  EXPECT_EQ(asks.known, std::vector<ContentId>{village.content});
  EXPECT_EQ(asks.parts[0].part.content, village.content);
  EXPECT_EQ(asks.parts[0].triangles.size(), 16u);  // 2 V - 4
  EXPECT_EQ(asks.parts[1].part.content, village.content);
  EXPECT_TRUE(asks.parts[1].triangles.empty());
  EXPECT_EQ(asks.parts[2].part.content, ContentId{});
  EXPECT_TRUE(asks.parts[2].triangles.empty());
}

/// One blob, two surfaces: that of a rounded hull is its own, once.
TYPED_TEST(DebugDrawsTriangles, OfEachRadiusByItself) {
  using S = TypeParam;
  World<S> world(settings<S>(0));
  const BlobRef blob = house();
  for (const double radius : {0.0, 0.25, 0.125, 0.25}) {
    Child<S> child = house_at<S>(Pose<S>::identity());
    child.primitive.radius = num<S>(radius);
    world.create(moving<S>(add(world, child, blob), {0, 0, 0}));
  }
  Asks asks;
  draw(world, asks);
  ASSERT_EQ(asks.parts.size(), 4u);
  EXPECT_EQ(asks.parts[0].part.content, blob->id());
  EXPECT_EQ(asks.known.size(), 3u);
  EXPECT_EQ(asks.parts[3].part.content, asks.parts[1].part.content);
  EXPECT_FALSE(asks.parts[1].triangles.empty());
  EXPECT_FALSE(asks.parts[2].triangles.empty());
  EXPECT_TRUE(asks.parts[3].triangles.empty());
}

TYPED_TEST(DebugDrawsTriangles, ToNobodyWhoDoesNotAsk) {
  const Village<TypeParam> village;
  DoesNotAsk silent;
  draw(village.world, silent);
}

TYPED_TEST(DebugDrawsTriangles, ThatCloseAVolumeAndFaceOutwards) {
  const Village<TypeParam> village;
  Asks asks;
  draw(village.world, asks);
  std::map<std::pair<Corner, Corner>, int> edges;
  double volume = 0;
  for (const Triangle& triangle : asks.parts.at(0).triangles) {
    const D3 a = real(triangle[0]), b = real(triangle[1]), c = real(triangle[2]);
    EXPECT_GT(dot(a, cross(b - a, c - a)), 0) << "the origin is inside";
    volume += dot(a, cross(b, c)) / 6;
    for (std::size_t i = 0; i < 3; ++i) ++edges[{triangle[i], triangle[(i + 1) % 3]}];
  }
  EXPECT_NEAR(volume, kHouse, 1e-12);
  EXPECT_EQ(edges.size(), 48u);
  for (const auto& [edge, count] : edges) {
    EXPECT_EQ(count, 1);
    EXPECT_TRUE(edges.count({edge.second, edge.first}));
  }
}

/// The part's pose takes the triangles' corners to the ends of the part's lines, which are in the world's frame.
TYPED_TEST(DebugDrawsTriangles, InTheFrameOfThePart) {
  using S = TypeParam;
  const Village<S> village;
  Asks asks;
  draw(village.world, asks, {.lines = true});
  ASSERT_EQ(asks.lines.size(), 15u + 15u + 12u);
  for (std::size_t house = 0; house < 2; ++house) {
    const std::span<const DrawnLine> outline = std::span<const DrawnLine>(asks.lines).subspan(15 * house, 15);
    for (const Triangle& triangle : asks.parts[0].triangles) {
      for (const Corner& corner : triangle)
        EXPECT_LT(gap_to_ends(outline, placed(asks.parts[house].part.pose, real(corner))), 1e-3);
    }
  }
}

}  // namespace debug_draw_triangles_test
}  // namespace isostep::test
