// Every way in which a shape can be refused, one test each.
// SPDX-License-Identifier: MIT
#include "isostep/geometry/validate.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include "isostep/geometry/limits.hpp"

namespace isostep {
namespace validate_test {

template <class S> class ValidateTest : public testing::Test {
 protected:
  static Primitive<S> ball(S radius) { return primitive_of(Sphere<S>{radius}); }
  static Primitive<S> box(S x, S y, S z) { return primitive_of(Box<S>{{x, y, z}}); }
  static Primitive<S> rod(S radius, S half_height) { return primitive_of(Capsule<S>{radius, half_height}); }
  static Primitive<S> plane(Unit<S> x, Unit<S> y, Unit<S> z, S offset) {
    return primitive_of(HalfSpace<S>{{x, y, z}, offset});
  }
  static Child<S> at(Primitive<S> p, Vec3<S> position) {
    Child<S> child = {p, Pose<S>::identity()};
    child.pose.position = position;
    return child;
  }
  static ShapeFault check(const std::vector<Child<S>>& list) { return validate<S>(std::span<const Child<S>>(list)); }
};
using Scalars = testing::Types<float, double, Q16_16, Q32_32>;
TYPED_TEST_SUITE(ValidateTest, Scalars);

TYPED_TEST(ValidateTest, OrdinaryShapesPass) {
  using S = TypeParam;
  EXPECT_EQ(validate(this->ball(S(0.5))), ShapeFault::none);
  EXPECT_EQ(validate(this->box(S(100), S(1), S(100))), ShapeFault::none);
  EXPECT_EQ(validate(this->rod(S(0.25), S(0.5))), ShapeFault::none);
  EXPECT_EQ(validate(this->plane(Unit<S>(0.6), Unit<S>(0.8), Unit<S>(0), S(-3))), ShapeFault::none);
  EXPECT_EQ(this->check({this->at(this->ball(S(1)), {S(2), S(0), S(0)}), this->at(this->ball(S(2)), Vec3<S>::zero())}),
            ShapeFault::none);
}

TYPED_TEST(ValidateTest, SizesAtTheLimitsPass) {
  using S = TypeParam;
  const S most = Limits<S>::extent(), least = Limits<S>::minimum_size();
  EXPECT_EQ(this->check({this->at(this->box(most, least, most), Vec3<S>::zero())}), ShapeFault::none);
}

TYPED_TEST(ValidateTest, AnEmptyListIsRefused) { EXPECT_EQ(this->check({}), ShapeFault::no_children); }

TYPED_TEST(ValidateTest, AnUnknownTypeIsRefused) {
  auto p = this->ball(TypeParam(1));
  p.type = static_cast<ShapeType>(kShapeTypes);
  EXPECT_EQ(validate(p), ShapeFault::unknown_type);
}

TYPED_TEST(ValidateTest, ZeroAndNegativeSizesAreRefused) {
  using S = TypeParam;
  for (const S bad : {S(0), S(-1)}) {
    EXPECT_EQ(validate(this->ball(bad)), ShapeFault::size_not_positive);
    EXPECT_EQ(validate(this->box(bad, S(1), S(1))), ShapeFault::size_not_positive);
    EXPECT_EQ(validate(this->box(S(1), bad, S(1))), ShapeFault::size_not_positive);
    EXPECT_EQ(validate(this->box(S(1), S(1), bad)), ShapeFault::size_not_positive);
    EXPECT_EQ(validate(this->rod(bad, S(1))), ShapeFault::size_not_positive);
    EXPECT_EQ(validate(this->rod(S(1), bad)), ShapeFault::size_not_positive);
  }
}

TYPED_TEST(ValidateTest, SizesBelowTheSmallestAreRefused) {
  using S = TypeParam;
  const S tiny = Limits<S>::minimum_size() * S(0.5);
  EXPECT_EQ(validate(this->ball(tiny)), ShapeFault::size_too_small);
  EXPECT_EQ(validate(this->box(S(1), S(1), tiny)), ShapeFault::size_too_small);
  EXPECT_EQ(validate(this->rod(S(1), tiny)), ShapeFault::size_too_small);
}

TYPED_TEST(ValidateTest, SizesAboveTheExtentAreRefused) {
  using S = TypeParam;
  const S huge = Limits<S>::extent() + S(1);
  EXPECT_EQ(validate(this->ball(huge)), ShapeFault::size_too_large);
  EXPECT_EQ(validate(this->box(huge, S(1), S(1))), ShapeFault::size_too_large);
  EXPECT_EQ(validate(this->rod(S(1), huge)), ShapeFault::size_too_large);
}

TYPED_TEST(ValidateTest, AHalfSpaceOutOfTheWorldIsRefused) {
  using S = TypeParam;
  const S far = Limits<S>::position() + S(1);
  EXPECT_EQ(validate(this->plane(Unit<S>(0), Unit<S>(1), Unit<S>(0), far)), ShapeFault::offset_too_large);
  EXPECT_EQ(validate(this->plane(Unit<S>(0), Unit<S>(1), Unit<S>(0), -far)), ShapeFault::offset_too_large);
}

TYPED_TEST(ValidateTest, ANormalThatIsNotUnitIsRefused) {
  using S = TypeParam;
  using U = Unit<S>;
  EXPECT_EQ(validate(this->plane(U(0), U(0), U(0), S(0))), ShapeFault::normal_not_unit);
  EXPECT_EQ(validate(this->plane(U(1), U(1), U(0), S(0))), ShapeFault::normal_not_unit);
  EXPECT_EQ(validate(this->plane(U(0), U(0.9), U(0), S(0))), ShapeFault::normal_not_unit);
  // Squares that overflow the sum must not pass for one.
  EXPECT_EQ(validate(this->plane(U(-1.99), U(-1.99), U(-1.99), S(0))), ShapeFault::normal_not_unit);
}

TYPED_TEST(ValidateTest, AnOrientationThatIsNotUnitIsRefused) {
  using S = TypeParam;
  using U = Unit<S>;
  for (const Quat<U> bad : {Quat<U>{U(0), U(0), U(0), U(0)}, Quat<U>{U(0.5), U(0), U(0), U(1)},
                            Quat<U>{U(-1.99), U(-1.99), U(-1.99), U(-1.99)}}) {
    Child<S> child = this->at(this->ball(S(1)), Vec3<S>::zero());
    child.pose.orientation = bad;
    EXPECT_EQ(validate(child.pose), ShapeFault::orientation_not_unit);
    EXPECT_EQ(this->check({child}), ShapeFault::orientation_not_unit);
  }
}

TYPED_TEST(ValidateTest, AFieldThatTheTypeDoesNotUseMustBeZero) {
  using S = TypeParam;
  auto with_blob = this->ball(S(1));
  with_blob.blob = 1;
  EXPECT_EQ(validate(with_blob), ShapeFault::unused_field_set);
  auto ball = this->ball(S(1));
  ball.half.x = S(1);
  EXPECT_EQ(validate(ball), ShapeFault::unused_field_set);
  auto box = this->box(S(1), S(1), S(1));
  box.radius = S(0.25);
  EXPECT_EQ(validate(box), ShapeFault::unused_field_set);
  auto rod = this->rod(S(1), S(1));
  rod.half.z = S(1);
  EXPECT_EQ(validate(rod), ShapeFault::unused_field_set);
  auto plane = this->plane(Unit<S>(0), Unit<S>(1), Unit<S>(0), S(0));
  plane.radius = S(1);
  EXPECT_EQ(validate(plane), ShapeFault::unused_field_set);
  auto tilted = this->ball(S(1));
  tilted.normal.y = Unit<S>(1);
  EXPECT_EQ(validate(tilted), ShapeFault::unused_field_set);
}

TYPED_TEST(ValidateTest, AChildThatReachesTooFarIsRefused) {
  using S = TypeParam;
  const S extent = Limits<S>::extent();
  const auto ball = this->ball(S(1));
  EXPECT_EQ(this->check({this->at(ball, {extent - S(1), S(0), S(0)})}), ShapeFault::none);
  EXPECT_EQ(this->check({this->at(ball, {S(0), extent - S(0.5), S(0)})}), ShapeFault::outside_extent);
  EXPECT_EQ(this->check({this->at(ball, {S(0), S(0), -(extent + extent)})}), ShapeFault::outside_extent);
}

TEST(Validate, NumbersThatAreNotFiniteAreRefused) {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                           -std::numeric_limits<double>::infinity()}) {
    EXPECT_EQ(validate(primitive_of(Sphere<double>{bad})), ShapeFault::not_finite);
    EXPECT_EQ(validate(primitive_of(Box<double>{{1, bad, 1}})), ShapeFault::not_finite);
    EXPECT_EQ(validate(primitive_of(Capsule<double>{1, bad})), ShapeFault::not_finite);
    EXPECT_EQ(validate(primitive_of(HalfSpace<double>{{0, bad, 0}, 0})), ShapeFault::not_finite);
    EXPECT_EQ(validate(primitive_of(HalfSpace<double>{{0, 1, 0}, bad})), ShapeFault::not_finite);
    EXPECT_EQ(validate(Pose<double>{{0, 0, bad}, Quat<double>::identity()}), ShapeFault::not_finite);
    EXPECT_EQ(validate(Pose<double>{{0, 0, 0}, {0, 0, 0, bad}}), ShapeFault::not_finite);
  }
}

