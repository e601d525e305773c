// The portable form from hands nobody vouches for: refused, or a world that steps; and numbers at a scalar's rim.
// SPDX-License-Identifier: MIT

#include <cstring>
#include <limits>

#include "determinism/mess.hpp"
#include "isostep/replay/world_kinds.hpp"

namespace isostep::test {
namespace portable_test {

template <class S> class PortableWorlds : public ::testing::Test {};
TYPED_TEST_SUITE(PortableWorlds, AllScalars);

template <class S> std::vector<std::uint8_t> sample() {
  World<S> w(settings<S>(-10, 60, 2));
  build_mess(w);
  for (std::uint64_t f = 0; f < 120; ++f) play(w, f);
  for (int i = 0; i < 400 && w.counts().asleep < 5; ++i) w.step();
  EXPECT_GT(w.counts().asleep, 0u);
  EXPECT_GT(w.counts().joints, 0u);
  w.apply_force(w.bodies()[3], vec<S>(1, 1, 1));
  return bytes_of(w);
}

TYPED_TEST(PortableWorlds, its_first_word_says_whose_it_is) {
  using S = TypeParam;
  const auto word = load_le<std::uint32_t>(bytes_of(World<S>()).data());
  bool same = false;
  EXPECT_TRUE(
      with_portable_world(word, [&](auto tag) { same = std::is_same_v<typename decltype(tag)::Type, World<S>>; }));
  EXPECT_TRUE(same);
  EXPECT_FALSE(with_portable_world(word ^ 1u << 24, [](auto) {}));
}

TYPED_TEST(PortableWorlds, a_form_cut_short_anywhere_is_refused_and_changes_nothing) {
  using S = TypeParam;
  const std::vector<std::uint8_t> bytes = sample<S>();
  World<S> w(settings<S>());
  add_ground(w);
  const std::uint64_t before = w.hash();
  for (std::size_t cut = 0; cut < bytes.size(); cut += 1 + cut / 16) {
    Reader reader({bytes.data(), cut});
    ASSERT_FALSE(w.read_portable(reader).ok()) << cut;
    ASSERT_EQ(w.hash(), before);
  }
}

TYPED_TEST(PortableWorlds, a_damaged_form_is_refused_or_makes_a_world_that_steps) {
  using S = TypeParam;
  const std::vector<std::uint8_t> bytes = sample<S>();
  Dice dice(12);
  int taken = 0, refused = 0;
  World<S> w(settings<S>());
  for (int i = 0; i < 1500; ++i) {
    std::vector<std::uint8_t> damaged = bytes;
    const std::uint32_t spots = 1 + dice.below(3);
    for (std::uint32_t k = 0; k < spots; ++k) {
      std::uint8_t& at = damaged[dice.below(static_cast<std::uint32_t>(damaged.size()))];
      const std::uint32_t kind = dice.below(3);
      at = static_cast<std::uint8_t>(kind == 0 ? at ^ (1u << dice.below(8)) : kind == 1 ? 0xffu : dice.below(256));
    }
    Reader reader(damaged);
    if (!w.read_portable(reader).ok()) {
      ++refused;
      continue;
    }
    ++taken;
    w.step();
    w.step();
    if (i % 4 == 0) {
      for (const BodyId id : w.bodies()) w.wake(id);
      w.step();
      hail(w, static_cast<std::uint64_t>(i));
      w.step();
    }
  }
  EXPECT_GT(taken, 100);
  EXPECT_GT(refused, 50);
}

TYPED_TEST(PortableWorlds, another_scalars_form_is_refused) {
  using S = TypeParam;
  using Other = std::conditional_t<std::is_same_v<S, float>, Q16_16, float>;
  const std::vector<std::uint8_t> bytes = bytes_of(World<Other>());
  World<S> w;
  Reader reader(bytes);
  const Result<void> result = w.read_portable(reader);
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().code, ErrorCode::incompatible);
}

template <class T> T lowest_of() {
  if constexpr (kIsFixed<T>) return T::lowest();
  else return std::numeric_limits<T>::lowest();
}

template <class S> class RimOfTheScalar : public ::testing::Test {};
TYPED_TEST_SUITE(RimOfTheScalar, AllScalars);

TYPED_TEST(RimOfTheScalar, very_rough_surfaces_hold_whatever_stands_on_them) {
  using S = TypeParam;
  for (const double friction : {2.0, 20.0, 200.0, 2000.0, 20000.0}) {
    World<S> w(settings<S>());
    BodyDefinition<S> d = still<S>(w.add_shape(HalfSpace<S>{{Unit<S>(0.6), Unit<S>(0.8), Unit<S>(0)}, S(0)}));
    d.material.friction = num<S>(friction);
    if (!w.create(d)) {
      EXPECT_EQ(w.fault(), Fault::out_of_range) << friction;
      continue;
    }
    d = moving<S>(add_box(w, 1, 0.25, 1), {0.6 * 0.5, 0.8 * 0.5, 0}, {0, -8, 0});
    d.orientation = turn<S>({0, 0, 1}, -std::asin(0.6));
    d.material.friction = num<S>(friction * 1.5);
    const BodyId id = w.create(d);
    if (!id) {
      EXPECT_EQ(w.fault(), Fault::out_of_range) << friction;
      continue;
    }
    for (int i = 0; i < 60; ++i) w.step();
    EXPECT_LT(length(real(w.center_of_mass(id))), 1) << "friction " << friction;
    EXPECT_LT(length(real(w.velocity(id))), 0.2) << "friction " << friction;
  }
}

TYPED_TEST(RimOfTheScalar, the_lowest_number_of_all_is_out_of_range_too) {
  using S = TypeParam;
  const S lowest = lowest_of<S>();
  World<S> w(settings<S>(0));
  const ShapeId ball = add_ball(w, 0.5);
  const BodyId id = w.create(moving<S>(ball, {0, 0, 0}));
  const Vec3<S> v = {S(0), lowest, S(0)}, zero = Vec3<S>::zero();
  BodyDefinition<S> d = moving<S>(ball, {0, 0, 0});
  const auto expect_refused = [&](auto answer) {
    EXPECT_FALSE(static_cast<bool>(answer));
    EXPECT_EQ(w.fault(), Fault::out_of_range);
  };
  d.position = v;
  expect_refused(w.create(d));
  d.position = zero;
  d.velocity = v;
  expect_refused(w.create(d));
  expect_refused(w.set_pose(id, {v, Quat<Unit<S>>::identity()}));
  expect_refused(w.set_velocity(id, v, zero));
  expect_refused(w.set_velocity(id, zero, v));
  expect_refused(w.set_gravity(v));
  expect_refused(w.set_motion(id, lowest, S(0), S(0), 0));
  EXPECT_FALSE(w.cast_ray(v, zero).has_value());
  EXPECT_FALSE(w.closest_point(v, S(1)).has_value());
  EXPECT_TRUE(w.apply_impulse(id, v, v));
  EXPECT_LT(to_double(w.velocity(id).y), 0);
  EXPECT_LT(to_double(w.angular_velocity(id).y), 0);
}

TYPED_TEST(RimOfTheScalar, the_lowest_number_of_all_is_no_speed_of_a_state) {
  using S = TypeParam;
  using V = Velocity<S>;
  for (const bool turns : {false, true}) {
    World<S> w(settings<S>(0));
    BodyDefinition<S> d = moving<S>(add_ball(w, 0.5), {0, 0, 0});
    const V mark = V(11.125);
    (turns ? d.angular_velocity : d.velocity).x = S(11.125);
    ASSERT_TRUE(w.create(d));
    std::vector<std::uint8_t> bytes;
    Writer writer(bytes);
    w.write_portable(writer);
    const V lowest = lowest_of<V>();
    std::size_t found = 0;
    for (std::size_t at = 0; at + sizeof mark <= bytes.size(); ++at) {
      if (std::memcmp(bytes.data() + at, &mark, sizeof mark) != 0) continue;
      ++found;
      std::memcpy(bytes.data() + at, &lowest, sizeof lowest);
    }
    ASSERT_EQ(found, 1u);
    World<S> other(settings<S>(0));
    const std::uint64_t before = other.hash();
    Reader reader({bytes.data(), bytes.size()});
    EXPECT_FALSE(other.read_portable(reader).ok());
    EXPECT_EQ(other.hash(), before);
  }
}

TYPED_TEST(RimOfTheScalar, a_cone_ends_at_half_a_turn) {
  using S = TypeParam;
  World<S> w(settings<S>(0));
  const BodyId id = w.create(moving<S>(add_ball(w, 0.5), {0, 0, 0}));
  JointProperties<S> joint = w.joint_at(JointType::ball, BodyId{}, id, Pose<S>::identity());
  joint.flags |= joint_flag::kCone;
  joint.cone = S(-1);
  EXPECT_FALSE(w.create(joint));
  EXPECT_EQ(w.fault(), Fault::out_of_range);
  joint.cone = S(1);
  const JointId made = w.create(joint);
  ASSERT_TRUE(made);
  joint.cone = S(-6);
  EXPECT_FALSE(w.set_joint(made, joint));
  joint.cone = num<S>(3.2);
  EXPECT_FALSE(w.set_joint(made, joint));
  EXPECT_EQ(w.fault(), Fault::out_of_range);
  joint.cone = num<S>(3.14);
  EXPECT_TRUE(w.set_joint(made, joint));
}

TYPED_TEST(RimOfTheScalar, gravity_scaled_up_pulls_down_or_is_refused) {
  using S = TypeParam;
  for (const double scale : {50.0, 500.0, 3000.0, 7000.0, 30000.0}) {
    World<S> w(settings<S>(-16));
    BodyDefinition<S> d = moving<S>(add_ball(w, 0.5), {0, 0, 0});
    d.gravity_scale = num<S>(scale);
    const BodyId id = w.create(d);
    if (!id) {
      EXPECT_EQ(w.fault(), Fault::out_of_range);
      d.gravity_scale = S(1);
      const BodyId other = w.create(d);
      EXPECT_FALSE(w.set_motion(other, num<S>(scale), S(0), S(0), 0));
      EXPECT_EQ(w.fault(), Fault::out_of_range);
      continue;
    }
    w.step();
    EXPECT_LT(to_double(w.velocity(id).y), 0) << "scale " << scale;
    EXPECT_LT(to_double(w.center_of_mass(id).y), 0) << "scale " << scale;
  }
}

TYPED_TEST(RimOfTheScalar, bodies_that_meet_at_the_speed_limit_part_or_stop_but_do_not_pass) {
  using S = TypeParam;
  World<S> w(settings<S>(0));
  const double v = std::fmin(60, to_double(Limits<S>::speed()) * 0.9);
  const ShapeId box = add_box(w, 1, 1, 1);
  BodyDefinition<S> d = moving<S>(box, {-1.1, 0, 0}, {v, 0, 0});
  d.angular_velocity = vec<S>(v / 2, 0, 0);
  d.material.restitution = S(1);
  const BodyId a = w.create(d);
  d = moving<S>(box, {1.1, 0, 0}, {-v, 0, 0});
  d.angular_velocity = vec<S>(-v / 2, 0, 0);
  const BodyId b = w.create(d);
  for (int i = 0; i < 30; ++i) w.step();
  EXPECT_LT(to_double(w.center_of_mass(a).x), to_double(w.center_of_mass(b).x));
  EXPECT_LE(to_double(w.velocity(a).x), 1);
  EXPECT_GE(to_double(w.velocity(b).x), -1);
}

TYPED_TEST(RimOfTheScalar, the_heaviest_bodies_still_stack) {
  using S = TypeParam;
  World<S> w(settings<S>());
  add_ground(w);
  const ShapeId box = add_box(w, 0.5, 0.5, 0.5);
  BodyDefinition<S> d = moving<S>(box, {0, 0.5, 0});
  d.mass = Limits<S>::mass();
  const BodyId low = w.create(d);
  d.position = vec<S>(0, 1.5, 0);
  const BodyId high = w.create(d);
  for (int i = 0; i < 180; ++i) w.step();
  EXPECT_NEAR(to_double(w.center_of_mass(low).y), 0.5, 0.02);
  EXPECT_NEAR(to_double(w.center_of_mass(high).y), 1.5, 0.02);
  EXPECT_FALSE(w.is_awake(high));
}

}  // namespace portable_test
}  // namespace isostep::test
