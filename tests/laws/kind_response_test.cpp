// Laws of KindResponse: whom contacts of two kinds move, and how hard they press at most.
// SPDX-License-Identifier: MIT

#include <cstring>
#include <limits>
#include <utility>

#include "built.hpp"
#include "laws/exact_rollback.hpp"

namespace isostep::test {
namespace kind_response_test {

const std::vector<SolverName> kResponding = built({SolverName::soft_step, SolverName::pgs, SolverName::worst_first});

const char* name_of(SolverName solver) { return kSolverNames[static_cast<int>(solver)]; }

template <class S> KindResponse<S> response(double mass_a, double mass_b, double max_force = 0) {
  KindResponse<S> r;
  r.kind_a = 1;
  r.kind_b = 2;
  r.inverse_mass_scale_a = num<S>(mass_a);
  r.inverse_mass_scale_b = num<S>(mass_b);
  r.max_force = num<S>(max_force);
  return r;
}

template <class S> class KindResponses : public ::testing::Test {
 protected:
  static World<S> world(SolverName solver, double gravity = 0) {
    Settings<S> s = settings<S>(gravity);
    s.solver = solver;
    return World<S>(s);
  }
  /// Creates a body without rolling resistance, and with the friction that the test asks for.
  static BodyId body(World<S>& w, BodyDefinition<S> d, std::uint32_t kind, double mass, double friction = 0) {
    d.material.kind = kind;
    d.material.friction = num<S>(friction);
    d.mass = num<S>(mass);
    d.allow_sleep = false;
    return w.create(d);
  }
  static BodyId ball(World<S>& w, D3 at, D3 velocity, std::uint32_t kind, double mass) {
    return body(w, moving<S>(add_ball(w, 0.25), at, velocity), kind, mass);
  }
  static BodyId ground(World<S>& w, double friction = 0) {
    BodyDefinition<S> d = still<S>(w.add_shape(HalfSpace<S>{{Unit<S>(0), Unit<S>(1), Unit<S>(0)}, S(0)}));
    return body(w, d, 2, 0, friction);
  }
  static double speed(const World<S>& w, BodyId id) { return to_double(w.velocity(id).x); }
};
TYPED_TEST_SUITE(KindResponses, AllScalars);

TYPED_TEST(KindResponses, scaled_masses_share_their_momentum) {
  using S = TypeParam;
  struct Case {
    double mass_a, mass_b, scale_a, scale_b;
  };
  constexpr Case kCases[] = {{1, 8, 0.5, 1}, {8, 1, 1, 0.25},    {2, 2, 0.125, 1},
                             {64, 1, 1, 1},  {1, 64, 0.0625, 1}, {3, 1, 0.5, 0.25}};
  for (const SolverName solver : kResponding) {
    for (const Case& c : kCases) {
      for (const bool swapped : {false, true}) {  // the record's sides are kinds, whoever was there first
        World<S> w = this->world(solver);
        BodyId a, b;
        if (swapped) b = this->ball(w, {0.75, 0, 0}, {0, 0, 0}, 2, c.mass_b);
        a = this->ball(w, {0, 0, 0}, {4, 0, 0}, 1, c.mass_a);
        if (!swapped) b = this->ball(w, {0.75, 0, 0}, {0, 0, 0}, 2, c.mass_b);
        ASSERT_TRUE(w.add(response<S>(c.scale_a, c.scale_b))) << describe(w.fault());
        run(w, 20);
        const double weight_a = c.mass_a / c.scale_a, weight_b = c.mass_b / c.scale_b;
        const double a_left = this->speed(w, a), b_left = this->speed(w, b);
        const double bar = pick<S>(1e-5, 1e-12, 2e-3, 1e-7);  // [1]
        EXPECT_NEAR((weight_a * a_left + weight_b * b_left) / (weight_a + weight_b),
                    4 * weight_a / (weight_a + weight_b), bar)
            << c.mass_a << " " << c.scale_a << " " << name_of(solver);
        // Those of pgs overlap by then, and are pushed apart.
        EXPECT_NEAR(a_left, b_left, solver == SolverName::pgs ? 0.5 : 0.02) << name_of(solver);
      }
    }
  }
}

TYPED_TEST(KindResponses, what_is_not_pushed_back_keeps_every_bit_of_its_motion) {
  using S = TypeParam;
  for (const SolverName solver : kResponding) {
    World<S> w = this->world(solver), alone = this->world(solver);
    const auto plough = [&](World<S>& in) {
      BodyDefinition<S> d = moving<S>(add_box(in, 0.25, 0.25, 0.5), {0, 0, 0}, {3, 0, 0});
      d.angular_velocity = vec<S>(0.125, 0.25, 0);
      return this->body(in, d, 1, 1);
    };
    const BodyId a = plough(w), same = plough(alone);
    const BodyId heavy = this->ball(w, {1, 0, 0}, {0, 0, 0}, 2, 40);
    ASSERT_TRUE(w.add(response<S>(0, 1)));
    for (int i = 0; i < 60; ++i) {
      w.step();
      alone.step();
    }
    EXPECT_GT(this->speed(w, heavy), 2.5) << name_of(solver);
    EXPECT_EQ(std::memcmp(w.view(a).state, alone.view(same).state, sizeof(BodyState<S>)), 0);
  }
}

TYPED_TEST(KindResponses, inertia_of_0_is_not_turned_by_friction) {
  using S = TypeParam;
  for (const SolverName solver : kResponding) {
    World<S> w = this->world(solver, -10);
    this->ground(w, 0.5);
    const BodyId slides = this->body(w, moving<S>(add_ball(w, 0.25), {0, 0.25, 0}, {4, 0, 0}), 1, 2, 0.5);
    const BodyId rolls = this->body(w, moving<S>(add_ball(w, 0.25), {0, 0.25, 4}, {4, 0, 0}), 3, 2, 0.5);
    KindResponse<S> r = response<S>(1, 1);
    r.inverse_inertia_scale_a = S(0);
    ASSERT_TRUE(w.add(r));
    run(w, 24);
    EXPECT_EQ(w.angular_velocity(slides), Vec3<S>::zero());
    EXPECT_NEAR(this->speed(w, slides), 4 - 0.5 * 10 * 24 / 60.0, 0.05) << name_of(solver);
    EXPECT_LT(to_double(w.angular_velocity(rolls).z), -8);
    run(w, 48);
    EXPECT_NEAR(this->speed(w, slides), 0, 0.01);
    EXPECT_NEAR(this->speed(w, rolls), 4 * 5 / 7.0, 0.05);
  }
}

TYPED_TEST(KindResponses, what_presses_harder_than_a_force_is_slowed_by_that_force) {
  using S = TypeParam;
  for (const SolverName solver : kResponding) {
    World<S> w = this->world(solver, -10);
    this->ground(w);
    const BodyId heavy = this->body(w, moving<S>(add_box(w, 2, 2, 2), {0, 1.99, 0}), 1, 4);
    const BodyId light = this->body(w, moving<S>(add_box(w, 2, 2, 2), {8, 1.99, 0}), 1, 2);
    ASSERT_TRUE(w.add(response<S>(1, 1, 24)));
    run(w, 30);
    EXPECT_NEAR(to_double(w.velocity(heavy).y), -(10 - 24 / 4.0) * 0.5, 0.02) << name_of(solver);
    // The first point of worst_first takes what all may: the box tips.
    const double tips = solver == SolverName::worst_first ? 1 : 0.01;
    EXPECT_NEAR(to_double(w.angular_velocity(heavy).x), 0, tips) << name_of(solver);
    EXPECT_NEAR(to_double(w.velocity(light).y), 0, 0.01) << name_of(solver);
    EXPECT_GT(to_double(w.center_of_mass(light).y), 1.985);
  }
}

TYPED_TEST(KindResponses, a_contact_never_gives_more_than_its_force_and_friction_is_of_that) {
  using S = TypeParam;
  for (const SolverName solver : kResponding) {
    World<S> w = this->world(solver, -10);
    const BodyId floor = this->ground(w, 0.5);
    const BodyId crate = this->body(w, moving<S>(add_box(w, 2, 2, 2), {0, 2.25, 0}, {4, -3, 0}), 1, 4, 0.5);
    constexpr double kForce = 20;
    ASSERT_TRUE(w.add(response<S>(1, 1, kForce)));
    ASSERT_TRUE(w.add(ContactReport<S>{floor}));
    double given = 0;
    for (int i = 0; i < 20; ++i) {
      const double before = to_double(w.velocity(crate).y);
      run(w, 1);
      double borne = 0;
      for (const ContactPoint<S>& point : w.events().contacts) borne += to_double(point.impulse);
      EXPECT_LE(borne, kForce / 60 * pick<S>(1.0001, 1.0000001, 1.01, 1.000001)) << name_of(solver);
      EXPECT_NEAR(4 * (to_double(w.velocity(crate).y) - before + 10 / 60.0), borne, 0.01);
      given += borne;
    }
    EXPECT_GT(given, kForce / 60 * 10);
    EXPECT_NEAR(4 * (4 - this->speed(w, crate)), 0.5 * given, 0.1 * given) << name_of(solver);
  }
}

TYPED_TEST(KindResponses, a_yielding_contact_conserves_momentum) {
  using S = TypeParam;
  for (const SolverName solver : kResponding) {
    World<S> w = this->world(solver);
    const BodyId a = this->ball(w, {0, 0, 0}, {6, 0, 0}, 1, 3), b = this->ball(w, {0.75, 0.125, 0}, {0, 0, 0}, 2, 2);
    ASSERT_TRUE(w.add(response<S>(1, 1, 30)));
    const auto momentum = [&] { return real(w.velocity(a)) * 3.0 + real(w.velocity(b)) * 2.0; };
    const D3 before = momentum();
    run(w, 30);
    expect_near(momentum(), before, pick<S>(1e-4, 1e-10, 0.02, 1e-6));
    EXPECT_GT(length(real(w.velocity(b))), 0.25) << name_of(solver);
    EXPECT_GT(this->speed(w, a), this->speed(w, b)) << "it went through";
  }
}

TYPED_TEST(KindResponses, a_bullet_meets_what_gives_way_and_goes_through) {
  using S = TypeParam;
  for (const SolverName solver : kResponding) {
    World<S> w = this->world(solver);
    this->body(w, still<S>(add_box(w, 0.25, 2, 2), {4, 0, 0}), 2, 0);
    BodyDefinition<S> d = moving<S>(add_ball(w, 0.125), {0, 0, 0}, {40, 0, 0});
    d.bullet = true;
    const BodyId bullet = this->body(w, d, 1, 1);
    ASSERT_TRUE(w.add(response<S>(1, 1, 300)));
    run(w, 30);
    EXPECT_GT(to_double(w.center_of_mass(bullet).x), 5) << name_of(solver);
    EXPECT_GT(this->speed(w, bullet), 20) << name_of(solver);
  }
}

TYPED_TEST(KindResponses, a_bullet_that_is_not_pushed_back_is_not_stopped_either) {
  using S = TypeParam;
  constexpr double kWay = 48.0 / 60;  // [m] of a step
  for (const double scale : {0.0, 1.0}) {
    World<S> w = this->world(SolverName::soft_step);
    this->body(w, moving<S>(add_box(w, 0.0625, 1, 1), {1.25 * kWay, 0, 0}), 2, 1);
    BodyDefinition<S> d = moving<S>(add_ball(w, 0.0625), {0, 0, 0}, {48, 0, 0});
    d.bullet = true;
    const BodyId bullet = this->body(w, d, 1, 1);
    ASSERT_TRUE(w.add(response<S>(scale, 1)));
    run(w, 2);
    const double at = to_double(w.center_of_mass(bullet).x);
    if (scale == 0) EXPECT_NEAR(at, 2 * kWay, 0.01);
    else EXPECT_LT(at, 1.25 * kWay);
  }
}

TYPED_TEST(KindResponses, events_tell_what_the_side_that_is_moved_gets) {
  using S = TypeParam;
  for (const SolverName solver : kResponding) {
    World<S> w = this->world(solver);
    this->ball(w, {0, 0, 0}, {4, 0, 0}, 1, 1);
    const BodyId b = this->ball(w, {0.5625, 0, 0}, {0, 0, 0}, 2, 8);
    ASSERT_TRUE(w.add(response<S>(0, 1)));
    int told = 0;
    for (int i = 0; i < 10; ++i) {
      w.step();
      for (const ContactBegin<S>& begin : w.events().contact_begin) {
        EXPECT_NEAR(to_double(begin.impulse), 8 * this->speed(w, b), 0.05) << name_of(solver);
        EXPECT_GT(to_double(begin.impulse), 4);
        ++told;
      }
    }
    EXPECT_EQ(told, 1);
  }
}

/// A heap of boxes and balls of two kinds in a trough.
template <class S> void fill(World<S>& w) {
  BodyDefinition<S> floor = still<S>(add_box(w, 4, 0.5, 4), {0, -0.5, 0});
  floor.material.kind = 2;
  w.create(floor);
  for (std::uint32_t i = 0; i < 18; ++i) {
    const double x = (i % 3) * 0.75 - 0.75, z = (i / 3 % 2) * 0.75;
    BodyDefinition<S> d = moving<S>(i % 2 == 0 ? add_ball(w, 0.25) : add_box(w, 0.25, 0.25, 0.25),
                                    {x, 0.5 + (i / 6) * 0.75, z}, {0.25 * (i % 5) - 0.5, 0, 0.125 * (i % 3)});
    d.material.kind = 1 + i % 2;
    d.mass = num<S>(1 + i % 4);
    w.create(d);
  }
}

TYPED_TEST(KindResponses, every_width_gives_the_same_bits) {
  using S = TypeParam;
  std::vector<std::uint64_t> hashes;
  for (std::uint32_t i = 0; i < kSimds; ++i) {
    World<S> w = this->world(SolverName::soft_step, -10);
    if (!w.use_simd(static_cast<Simd>(i))) continue;
    fill(w);
    ASSERT_TRUE(w.add(response<S>(0.25, 1, 8)));
    for (int frame = 0; frame < 90; ++frame) w.step();
    hashes.push_back(w.hash());
  }
  ASSERT_GT(hashes.size(), 1u);
  for (const std::uint64_t hash : hashes) EXPECT_EQ(hash, hashes.front());
}

TYPED_TEST(KindResponses, a_record_of_other_kinds_changes_no_bit) {
  using S = TypeParam;
  for (const SolverName solver : kResponding) {
    World<S> with = this->world(solver, -10), without = this->world(solver, -10);
    fill(with);
    fill(without);
    KindResponse<S> r = response<S>(0.25, 1, 8);
    r.kind_a = 3;
    ASSERT_TRUE(with.add(r));
    for (int frame = 0; frame < 60; ++frame) {
      with.step();
      without.step();
    }
    const auto& a = with.state().awake.states;
    const auto& b = without.state().awake.states;
    ASSERT_EQ(a.size(), b.size());
    EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size() * sizeof(BodyState<S>)), 0) << name_of(solver);
  }
}

