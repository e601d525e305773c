// Laws of collisions: two particles in line, bouncing, rows of balls, sliding to a stop, conserved sums, bullets.
// SPDX-License-Identifier: MIT

#include <algorithm>

#include "isostep/particles/limits.hpp"
#include "laws/particle_laws.hpp"

namespace isostep::test {
namespace particle_collisions_test {

template <class S> class ParticleCollisionLaws : public ::testing::Test {};
TYPED_TEST_SUITE(ParticleCollisionLaws, AllScalars);

constexpr ParticleSolver kSolvers[] = {ParticleSolver::soft_step, ParticleSolver::worst_first};
const char* name_of(ParticleSolver solver) { return kParticleSolverNames[static_cast<int>(solver)]; }

template <class S>
ParticleSettings<S> solved_by(ParticleSolver solver, double gravity = 0, int hz = 60, int substeps = 4) {
  ParticleSettings<S> s = at_rate<S>(gravity, hz, substeps);
  s.solver = solver;
  return s;
}
/// The speed in the format that velocities have.
template <class S> D3 speed_of(const ParticleWorld<S>& w, ParticleId id) { return real(w.state().velocity[id.slot]); }

// O8. v_a' = ((m_a - e m_b) v_a + (1 + e) m_b v_b) / (m_a + m_b); the energy of the relative motion falls to e^2.
TYPED_TEST(ParticleCollisionLaws, two_balls_in_line_part_by_newtons_rule_and_keep_their_momentum) {
  using S = TypeParam;
  for (const ParticleSolver solver : kSolvers) {
    for (const double e : {0.0, 0.25, 0.5, 1.0}) {
      for (const double m : {1.0, 2.0, 10.0}) {
        ParticleWorld<S> w(solved_by<S>(solver));
        const ParticleMaterialId ball = w.add(grain_of<S>(0.5, e, 0, true));
        const ParticleId a = w.create(point<S>({-1, 0, 0}, {5, 0, 0}, m, ball));
        const ParticleId b = w.create(point<S>({1, 0, 0}, {-3, 0, 0}, 1, ball));
        run(w, 30);
        const double va = ((m - e) * 5 + (1 + e) * -3) / (m + 1), vb = ((1 - e * m) * -3 + (1 + e) * m * 5) / (m + 1);
        // Two units of what closes at 8 m/s; Q16.16 has its velocities in Q12.20.
        const double bound = 2 * speed_grain<S>(8);
        const D3 u = speed_of(w, a), v = speed_of(w, b);
        EXPECT_NEAR(u.x, va, bound) << name_of(solver) << " e " << e << " mass " << m;
        EXPECT_NEAR(v.x, vb, bound) << name_of(solver) << " e " << e << " mass " << m;
        // Equal masses of fixed point get exact halves.
        const double lost = kIsFixed<S> && m == 1 ? 0 : (m + 1) * bound;
        EXPECT_NEAR(m * u.x + v.x, m * 5 - 3, lost) << name_of(solver) << " e " << e << " mass " << m;
        const double reduced = m / (m + 1), energy = (m * u.x * u.x + v.x * v.x) / 2;
        EXPECT_NEAR(energy, (m * 25 + 9) / 2 - reduced * 64 / 2 * (1 - e * e), 20 * (m + 1) * bound);
        EXPECT_EQ(std::fabs(u.y) + std::fabs(u.z) + std::fabs(v.y) + std::fabs(v.z), 0);
      }
    }
  }
}

// O8 near the end of the range: the squares of these speeds are no numbers of Q16.16.
TYPED_TEST(ParticleCollisionLaws, a_ball_of_any_speed_goes_back_with_its_share_of_it) {
  using S = TypeParam;
  for (const ParticleSolver solver : kSolvers) {
    for (const double e : {0.5, 1.0}) {
      ParticleWorld<S> w(solved_by<S>(solver));
      const double fast = to_double(ParticleLimits<S>::speed()) * 0.75;
      const ParticleId id = w.create(point<S>({1, 0, 0}, {-fast, 0, 0}, 1, w.add(grain_of<S>(0.25, e, 0, false))));
      ASSERT_TRUE(w.add(plane<S>({1, 0, 0}, 0)));
      run(w, 2);
      EXPECT_NEAR(speed_of(w, id).x, e * fast, 2 * speed_grain<S>(fast)) << name_of(solver) << e;
    }
  }
}

/// A ball that falls from 1 m.
template <class S> struct Bouncer {
  static constexpr double kRadius = 0.25;
  ParticleWorld<S> world;
  ParticleId id;

  Bouncer(const ParticleSettings<S>& settings, double e) : world(settings) {
    const ParticleMaterialId ball = world.add(grain_of<S>(kRadius, e, 0, false));
    world.add(plane<S>({0, 1, 0}, 0));
    id = world.create(point<S>({0, 1 + kRadius, 0}, {0, 0, 0}, 1, ball));
  }
  double height() const { return to_double(world.position(id).y) - kRadius; }
  double speed() const { return speed_of(world, id).y; }
};

// O9. One sub-step a step: what would pass through the ground ends on it and leaves with e times its speed.
TYPED_TEST(ParticleCollisionLaws, a_bouncing_ball_follows_the_recurrence_of_its_bounces) {
  using S = TypeParam;
  constexpr Wide kStep = 1.0L / 64;
  Bouncer<S> ball(at_rate<S>(-10), 0.75);
  Wide y = 1, v = 0;
  int bounces = 0;
  for (int i = 1; i <= 160; ++i) {
    ASSERT_TRUE(ball.world.step().clean());
    const Wide gained = 10 * kStep;
    if (y + (v - gained) * kStep < 0) {
      // As fast as it comes there: v is of half a sub-step ago, and the weight works on the way.
      v = 0.75L * std::sqrt((v - gained / 2) * (v - gained / 2) + 2 * 10 * y);
      y = 0;
      ++bounces;
    } else {
      v -= gained;
      y += v * kStep;
    }
    ASSERT_NEAR(ball.height(), double(y), pick<S>(1e-5, 1e-13, 1e-3, 1e-8)) << i;
    ASSERT_NEAR(ball.speed(), double(v), pick<S>(1e-5, 1e-13, 1e-3, 1e-8)) << i;
  }
  EXPECT_GE(bounces, 5);
}

// O9. Peak n at h_0 e^2n; at the default rate, whose truncation is of first order: g h / v of the speed a bounce.
TYPED_TEST(ParticleCollisionLaws, a_bouncing_ball_reaches_its_share_of_the_height_and_comes_to_rest) {
  using S = TypeParam;
  struct Mode {
    ParticleSolver solver;
    Stepping stepping;
    const char* name;
  };
  for (const Mode mode : {Mode{ParticleSolver::soft_step, Stepping::fixed, "soft_step "},
                          Mode{ParticleSolver::worst_first, Stepping::fixed, "worst_first "},
                          Mode{ParticleSolver::worst_first, Stepping::time_division, "time_division "}}) {
    for (const double e : {0.5, 0.8}) {
      ParticleSettings<S> settings = solved_by<S>(mode.solver, -10);
      settings.stepping = mode.stepping;
      Bouncer<S> ball(settings, e);
      double before = 0, previous = 1;
      int peak = 0;
      for (int i = 0; i < 60 * 15; ++i) {
        ASSERT_TRUE(ball.world.step().clean());
        if (before > 0 && ball.speed() <= 0 && ball.height() > 0.005) {
          ++peak;
          EXPECT_NEAR(ball.height(), std::pow(e, 2 * peak), pick<S>(0.02, 0.02, 0.03, 0.02)) << mode.name << peak;
          // The book finds a ball in the ground, by up to its way of a sub-step, and lifts it out.
          const double lift = mode.solver == ParticleSolver::worst_first ? std::sqrt(20 * previous) / 240 : 0;
          EXPECT_LE(ball.height(), e * e * previous + lift + pick<S>(1e-4, 1e-4, 3e-4, 1e-4))
              << mode.name << " gains by bouncing";
          previous = ball.height();
        }
        before = ball.speed();
      }
      EXPECT_GE(peak, e == 0.5 ? 2 : 6) << mode.name;
      // Below 0.25 m/s nothing bounces: it lies still, not on a rain of small bounces.
      EXPECT_NEAR(ball.height(), 0, 5e-4) << mode.name;
      EXPECT_NEAR(ball.speed(), 0, 1e-4) << mode.name;
    }
  }
}

/// Five balls in a row, of which the first or the last comes at 4 m/s.
template <class S> struct Cradle {
  ParticleWorld<S> world;
  std::vector<ParticleId> row;
  double heading;

  Cradle(ParticleSolver solver, double gap, bool from_right, int hz = 60) : world(solved_by<S>(solver, 0, hz)) {
    heading = from_right ? -1 : 1;
    const ParticleMaterialId ball = world.add(grain_of<S>(0.5, 1, 0, true));
    for (int i = 0; i < 5; ++i) {
      const bool comes = i == (from_right ? 4 : 0);
      const double x = (1 + gap) * (i - 2) - (comes ? heading : 0);
      row.push_back(world.create(point<S>({x, 0, 0}, {comes ? 4 * heading : 0, 0, 0}, 1, ball)));
    }
  }
  double speed(int i) const { return speed_of(world, row[static_cast<std::size_t>(i)]).x; }
  double energy() const {
    double sum = 0;
    for (int i = 0; i < 5; ++i) sum += speed(i) * speed(i) / 2;
    return sum;
  }
  double momentum() const {
    double sum = 0;
    for (int i = 0; i < 5; ++i) sum += speed(i);
    return sum;
  }
  void expect_last_alone_moves(double bound, const char* what) const {
    for (int i = 0; i < 5; ++i) {
      const bool last = i == (heading < 0 ? 0 : 4);
      EXPECT_NEAR(speed(i), last ? 4 * heading : 0, bound) << what << " ball " << i;
    }
  }
};

// O10. One after another they pass it on: the book's resolver even where they touch.
TYPED_TEST(ParticleCollisionLaws, of_a_row_of_balls_only_the_last_leaves) {
  using S = TypeParam;
  const double bound = pick<S>(1e-5, 1e-12, 1e-3, 1e-8);
  for (const bool from_right : {false, true}) {
    for (const double gap : {0.0, 0.0078125, 0.09375}) {
      Cradle<S> book(ParticleSolver::worst_first, gap, from_right);
      run(book.world, 90);
      book.expect_last_alone_moves(bound, "worst_first");
    }
    // The default restores speed at the end of a step: what is farther apart than a step's way is hit in a later one.
    Cradle<S> apart(ParticleSolver::soft_step, 0.09375, from_right);
    run(apart.world, 90);
    apart.expect_last_alone_moves(bound, "soft_step");
  }
}

// O10, and where it ends. Simultaneous impulses share out what touches: momentum stays, and no energy comes of it.
TYPED_TEST(ParticleCollisionLaws, a_row_that_is_hit_all_at_once_shares_the_blow_and_gains_nothing) {
  using S = TypeParam;
  for (const bool from_right : {false, true}) {
    for (const double gap : {0.0, 0.0078125, 0.015625, 0.03125, 0.0625}) {
      Cradle<S> c(ParticleSolver::soft_step, gap, from_right);
      double energy = c.energy();
      for (int i = 0; i < 120; ++i) {
        ASSERT_TRUE(c.world.step().clean());
        ASSERT_LE(c.energy(), energy + pick<S>(1e-5, 1e-12, 1e-3, 1e-8)) << "gap " << gap << " step " << i;
        energy = c.energy();
      }
      EXPECT_LT(energy, 8.001);
      EXPECT_NEAR(c.momentum(), 4 * c.heading, pick<S>(1e-5, 1e-13, 0, 0)) << gap;
      EXPECT_GT(c.speed(from_right ? 0 : 4) * c.heading, 1) << "the last one is the fastest";
    }
  }
}

// O17. v_0^2 / (2 mu g) after v_0 / (mu g), whatever the heading.
TYPED_TEST(ParticleCollisionLaws, a_sliding_particle_stops_after_its_square_of_speed_over_twice_friction) {
  using S = TypeParam;
  constexpr double kSpeed = 4, kFriction = 0.4;
  for (const ParticleSolver solver : kSolvers) {
    for (int i = 0; i < 7; ++i) {
      const double angle = 2 * kPi * i / 7 + 0.1;
      const D3 heading = {std::cos(angle), 0, std::sin(angle)};
      ParticleWorld<S> w(solved_by<S>(solver, -10));
      const ParticleMaterialId block = w.add(grain_of<S>(0.25, 0, kFriction, false));
      w.add(plane<S>({0, 1, 0}, 0));
      const ParticleId id = w.create(point<S>({0, 0.25, 0}, heading * kSpeed, 2, block));
      const double part = pick<S>(0.01, 0.01, 0.02, 0.01);
      const double time = kSpeed / (kFriction * 10), way = kSpeed * time / 2;
      for (int k = 1; k <= 90; ++k) {
        ASSERT_TRUE(w.step().clean());
        const double left = std::max(0.0, kSpeed - kFriction * 10 * k / 60.0);
        ASSERT_NEAR(dot(speed_of(w, id), heading), left, part * kSpeed) << name_of(solver) << " step " << k;
      }
      const D3 at = real(w.position(id));
      EXPECT_NEAR(dot(at, heading), way, part * way) << name_of(solver) << " heading " << i;
      EXPECT_NEAR(at.x * heading.z - at.z * heading.x, 0, 2e-3) << name_of(solver) << " heading " << i;
      EXPECT_LT(length(speed_of(w, id)), 1e-4) << name_of(solver);
    }
  }
}

/// 27 balls that fall towards their middle with some turning; some on rods and cables.
template <class S> struct Cluster {
  ParticleWorld<S> world;
  std::vector<ParticleId> ids;
  std::vector<double> masses;

  Cluster(ParticleSolver solver, bool alike, double friction) : world(solved_by<S>(solver)) {
    const ParticleMaterialId soft = world.add(grain_of<S>(0.5, 0, friction, true));
    const ParticleMaterialId hard = world.add(grain_of<S>(0.5, 0.5, friction, true));
    for (int i = 0; i < 27; ++i) {
      const D3 at = {1.5 * (i % 3 - 1), 1.5 * (i / 3 % 3 - 1), 1.5 * (i / 9 - 1)};
      masses.push_back(alike ? 1 : 1 + i % 4);
      const D3 v = at * -1.5 + D3{at.z, 0.1 * i, -at.x} * 0.5;
      ids.push_back(world.create(point<S>(at, v, masses.back(), i % 3 == 0 ? hard : soft)));
    }
    for (int i = 0; i + 9 < 27; i += 2) {
      Link<S> link;
      link.type = i % 4 == 0 ? LinkType::rod : LinkType::cable;
      link.a = ids[static_cast<std::size_t>(i)];
      link.b = ids[static_cast<std::size_t>(i) + 9];
      link.length = num<S>(1.5);
      EXPECT_TRUE(world.add(link));
    }
  }
  D3 momentum() const {
    D3 sum = {0, 0, 0};
    for (std::size_t i = 0; i < ids.size(); ++i) sum = sum + speed_of(world, ids[i]) * masses[i];
    return sum;
  }
  D3 angular_momentum() const {
    D3 sum = {0, 0, 0};
    for (std::size_t i = 0; i < ids.size(); ++i)
      sum = sum + cross(real(world.position(ids[i])), speed_of(world, ids[i])) * masses[i];
    return sum;
  }
};

// O24. Every impulse is given to two particles at once.
TYPED_TEST(ParticleCollisionLaws, a_cluster_that_collides_in_free_space_keeps_its_momentum) {
  using S = TypeParam;
  for (const ParticleSolver solver : kSolvers) {
    for (const bool alike : {true, false}) {
      for (const double friction : {0.0, 0.5}) {
        Cluster<S> c(solver, alike, friction);
        const D3 p = c.momentum(), l = c.angular_momentum();
        std::size_t touches = 0;
        for (int i = 0; i < 120; ++i) {
          c.world.step();
          touches += c.world.events().contact_begin.size();
        }
        EXPECT_GT(touches, 40u);
        // Sums of halves are exact in fixed point: equal masses, and not one bit is lost.
        const double bound = kIsFixed<S> && alike ? 0 : pick<S>(2e-4, 1e-12, 2e-2, 1e-6);
        expect_near(c.momentum(), p, bound, name_of(solver));
        // Impulses along the line between two points turn nothing; friction at points has no surface to act on.
        EXPECT_GT(length(l), 20);
        if (friction == 0) expect_near(c.angular_momentum(), l, 0.02 * length(l), name_of(solver));
      }
    }
  }
}

// O31. A bullet whose sub-step is twenty walls long meets the wall at d / v and goes back from there.
TYPED_TEST(ParticleCollisionLaws, divided_time_stops_a_bullet_at_a_wall_twenty_times_thinner_than_its_step) {
  using S = TypeParam;
  constexpr double kRate = 60, kHalf = 1.0 / 64, kSpeed = 20 * 2 * kHalf * kRate, kSize = 1.0 / 128;  // [m], [m/s]
  for (const double e : {0.0, 0.5, 1.0}) {
    for (const double share : {0.25, 0.5, 0.75}) {
      ParticleSettings<S> s = solved_by<S>(ParticleSolver::worst_first, 0, 60, 1);
      s.stepping = Stepping::time_division;
      ParticleWorld<S> w(s);
      const ParticleMaterialId lead = w.add(grain_of<S>(kSize, e, 0, false));
      Collider<S> wall;
      wall.type = ColliderType::line;
      wall.start = vec<S>(0, -1, 0);
      wall.end = vec<S>(0, 1, 0);
      wall.radius = num<S>(kHalf);
      ASSERT_TRUE(w.add(wall));
      const double way = share * kSpeed / kRate, edge = -(kHalf + kSize);
      const ParticleId id = w.create(point<S>({edge - way, 0, 0}, {kSpeed, 0, 0}, 0.5, lead));
      ASSERT_TRUE(w.step().clean());
      // Where it would be by now, had it bounced at way / speed: the law's 10 us and so on of time, times the speed.
      const double expected = edge - e * (1 - share) * kSpeed / kRate;
      const double bound = pick<S>(1e-5, 1e-12, 1e-3, 1e-8) * kSpeed;
      EXPECT_NEAR(to_double(w.position(id).x), expected, bound) << "e " << e << " after " << share;
      EXPECT_NEAR(to_double(w.velocity(id).x), -e * kSpeed, bound) << "e " << e << " after " << share;
      EXPECT_EQ(w.events().contact_begin.size(), 1u);
      run(w, 20);
      EXPECT_LT(to_double(w.position(id).x), edge + bound) << "it went through";
    }
  }
}

// O31. The same for a particle that is shot at a smaller one.
TYPED_TEST(ParticleCollisionLaws, divided_time_lets_no_bullet_pass_through_a_particle) {
  using S = TypeParam;
  ParticleSettings<S> s = solved_by<S>(ParticleSolver::worst_first, 0, 60, 1);
  s.stepping = Stepping::time_division;
  ParticleWorld<S> w(s);
  const ParticleMaterialId lead = w.add(grain_of<S>(1.0 / 64, 1, 0, true));
  const ParticleId bullet = w.create(point<S>({-0.25, 0, 0}, {60, 0, 0}, 1, lead));
  const ParticleId target = w.create(point<S>({0.25, 0, 0}, {0, 0, 0}, 1, lead));
  ASSERT_TRUE(w.step().clean());
  // They meet 1/32 m apart after 0.46875 m of the metre; the target flies on with the rest.
  const double bound = pick<S>(1e-5, 1e-12, 1e-3, 1e-8) * 60;
  EXPECT_NEAR(to_double(w.position(bullet).x), 0.25 - 0.03125, bound);
  EXPECT_NEAR(to_double(w.position(target).x), 0.25 + 1 - 0.46875, bound);
  EXPECT_NEAR(to_double(w.velocity(bullet).x), 0, bound);
  EXPECT_NEAR(to_double(w.velocity(target).x), 60, bound);
}

}  // namespace particle_collisions_test
}  // namespace isostep::test
