// Laws of SurfaceVelocity: belts and turntables carry what lies on them, in every solver; and it is all state.
// SPDX-License-Identifier: MIT

#include <algorithm>

#include "built.hpp"
#include "laws/exact_rollback.hpp"

namespace isostep::test {
namespace surface_velocity_test {

const char* name_of(SolverName solver) { return kSolverNames[static_cast<int>(solver)]; }

template <class S> class SurfaceVelocities : public ::testing::Test {
 protected:
  void begin(SolverName solver = SolverName::soft_step, bool allow_sleep = true) {
    Settings<S> s = settings<S>();
    s.solver = solver;
    s.allow_sleep = allow_sleep;
    w = World<S>(s);
  }
  BodyId plank(D3 half, D3 at, double turned = 0) {
    BodyDefinition<S> d = still<S>(add_box(w, half.x, half.y, half.z), at);
    d.orientation = turn<S>({0, 1, 0}, turned);
    d.material.friction = num<S>(0.5);
    return w.create(d);
  }
  BodyId crate(D3 at, D3 velocity = {0, 0, 0}) {
    BodyDefinition<S> d = moving<S>(add_box(w, 0.25, 0.25, 0.25), at, velocity);
    d.material.friction = num<S>(0.5);
    return w.create(d);
  }
  SurfaceVelocityId drive(BodyId body, D3 linear, D3 angular = {0, 0, 0}) {
    const SurfaceVelocityId id = w.add(SurfaceVelocity<S>{body, vec<S>(linear), vec<S>(angular)});
    EXPECT_TRUE(id) << describe(w.fault());
    return id;
  }
  D3 speed(BodyId body) const { return real(w.velocity(body)); }

  World<S> w{settings<S>()};
};
TYPED_TEST_SUITE(SurfaceVelocities, AllScalars);

// Friction of 0.5 at 10 m/s^2: 5 m/s^2 for 0.4 s, on 0.4 m.
TYPED_TEST(SurfaceVelocities, a_crate_slides_until_it_has_the_speed_of_its_belt) {
  for (const SolverName solver : kBuiltSolvers) {
    this->begin(solver);
    this->drive(this->plank({8, 0.25, 1}, {0, -0.25, 0}), {2, 0, 0});
    const BodyId crate = this->crate({-6, 0.25, 0});
    const auto at = [&] { return to_double(this->w.center_of_mass(crate).x); };
    run(this->w, 12);
    EXPECT_NEAR(this->speed(crate).x, 5 * 0.2, 0.005) << name_of(solver);
    run(this->w, 18);
    EXPECT_NEAR(at() + 6, 0.4 + 2 * 0.1, 0.02) << name_of(solver);
    const double before = at();
    for (int i = 0; i < 180; ++i) {
      this->w.step();
      ASSERT_NEAR(this->speed(crate).x, 2, 0.001) << name_of(solver) << i;
    }
    EXPECT_NEAR(at() - before, 6, 0.03) << name_of(solver);
    EXPECT_NEAR(this->speed(crate).z, 0, 1e-3) << name_of(solver);
    EXPECT_EQ(this->w.counts().awake, 1u) << name_of(solver);
  }
}

TYPED_TEST(SurfaceVelocities, run_in_the_frame_of_their_body) {
  this->begin();
  this->drive(this->plank({8, 0.25, 8}, {0, -0.25, 0}, 0.5), {2, 0, 0});
  const BodyId crate = this->crate({0, 0.25, 0});
  run(this->w, 60);
  expect_near(this->speed(crate), {2 * std::cos(0.5), 0, -2 * std::sin(0.5)}, 0.01);
}

/// A rider on a static table that turns: how far it comes from where it lay, seen from the turning surface [m], and how
/// far its own turn is from the table's [rad/s].
template <class S> struct Ridden { double drift = 0, spin_error = 0; };
template <class S> Ridden<S> ride(SolverName solver, double spin, double radius, double seconds) {
  Settings<S> s = settings<S>();
  s.solver = solver;
  World<S> w(s);
  BodyDefinition<S> d = still<S>(add_box(w, 2, 0.5, 2));
  d.material.friction = S(1);
  const BodyId table = w.create(d);
  EXPECT_TRUE(w.add(SurfaceVelocity<S>{table, Vec3<S>::zero(), vec<S>(0, spin, 0)}));
  d = moving<S>(add_box(w, 0.25, 0.25, 0.25), {radius, 0.75, 0}, {0, 0, -spin * radius});
  d.angular_velocity = vec<S>(0, spin, 0);
  d.material.friction = S(1);
  const BodyId rider = w.create(d);
  // A sub-step of h turns by 2 atan(w h / 2), as that of any body does: less than w h by a part of (w h)^2 / 12.
  const double rate = integration_rate(solver, s.hz, s.substeps), turned = 2 * std::atan(spin / rate / 2) * rate;
  const auto seen = [&](int frame) {
    const double angle = turned * frame / 60;
    const D3 at = real(w.center_of_mass(rider));
    return D3{at.x * std::cos(angle) - at.z * std::sin(angle), at.y, at.x * std::sin(angle) + at.z * std::cos(angle)};
  };
  Ridden<S> result;
  D3 start = {};
  for (int i = 1; i <= (seconds + 1) * 60; ++i) {
    w.step();
    if (i == 60) start = seen(i);
    if (i <= 60) continue;
    const D3 moved = seen(i) - start;
    result.drift = std::max(result.drift, std::sqrt(moved.x * moved.x + moved.z * moved.z));
    result.spin_error = std::max(result.spin_error, std::fabs(to_double(w.angular_velocity(rider).y) - spin));
  }
  return result;
}

// As turntable_test.cpp has it of kinematic bodies.
TYPED_TEST(SurfaceVelocities, a_turntable_carries_and_turns_its_rider) {
  using S = TypeParam;
  for (const SolverName solver : kBuiltSolvers) {
    const Ridden<S> slow = ride<S>(solver, 1, 1, 20), fast = ride<S>(solver, 2, 1, 20);
    EXPECT_LT(slow.drift, 0.0005) << name_of(solver);
    EXPECT_LT(fast.drift, 0.0005) << name_of(solver);
    EXPECT_LT(fast.spin_error, 0.001) << name_of(solver);
  }
}

TYPED_TEST(SurfaceVelocities, a_sphere_of_one_point_and_a_crate_on_two_belts_stay_sound) {
  using S = TypeParam;
  for (const SolverName solver : kBuiltSolvers) {
    this->begin(solver);
    this->drive(this->plank({4, 0.25, 2}, {-4, -0.25, 0}), {1, 0, 0}, {0, 0.5, 0});
    this->drive(this->plank({4, 0.25, 2}, {4, -0.25, 0}), {-1, 0, 0}, {0, -0.5, 0});
    const BodyId crate = this->crate({0, 0.25, 0});
    const BodyId ball = this->w.create(moving<S>(add_ball(this->w, 0.25), {-4, 0.25, 0}));
    run(this->w, 120);
    // The belts meet under the crate and draw it from both sides: it stays, though it may turn.
    EXPECT_NEAR(to_double(this->w.center_of_mass(crate).x), 0, 0.3) << name_of(solver);
    EXPECT_GT(to_double(this->w.center_of_mass(ball).y), 0.2) << name_of(solver);
  }
}

TYPED_TEST(SurfaceVelocities, a_dynamic_belt_is_pushed_back) {
  using S = TypeParam;
  for (const SolverName solver : kBuiltSolvers) {
    this->begin(solver);
    BodyDefinition<S> d = still<S>(add_box(this->w, 20, 0.5, 4), {0, -0.5, 0});
    d.material.friction = S(0);
    this->w.create(d);
    d = moving<S>(add_box(this->w, 4, 0.125, 1), {0, 0.125, 0});
    d.mass = S(4);
    const BodyId sled = this->w.create(d);
    this->drive(sled, {1, 0, 0});
    const BodyId crate = this->crate({0, 0.5, 0});
    const double mass = to_double(this->w.mass(crate));
    run(this->w, 90);
    const double of_crate = this->speed(crate).x, of_sled = this->speed(sled).x;
    EXPECT_NEAR(of_crate - of_sled, 1, 0.01) << name_of(solver);
    EXPECT_NEAR(mass * of_crate + 4 * of_sled, 0, pick<S>(1e-4, 1e-4, 2e-2, 1e-4)) << name_of(solver);
  }
}

TYPED_TEST(SurfaceVelocities, wake_what_rests_when_they_begin_change_and_end) {
  using S = TypeParam;
  this->begin();
  const BodyId belt = this->plank({8, 0.25, 1}, {0, -0.25, 0});
  this->plank({0.25, 1, 1}, {1, 1, 0});  // a wall, on which the crate is held
  const BodyId crate = this->crate({0.5, 0.25, 0});
  ASSERT_TRUE(settle(this->w));
  SurfaceVelocity<S> record = {belt, Vec3<S>::zero(), Vec3<S>::zero()};
  const SurfaceVelocityId id = this->w.add(record);
  EXPECT_EQ(this->w.counts().awake, 1u);
  ASSERT_TRUE(settle(this->w)) << "it stands still";
  record.linear = vec<S>(2, 0, 0);
  ASSERT_TRUE(this->w.set(id, record));
  EXPECT_EQ(this->w.counts().awake, 1u);
  run(this->w, 300);
  EXPECT_EQ(this->w.counts().awake, 1u) << "held on the wall, but the belt runs";
  EXPECT_LT(std::fabs(this->speed(crate).x), 0.05);
  record.linear = vec<S>(-1, 0, 0);
  ASSERT_TRUE(this->w.set(id, record));
  run(this->w, 60);
  EXPECT_NEAR(this->speed(crate).x, -1, 0.01);
  ASSERT_TRUE(this->w.remove(id));
  ASSERT_TRUE(settle(this->w));
  const SurfaceVelocityId again = this->w.add(record);
  EXPECT_EQ(this->w.counts().awake, 1u);
  record.linear = Vec3<S>::zero();
  ASSERT_TRUE(this->w.set(again, record));
  ASSERT_TRUE(settle(this->w));
  ASSERT_TRUE(this->w.remove(again));
  EXPECT_EQ(this->w.counts().awake, 1u);
}

TYPED_TEST(SurfaceVelocities, a_character_rides_and_jumps_off_with_its_speed) {
  using S = TypeParam;
  this->begin();
  this->drive(this->plank({20, 0.25, 20}, {0, -0.25, 0}), {2, 0, 0});
  BodyDefinition<S> d = still<S>(this->w.add_shape(Capsule<S>{num<S>(0.25), num<S>(0.5)}), {0, 0.765625, 0});
  d.type = BodyType::kinematic;
  CharacterSettings<S> character;
  character.body = this->w.create(d);
  const CharacterId id = this->w.add(character);
  ASSERT_TRUE(id);
  run(this->w, 3);
  const double before = to_double(this->w.pose(character.body).position.x);
  run(this->w, 60);
  EXPECT_NEAR(to_double(this->w.pose(character.body).position.x) - before, 2, 0.01);
  EXPECT_EQ(this->w.state(id)->footing, Footing::floor);
  character.air_acceleration = S(0);
  ASSERT_TRUE(this->w.set(id, character));
  ASSERT_TRUE(this->w.set_input(id, {.jump = S(3)}));
  this->w.step();
  EXPECT_EQ(this->w.state(id)->footing, Footing::airborne);
  EXPECT_NEAR(to_double(this->w.state(id)->velocity.x), 2, 0.02);
}

TYPED_TEST(SurfaceVelocities, refuse_what_is_no_record_and_change_nothing) {
  using S = TypeParam;
  this->begin();
  const BodyId a = this->plank({1, 1, 1}, {0, 0, 0}), b = this->plank({1, 1, 1}, {4, 0, 0});
  this->drive(a, {1, 0, 0});
  const std::uint64_t before = this->w.hash();
  const auto refused = [&](SurfaceVelocity<S> record, Fault fault, const char* field) {
    EXPECT_FALSE(this->w.add(record));
    EXPECT_EQ(this->w.fault(), fault) << field;
    EXPECT_STREQ(this->w.fault().field, field);
    EXPECT_EQ(this->w.hash(), before) << field;
  };
  const Vec3<S> zero = Vec3<S>::zero();
  refused({{}, zero, zero}, Fault::null_id, "body");
  refused({a, zero, zero}, Fault::bad_argument, "body");
  refused({b, {Limits<S>::speed(), Limits<S>::speed(), S(0)}, zero}, Fault::out_of_range, "linear");
  refused({b, zero, {S(0), Limits<S>::angular_speed(), Limits<S>::angular_speed()}}, Fault::out_of_range, "angular");
  if constexpr (!kIsFixed<S>) {
    refused({b, {S(0), num<S>(NAN), S(0)}, zero}, Fault::not_finite, "linear");
    refused({b, zero, {num<S>(NAN), S(0), S(0)}}, Fault::not_finite, "angular");
  }
  ASSERT_TRUE(this->w.destroy(a));
  EXPECT_EQ(this->w.state().records->surface_velocitys.slot_map().template ids<SurfaceVelocityId>().size(), 0u);
}

TYPED_TEST(SurfaceVelocities, are_rolled_back_and_equal_on_all_lanes) {
  using S = TypeParam;
  for (const SolverName solver : kBuiltSolvers) {
    std::vector<std::uint64_t> first;
    for (const Simd simd : {Simd::scalar, Simd::best}) {
      this->begin(solver);
      ASSERT_TRUE(this->w.use_simd(simd));
      const BodyId belt = this->plank({8, 0.25, 4}, {0, -0.25, 0});
      const SurfaceVelocityId id = this->drive(belt, {1, 0, 0}, {0, 0.5, 0});
      for (int i = 0; i < 9; ++i) this->crate({1.0 * (i % 3), 0.25, 1.0 * (i / 3)});
      for (int i = 0; i < 5; ++i) this->w.create(moving<S>(add_ball(this->w, 0.25), {-3, 0.25, 0.75 * i - 1}));
      const auto hashes = expect_exact_rollback(this->w, 90, [&](World<S>& world, int frame) {
        if (frame % 30 == 20) world.set(id, {belt, vec<S>(frame % 60 == 20 ? -1 : 2, 0, 0.5), vec<S>(0, 0.25, 0)});
      });
      if (first.empty()) first = hashes;
      EXPECT_EQ(hashes, first) << name_of(solver);
    }
  }
}

}  // namespace surface_velocity_test
}  // namespace isostep::test
