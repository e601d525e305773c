// Laws of friction along a grain: sledges against the ellipse of maximal dissipation.
// SPDX-License-Identifier: MIT

#include "built.hpp"
#include "laws/slabs.hpp"
#include "random/dice.hpp"

namespace isostep::test {
namespace grain_test {
using namespace slabs;

template <class S> class GrainLaws : public ::testing::Test {};
TYPED_TEST_SUITE(GrainLaws, AllScalars);

/// Friction of maximal dissipation on an ellipse, by small steps: what slips by v slows by mu g f^2 v / |f v|. `pull`
/// [m/s^2] acts along the ground.
D3 slowed(D3 v, D3 f, double most, double seconds, D3 pull = {0, 0, 0}) {
  const int steps = 100000;
  const double h = seconds / steps;
  for (int i = 0; i < steps; ++i) {
    const D3 fv = {f.x * v.x, 0, f.z * v.z};
    v = v + pull * h;
    if (length(fv) > 1e-6) v = v - D3{f.x * fv.x, 0, f.z * fv.z} * (most * h / length(fv));
  }
  return v;
}

TYPED_TEST(GrainLaws, a_sledge_runs_along_its_runners_and_holds_across_them) {
  using S = TypeParam;
  constexpr double kMu = 0.5, kSeconds = 0.25;
  for (const SolverName solver : kBuiltSolvers) {
    for (const D3 f : {D3{1.0 / 16, 1, 1}, D3{0.5, 1, 1}, D3{1, 1, 0.25}}) {
      for (const double yaw : {0.0, 0.5, 2.0}) {
        for (const double heading : {0.0, kPi / 2, kPi / 4}) {
          World<S> w = tilted<S>(0, solver);
          add_floor(w, material<S>(kMu));
          const D3 own = {3 * std::cos(heading), 0, -3 * std::sin(heading)};  // in the body's frame
          const Quat<Unit<S>> q = turn<S>({0, 1, 0}, yaw);
          const BodyId id = add_slab(w, material<S>(kMu, 0, f), rotated<S>(q, own), yaw);
          run(w, 4);  // until the contact bears the weight
          const auto seen = [&] { return rotated<S>(turn<S>({0, 1, 0}, -yaw), real(w.velocity(id))); };
          const D3 before = seen();
          run(w, static_cast<int>(60 * kSeconds));
          const D3 lost = before - seen(), expected = before - slowed(before, f, kMu * kG, kSeconds);
          const double near = 0.02 * length(expected) + pick<S>(2e-3, 2e-3, 8e-3, 2e-3);
          SCOPED_TRACE(::testing::Message() << static_cast<int>(solver) << " " << f.x << " " << yaw << " " << heading);
          EXPECT_NEAR(lost.x, expected.x, near);
          EXPECT_NEAR(lost.z, expected.z, near);
        }
      }
    }
  }
}

TYPED_TEST(GrainLaws, a_sledge_that_slides_askew_ends_up_running_along_its_runners) {
  using S = TypeParam;
  World<S> w = tilted<S>(0);
  add_floor(w, material<S>(0.5));
  const BodyId id = add_slab(w, material<S>(0.5, 0, {1.0 / 32, 1, 1}), {4, 0, 2});
  run(w, 60);
  EXPECT_GT(to_double(w.velocity(id).x), 3.0);
  EXPECT_LT(std::fabs(to_double(w.velocity(id).z)), 0.1);
}

TYPED_TEST(GrainLaws, a_sledge_that_runs_where_the_slope_falls_across_its_runners_creeps_as_the_ellipse_says) {
  using S = TypeParam;
  constexpr double kNear = 0.01;  // [m/s]
  const double angle = std::atan(0.4);
  for (const SolverName solver : kBuiltSolvers) {
    for (const double speed : {1.0, 5.0}) {
      for (const double f : {0.25, 1.0 / 16}) {
        World<S> w = tilted<S>(angle, solver);
        add_floor(w, material<S>(0.5));
        const BodyId id = add_slab(w, material<S>(0.5, 0, {1, 1, f}), {0, 0, speed});
        run(w, 60);
        const D3 v = slowed({0, 0, speed}, {1, 1, f}, 0.5 * kG * std::cos(angle), 1, {kG * std::sin(angle), 0, 0});
        SCOPED_TRACE(::testing::Message() << static_cast<int>(solver) << " " << speed << " " << f);
        EXPECT_NEAR(to_double(w.velocity(id).x), v.x, kNear);
        EXPECT_NEAR(to_double(w.velocity(id).z), v.z, kNear);
      }
    }
  }
}

/// The slower it is and the less its runners grip, the more would friction throw it from one side of them to the other.
TYPED_TEST(GrainLaws, a_sledge_that_runs_slowly_stops_where_the_ellipse_says) {
  using S = TypeParam;
  constexpr double kMu = 0.6;
  for (const SolverName solver : kBuiltSolvers) {
    for (const double f : {0.25, 1.0 / 16, 1.0 / 64}) {
      for (const double across : {0.0, 0.01, 0.1, 0.3}) {
        World<S> w = tilted<S>(0, solver);
        add_floor(w, material<S>(kMu));
        const BodyId id = add_slab(w, material<S>(kMu, 0, {f, 1, 1}), {0.5, 0, across});
        const double seconds = 0.5 / (kMu * kG * f);  // until it would stop without the slip across
        const int frames = static_cast<int>(60 * seconds / 2);
        run(w, frames);
        const D3 v = slowed({0.5, 0, across}, {f, 1, 1}, kMu * kG, frames / 60.0);
        SCOPED_TRACE(::testing::Message() << static_cast<int>(solver) << " " << f << " " << across);
        EXPECT_NEAR(to_double(w.velocity(id).x), v.x, pick<S>(0.02, 0.02, 0.05, 0.02));
        run(w, frames + 30);
        EXPECT_LT(length(real(w.velocity(id))), 0.01);
      }
    }
  }
}

TYPED_TEST(GrainLaws, a_sledge_stops_on_a_slope_that_its_runners_hold_on) {
  using S = TypeParam;
  constexpr double kMu = 0.6, kRunners = 0.25, kSlope = 0.1;
  for (const SolverName solver : kBuiltSolvers) {
    for (const double across : {0.0, 0.3, 1.0}) {
      World<S> w = tilted<S>(std::atan(kSlope), solver);
      add_floor(w, material<S>(kMu));
      const BodyId id = add_slab(w, material<S>(kMu, 0, {kRunners, 1, 1}), {0.2, 0, across});
      run(w, 120);
      const D3 at = real(w.center_of_mass(id));
      run(w, 120);
      EXPECT_LT(length(real(w.center_of_mass(id)) - at), pick<S>(1e-3, 1e-3, 5e-3, 1e-3))
          << static_cast<int>(solver) << " " << across;
    }
  }
}

/// From rest, by a pull that is neither along the runners nor across them. A floor that leaves half of the friction in
/// all directions cuts the sledge's ellipse.
TYPED_TEST(GrainLaws, a_sledge_that_is_pulled_askew_holds_and_goes_as_the_ellipse_says) {
  using S = TypeParam;
  constexpr double kMu = 0.5;
  for (const SolverName solver : kBuiltSolvers) {
    for (const double runners : {0.25, 1.0 / 16}) {
      for (const double yaw : {0.3, 0.8, 1.2}) {
        for (const double part : {0.9, 1.1, 1.5}) {  // of what the ellipse holds
          const double floor = part == 1.1 ? 0.5 : 1;
          const D3 f = {runners, 1, floor},
                   own = {std::cos(yaw), 0, std::sin(yaw)};  // of the pull, in the body's frame
          const double angle = std::atan(part * kMu / std::hypot(own.x / f.x, own.z / f.z));
          World<S> w = tilted<S>(angle, solver);
          add_floor(w, material<S>(kMu, 0, {floor, floor, floor}));
          const BodyId id = add_slab(w, material<S>(kMu, 0, {runners, 1, 1}), {0, 0, 0}, yaw);
          run(w, 120);
          const D3 v = rotated<S>(turn<S>({0, 1, 0}, -yaw), real(w.velocity(id)));
          const D3 pull = own * (kG * std::sin(angle));
          const D3 law = part < 1 ? D3{0, 0, 0} : slowed({0, 0, 0}, f, kMu * kG * std::cos(angle), 2, pull);
          const double near = part < 1 ? 0.002 : 0.005 + 0.01 * length(law);
          SCOPED_TRACE(::testing::Message() << static_cast<int>(solver) << " " << runners << " " << yaw << " " << part);
          EXPECT_NEAR(v.x, law.x, near + pick<S>(0, 0, 0.01, 0));
          EXPECT_NEAR(v.z, law.z, near + pick<S>(0, 0, 0.01, 0));
        }
      }
    }
  }
}

/// It slips in all directions, and grips in all but one.
TYPED_TEST(GrainLaws, a_sledge_that_spins_in_place_is_braked_by_what_its_directions_leave_on_average) {
  using S = TypeParam;
  constexpr double kMu = 0.5, kSpin = 8;
  for (const SolverName solver : kBuiltSolvers) {
    const auto left_after = [&](D3 grain, double drift) {
      World<S> w = tilted<S>(0, solver);
      add_floor(w, material<S>(kMu));
      const BodyId id = add_slab(w, material<S>(kMu, 0, grain), {drift, 0, 0});
      EXPECT_TRUE(w.set_velocity(id, vec<S>(drift, 0, 0), vec<S>(0, kSpin, 0)));
      run(w, 24);
      return kSpin - to_double(w.angular_velocity(id).y);
    };
    const double plain = left_after({1, 1, 1}, 0);
    EXPECT_GT(plain, 3) << static_cast<int>(solver);
    for (const double drift : {0.0, 0.001, 0.04}) {
      EXPECT_NEAR(left_after({1.0 / 64, 1, 1}, drift), 2 / kPi * plain, 0.15 * plain)
          << static_cast<int>(solver) << " " << drift;
      EXPECT_NEAR(left_after({0.25, 1, 0.25}, drift), 0.25 * plain, 0.05 * plain)
          << static_cast<int>(solver) << " " << drift;
    }
  }
}

TYPED_TEST(GrainLaws, a_sledge_rests_across_a_slope_and_not_along_it) {
  using S = TypeParam;
  for (const SolverName solver : kBuiltSolvers) {
    for (const bool across : {true, false}) {
      const double angle = std::atan(0.4);
      World<S> w = tilted<S>(angle, solver);
      add_floor(w, material<S>(0.5));
      const BodyId id = add_slab(w, material<S>(0.5, 0, {0.25, 1, 1}), {0, 0, 0}, across ? kPi / 2 : 0);
      run(w, 30);
      const D3 at = real(w.center_of_mass(id)), v = real(w.velocity(id));
      run(w, 60);
      const double a = kG * (std::sin(angle) - 0.125 * std::cos(angle));
      if (across) EXPECT_LT(length(real(w.center_of_mass(id)) - at), pick<S>(1e-3, 1e-3, 5e-3, 1e-3));
      else EXPECT_NEAR(to_double(w.velocity(id).x) - v.x, a, off<S>() * a);
    }
  }
}

TYPED_TEST(GrainLaws, it_does_not_matter_which_of_two_bodies_comes_first) {
  using S = TypeParam;
  D3 v[2];
  for (const bool floor_first : {true, false}) {
    World<S> w = tilted<S>(0.2);
    const Material<S> floor = material<S>(0.5, 0.7, {1, 1, 0.5}), sledge = material<S>(0.5, 0.75, {0.125, 1, 1});
    if (floor_first) add_floor(w, floor);
    const BodyId id = add_slab(w, sledge, {2, 0, 1}, 0.3);
    if (!floor_first) add_floor(w, floor);
    run(w, 60);
    v[floor_first ? 0 : 1] = real(w.velocity(id));
  }
  expect_near(v[0], v[1], pick<S>(1e-3, 1e-9, 1e-2, 1e-6));
}

TYPED_TEST(GrainLaws, sledges_that_meet_roll_back_to_every_step) {
  using S = TypeParam;
  constexpr std::size_t kFrames = 90;
  for (const SolverName solver : kBuiltSolvers) {
    World<S> w = tilted<S>(0.1, solver);
    add_floor(w, material<S>(0.5, 0, {0.5, 1, 1}));
    Dice dice(31);
    for (int i = 0; i < 8; ++i) {
      const D3 grain = {dice.in(0.1, 1), 1, dice.in(0.1, 1)}, v = {dice.in(-3, 3), 0, dice.in(-3, 3)};
      BodyDefinition<S> d = moving<S>(add_box(w, 0.4, 0.125, 0.4), {0.9 * (i % 3), 0.2 + 0.3 * i, 0.9 * (i % 2)}, v);
      d.material = material<S>(dice.in(0.2, 0.8), 0, grain);
      w.create(d);
    }
    std::vector<typename World<S>::Snapshot> before(kFrames);
    std::vector<std::uint64_t> hashes;
    for (typename World<S>::Snapshot& snapshot : before) {
      w.save(snapshot);
      w.step();
      hashes.push_back(w.hash());
    }
    for (std::size_t i = kFrames; i-- > 0;) {
      ASSERT_TRUE(w.load(before[i]));
      w.step();
      EXPECT_EQ(w.hash(), hashes[i]) << static_cast<int>(solver) << " " << i;
    }
  }
}

}  // namespace grain_test
}  // namespace isostep::test
