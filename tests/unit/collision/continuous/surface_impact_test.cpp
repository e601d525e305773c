// Sweeps against triangles: none is missed, and no more are looked at than the core's own way meets.
// SPDX-License-Identifier: MIT
#include "isostep/collision/continuous/surface_impact.hpp"

#include "isostep/geometry/baked/triangle_mesh.hpp"
#include "random/dice.hpp"

namespace isostep::test {
namespace surface_impact_test {

/// Squares of 1 m at y = 0, 64 by 64, of two triangles each.
TriangleMesh flat_squares() {
  constexpr std::uint32_t kPlaces = 65;
  std::vector<MeshPoint> points;
  std::vector<MeshTriangle> triangles;
  for (std::uint32_t k = 0; k < kPlaces; ++k) {
    for (std::uint32_t i = 0; i < kPlaces; ++i)
      points.push_back({static_cast<std::int32_t>(i) - 32, 0, static_cast<std::int32_t>(k) - 32});
  }
  for (std::uint32_t k = 0; k + 1 < kPlaces; ++k) {
    for (std::uint32_t i = 0; i + 1 < kPlaces; ++i) {
      const std::uint32_t at = k * kPlaces + i;
      triangles.push_back({{at, at + kPlaces, at + 1}});
      triangles.push_back({{at + kPlaces + 1, at + 1, at + kPlaces}});
    }
  }
  return triangle_mesh(points, triangles, {}, 0).value();
}

/// Tells how many of a surface's triangles were asked for.
struct Counted {
  const TriangleMesh& mesh;
  int* met;

