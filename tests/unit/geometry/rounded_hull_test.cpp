// Hulls with a radius, in every scalar: boxes, rays, closest points, mass and drawings against the core in double.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numbers>

#include "isostep/collision/query/closest_point.hpp"
#include "isostep/collision/query/ray_cast.hpp"
#include "isostep/geometry/bounds.hpp"
#include "isostep/geometry/content.hpp"
#include "isostep/geometry/mass_properties.hpp"
#include "isostep/geometry/validate.hpp"
#include "sample.hpp"
#include "scenes/hull_points.hpp"
#include "scenes/nearest_point.hpp"
#include "unit/geometry/hull_recipes.hpp"
#include "unit/geometry/oracle.hpp"
#include "unit/world/worlds.hpp"

namespace isostep::test {
namespace rounded_hull_test {

template <class S> class RoundedHull : public ::testing::Test {
 protected:
  void take(int n) {
    scenes::Draws draws(static_cast<std::uint32_t>(n) + 1);
    std::vector<D3> points;
    for (const scenes::Point& p : scenes::drawn_hull(n, draws).points)
      points.push_back(D3{p.x + 0.5 * (n % 3), p.y, p.z - 0.25 * (n % 5)});
    take(points, (1 + n % 7) / 16.0);
    child_.pose = {vec<S>(random_.point(0.5)), random_.template orientation<S>()};
  }
  void take(const std::vector<D3>& points, double radius) {
    radius_ = radius;
    blobs_ = {hull_blob(std::span<const D3>(points)).value()};
    exact_ = scenes::solid_hull(*blobs_[0]);
    child_ = {Hull<S>{1, from_double<S>(radius)}.primitive(), Pose<S>::identity()};
    find_contents<S>(blobs_, contents_);
  }
  std::span<const Child<S>> children() const { return {&child_, 1}; }
  Contents<S> contents() const { return {contents_.data()}; }
  ShapeView<S> view() const { return contents().view(child_.primitive); }
  Transform<S> place() const { return Transform<S>::of(child_.pose); }
  /// The signed distance of a point in the hull's frame.
  double signed_distance(D3 p) const {
    double most = -1e9, outside = 1e9;
    for (std::size_t f = 0; f < exact_->normals.size(); ++f) {
      double offset = -1e9;
      for (const D3 v : exact_->vertices) offset = std::max(offset, dot(exact_->normals[f], v));
      most = std::max(most, dot(exact_->normals[f], p) - offset);
    }
    if (most <= 0) return most - radius_;
    for (const auto& t : exact_->triangles) outside = std::min(outside, length(p - scenes::nearest_on_triangle(p, t)));
    return outside - radius_;
  }

  oracle::Random random_{11};
  double radius_ = 0;  // [m]
  std::vector<BlobRef> blobs_;
  std::shared_ptr<const scenes::SolidHull> exact_;
  Child<S> child_;
  std::vector<const void*> contents_;
};
TYPED_TEST_SUITE(RoundedHull, AllScalars);

TYPED_TEST(RoundedHull, its_box_and_its_ball_are_wider_by_the_radius) {
  using S = TypeParam;
  for (int n = 0; n < 20; ++n) {
    this->take(n);
    Child<S> core = this->child_;
    core.primitive.radius = S(0);
    const ShapeView<S> core_view = this->contents().view(core.primitive);
    const Aabb<S> box = bounds(this->view(), this->place()), inner = bounds(core_view, this->place());
    EXPECT_EQ(box, grow(inner, from_double<S>(this->radius_)));
    const S ball = shape_as<Hull>(this->view()).inner_radius(), core_ball = shape_as<Hull>(core_view).inner_radius();
    EXPECT_EQ(ball, core_ball + from_double<S>(this->radius_));
  }
}

TYPED_TEST(RoundedHull, rays_enter_where_the_core_is_a_radius_away) {
  using S = TypeParam;
  const int rays = sampled(60, 20);  // of each hull
  int hits = 0, misses = 0, inside = 0;
  for (int n = 0; n < 40; ++n) {
    this->take(n);
    const Transform<double> exact = oracle::real(this->place());
    for (int k = 0; k < rays; ++k) {
      const double start = k % 10 == 0 ? 0.5 : 6.0;
      const D3 aim = to_world(exact, this->exact_->centre) + this->random_.point(0.9);
      const D3 origin = aim + this->random_.direction() * start, translation = (aim - origin) * 2.0;
      RayHit<S> hit;
      const bool met = ray_cast(this->view(), this->place(), vec<S>(origin), vec<S>(translation), S(1), hit);
      double least = 1e9;  // of the way, sampled
      for (int i = 0; i <= 400; ++i)
        least = std::min(least, this->signed_distance(to_local(exact, origin + translation * (i / 400.0))));
      const double here = this->signed_distance(to_local(exact, origin));
      if (std::fabs(here) < 0.002 || (least > 0 ? least < 0.002 : least > -0.002)) continue;
      ASSERT_EQ(met, least < 0) << n << " " << k << " by " << least;
      met ? ++hits : ++misses;
      if (!met) continue;
      ASSERT_EQ(hit.inside, here < 0);
      if (hit.inside) {
        ++inside;
        continue;
      }
      const D3 at = origin + translation * to_double(hit.fraction);
      EXPECT_NEAR(this->signed_distance(to_local(exact, at)), 0, pick<S>(2e-4, 1e-11, 2e-3, 4e-7)) << n << " " << k;
      const D3 out = real(hit.normal) * 0.001;
      EXPECT_NEAR(this->signed_distance(to_local(exact, at + out)), 0.001, pick<S>(3e-4, 1e-5, 2e-3, 1e-5));
      EXPECT_LT(dot(real(hit.normal), translation), 0);
    }
  }
  EXPECT_GT(hits, rays * 800 / 60);
  EXPECT_GT(misses, rays * 200 / 60);
  EXPECT_GT(inside, rays * 20 / 60);
}

TYPED_TEST(RoundedHull, the_closest_point_lies_on_the_surface_at_the_distance_told) {
  using S = TypeParam;
  for (int n = 0; n < 40; ++n) {
    this->take(n);
    const Transform<double> exact = oracle::real(this->place());
    for (int k = 0; k < 40; ++k) {
      const D3 query = to_world(exact, this->exact_->centre) + this->random_.point(1.0);
      const ClosestPoint<S> got = closest_point(this->view(), this->place(), vec<S>(query));
      const double bar = pick<S>(1e-5, 1e-12, 2e-3, 2e-8);
      EXPECT_NEAR(to_double(got.distance), this->signed_distance(to_local(exact, query)), bar);
      EXPECT_NEAR(this->signed_distance(to_local(exact, real(got.point))), 0, bar);
      expect_near(real(got.point) + real(got.normal) * to_double(got.distance), query, bar);
    }
  }
}

TYPED_TEST(RoundedHull, mass_and_inertia_are_those_of_the_stretched_core) {
  using S = TypeParam;
  for (int n = 0; n < 40; ++n) {
    this->take(n);
    ASSERT_EQ(validate(this->children(), this->blobs_), ShapeFault::none);
    const auto got = mass_properties(this->children(), S(2), this->contents());
    const scenes::StretchedHull wanted = scenes::stretched(*this->exact_, this->radius_);
    const double mass = 2 * wanted.volume;
    EXPECT_NEAR(to_double(got.mass), mass, mass * pick<S>(1e-6, 1e-13, 1e-3, 1e-8) + grain<S>(mass));
    expect_near(real(got.centre), to_world(oracle::real(this->place()), this->exact_->centre),
                pick<S>(2e-6, 4e-9, 1e-4, 4e-9));
    double trace = 0, got_trace = 0;
    for (int i = 0; i < 3; ++i) trace += 2 * wanted.moments.rows[i][i], got_trace += 1 / to_double(got.kappa[i]);
    EXPECT_NEAR(got_trace, trace, trace * pick<S>(1e-5, 1e-9, 2e-3, 1e-7)) << n;
  }
}

TYPED_TEST(RoundedHull, a_radius_below_nothing_or_too_large_is_a_fault) {
  using S = TypeParam;
  this->take(0);
  const auto fault_of = [&](S radius) {
    this->child_.primitive.radius = radius;
    return validate(this->children(), this->blobs_);
  };
  const S most = Limits<S>::extent();
  EXPECT_EQ(fault_of(S(0)), ShapeFault::none);
  EXPECT_EQ(fault_of(resolution<S>()), ShapeFault::none);
  EXPECT_EQ(fault_of(most * S(0.5)), ShapeFault::none);
  EXPECT_EQ(fault_of(-resolution<S>()), ShapeFault::radius_not_in_range);
  EXPECT_EQ(fault_of(most + S(1)), ShapeFault::radius_not_in_range);
  EXPECT_EQ(fault_of(most), ShapeFault::outside_extent);
}

TYPED_TEST(RoundedHull, what_is_drawn_is_closed_and_lies_on_the_surface) {
  using S = TypeParam;
  using Place = std::array<double, 3>;
  for (int n = 0; n < 8; ++n) {
    this->take(n);
    std::map<std::pair<Place, Place>, int> sides;
    const auto place = [](Vec3<S> v) { return Place{to_double(v.x), to_double(v.y), to_double(v.z)}; };
    const auto look = [&](Vec3<S> v) {
      const double off = this->signed_distance(real(v));
      ASSERT_NEAR(off, 0, pick<S>(1e-6, 1e-12, 1e-4, 1e-8));
    };
    const Hull<S> hull = shape_as<Hull>(this->view());
    hull.visit_triangles([&](Vec3<S> a, Vec3<S> b, Vec3<S> c) {
      look(a);
      const Place corners[3] = {place(a), place(b), place(c)};
      for (int i = 0; i < 3; ++i) ++sides[{corners[i], corners[(i + 1) % 3]}];
    });
    for (const auto& [side, times] : sides) {
      ASSERT_EQ(times, 1);
      ASSERT_EQ(sides.count({side.second, side.first}), 1u);
    }
    hull.visit_lines([&](Vec3<S> from, Vec3<S> to) { look(from), look(to); });
  }
}

/// The exact volume of what is within a radius of a convex solid, by Steiner's formula, beside the stretched core's.
TEST(RoundedHullMass, errs_by_what_its_file_says) {
  const auto error = [](const std::vector<D3>& points) {
    const auto hull = scenes::solid_hull(*hull_blob(std::span<const D3>(points)).value());
    double width = 0, area = 0, turns = 0;
    for (int i = 0; i < 3; ++i) {
      double low = 1e9, high = -1e9;
      for (const D3 v : hull->vertices) low = std::min(low, v[i]), high = std::max(high, v[i]);
      width = std::max(width, high - low);
    }
    for (const auto& t : hull->triangles) area += length(cross(t[1] - t[0], t[2] - t[0])) / 2;
    for (const auto& e : hull->edges) {  // its faces: those that hold both ends
      std::vector<D3> normals;
      for (const D3 n : hull->normals) {
        double offset = -1e9;
        for (const D3 v : hull->vertices) offset = std::max(offset, dot(n, v));
        if (offset - dot(n, e[0]) < 1e-9 && offset - dot(n, e[1]) < 1e-9) normals.push_back(n);
      }
      turns += length(e[1] - e[0]) * std::acos(std::clamp(dot(normals.at(0), normals.at(1)), -1.0, 1.0)) / 2;
    }
    const double r = width / 10;
    const double exact = hull->volume + area * r + turns * r * r + 4 * std::numbers::pi / 3 * r * r * r;
    return scenes::stretched(*hull, r).volume / exact - 1;
  };
  std::vector<D3> cube, rock;
  for (int i = 0; i < 8; ++i) cube.push_back({i & 1 ? 1.0 : 0.0, i & 2 ? 1.0 : 0.0, i & 4 ? 1.0 : 0.0});
  oracle::Random random(3);
  while (rock.size() < 20) rock.push_back(random.direction());
  EXPECT_NEAR(error(cube), 0.018, 0.002);
  EXPECT_NEAR(error({{1, 1, 1}, {-1, -1, 1}, {-1, 1, -1}, {1, -1, -1}}), -0.25, 0.01);
  EXPECT_NEAR(error(rock), -0.084, 0.01);
}

}  // namespace rounded_hull_test
}  // namespace isostep::test
