// Refusals of worlds by name: parts of shapes, limits that never act, rays without length, masses beyond the format.
// SPDX-License-Identifier: MIT
#include <limits>
#include <string>

#include "isostep/world/joint_presets.hpp"
#include "unit/world/worlds.hpp"

namespace isostep::test {
namespace refusals_test {

template <class S> class Refusals : public ::testing::Test {
 protected:
  World<S> w{settings<S>()};
};
TYPED_TEST_SUITE(Refusals, AllScalars);

TYPED_TEST(Refusals, a_shape_is_refused_with_its_child_and_field) {
  using S = TypeParam;
  using U = Unit<S>;
  const Child<S> good = part_at(primitive_of(Sphere<S>{S(1)}), {0, 0, 0});
  struct Case {
    Child<S> wrong;
    const char* field;
    const char* expected;
  };
  const auto part = [](const auto& shape) { return part_at<S>(primitive_of(shape), {0, 0, 0}); };
  Child<S> turned = good, far = good, odd = good;
  turned.pose.orientation = {U(0), U(0), U(0), U(0.5)};
  far.pose.position.y = Limits<S>::extent();
  odd.primitive.offset = S(1);
  const std::vector<Case> cases = {
      {part(Sphere<S>{S(0)}), "primitive.radius", "above 0"},
      {part(Sphere<S>{S(-1)}), "primitive.radius", "above 0"},
      {part(Capsule<S>{S(-1), S(1)}), "primitive.radius", "above 0"},
      {part(Capsule<S>{S(1), S(0)}), "primitive.half", "above 0"},
      {part(Cylinder<S>{S(1), S(-1)}), "primitive.half", "above 0"},
      {part(Box<S>{vec<S>(1, 0, 1)}), "primitive.half", "above 0"},
      {part(Box<S>{{S(1), Limits<S>::minimum_size() * S(0.5), S(1)}}), "primitive.half",
       "Limits::minimum_size() or more"},
      {part(Sphere<S>{Limits<S>::extent() * S(2)}), "primitive.radius", "up to Limits::extent()"},
      {part(HalfSpace<S>{{U(0), U(0.5), U(0)}, S(0)}), "primitive.normal", "a vector of length 1"},
      {turned, "pose.orientation", "a quaternion of length 1"},
      {far, "pose.position", "all of the child up to Limits::extent() from the body's origin"},
      {odd, "primitive.offset", "0: the type does not use it"},
  };
  for (std::size_t i = 0; i < cases.size(); ++i) {
    for (const std::uint32_t before : {0u, 1u, 11u}) {
      std::vector<Child<S>> children(before, good);
      children.push_back(cases[i].wrong);
      children.push_back(good);
      EXPECT_FALSE(this->w.add_shape(std::span<const Child<S>>(children)));
      const FaultReport& fault = this->w.fault();
      EXPECT_EQ(fault.fault, Fault::bad_shape) << i;
      EXPECT_STREQ(fault.field, cases[i].field) << i;
      EXPECT_STREQ(fault.expected, cases[i].expected) << i;
      EXPECT_EQ(fault.child, before) << i;
      EXPECT_NE(describe(fault).find("add_shape: child " + std::to_string(before) + ": " + cases[i].field),
                std::string::npos);
    }
  }
  EXPECT_FALSE(this->w.add_shape(std::span<const Child<S>>()));
  EXPECT_STREQ(this->w.fault().field, "children");
  EXPECT_EQ(this->w.fault().child, FaultReport::kNoChild);
  if constexpr (!kIsFixed<S>) {
    Child<S> lost = good;
    lost.pose.position.x = std::numeric_limits<S>::quiet_NaN();
    EXPECT_FALSE(this->w.add_shape(std::span<const Child<S>>(&lost, 1)));
    EXPECT_EQ(this->w.fault().fault, Fault::not_finite);
    EXPECT_STREQ(this->w.fault().field, "pose.position");
  }
}

TYPED_TEST(Refusals, limits_wider_than_a_turn_are_refused) {
  using S = TypeParam;
  const BodyId b = this->w.create(moving<S>(add_box(this->w, 0.5, 0.5, 0.5), {0, 0, 0}));
  const auto hinge_between = [&](double lower, double upper) {
    return this->w.create(hinge<S>({.b = b, .limit = {{num<S>(lower), num<S>(upper)}}}));
  };
  for (const double middle : {-2.0, 0.0, 1.0}) {
    EXPECT_TRUE(hinge_between(middle - 3.14, middle + 3.14)) << describe(this->w.fault());
    EXPECT_FALSE(hinge_between(middle - 3.2, middle + 3.2));
    EXPECT_STREQ(this->w.fault().field, "upper");
  }
  EXPECT_FALSE(hinge_between(-6, 6));
  OneAxisJoint<S> slide;
  slide.b = b;
  slide.limit = {{S(-10), S(10)}};
  EXPECT_TRUE(this->w.create(slider(slide))) << describe(this->w.fault());
}

TYPED_TEST(Refusals, rays_without_length_are_refused_wherever_they_begin) {
  using S = TypeParam;
  this->w.create(still<S>(add_ball(this->w, 1), {0, 0, 0}));
  for (const double y : {0.0, 0.5, 1.0, 3.0}) {
    EXPECT_FALSE(this->w.cast_ray(vec<S>(0, y, 0), Vec3<S>::zero()));
    EXPECT_STREQ(this->w.fault().field, "translation");
    std::vector<RayCastHit<S>> all;
    this->w.cast_ray_all(vec<S>(0, y, 0), Vec3<S>::zero(), all);
    EXPECT_TRUE(all.empty());
  }
  // The shortest that the format holds has a direction.
  for (int axis = 0; axis < 3; ++axis) {
    Vec3<S> way = Vec3<S>::zero();
    way[axis] = resolution<S>();
    const auto hit = this->w.cast_ray(vec<S>(0.25, 0.25, 0.25), way);
    if (hit) {
      EXPECT_GT(length(real(hit->normal)), 0.9);
    }
  }
}

TYPED_TEST(Refusals, a_density_that_makes_more_mass_than_the_format_holds_is_refused) {
  using S = TypeParam;
  const double most = to_double(Limits<S>::mass());
  BodyDefinition<S> d = moving<S>(add_box(this->w, 5, 5, 5), {0, 0, 0});  // 1000 m^3
  d.density = num<S>(std::fmin(most / 1100, 1e9));
  EXPECT_TRUE(this->w.create(d)) << describe(this->w.fault());
  if constexpr (std::is_same_v<S, Q16_16>) {
    d.density = S(800);
    EXPECT_FALSE(this->w.create(d));
    EXPECT_EQ(this->w.fault().fault, Fault::bad_mass);
    EXPECT_STREQ(this->w.fault().field, "density");
    d.mass = S(1000);  // its own
    EXPECT_TRUE(this->w.create(d)) << describe(this->w.fault());
  }
}

}  // namespace refusals_test
}  // namespace isostep::test
