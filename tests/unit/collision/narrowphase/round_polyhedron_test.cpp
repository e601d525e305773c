// Spheres, capsules, points and rays on polyhedra. A nearest point is right where it lies in the solid and a plane
// through it parts the solid from the query: both are looked at in double.
// SPDX-License-Identifier: MIT
#include "isostep/collision/narrowphase/round_polyhedron.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <set>

#include "unit/collision/narrowphase/placed_solids.hpp"

namespace isostep::test {
namespace round_polyhedron_test {

using oracle::D3;

/// A hull in double, in its own frame.
struct Oracle {
  explicit Oracle(const ConvexHull& hull) {
    for (const GridPoint p : hull.vertices)
      vertices.push_back(D3{static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)} * 0x1p-16);
    for (std::uint32_t f = 0; f < hull.faces.size(); ++f) {
      const GridVector n = hull.normal(static_cast<std::uint8_t>(f));
      normals.push_back(oracle::unit({static_cast<double>(n.x), static_cast<double>(n.y), static_cast<double>(n.z)}));
    }
    for (std::size_t e = 0; e < hull.half_edges.size(); e += 2)
      edges.push_back(oracle::unit(vertices[hull.half_edges[e + 1].origin] - vertices[hull.half_edges[e].origin]));
  }
  double reach(D3 n) const {
    double most = -1e300;
    for (const D3 v : vertices) most = std::max(most, dot(n, v));
    return most;
  }
  /// [m] The height of p above the highest face: negative inside.
  double above(D3 p) const {
    double most = -1e300;
    for (const D3 n : normals) most = std::max(most, dot(n, p) - reach(n));
    return most;
  }
  /// [m] The distance of a segment's core from the solid along the best axis there is: minus the depth where they
  /// overlap.
  double best_axis(D3 low, D3 high) const {
    const D3 along = oracle::unit(high - low);
    const auto separation = [&](D3 n) { return std::min(dot(n, low), dot(n, high)) - reach(n); };
    double best = -1e300;
    for (const D3 n : normals) best = std::max(best, separation(n));
    for (const D3 e : edges) {
      const D3 n = cross(e, along);
      if (oracle::length(n) < 1e-6) continue;
      best = std::max({best, separation(oracle::unit(n)), separation(-oracle::unit(n))});
    }
    return best;
  }