  int exponent() const { return mesh.exponent(); }
  BakedTriangle triangle(std::uint32_t id) const {
    ++*met;
    return mesh.triangle(id);
  }
  template <class Visit> bool query(const MeshBox& box, const Visit& visit) const { return mesh.query(box, visit); }
};

template <class S> class SurfaceImpacts : public ::testing::Test {
 protected:
  /// The corners of a cube with sides of 1 m, there in its body's frame.
  void place_cube(D3 at) {
    for (int i = 0; i < 8; ++i) corners_[i] = vec<S>(at + D3{(i & 1) - 0.5, (i >> 1 & 1) - 0.5, (i >> 2 & 1) - 0.5});
  }
  ConvexCore<S> core() const { return {{corners_, 8}, S(0)}; }
  TimeOfImpact<S> impact(const CoreMotion<S>& motion) {
    met_ = 0;
    const Transform<S> place = Transform<S>::of(Pose<S>::identity());
    return detail::surface_impact(Counted{mesh_, &met_}, place, core(), motion, num<S>(0.002));
  }

  TriangleMesh mesh_ = flat_squares();
  Vec3<S> corners_[8];
  int met_ = 0;
};
TYPED_TEST_SUITE(SurfaceImpacts, AllScalars);

/// A body turns about a middle that is far away, as a tree that falls; its foot, one corner first, nears the ground.
TYPED_TEST(SurfaceImpacts, meet_as_many_triangles_however_large_the_body_is) {
  using S = TypeParam;
  for (const double far : {1.0, 4.0, 16.0, 64.0}) {
    this->place_cube({0, -far, 0});
    const double angle = 0.25 / far;  // [rad] the foot moves by a quarter of a metre
    const CoreMotion<S> motion = {{vec<S>(0, far + 0.625, 0), Quat<Unit<S>>::identity()},
                                  {vec<S>(0, far + 0.25, 0), turn<S>({0, 0, 1}, angle)},
                                  Vec3<S>::zero()};
    const TimeOfImpact<S> found = this->impact(motion);
    EXPECT_EQ(found.impact, Impact::touch) << far;
    EXPECT_NEAR(to_double(found.fraction), 0.125 / (0.375 + 0.5 * angle), 0.03) << far;
    EXPECT_LE(this->met_, 2 * 4 * 4) << "the squares that the foot is above, and those at their edges: " << far;
  }
}

TYPED_TEST(SurfaceImpacts, of_a_crown_high_above_the_ground_meet_none) {
  using S = TypeParam;
  this->place_cube({0, 20, 0});
  const CoreMotion<S> motion = {
      {vec<S>(0, 20, 0), Quat<Unit<S>>::identity()}, {vec<S>(0, 20, 0), turn<S>({0, 0, 1}, 0.125)}, Vec3<S>::zero()};
  EXPECT_EQ(this->impact(motion).impact, Impact::none);
  EXPECT_EQ(this->met_, 0);
}

/// Wherever a core is on its way, about whatever point it turns, the box holds it.
TYPED_TEST(SurfaceImpacts, look_at_all_that_the_core_passes) {
  using S = TypeParam;
  Dice dice(5);
  const auto place = [&](double reach) { return Pose<S>{vec<S>(dice.point(reach)), dice.template orientation<S>()}; };
  for (int trial = 0; trial < 400; ++trial) {
    this->place_cube(dice.point(dice.magnitude(0.25, 16)));
    const Vec3<S> centre = vec<S>(dice.one_in(2) ? D3{0, 0, 0} : dice.point(4));
    const Pose<S> start = place(20);
    Pose<S> end = place(20);
    if (dice.one_in(2)) {
      const double angle = dice.in(0, 0.25);
      end.orientation = normalise(turn<S>(dice.direction(), angle) * start.orientation);
    }
    const CoreMotion<S> motion = {start, end, centre};
    const Transform<S> frame = Transform<S>::of(place(10));
    const ConvexCore<S> core = this->core();
    const Aabb<S> box = detail::CoreWay<S>(frame, core, motion).box(S(0));
    for (int i = 0; i <= 16; ++i) {
      const Transform<S> at = Transform<S>::of(pose_at(motion, num<Unit<S>>(i / 16.0)));
      for (const Vec3<S>& v : core.vertices) {
        const Vec3<S> p = to_local(frame, to_world(at, v));
        const Aabb<S> point = {p, p};
        ASSERT_TRUE(contains(grow(box, num<S>(kIsFixed<S> ? 0.001 : 1e-4)), point)) << trial << " at " << i << "/16";
      }
    }
  }
}

/// A core that is said to stay above a plane is above it wherever it is on its way.
TYPED_TEST(SurfaceImpacts, leave_out_what_the_core_stays_above) {
  using S = TypeParam;
  Dice dice(7);
  int above = 0, below = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    this->place_cube(dice.one_in(2) ? D3{0, 0, 0} : dice.point(4));
    const ConvexCore<S> core = {this->core().vertices, num<S>(dice.one_in(2) ? 0 : 0.25)};
    const Vec3<S> centre = vec<S>(dice.one_in(2) ? D3{0, 0, 0} : dice.point(1));
    const D3 from = dice.point(dice.one_in(4) ? 200 : 4), way = dice.point(dice.magnitude(0.01, 4));
    const double angle = dice.magnitude(0.01, 2);
    const Pose<S> start = {vec<S>(from), dice.template orientation<S>()};
    const Pose<S> end = {vec<S>(from + way), normalise(turn<S>(dice.direction(), angle) * start.orientation)};
    const CoreMotion<S> motion = {start, end, centre};
    const D3 up = dice.direction();
    const Vec3<Unit<S>> normal = {num<Unit<S>>(up.x), num<Unit<S>>(up.y), num<Unit<S>>(up.z)};
    const Vec3<S> point = vec<S>(from - up * dice.in(-1, 5));
    const S margin = num<S>(dice.one_in(2) ? 0 : 0.01);
    const Transform<S> frame = Transform<S>::of(Pose<S>::identity());
    if (!detail::CoreWay<S>(frame, core, motion).stays_above({normal, point}, margin)) {
      ++below;
      continue;
    }
    ++above;
    for (int i = 0; i <= 16; ++i) {
      const Transform<S> at = Transform<S>::of(pose_at(motion, num<Unit<S>>(i / 16.0)));
      for (const Vec3<S>& v : core.vertices)
        ASSERT_GT(dot(normal, to_world(at, v) - point), core.radius + margin) << trial << " at " << i << "/16";
    }
  }
  EXPECT_GT(above, 500);
  EXPECT_GT(below, 500);
}

}  // namespace surface_impact_test
}  // namespace isostep::test
