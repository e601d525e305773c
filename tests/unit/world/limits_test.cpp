// The limits of a scalar in a world: speeds and places that it takes, what a step cuts, what it writes and reads.
// SPDX-License-Identifier: MIT
#include "unit/world/refusing_world.hpp"

namespace isostep::test {
namespace limits_test {

template <class S> class WorldLimits : public RefusingWorld<S> {};
TYPED_TEST_SUITE(WorldLimits, AllScalars);

TYPED_TEST(WorldLimits, a_speed_is_a_length_and_not_that_of_an_axis) {
  using S = TypeParam;
  World<S>& w = this->world;
  const S most = Limits<S>::speed(), angular_speed = Limits<S>::angular_speed();
  const Vec3<S> zero = Vec3<S>::zero();
  EXPECT_FALSE(w.set_velocity(this->a, {most, most, most}, zero));
  this->expect_fault(Fault::out_of_range, "set_velocity", "linear");
  EXPECT_FALSE(w.set_velocity(this->a, zero, {angular_speed, angular_speed, S(0)}));
  this->expect_fault(Fault::out_of_range, "set_velocity", "angular");
  BodyDefinition<S> d = moving<S>(this->ball, {0, 9, 0});
  d.velocity = {most, most, most};
  EXPECT_FALSE(w.create(d));
  this->expect_fault(Fault::out_of_range, "create_body", "velocity");
  Material<S> m;
  m.surface_velocity = {most, S(0), most};
  EXPECT_FALSE(w.set_material(this->a, m));
  this->expect_fault(Fault::out_of_range, "set_material", "material.surface_velocity");
  for (const Vec3<S>& along : {Vec3<S>{most, S(0), S(0)}, Vec3<S>{S(0), -most, S(0)}})
    EXPECT_TRUE(w.set_velocity(this->a, along, zero));
}

TYPED_TEST(WorldLimits, what_a_step_cuts_is_no_longer_than_the_limit_and_points_where_it_did) {
  using S = TypeParam;
  World<S> w(settings<S>(0));
  const S part = Limits<S>::speed() * num<S>(0.9);
  const BodyId body = w.create(moving<S>(add_ball(w, 0.5), {0, 0, 0}));
  const S mass = w.mass(body);
  ASSERT_TRUE(w.apply_impulse(body, Vec3<S>{part, part, part} * mass));
  EXPECT_EQ(w.step().clamped_speed, 1u);
  const D3 v = real(w.velocity(body));
  EXPECT_LE(length(v), to_double(Limits<S>::speed()));
  EXPECT_GE(length(v), to_double(Limits<S>::speed()) * 0.999);
  expect_near(v, D3{1, 1, 1} * (length(v) / std::sqrt(3.0)), 1e-3 * length(v));
  EXPECT_TRUE(w.set_velocity(body, w.velocity(body), Vec3<S>::zero())) << "a world takes what it gives";
  EXPECT_EQ(w.step().clamped_speed, 0u);
}

TYPED_TEST(WorldLimits, what_a_world_writes_it_reads_wherever_a_body_was_put) {
  using S = TypeParam;
  World<S>& w = this->world;
  const S edge = Limits<S>::position();
  const Child<S> aside = {primitive_of(Sphere<S>{num<S>(0.5)}), {vec<S>(2, 0, 0), Quat<Unit<S>>::identity()}};
  const ShapeId shape = w.add_shape(std::span<const Child<S>>(&aside, 1));
  BodyDefinition<S> d = moving<S>(shape, {0, 9, 0});
  const auto expect_readable = [&] {
    const std::vector<std::uint8_t> bytes = bytes_of(w);
    Reader reader(bytes);
    const Result<void> read = World<S>(settings<S>()).read_portable(reader);
    EXPECT_TRUE(read) << (read.ok() ? "" : read.error().message.view());
  };
  for (const BodyType type : {BodyType::dynamic, BodyType::kinematic, BodyType::static_}) {
    d.type = type;
    d.position = {edge, S(0), S(0)};
    EXPECT_FALSE(w.create(d)) << "its centre would be 2 m beyond the edge";
    this->expect_fault(Fault::out_of_range, "create_body", "position");
    d.position.x = edge - S(2);
    const BodyId body = w.create(d);
    ASSERT_TRUE(body);
    expect_readable();
    EXPECT_FALSE(w.set_pose(body, {{edge, S(0), S(0)}, Quat<Unit<S>>::identity()}));
    this->expect_fault(Fault::out_of_range, "set_pose", "position");
    EXPECT_TRUE(w.set_pose(body, {{edge, S(0), S(0)}, turn<S>({0, 1, 0}, kPi)})) << "turned, it lies inside";
    expect_readable();
  }
}

}  // namespace limits_test
}  // namespace isostep::test
