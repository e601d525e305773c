// The range of geometry: at the published limits nothing overflows, by formats that stop the program if anything does.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "isostep/collision/query/closest_point.inl"
#include "isostep/collision/query/ray_cast.inl"
#include "isostep/geometry/mass_properties.inl"
#include "isostep/geometry/validate.inl"
#include "oracle.hpp"

namespace isostep {
namespace range_test {

template <class S> class RangeTest : public testing::Test {};
using Formats = testing::Types<Fixed<std::int32_t, 16, Overflow::trap>, Fixed<std::int64_t, 32, Overflow::trap>,
                               Fixed<std::int64_t, 40, Overflow::trap>>;
TYPED_TEST_SUITE(RangeTest, Formats);

TYPED_TEST(RangeTest, MassPropertiesOfAnyValidCompoundStayInRange) {
  using S = TypeParam;
  oracle::Random random(1);
  const double extent = to_double(Limits<S>::extent()), least = to_double(Limits<S>::minimum_size()) * 1.01;
  int taken = 0;
  for (int n = 0; n < 3000; ++n) {
    std::vector<Child<S>> list;
    for (int i = 0; i <= n % 4; ++i) {
      list.push_back({random.primitive<S>((n + i) % 5, least, extent),
                      {oracle::made<S>(random.arrow_of(random.size(0.01, extent))), random.orientation<S>()}});
    }
    const std::span<const Child<S>> children(list);
    if (validate(children) != ShapeFault::none) continue;
    ++taken;
    const auto got = mass_properties(children, from_double<S>(random.size(0.1, 8000)));
    EXPECT_GT(got.mass, S(0));
    EXPECT_LE(got.mass, Limits<S>::mass());
    EXPECT_FALSE(min(got.kappa.x, min(got.kappa.y, got.kappa.z)) < S(0));
  }
  EXPECT_GT(taken, 1000);
}

TYPED_TEST(RangeTest, TheLargestShapeAtTheLimitIsStillValidAndBounded) {
  using S = TypeParam;
  const S e = Limits<S>::extent(), p = Limits<S>::position();
  oracle::Random random(2);
  for (int n = 0; n < 100; ++n) {
    const Primitive<S> box = primitive_of(Box<S>{{e, e, e}});
    const Transform<S> corner = {{p, -p, p}, to_matrix(random.orientation<S>())};
    const Aabb<S> around = bounds(box, corner);
    EXPECT_TRUE(contains(around, Aabb<S>::around(corner.position, {e, e, e})));
    EXPECT_GT(half_area(around), product(e, e));
  }
}

TYPED_TEST(RangeTest, RaysAndPointsAcrossTheWholeWorldStayInRange) {
  using S = TypeParam;
  oracle::Random random(3);
  const double extent = to_double(Limits<S>::extent()), least = to_double(Limits<S>::minimum_size()) * 1.01;
  const double position = to_double(Limits<S>::position());
  int hits = 0;
  for (int n = 0; n < 3000; ++n) {
    const bool plane = n % 6 == 5;
    const auto p = plane ? primitive_of(HalfSpace<S>{{Unit<S>(0.6), Unit<S>(0), Unit<S>(0.8)}, Limits<S>::position()})
                         : random.primitive<S>(n % 6, least, extent);
    const Transform<S> t = {oracle::made<S>(random.point(position)), to_matrix(random.orientation<S>())};
    const Vec3<S> origin = oracle::made<S>(random.point(position));
    const Vec3<S> translation = (t.position - origin) * from_double<S>(random.in(-0.5, 1));
    RayHit<S> hit;
    if (ray_cast(p, t, origin, translation, S(1), hit)) {
      ++hits;
      EXPECT_TRUE(hit.fraction >= S(0) && hit.fraction <= S(1));
    }
    EXPECT_TRUE(is_finite(closest_point(p, t, origin).distance));
  }
  EXPECT_GT(hits, 300);
}

}  // namespace range_test
}  // namespace isostep
