// Laws of forces and impulses: the change of velocity is theirs, however large they are, or the step says that it cut.
// SPDX-License-Identifier: MIT

#include "unit/world/worlds.hpp"

namespace isostep::test {
namespace forces_test {

template <class S> class Forces : public ::testing::Test {
 protected:
  static constexpr int kOften = 40;  // doublings from 2^-4 up, as far as the format goes

  /// Runs `visit(size)` for sizes up to the end of the format.
  template <class Visit> static void each_size(Visit&& visit) {
    double size = 1.0 / 16;
    for (int i = 0; i < kOften && size < 0.9 * to_double(highest<S>()); ++i, size *= 2) visit(size);
  }
  static bool is_cut(const StepReport& report) { return report.clamped_force + report.clamped_speed > 0; }
};
TYPED_TEST_SUITE(Forces, AllScalars);

TYPED_TEST(Forces, two_kilonewtons_for_a_frame_give_a_kilogram_its_speed) {
  using S = TypeParam;
  World<S> w(settings<S>(0));
  BodyDefinition<S> d = moving<S>(add_ball(w, 0.5), {0, 0, 0});
  d.mass = S(1);
  const BodyId id = w.create(d);
  ASSERT_TRUE(w.apply_force(id, vec<S>(2000, 0, 0)));
  EXPECT_TRUE(w.step().clean());
  EXPECT_NEAR(to_double(w.velocity(id).x), 2000.0 / 60, 0.001);
}

TYPED_TEST(Forces, change_velocities_by_force_times_time_over_mass_or_are_reported_cut) {
  using S = TypeParam;
  int whole = 0, cut = 0;
  for (const std::int32_t hz : {30, 60, 500}) {
    for (const double mass : {0.25, 1.0, 64.0}) {
      this->each_size([&](double size) {
        World<S> w(settings<S>(0, hz, 4));
        BodyDefinition<S> d = moving<S>(add_ball(w, 0.5), {0, 0, 0});
        d.mass = num<S>(mass);
        const BodyId id = w.create(d);
        ASSERT_TRUE(w.apply_force(id, vec<S>(-size, 0, 0)));
        const bool told = this->is_cut(w.step());
        (told ? cut : whole) += 1;
        if (told) return;
        const double expected = -size / mass / hz;
        EXPECT_NEAR(to_double(w.velocity(id).x), expected, 1e-4 * std::fabs(expected) + 8 * grain<S>(0.01) + 1e-5)
            << size << " N on " << mass << " kg at " << hz << " Hz";
      });
    }
  }
  EXPECT_GT(whole, 50);
  EXPECT_GT(cut, 10);
}

TYPED_TEST(Forces, torques_do_so_too) {
  using S = TypeParam;
  int whole = 0, cut = 0;
  this->each_size([&](double size) {
    World<S> w(settings<S>(0, 60, 4));
    BodyDefinition<S> d = moving<S>(add_ball(w, 0.5), {0, 0, 0});
    d.mass = S(10);
    const BodyId id = w.create(d);
    ASSERT_TRUE(w.apply_force(id, Vec3<S>::zero(), vec<S>(0, size, 0)));
    const bool told = this->is_cut(w.step());
    (told ? cut : whole) += 1;
    if (!told) {
      EXPECT_NEAR(to_double(w.angular_velocity(id).y), size / 60, 1e-3 * size / 60 + 1e-4) << size << " N m";
    }
  });
  EXPECT_GT(whole, 10);
  EXPECT_GT(cut, 0);
}

TYPED_TEST(Forces, impulses_change_velocities_by_themselves_over_mass_or_are_reported_cut) {
  using S = TypeParam;
  int whole = 0, cut = 0;
  for (const double mass : {0.25, 1.0, 64.0}) {
    this->each_size([&](double size) {
      World<S> w(settings<S>(0));
      BodyDefinition<S> d = moving<S>(add_ball(w, 0.5), {0, 0, 0});
      d.mass = num<S>(mass);
      const BodyId id = w.create(d);
      ASSERT_TRUE(w.apply_impulse(id, vec<S>(0, 0, size)));
      const bool told = this->is_cut(w.step());
      (told ? cut : whole) += 1;
      if (told) return;
      EXPECT_NEAR(to_double(w.velocity(id).z), size / mass, 1e-4 * size / mass + 8 * grain<S>(0.01))
          << size << " on " << mass;
    });
  }
  EXPECT_GT(whole, 20);
  EXPECT_GT(cut, 3);
}

// What was cut before the step is told by it, though a wall takes the speed away within it.
TYPED_TEST(Forces, a_cut_impulse_is_told_even_when_a_wall_stops_the_body_at_once) {
  using S = TypeParam;
  World<S> w(settings<S>(-10));
  add_ground(w);
  const BodyId id = w.create(moving<S>(add_box(w, 0.5, 0.5, 0.5), {0, 0.5, 0}));
  run(w, 10);
  const S speed = Limits<S>::speed();
  ASSERT_TRUE(w.apply_impulse(id, {S(0), -(w.mass(id) * speed * S(4)), S(0)}));
  EXPECT_EQ(w.step().clamped_force, 1u);
  EXPECT_EQ(w.step().clamped_force, 0u);
}

TYPED_TEST(Forces, one_after_another_add_up_or_are_reported_cut) {
  using S = TypeParam;
  World<S> w(settings<S>(0));
  BodyDefinition<S> d = moving<S>(add_ball(w, 0.5), {0, 0, 0});
  d.mass = S(1);
  const BodyId id = w.create(d);
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(w.apply_force(id, vec<S>(0, 1000, 0)));
  EXPECT_TRUE(w.step().clean());
  EXPECT_NEAR(to_double(w.velocity(id).y), 50, 0.001);
  for (int i = 0; i < 8; ++i) ASSERT_TRUE(w.apply_force(id, {S(0), Limits<S>::speed() * S(40), S(0)}));
  EXPECT_EQ(w.step().clamped_force, 1u);
}

}  // namespace forces_test
}  // namespace isostep::test
