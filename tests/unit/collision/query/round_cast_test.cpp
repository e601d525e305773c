// Casts of balls and capsules in closed form against the search that they spare.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "isostep/collision/query/solid_cast.hpp"
#include "unit/collision/query/cores.hpp"

namespace isostep::test {
namespace round_cast_test {

using oracle::D3;
using Scalars = testing::Types<float, double, Q16_16, Q32_32>;

template <class S> class RoundCasts : public testing::Test {
 protected:
  /// A ball or capsule on its way past or into a ball, capsule or box, and both answers.
  struct Both {
    bool by_segments, by_search;
    SolidHit<S> segments;
    CastHit<S> search;
    Vec3<S> way;
    Parting<S> parting;
  };
  Both cast(int n) {
    const CoreKind kinds[] = {CoreKind::point, CoreKind::segment, CoreKind::box};
    const CoreKind of_b = kinds[n / 2 % 3];
    a_ = random_core<S>(kinds[n % 2], 0.5, random_);
    b_ = random_core<S>(of_b, 0.5, random_);
    from_ = {oracle::made<S>({0, 0, 0}), to_matrix(random_.template orientation<S>())};
    const D3 to = random_.direction() * ((a_.size + b_.size) * random_.in(1.1, 3));
    at_ = {oracle::made<S>(to), to_matrix(random_.template orientation<S>())};
    Both both = {};
    both.way = oracle::made<S>(to * random_.in(0.5, 2) + random_.arrow_of((a_.size + b_.size) * random_.in(0, 1)));
    const CastMotion<S> motion = {both.way, Unit<S>(1), S(0), Unit<S>(1), &both.parting};
    both.by_segments =
        cast_solid(SolidCast<S>{a_.core(), from_, motion, false, false}, shape_of_b(of_b), at_, both.segments);
    both.by_search = cast_convex(a_.core(), from_, b_.core(), at_, {both.way, Unit<S>(1), S(0)}, both.search);
    return both;
  }
  ShapeView<S> shape_of_b(CoreKind kind) {
    if (kind == CoreKind::box) b_.radius = S(0);
    primitive_ = kind == CoreKind::point     ? primitive_of(Sphere<S>{b_.radius})
                 : kind == CoreKind::segment ? primitive_of(Capsule<S>{b_.radius, b_.vertices[1].y})
                                             : primitive_of(Box<S>{b_.vertices[7]});
    return primitive_;
  }

  oracle::Random random_{1};
  TestCore<S> a_, b_;
  Transform<S> from_, at_;
  Primitive<S> primitive_;
};
TYPED_TEST_SUITE(RoundCasts, Scalars);

TYPED_TEST(RoundCasts, meet_where_the_search_meets) {
  int hits = 0, differ = 0;
  for (int n = 0; n < 3000; ++n) {
    const auto both = this->cast(n);
    differ += both.by_segments != both.by_search;  // what passes by a rounding
    if (!both.by_segments || !both.by_search) continue;
    ++hits;
    const double apart =
        (to_double(both.segments.fraction) - to_double(both.search.fraction)) * oracle::length(oracle::real(both.way));
    ASSERT_LT(std::fabs(apart), 2e-3) << n;
    EXPECT_LT(dot(oracle::real(both.segments.normal), oracle::real(both.way)), 0) << n;
  }
  EXPECT_GT(hits, 1000);
  EXPECT_LE(differ, 3);
}

TYPED_TEST(RoundCasts, leave_a_plane_when_they_miss_that_no_other_way_crosses_unseen) {
  using S = TypeParam;
  int spared = 0;
  for (int n = 0; n < 3000; ++n) {
    const auto both = this->cast(n);
    if (both.by_segments || both.parting.normal == Vec3<Unit<S>>::zero()) continue;
    for (int k = 0; k < 4; ++k) {
      const Vec3<S> begin = oracle::made<S>(this->random_.direction() * 0.2);
      const Vec3<S> way = oracle::made<S>(this->random_.direction() * 2.0);
      if (!both.parting.holds(begin, way, S(0x1p-9))) continue;
      ++spared;
      CastHit<S> hit;
      const Transform<S> from = {begin, this->from_.rotation};
      EXPECT_FALSE(cast_convex(this->a_.core(), from, this->b_.core(), this->at_, {way, Unit<S>(1), S(0)}, hit)) << n;
    }
  }
  EXPECT_GT(spared, 500);
}

}  // namespace round_cast_test
}  // namespace isostep::test
