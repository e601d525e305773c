// Hulls as shapes, in every scalar: mass against sums in double, boxes, rays and closest points against the faces.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "isostep/collision/query/closest_point.hpp"
#include "isostep/collision/query/ray_cast.hpp"
#include "isostep/geometry/bounds.hpp"
#include "isostep/geometry/content.hpp"
#include "isostep/geometry/mass_properties.hpp"
#include "isostep/geometry/validate.hpp"
#include "sample.hpp"
#include "scenes/hull_points.hpp"
#include "unit/geometry/hull_recipes.hpp"
#include "unit/geometry/oracle.hpp"
#include "unit/world/worlds.hpp"

namespace isostep::test {
namespace hull_shape_test {

template <class U> Quat<double> real_quat(Quat<U> q) {
  return {to_double(q.x), to_double(q.y), to_double(q.z), to_double(q.w)};
}

template <class S> class HullShape : public ::testing::Test {
 protected:
  /// A recipe, moved away from its origin, so that its centre of mass is not there.
  void take(int n, double scale = 1) {
    scenes::Draws draws(static_cast<std::uint32_t>(n) + 1);
    std::vector<D3> points;
    for (const scenes::Point& p : scenes::drawn_hull(n, draws).points)
      points.push_back(D3{p.x + 0.5 * (n % 3), p.y, p.z - 0.25 * (n % 5)} * scale);
    blobs_ = {hull_blob(std::span<const D3>(points)).value()};
    exact_ = scenes::solid_hull(*blobs_[0]);
    offsets_.clear();
    for (const D3 normal : exact_->normals) {
      double offset = -1e9;
      for (const D3 v : exact_->vertices) offset = std::max(offset, dot(normal, v));
      offsets_.push_back(offset);
    }
    child_ = {Hull<S>{1}.primitive(), {vec<S>(random_.point(0.5)), random_.template orientation<S>()}};
    find_contents<S>(blobs_, contents_);
  }
  std::span<const Child<S>> children() const { return {&child_, 1}; }
  Contents<S> contents() const { return {contents_.data()}; }
  ShapeView<S> view() const { return contents().view(child_.primitive); }
  double signed_distance(D3 p) const {  // of a point in the hull's frame, where it is inside
    double most = -1e9;
    for (std::size_t f = 0; f < offsets_.size(); ++f) most = std::max(most, dot(exact_->normals[f], p) - offsets_[f]);
    return most;
  }

  oracle::Random random_{7};
  std::vector<BlobRef> blobs_;
  std::shared_ptr<const scenes::SolidHull> exact_;
  std::vector<double> offsets_;  // [m] of its faces
  Child<S> child_;
  std::vector<const void*> contents_;
};
TYPED_TEST_SUITE(HullShape, AllScalars);

TYPED_TEST(HullShape, mass_centre_and_inertia_are_those_of_its_tetrahedra) {
  using S = TypeParam;
  for (int n = 0; n < 60; ++n) {
    this->take(n, n % 2 == 0 ? 1 : 8);
    ASSERT_EQ(validate(this->children(), this->blobs_), ShapeFault::none);
    const auto got = mass_properties(this->children(), S(2), this->contents());
    const double mass = 2 * this->exact_->volume;
    EXPECT_NEAR(to_double(got.mass), mass, mass * pick<S>(1e-6, 1e-13, 1e-3, 1e-8) + grain<S>(mass)) << n;
    const Transform<double> place = oracle::real(Transform<S>::of(this->child_.pose));
    // The exact centre is told in 2^-16 steps of the hull's grid: 2e-9 m here.
    expect_near(real(got.centre), to_world(place, this->exact_->centre), pick<S>(2e-6, 4e-9, 1e-4, 4e-9));
    // The tensor, from its principal axes, against the sum of tetrahedra.
    const D3 kappa = real(got.kappa);
    const Mat3<double> axes = to_matrix(real_quat(got.principal));
    const Mat3<double> inertia = rotate_diagonal(axes, D3{1 / kappa.x, 1 / kappa.y, 1 / kappa.z});
    const Mat3<double>& m = this->exact_->moments;
    const double trace = m.rows[0].x + m.rows[1].y + m.rows[2].z;
    const Mat3<double> own = Mat3<double>::diagonal({trace, trace, trace}) +
                             Mat3<double>{{m.rows[0] * -1.0, m.rows[1] * -1.0, m.rows[2] * -1.0}};
    const Mat3<double> wanted = place.rotation * (own * transpose(place.rotation));
    for (int i = 0; i < 3; ++i)
      expect_near(inertia.rows[i], wanted.rows[i], trace * pick<S>(1e-5, 1e-9, 2e-3, 1e-7), "inertia");
  }
}

TYPED_TEST(HullShape, its_box_holds_its_vertices_and_touches_them) {
  using S = TypeParam;
  for (int n = 0; n < 40; ++n) {
    this->take(n);
    const Transform<S> place = Transform<S>::of(this->child_.pose);
    const Transform<double> exact = oracle::real(place);
    D3 low = {1e9, 1e9, 1e9}, high = {-1e9, -1e9, -1e9};
    for (const D3 v : this->exact_->vertices) {
      low = min(low, to_world(exact, v));
      high = max(high, to_world(exact, v));
    }
    const Aabb<S> box = bounds(this->view(), place);
    expect_near(real(box.low), low, 4 * grain<S>(4));
    expect_near(real(box.high), high, 4 * grain<S>(4));
  }
}

TYPED_TEST(HullShape, rays_enter_where_the_faces_are) {
  using S = TypeParam;
  const int rays = sampled(40, 12);  // of each hull
  int hits = 0, misses = 0;
  for (int n = 0; n < 40; ++n) {
    this->take(n);
    const Transform<S> place = Transform<S>::of(this->child_.pose);
    const Transform<double> exact = oracle::real(place);
    for (int k = 0; k < rays; ++k) {
      const D3 aim = to_world(exact, this->exact_->centre) + this->random_.point(0.5);
      const D3 origin = aim + this->random_.direction() * 6.0, translation = (aim - origin) * 2.0;
      RayHit<S> hit;
      const bool met = ray_cast(this->view(), place, vec<S>(origin), vec<S>(translation), S(1), hit);
      double least = 1e9;  // of the way, sampled
      for (int i = 0; i <= 4000; ++i)
        least = std::min(least, this->signed_distance(to_local(exact, origin + translation * (i / 4000.0))));
      if (std::fabs(least) < 0.004) continue;
      ASSERT_EQ(met, least < 0) << n << " " << k;
      met ? ++hits : ++misses;
      if (!met) continue;
      const D3 at = origin + translation * to_double(hit.fraction);
      EXPECT_NEAR(this->signed_distance(to_local(exact, at)), 0, pick<S>(1e-4, 1e-12, 2e-3, 1e-7));
      EXPECT_LT(dot(real(hit.normal), translation), 0);
    }
  }
  EXPECT_GT(hits, rays * 300 / 40);
  EXPECT_GT(misses, rays * 100 / 40);
}

TYPED_TEST(HullShape, the_closest_point_lies_on_the_surface_at_the_distance_told) {
  using S = TypeParam;
  for (int n = 0; n < 40; ++n) {
    this->take(n);
    const Transform<S> place = Transform<S>::of(this->child_.pose);
    const Transform<double> exact = oracle::real(place);
    for (int k = 0; k < 40; ++k) {
      const D3 query = to_world(exact, this->exact_->centre) + this->random_.point(1.0);
      const ClosestPoint<S> got = closest_point(this->view(), place, vec<S>(query));
      const double bar = pick<S>(4e-6, 1e-13, 1e-3, 1e-8);
      EXPECT_NEAR(this->signed_distance(to_local(exact, real(got.point))), 0, bar);
      expect_near(real(got.point) + real(got.normal) * to_double(got.distance), query, bar);
      const double inside = this->signed_distance(to_local(exact, query));
      if (inside < 0) EXPECT_NEAR(to_double(got.distance), inside, bar);
      else EXPECT_GE(to_double(got.distance), inside - bar);
    }
  }
}

TYPED_TEST(HullShape, too_small_too_large_or_of_another_type_is_a_fault) {
  using S = TypeParam;
  const auto fault_of = [&](const std::vector<D3>& points) {
    const std::vector<BlobRef> blobs = {hull_blob(std::span<const D3>(points)).value()};
    const Child<S> child = {Hull<S>{1}.primitive(), Pose<S>::identity()};
    return validate(std::span<const Child<S>>(&child, 1), blobs);
  };
  const double least = to_double(Limits<S>::minimum_size()), most = to_double(Limits<S>::extent());
  const auto wedge = [](double x, double y, double z) {
    return std::vector<D3>{{x, y, z}, {-x, -y, z}, {-x, y, -z}, {x, -y, -z}};
  };
  EXPECT_EQ(fault_of(wedge(least, 2 * least, 2 * least)), ShapeFault::none);
  EXPECT_EQ(fault_of(wedge(least / 2, 2 * least, 2 * least)), ShapeFault::size_too_small);
  if (most < 1e5) {
    EXPECT_EQ(fault_of(wedge(most * 1.5, most * 1.5, most * 1.5)), ShapeFault::size_too_large);
  }
  this->take(0);
  EXPECT_EQ(validate(this->children()), ShapeFault::blob_missing);
  const std::vector<BlobRef> strange = {Blob::make(ShapeType::hull, {1, 2, 3})};
  EXPECT_EQ(validate(this->children(), strange), ShapeFault::blob_not_valid);
  const std::vector<BlobRef> other = {Blob::make(ShapeType::box, {})};
  EXPECT_EQ(validate(this->children(), other), ShapeFault::blob_missing);
}

}  // namespace hull_shape_test
}  // namespace isostep::test