TYPED_TEST(ValidateTest, NearlyUnitDirectionsAreNormalised) {
  using S = TypeParam;
  using U = Unit<S>;
  Child<S> child = this->at(this->plane(U(0.603), U(0.804), U(0), S(0)), Vec3<S>::zero());
  child.pose.orientation = {U(0), U(0.704), U(0), U(0.712)};
  ASSERT_EQ(this->check({child}), ShapeFault::none);
  const Child<S> unit = normalised(child);
  const double slack = 8 * to_double(resolution<U>());
  EXPECT_NEAR(to_double(unit.primitive.normal.x), 0.6, slack);
  EXPECT_NEAR(to_double(unit.primitive.normal.y), 0.8, slack);
  const double y = to_double(unit.pose.orientation.y), w = to_double(unit.pose.orientation.w);
  EXPECT_NEAR(y * y + w * w, 1, slack);
  EXPECT_NEAR(y / w, 0.704 / 0.712, slack);
}

TYPED_TEST(ValidateTest, UnitDirectionsStayBitForBit) {
  using S = TypeParam;
  using U = Unit<S>;
  Child<S> child = this->at(this->plane(U(0), U(-1), U(0), S(0)), Vec3<S>::zero());
  child.pose.orientation = {U(0.5), U(-0.5), U(0.5), U(0.5)};
  const Child<S> unit = normalised(child);
  EXPECT_EQ(unit.primitive.normal, child.primitive.normal);
  EXPECT_EQ(unit.pose.orientation, child.pose.orientation);
}

TEST(Validate, EveryFaultHasItsOwnWords) {
  std::set<std::string> words;
  for (std::uint32_t i = 0; i <= static_cast<std::uint32_t>(ShapeFault::outside_extent); ++i) {
    words.insert(describe(static_cast<ShapeFault>(i)));
  }
  EXPECT_EQ(words.size(), static_cast<std::size_t>(ShapeFault::outside_extent) + 1);
  EXPECT_EQ(words.count("unknown fault"), 0u);
}

}  // namespace validate_test
}  // namespace isostep