TYPED_TEST(KindResponses, it_is_state) {
  using S = TypeParam;
  for (const SolverName solver : kResponding) {
    World<S> w = this->world(solver, -10);
    fill(w);
    const KindResponseId id = w.add(response<S>(0.25, 1, 8));
    expect_exact_rollback(w, 90, [&](World<S>& played, int i) {
      if (i % 20 == 13) played.set(id, response<S>(1, i % 40 == 13 ? 0 : 0.5, i));
      if (i == 70) played.remove(id);
    });
  }
}

TYPED_TEST(KindResponses, bad_numbers_second_records_and_direct_are_refused) {
  using S = TypeParam;
  World<S> w = this->world(SolverName::soft_step);
  const auto refused = [&](const char* field, const auto& change) {
    KindResponse<S> r = response<S>(1, 1);
    change(r);
    const std::uint64_t before = w.hash();
    EXPECT_FALSE(w.add(r)) << field;
    EXPECT_STREQ(w.fault().field, field);
    EXPECT_EQ(w.hash(), before);
  };
  refused("kind_a", [](auto& r) { r.kind_a = 0; });
  refused("kind_b", [](auto& r) { r.kind_b = 0; });
  for (const double bad : {-0.5, 0x1p-9, 1.5}) {
    refused("inverse_mass_scale_a", [&](auto& r) { r.inverse_mass_scale_a = num<S>(bad); });
    refused("inverse_mass_scale_b", [&](auto& r) { r.inverse_mass_scale_b = num<S>(bad); });
  }
  refused("inverse_mass_scale_b", [](auto& r) { r.inverse_mass_scale_a = r.inverse_mass_scale_b = S(0); });
  refused("inverse_mass_scale_b", [](auto& r) {
    r.kind_b = 1;
    r.inverse_mass_scale_b = S(0.5);
  });
  refused("inverse_inertia_scale_b", [](auto& r) {
    r.kind_b = 1;
    r.inverse_inertia_scale_b = S(0.5);
  });
  for (const double bad : {-0.5, 1.5}) {
    refused("inverse_inertia_scale_a", [&](auto& r) { r.inverse_inertia_scale_a = num<S>(bad); });
    refused("inverse_inertia_scale_b", [&](auto& r) { r.inverse_inertia_scale_b = num<S>(bad); });
  }
  refused("max_force", [](auto& r) { r.max_force = S(-1); });
  ASSERT_TRUE(w.add(response<S>(1, 1)));
  refused("kind_b", [](auto& r) { std::swap(r.kind_a, r.kind_b); });
  if constexpr (!kIsFixed<S>) {
    const S nan = std::numeric_limits<S>::quiet_NaN();
    refused("inverse_mass_scale_a", [&](auto& r) { r.inverse_mass_scale_a = nan; });
    refused("inverse_mass_scale_b", [&](auto& r) { r.inverse_mass_scale_b = nan; });
    refused("inverse_inertia_scale_a", [&](auto& r) { r.inverse_inertia_scale_a = nan; });
    refused("inverse_inertia_scale_b", [&](auto& r) { r.inverse_inertia_scale_b = nan; });
    refused("max_force", [&](auto& r) { r.max_force = nan; });
  }
  for (const SolverName solver : {SolverName::direct, SolverName::avbd, SolverName::admm}) {
    World<S> world = this->world(solver);
    EXPECT_FALSE(world.add(response<S>(1, 1)));
    EXPECT_STREQ(world.fault().field, "solver");
  }
}

}  // namespace kind_response_test
}  // namespace isostep::test
