// Laws of the friction of materials: static beside dynamic, pairs of kinds, and what bounces.
// SPDX-License-Identifier: MIT

#include "built.hpp"
#include "isostep/dynamics/friction_presets.hpp"
#include "laws/slabs.hpp"

namespace isostep::test {
namespace friction_test {
using namespace slabs;

template <class S> class FrictionLaws : public ::testing::Test {};
TYPED_TEST_SUITE(FrictionLaws, AllScalars);

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