  std::vector<D3> vertices, normals, edges;
};

template <class S> class RoundOnPolyhedron : public SolidTest<S> {
 protected:
  static constexpr double kMargin = 0.02, kRadius = 0.11;  // [m]
  static constexpr double kDigit = kIsFixed<S> ? 1 : 4;

  struct Solid {
    explicit Solid(const ConvexHull& hull) : solid(hull, 16), oracle(hull) {}
    HullSolid<S> solid;
    Oracle oracle;
  };
  RoundOnPolyhedron() {
    this->random_ = oracle::Random(5);
    scenes::Draws draws(31);
    for (int n = 0; n < 24; ++n) {
      const ConvexHull hull = convex_hull(drawn_points(n, draws)).value();
      solids_.push_back(std::make_unique<Solid>(hull));
      exact_.push_back(std::make_unique<HullSolid<double>>(hull, 16));
    }
  }
  static double error(double reach) {
    return (12 * kDigit + reach) * to_double(resolution<S>()) + reach * to_double(resolution<Unit<S>>()) * 32;
  }

  std::vector<std::unique_ptr<Solid>> solids_;
  std::vector<std::unique_ptr<HullSolid<double>>> exact_;
};
using Scalars = testing::Types<float, double, Q16_16, Q32_32>;
TYPED_TEST_SUITE(RoundOnPolyhedron, Scalars);

TYPED_TEST(RoundOnPolyhedron, the_nearest_point_is_in_the_solid_and_a_plane_parts_it_from_the_query) {
  using S = TypeParam;
  const double error = this->error(1);
  int inside = 0, faces = 0, edges = 0;
  for (int n = 0; n < 20000; ++n) {
    const auto& [solid, oracle] = *this->solids_[static_cast<std::size_t>(n % 24)];
    const Vec3<S> query = oracle::made<S>(this->random_.arrow(0.02, 0.9));
    const NearestPoint<S> nearest = nearest_on(solid.polyhedron(), query);
    const D3 q = oracle::real(query), p = oracle::real(nearest.point), normal = oracle::real(nearest.normal);
    const double distance = to_double(nearest.distance), above = oracle.above(q);
    ASSERT_LT(std::fabs(oracle.above(p)), 4 * error) << n << ": on the surface";
    ASSERT_NEAR(oracle::length(q - p - normal * distance), 0, 4 * error)
        << n << ": the query is point + distance normal";
    if (above < -error) {
      ASSERT_NEAR(distance, above, error) << n;
      ++inside;
      continue;
    }
    // The direction of a short gap has few digits.
    const double slack = 4 * error + std::min(1.0, 4 * error / std::max(distance, 1e-9));
    ASSERT_GT(dot(normal, q) - oracle.reach(normal), distance - slack) << n << ": a plane parts them";
    ++(nearest.feature < NearestPoint<S>::kEdge ? faces : edges);
  }
  EXPECT_GT(inside, 3000);
  EXPECT_GT(faces, 1000);
  EXPECT_GT(edges, 3000);
}

TYPED_TEST(RoundOnPolyhedron, a_sphere_touches_where_its_centre_is_nearest) {
  using S = TypeParam;
  int touching = 0;
  for (int n = 0; n < 5000; ++n) {
    const auto& [solid, oracle] = *this->solids_[static_cast<std::size_t>(n % 24)];
    const D3 at = n % 3 == 0 ? D3{40, -30, 20} : D3{0, 0, 0};
    const Transform<S> tb = this->transform(at);
    const Transform<S> ta = this->transform(at + this->random_.arrow(0.1, 0.9));
    Manifold<S> m;
    collide_sphere_polyhedron(from_double<S>(this->kRadius), ta, solid.polyhedron(), tb, from_double<S>(this->kMargin),
                              m);
    const NearestPoint<S> nearest = nearest_on(solid.polyhedron(), to_local(tb, ta.position));
    const double error = this->error(55), separation = to_double(nearest.distance) - this->kRadius;
    ASSERT_EQ(m.count, separation > this->kMargin + error ? 0 : separation < this->kMargin - error ? 1 : m.count);
    if (m.count == 0) continue;
    ++touching;
    const D3 normal = oracle::real(m.normal), position = oracle::real(m.points[0].position);
    ASSERT_NEAR(to_double(m.points[0].separation), separation, error);
    const D3 on_sphere = oracle::real(ta.position) + normal * this->kRadius;
    ASSERT_NEAR(oracle::length(position - (on_sphere + normal * (separation / 2))), 0, 4 * error);
    ASSERT_EQ(m.points[0].feature, nearest.feature);
  }
  EXPECT_GT(touching, 1500);
}

TYPED_TEST(RoundOnPolyhedron, a_capsule_touches_as_deep_as_its_core_says) {
  using S = TypeParam;
  int apart = 0, over = 0, deep = 0, two = 0;
  for (int n = 0; n < 8000; ++n) {
    const std::size_t which = static_cast<std::size_t>(n % 24);
    const auto& [solid, oracle] = *this->solids_[which];
    const D3 at = n % 3 == 0 ? D3{40, -30, 20} : D3{0, 0, 0};
    const double half = this->random_.in(0.05, 0.4);
    const Transform<S> tb = this->transform(at);
    const Transform<S> ta = this->transform(at + this->random_.arrow(0.1, 1.1));
    Manifold<S> m;
    collide_capsule_polyhedron(from_double<S>(half), from_double<S>(this->kRadius), ta, solid.polyhedron(), tb,
                               from_double<S>(this->kMargin), m);
    const Transform<double> a = oracle::real(ta), b = oracle::real(tb);
    const D3 low = to_local(b, to_world(a, D3{0, -half, 0})), high = to_local(b, to_world(a, D3{0, half, 0}));
    double distance = oracle.best_axis(low, high);
    if (distance > 0) {
      distance = 1e300;
      for (int k = 0; k <= 400; ++k)
        distance = std::min(distance,
                            nearest_on(this->exact_[which]->polyhedron(), low + (high - low) * (k / 400.0)).distance);
    }
    const double inner = to_double(solid.polyhedron().inner_radius), error = this->error(55);
    const double tolerance = inner / 128 + 2e-3 * half + 2 * error;
    const double expected = distance - this->kRadius;
    if (m.count == 0) {
      ASSERT_GT(expected, this->kMargin - tolerance) << n;
      ++apart;
      continue;
    }
    ASSERT_LT(expected, this->kMargin + tolerance) << n;
    double least = 1e300;
    std::set<std::uint32_t> features;
    for (int i = 0; i < m.count; ++i) {
      least = std::min(least, to_double(m.points[i].separation));
      features.insert(m.points[i].feature);
    }
    ASSERT_NEAR(least, expected, tolerance) << n << " core " << distance;
    ASSERT_EQ(features.size(), static_cast<std::size_t>(m.count));
    const D3 normal = transposed_times(b.rotation, -oracle::real(m.normal));
    const double along = std::min(dot(normal, low), dot(normal, high)) - oracle.reach(normal);
    // Beyond the face that it lies along, a core may be lower than over it.
    const double slack =
        (distance > 0 ? std::min(1.0, 4 * error / distance) : 0) + ((*features.begin() >> 31) != 0 ? half / 8 : 0);
    ASSERT_GT(along, distance - 2 * tolerance - slack) << n << ": no other axis is much better";
    ++(distance > 0 ? over : deep);
    two += m.count == 2 ? 1 : 0;
  }
  EXPECT_GT(apart, 1000);
  EXPECT_GT(over, 1000);
  EXPECT_GT(deep, 1000);
  EXPECT_GT(two, 200);
}

TYPED_TEST(RoundOnPolyhedron, a_ray_enters_where_it_first_comes_inside) {
  using S = TypeParam;
  int entered = 0, missed = 0, inside = 0;
  for (int n = 0; n < 10000; ++n) {
    const auto& [solid, oracle] = *this->solids_[static_cast<std::size_t>(n % 24)];
    const Transform<S> still = {Vec3<S>::zero(), Mat3<Unit<S>>::identity()};
    const D3 from = this->random_.arrow(0.05, 2);
    const double times = this->random_.in(0.2, 30);
    const D3 way = (this->random_.point(0.4) - from) * times;
    const auto ray = detail::LocalRay<S>::of(still, oracle::made<S>(from), oracle::made<S>(way));
    const detail::LocalHit<S> hit = cast_ray(solid.polyhedron(), ray);
    const D3 origin = oracle::real(ray.origin), translation = oracle::real(ray.translation);
    const double error = this->error(2) * 8, along = oracle::length(translation);
    if (hit.kind == detail::LocalHit<S>::inside) {
      ASSERT_LT(oracle.above(origin), error) << n;
      ++inside;
      continue;
    }
    const double end = hit.kind == detail::LocalHit<S>::missed ? 1 : to_double(hit.fraction);
    // The fraction's last digit is a long way of a long ray.
    const double slack = error + 2 * along * to_double(resolution<S>());
    for (int k = 0; k < 200; ++k) ASSERT_GT(oracle.above(origin + translation * (end * k / 200)), -slack) << n;
    if (hit.kind == detail::LocalHit<S>::missed) {
      ++missed;
      continue;
    }
    ++entered;
    ASSERT_NEAR(oracle.above(origin + translation * end), 0, slack) << n;
    ASSERT_LT(dot(oracle::real(hit.normal), translation), 0) << n;
  }
  EXPECT_GT(entered, 3000);
  EXPECT_GT(missed, 1000);
  EXPECT_GT(inside, 200);
}

/// One point would jump from end to end with the last digit of the pitch.
TYPED_TEST(RoundOnPolyhedron, a_capsule_along_a_ridge_touches_it_at_both_ends) {
  using S = TypeParam;
  const HullSolid<S> roof(convex_hull(std::vector<GridPoint>{{-65536, 0, 0},
                                                             {65536, 0, 0},
                                                             {-65536, -32768, 40000},
                                                             {65536, -32768, 40000},
                                                             {-65536, -32768, -40000},
                                                             {65536, -32768, -40000}})
                              .value(),
                          16);
  using U = Unit<S>;
  const Transform<S> still = {Vec3<S>::zero(), Mat3<U>::identity()};
  for (const double pitch : {0.0, 1e-5, -1e-5, 1e-4, -1e-4, 1e-3, -1e-3}) {
    const double half_angle = -0.78539816339744830962 + pitch / 2;  // y to x, and up
    const double sine = isostep::sin(half_angle), cosine = isostep::cos(half_angle);
    const Quat<U> turn = {U(0), U(0), from_double<U>(sine), from_double<U>(cosine)};
    Manifold<S> m;
    collide_capsule_polyhedron(S(0.4), S(0.1), {{S(0), S(0.1), S(0)}, to_matrix(turn)}, roof.polyhedron(), still,
                               S(0.02), m);
    ASSERT_EQ(m.count, 2) << pitch;
    EXPECT_NEAR(std::fabs(to_double(m.points[0].position.x)), 0.4, 1e-3);
    EXPECT_NEAR(to_double(m.points[0].position.x), -to_double(m.points[1].position.x), 1e-3);
    EXPECT_NEAR(to_double(m.points[0].separation), 0, 5e-4);
  }
}

}  // namespace round_polyhedron_test
}  // namespace isostep::test
