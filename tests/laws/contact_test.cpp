// Laws of bodies on scenery: slopes, stopping, rolling, bouncing, tipping, stacks, and energy that does not rise.
// SPDX-License-Identifier: MIT

#include <algorithm>

#include "unit/world/worlds.hpp"

namespace isostep::test {
namespace contact_test {

template <class S> class ContactLaws : public ::testing::Test {};
TYPED_TEST_SUITE(ContactLaws, AllScalars);

constexpr int kAzimuths = 7;
double azimuth(int i) { return 2 * kPi * i / kAzimuths + 0.1; }

/// A plane through the origin that rises by `angle` against `azimuth`, and what lies along it.
struct Slope {
  double angle, azimuth;
  D3 normal() const {
    return {std::sin(angle) * std::cos(azimuth), std::cos(angle), std::sin(angle) * std::sin(azimuth)};
  }
  D3 down() const {
    return {std::cos(angle) * std::cos(azimuth), -std::sin(angle), std::cos(angle) * std::sin(azimuth)};
  }
  template <class S> Quat<Unit<S>> frame() const { return turn<S>({std::sin(azimuth), 0, -std::cos(azimuth)}, angle); }
  template <class S> BodyId add_to(World<S>& w, double friction) const {
    using U = Unit<S>;
    const D3 n = normal();
    BodyDefinition<S> d = still<S>(w.add_shape(HalfSpace<S>{{num<U>(n.x), num<U>(n.y), num<U>(n.z)}, S(0)}));
    d.material.friction = num<S>(friction);
    return w.create(d);
  }
};

template <class S> World<S> sleepless() {
  Settings<S> s = settings<S>();
  s.allow_sleep = false;
  return World<S>(s);
}

// O16.
TYPED_TEST(ContactLaws, a_block_rests_on_a_slope_exactly_while_its_tangent_is_below_friction) {
  using S = TypeParam;
  const double angle = std::atan(0.5);
  for (int i = 0; i < kAzimuths; ++i) {
    for (const double part : {0.9, 1.1}) {
      World<S> w = sleepless<S>();
      const Slope slope = {angle, azimuth(i)};
      const double mu = part * 0.5;
      slope.add_to(w, mu);
      BodyDefinition<S> d = moving<S>(add_box(w, 0.5, 0.25, 0.5), slope.normal() * 0.25);
      d.orientation = slope.frame<S>();
      d.material.friction = num<S>(mu);
      const BodyId id = w.create(d);
      const D3 start = real(w.center_of_mass(id));
      if (part > 1) {
        run(w, 30);
        const D3 settled = real(w.center_of_mass(id));
        run(w, 300);
        EXPECT_LT(length(real(w.center_of_mass(id)) - settled), pick<S>(1e-3, 1e-3, 5e-3, 1e-3)) << "azimuth " << i;
        EXPECT_LT(length(settled - start), 0.01);
      } else {
        // A few sub-steps pass before the contact bears the weight, and so friction.
        run(w, 12);
        const D3 from = real(w.center_of_mass(id)), v = real(w.velocity(id));
        run(w, 60);
        const double a = 10 * (std::sin(angle) - mu * std::cos(angle));
        // The difference of two forces ten times as large.
        const double part_off = pick<S>(0.02, 0.02, 0.06, 0.02);
        EXPECT_NEAR(dot(real(w.velocity(id)) - v, slope.down()), a, part_off * a) << "azimuth " << i;
        EXPECT_NEAR(dot(real(w.center_of_mass(id)) - from - v, slope.down()), a / 2, 1.5 * part_off * a / 2)
            << "azimuth " << i;
        EXPECT_NEAR(dot(real(w.center_of_mass(id)) - start, cross(slope.normal(), slope.down())), 0, 0.01)
            << "azimuth " << i;
      }
    }
  }
}

// O17.
TYPED_TEST(ContactLaws, a_sliding_block_stops_after_its_square_of_speed_over_twice_friction_whatever_its_heading) {
  using S = TypeParam;
  for (int i = 0; i < kAzimuths; ++i) {
    World<S> w = sleepless<S>();
    add_ground(w, 0.4);
    const D3 heading = {std::cos(azimuth(i)), 0, std::sin(azimuth(i))};
    BodyDefinition<S> d = moving<S>(add_box(w, 0.5, 0.25, 0.5), {0, 0.25, 0}, heading * 4.0);
    d.material.friction = num<S>(0.4);
    const BodyId id = w.create(d);
    run(w, 90);
    EXPECT_LT(length(real(w.velocity(id))), 0.01);
    const D3 at = real(w.center_of_mass(id));
    EXPECT_NEAR(dot(at, heading), 4.0 * 4 / (2 * 0.4 * 10), pick<S>(0.02, 0.02, 0.03, 0.02) * 2) << "heading " << i;
    EXPECT_NEAR(at.x * heading.z - at.z * heading.x, 0, 0.02) << "heading " << i;
  }
}

// O17 again, where it is hardest: a cube tips its load onto its leading edge, and few sub-steps let that tremble.
TYPED_TEST(ContactLaws, friction_slows_slabs_and_cubes_alike_at_any_number_of_sub_steps) {
  using S = TypeParam;
  for (const int substeps : {2, 4, 8, 16}) {
    for (const double half_height : {0.25, 0.5}) {
      for (const double speed : {3.0, 10.0}) {
        Settings<S> settings;
        settings.substeps = substeps;
        settings.allow_sleep = false;
        World<S> w(settings);
        add_ground(w, 0.5);
        const D3 heading = {std::cos(0.4), 0, std::sin(0.4)};
        BodyDefinition<S> d = moving<S>(add_box(w, 0.5, half_height, 0.5), {0, half_height, 0}, heading * speed);
        d.material.friction = num<S>(0.5);
        const BodyId id = w.create(d);
        const int frames = static_cast<int>(0.6 * speed / 5 * 60);
        run(w, frames);
        const D3 v = real(w.velocity(id));
        const double slowing = (speed - length({v.x, 0, v.z})) / (frames / 60.0);
        EXPECT_NEAR(slowing, 5, 0.05) << substeps << " sub-steps, half height " << half_height << ", " << speed
                                      << " m/s";
        EXPECT_NEAR(v.x * heading.z - v.z * heading.x, 0, 0.03) << substeps << " sub-steps";
      }
    }
  }
}

// O18.
TYPED_TEST(ContactLaws, a_sliding_ball_ends_up_rolling_at_five_sevenths_of_its_speed) {
  using S = TypeParam;
  for (int i = 0; i < kAzimuths; ++i) {
    World<S> w = sleepless<S>();
    add_ground(w, 0.25);
    const D3 heading = {std::cos(azimuth(i)), 0, std::sin(azimuth(i))};
    BodyDefinition<S> d = moving<S>(add_ball(w, 0.5), {0, 0.5, 0}, heading * 7.0);
    d.material.friction = num<S>(0.25);
    const BodyId id = w.create(d);
    // Rolls from 2 v / (7 mu g) = 0.8 s on; half way there it has lost half of what it will lose.
    run(w, 24);
    EXPECT_NEAR(dot(real(w.velocity(id)), heading), 6, 0.07) << "heading " << i;
    run(w, 48);
    EXPECT_NEAR(dot(real(w.velocity(id)), heading), 5, 0.05) << "heading " << i;
    expect_near(real(w.angular_velocity(id)), D3{heading.z, 0, -heading.x} * 10.0, 0.15, "angular velocity");
  }
}

TYPED_TEST(ContactLaws, a_ball_rolls_down_a_slope_with_five_sevenths_of_what_it_would_slide) {
  using S = TypeParam;
  for (int i = 0; i < kAzimuths; ++i) {
    World<S> w = sleepless<S>();
    const Slope slope = {0.35, azimuth(i)};
    slope.add_to(w, 0.6);
    const BodyId id = w.create(moving<S>(add_ball(w, 0.5), slope.normal() * 0.5));
    run(w, 60);
    const double a = 5.0 / 7 * 10 * std::sin(0.35);
    EXPECT_NEAR(dot(real(w.velocity(id)), slope.down()), a, 0.02 * a) << "azimuth " << i;
  }
}

// O9.
TYPED_TEST(ContactLaws, every_bounce_reaches_the_square_of_restitution_of_the_height_before) {
  using S = TypeParam;
  World<S> w = sleepless<S>();
  add_ground(w);
  BodyDefinition<S> d = moving<S>(add_ball(w, 0.25), {0, 4.25, 0});
  d.material.restitution = num<S>(0.8);
  const BodyId id = w.create(d);
  std::vector<double> peaks;
  double before = 1e9, now = 4;
  for (int i = 0; i < 60 * 6; ++i) {
    w.step();
    const double next = to_double(w.center_of_mass(id).y) - 0.25;
    if (now > before && now >= next) peaks.push_back(now);
    before = now;
    now = next;
  }
  ASSERT_GE(peaks.size(), 3u);
  double expected = 4;
  for (std::size_t n = 0; n < 3; ++n) {
    expected *= 0.64;
    EXPECT_NEAR(peaks[n], expected, 0.06 * expected) << "bounce " << n + 1;
  }
  for (std::size_t n = 1; n < peaks.size(); ++n) EXPECT_LT(peaks[n], peaks[n - 1]);
}

TYPED_TEST(ContactLaws, a_perfect_bounce_gives_no_energy_over_many_bounces) {
  using S = TypeParam;
  World<S> w = sleepless<S>();
  add_ground(w);
  BodyDefinition<S> d = moving<S>(add_ball(w, 0.25), {0, 2.25, 0});
  d.material.restitution = S(1);
  const BodyId id = w.create(d);
  double highest = 0;
  for (int i = 0; i < 60 * 20; ++i) {
    w.step();
    if (i > 60) highest = std::max(highest, to_double(w.center_of_mass(id).y) - 0.25);
  }
  EXPECT_LT(highest, 2.0 * 1.02);
  EXPECT_GT(highest, 1.0);
}

// O19.
TYPED_TEST(ContactLaws, ten_boxes_stand_for_ten_seconds_and_sleep) {
  using S = TypeParam;
  for (const bool sleep : {false, true}) {
    Settings<S> s = settings<S>();
    s.allow_sleep = sleep;
    World<S> w(s);
    add_ground(w);
    const ShapeId box = add_box(w, 0.5, 0.5, 0.5);
    std::vector<BodyId> stack;
    for (int i = 0; i < 10; ++i) stack.push_back(w.create(moving<S>(box, {0, 0.5 + i, 0})));
    run(w, 300);
    if (sleep) {
      EXPECT_EQ(w.counts().awake, 0u);
    }
    run(w, 300);
    const D3 top = real(w.center_of_mass(stack[9]));
    // Springs in series sag 3.5 n^2 / substeps^2 mm.
    EXPECT_NEAR(top.y, 9.5, 3.5e-3 * 100 / 64 + 0.004);
    EXPECT_LT(std::hypot(top.x, top.z), 0.01);
    for (int i = 0; i < 10; ++i) EXPECT_LT(length(real(w.velocity(stack[static_cast<std::size_t>(i)]))), 0.01);
  }
}

// O20.
TYPED_TEST(ContactLaws, a_tall_box_tips_on_a_slope_steeper_than_its_width_over_its_height) {
  using S = TypeParam;
  const double critical = std::atan(0.5);
  for (int i = 0; i < 4; ++i) {
    for (const double off : {-1.0, 1.0}) {
      World<S> w = sleepless<S>();
      const Slope slope = {critical + off * kPi / 180, i * kPi / 2};
      slope.add_to(w, 1.5);
      BodyDefinition<S> d = moving<S>(add_box(w, 0.25, 0.5, 0.25), slope.normal() * 0.5);
      d.orientation = slope.frame<S>();
      d.material.friction = num<S>(1.5);
      const BodyId id = w.create(d);
      run(w, 240);
      const double upright = dot(rotated<S>(w.pose(id).orientation, {0, 1, 0}), slope.normal());
      if (off < 0) {
        EXPECT_GT(upright, 0.99) << "azimuth " << i;
      } else {
        EXPECT_LT(upright, 0.8) << "azimuth " << i;
      }
    }
  }
}

TYPED_TEST(ContactLaws, a_block_overhangs_by_up_to_half_its_length_and_no_more) {
  using S = TypeParam;
  for (const double overhang : {0.45, 0.55}) {
    World<S> w = sleepless<S>();
    w.create(still<S>(add_box(w, 0.5, 0.25, 0.5), {0, 0.25, 0}));
    const BodyId id = w.create(moving<S>(add_box(w, 0.5, 0.25, 0.5), {overhang, 0.75, 0}));
    run(w, 180);
    if (overhang < 0.5) {
      expect_near(real(w.center_of_mass(id)), {overhang, 0.75, 0}, 0.02);
    } else {
      EXPECT_LT(to_double(w.center_of_mass(id).y), 0.5);
    }
  }
}

// O33. Per kilogram, against the scalar's own noise and what a soft contact stores.
TYPED_TEST(ContactLaws, the_energy_of_a_settled_pile_does_not_rise) {
  using S = TypeParam;
  World<S> w = sleepless<S>();
  add_ground(w);
  const ShapeId shapes[] = {add_box(w, 0.5, 0.25, 0.375), add_ball(w, 0.375),
                            w.add_shape(Capsule<S>{num<S>(0.25), num<S>(0.375)})};
  const D3 moments[] = {{(0.0625 + 0.140625) / 3, (0.25 + 0.140625) / 3, (0.25 + 0.0625) / 3},
                        {0.05625, 0.05625, 0.05625},
                        {0.1, 0.02, 0.1}};
  std::vector<BodyId> ids;
  for (int i = 0; i < 5; ++i) {
    for (const D3 side : {D3{0, 0, -1.5}, D3{1.5, 0, 0}, D3{-1.5, 0, 0}, D3{0.2, 0, 1.5}}) {
      BodyDefinition<S> d =
          moving<S>(shapes[static_cast<std::size_t>(i) % 3], side * (0.3 + 0.05 * i) + D3{0, 0.5 + 0.8 * i, 0});
      d.mass = S(1);
      d.material.rolling_resistance = num<S>(0.03125);
      ids.push_back(w.create(d));
    }
  }
  const auto energy = [&] {
    double sum = 0;
    for (std::size_t i = 0; i < ids.size(); ++i) {
      const D3 v = real(w.velocity(ids[i])), angular_velocity = real(w.angular_velocity(ids[i]));
      sum += 10 * to_double(w.center_of_mass(ids[i]).y) + dot(v, v) / 2 +
             dot(angular_velocity, angular_velocity) * moments[i / 4 % 3].x / 2;
    }
    return sum / static_cast<double>(ids.size());
  };
  run(w, 600);
  EXPECT_GT(w.counts().contacts, 20u);
  const double start = energy();
  double lowest = start, rise = 0;
  for (int i = 0; i < 300; ++i) {
    w.step();
    const double now = energy();
    rise = std::max(rise, now - lowest);
    lowest = std::min(lowest, now);
  }
  EXPECT_LT(rise, pick<S>(1e-3, 1e-3, 1e-2, 1e-3)) << "[J/kg]";
  EXPECT_LE(energy(), start + pick<S>(5e-4, 2e-4, 1e-2, 7e-4)) << "[J/kg] of height 70 um in Q32.32";
}

}  // namespace contact_test
}  // namespace isostep::test
