// Laws of the friction of materials: static beside dynamic, grain, pairs of kinds, and what bounces.
// SPDX-License-Identifier: MIT

#include "built.hpp"
#include "isostep/dynamics/friction_presets.hpp"
#include "random/dice.hpp"
#include "unit/world/worlds.hpp"

namespace isostep::test {
namespace friction_test {

template <class S> class FrictionLaws : public ::testing::Test {};
TYPED_TEST_SUITE(FrictionLaws, AllScalars);

constexpr double kG = 10;  // [m/s^2]

/// A flat ground that gravity meets at an angle, as a slope does that falls along x.
template <class S> World<S> tilted(double angle, SolverName solver = SolverName::soft_step) {
  Settings<S> s = settings<S>();
  s.gravity = vec<S>(kG * std::sin(angle), -kG * std::cos(angle), 0);
  s.allow_sleep = false;
  s.solver = solver;
  return World<S>(s);
}
template <class S> Material<S> material(double friction, double static_friction = 0, D3 anisotropy = {1, 1, 1}) {
  Material<S> m;
  m.friction = num<S>(friction);
  m.static_friction = num<S>(static_friction);
  m.anisotropy = vec<S>(anisotropy);
  return m;
}
template <class S> BodyId add_floor(World<S>& w, const Material<S>& material) {
  BodyDefinition<S> d = still<S>(w.add_shape(HalfSpace<S>{{Unit<S>(0), Unit<S>(1), Unit<S>(0)}, S(0)}));
  d.material = material;
  return w.create(d);
}
template <class S> BodyId add_slab(World<S>& w, const Material<S>& material, D3 velocity = {0, 0, 0}, double yaw = 0) {
  BodyDefinition<S> d = moving<S>(add_box(w, 0.5, 0.125, 0.5), {0, 0.125, 0}, velocity);
  d.orientation = turn<S>({0, 1, 0}, yaw);
  d.material = material;
  return w.create(d);
}
template <class S> double off() { return pick<S>(0.02, 0.02, 0.06, 0.02); }

// O16 with two coefficients.
TYPED_TEST(FrictionLaws, a_block_rests_up_to_the_static_coefficient_and_slides_by_the_dynamic_one) {
  using S = TypeParam;
  constexpr double kStatic = 0.6, kDynamic = 0.4;
  const Material<S> both = material<S>(kDynamic, kStatic);
  for (const SolverName solver : kBuiltSolvers) {
    SCOPED_TRACE(static_cast<int>(solver));
    for (const double part : {0.9, 1.1}) {
      const double angle = std::atan(part * kStatic), a = kG * (std::sin(angle) - kDynamic * std::cos(angle));
      World<S> w = tilted<S>(angle, solver);
      add_floor(w, both);
      const BodyId id = add_slab(w, both);
      run(w, 60);
      const D3 at = real(w.center_of_mass(id)), v = real(w.velocity(id));
      run(w, 60);
      if (part < 1) {
        EXPECT_LT(length(real(w.center_of_mass(id)) - at), pick<S>(1e-3, 1e-3, 5e-3, 1e-3));
        ASSERT_TRUE(w.set_velocity(id, vec<S>(1, 0, 0), Vec3<S>::zero()));
        run(w, 60);
        EXPECT_NEAR(to_double(w.velocity(id).x) - 1, a, off<S>() * a) << "pushed, below the static angle";
      } else {
        EXPECT_NEAR(to_double(w.velocity(id).x) - v.x, a, off<S>() * a);
      }
    }
  }
}

// O17 with two coefficients.
TYPED_TEST(FrictionLaws, what_slides_stops_by_the_dynamic_coefficient) {
  using S = TypeParam;
  for (const SolverName solver : kBuiltSolvers) {
    World<S> w = tilted<S>(0, solver);
    const Material<S> both = material<S>(0.4, 1.2);
    add_floor(w, both);
    const BodyId id = add_slab(w, both, {4, 0, 0});
    run(w, 90);
    EXPECT_NEAR(to_double(w.center_of_mass(id).x), 4.0 * 4 / (2 * 0.4 * kG), 0.03 * 2) << static_cast<int>(solver);
    EXPECT_LT(length(real(w.velocity(id))), 0.01) << static_cast<int>(solver);
  }
}

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

TYPED_TEST(FrictionLaws, a_sledge_runs_along_its_runners_and_holds_across_them) {
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

TYPED_TEST(FrictionLaws, a_sledge_that_slides_askew_ends_up_running_along_its_runners) {
  using S = TypeParam;
  World<S> w = tilted<S>(0);
  add_floor(w, material<S>(0.5));
  const BodyId id = add_slab(w, material<S>(0.5, 0, {1.0 / 32, 1, 1}), {4, 0, 2});
  run(w, 60);
  EXPECT_GT(to_double(w.velocity(id).x), 3.0);
  EXPECT_LT(std::fabs(to_double(w.velocity(id).z)), 0.1);
}

TYPED_TEST(FrictionLaws, a_sledge_that_runs_where_the_slope_falls_across_its_runners_creeps_as_the_ellipse_says) {
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
TYPED_TEST(FrictionLaws, a_sledge_that_runs_slowly_stops_where_the_ellipse_says) {
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

TYPED_TEST(FrictionLaws, a_sledge_stops_on_a_slope_that_its_runners_hold_on) {
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
TYPED_TEST(FrictionLaws, a_sledge_that_is_pulled_askew_holds_and_goes_as_the_ellipse_says) {
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
TYPED_TEST(FrictionLaws, a_sledge_that_spins_in_place_is_braked_by_what_its_directions_leave_on_average) {
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

TYPED_TEST(FrictionLaws, a_sledge_rests_across_a_slope_and_not_along_it) {
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

/// A box that falls straight on an edge, drifting by next to nothing. It strikes the same, whichever way it drifts.
TYPED_TEST(FrictionLaws, a_drift_of_next_to_nothing_does_not_change_a_blow) {
  using S = TypeParam;
  constexpr double kDrift = kIsFixed<S> && sizeof(S) == 4 ? 3e-5 : 1e-6;  // [m/s]
  const double near = pick<S>(1e-3, 1e-4, 1e-2, 1e-4);                    // [m/s], [rad/s]
  D3 first = {}, first_turn = {};
  for (int n = 0; n < 8; ++n) {
    World<S> w = tilted<S>(0);
    add_floor(w, material<S>(0.5));
    const double angle = kPi / 4 * n;
    BodyDefinition<S> d =
        moving<S>(add_box(w, 0.25, 0.25, 0.25), {0, 1.25, 0}, {kDrift * std::cos(angle), 0, kDrift * std::sin(angle)});
    d.orientation = turn<S>({0, 0, 1}, kPi / 6);
    d.material = material<S>(0.5);
    const BodyId id = w.create(d);
    run(w, 27);
    const D3 v = real(w.velocity(id)), turn = real(w.angular_velocity(id));
    EXPECT_GT(length(turn), 1) << "it has struck";
    if (n == 0) first = v, first_turn = turn;
    expect_near(v, first, near);
    expect_near(turn, first_turn, near);
  }
}

TYPED_TEST(FrictionLaws, it_does_not_matter_which_of_two_bodies_comes_first) {
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

/// A contact on a grain has one row of friction while it slides, and two while it sticks.
TYPED_TEST(FrictionLaws, sledges_that_meet_roll_back_to_every_step) {
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

TYPED_TEST(FrictionLaws, a_record_of_two_kinds_overrides_the_mixture_of_those_alone) {
  using S = TypeParam;
  for (const bool turned : {false, true}) {
    World<S> w = tilted<S>(0);
    Material<S> floor = material<S>(0.5);
    floor.kind = 7;
    add_floor(w, floor);
    const auto slide = [&](std::uint32_t kind, double z) {
      BodyDefinition<S> d = moving<S>(add_box(w, 0.5, 0.125, 0.5), {0, 0.125, z}, {3, 0, 0});
      d.material = material<S>(0.5);
      d.material.kind = kind;
      return w.create(d);
    };
    const FrictionPreset<S> ice = presets::crate_on_ice<S>();
    ASSERT_TRUE(w.add(turned ? ice.between(7, 3) : ice.between(3, 7)));
    ASSERT_TRUE(w.add(presets::rubber_on_concrete<S>().between(3, 4)));
    const BodyId of_kind = slide(3, 0), of_other = slide(4, 3), of_none = slide(0, 6);
    run(w, 24);
    EXPECT_NEAR(to_double(w.velocity(of_kind).x), 3 - 0.1 * kG * 0.4, 0.03);
    EXPECT_NEAR(to_double(w.velocity(of_other).x), 3 - 0.5 * kG * 0.4, 0.03);
    EXPECT_NEAR(to_double(w.velocity(of_other).x), to_double(w.velocity(of_none).x), 1e-4);
  }
}

TYPED_TEST(FrictionLaws, a_record_of_two_kinds_says_how_they_bounce) {
  using S = TypeParam;
  World<S> w = tilted<S>(0);
  Material<S> m;
  m.kind = 1;
  add_floor(w, m);
  MaterialPair<S> pair;
  pair.kind_a = pair.kind_b = 1;
  pair.restitution = num<S>(0.5);
  ASSERT_TRUE(w.add(pair));
  BodyDefinition<S> d = moving<S>(add_ball(w, 0.5), {0, 0.75, 0}, {0, -4, 0});
  d.material.kind = 1;
  const BodyId id = w.create(d);
  double most = -1;
  for (int i = 0; i < 12; ++i) {
    w.step();
    most = std::max(most, to_double(w.velocity(id).y));
  }
  const double bounce = 0.5 * std::sqrt(4.0 * 4 + 2 * kG * 0.25);
  EXPECT_LE(most, bounce + 0.01);
  EXPECT_GE(most, bounce - kG / 60 - 0.01) << "it bounces within a step, and slows down in the rest of it";
}

TYPED_TEST(FrictionLaws, what_meets_at_the_restitution_threshold_or_faster_bounces) {
  using S = TypeParam;
  for (const SolverName solver : kBuiltSolvers) {
    for (const double threshold : {0.1, 0.25}) {
      Settings<S> s = settings<S>(-1);
      if (threshold == 0.1) s.restitution_threshold = num<S>(threshold);
      s.solver = solver;
      World<S> w(s);
      add_ground(w);
      BodyDefinition<S> d = moving<S>(add_ball(w, 0.5), {0, 0.501, 0}, {0, -0.2, 0});
      d.material.restitution = S(1);
      const BodyId id = w.create(d);
      double most = -1;
      for (int i = 0; i < 12; ++i) {
        w.step();
        most = std::max(most, to_double(w.velocity(id).y));
      }
      if (threshold == 0.1) EXPECT_NEAR(most, 0.2, 1.0 / 60 + 0.01) << static_cast<int>(solver);
      else EXPECT_LT(most, 0.05) << static_cast<int>(solver);
    }
  }
}

}  // namespace friction_test
}  // namespace isostep::test
