// Laws of cables and rods: pendulums plane and conical, the bounce at a cable's end, the catenary.
// SPDX-License-Identifier: MIT

#include <algorithm>

#include "laws/particle_laws.hpp"

namespace isostep::test {
namespace particle_links_test {

template <class S> class ParticleLinkLaws : public ::testing::Test {};
TYPED_TEST_SUITE(ParticleLinkLaws, AllScalars);

constexpr ParticleSolver kSolvers[] = {ParticleSolver::soft_step, ParticleSolver::worst_first};
constexpr const char* kLinkNames[] = {"cable ", "rod "};
const char* name_of(ParticleSolver solver) { return kParticleSolverNames[static_cast<int>(solver)]; }

/// A bob on a link of 2 m under the anchor.
template <class S> struct Pendulum {
  static constexpr double kLength = 2, kHeight = 3;
  ParticleWorld<S> world;
  ParticleId bob;
  LinkId link;

  Pendulum(ParticleSolver solver, LinkType type, D3 at, D3 velocity = {0, 0, 0}, int substeps = 4)
      : world(settings(solver, substeps)) {
    bob = world.create(point<S>(at, velocity, 3));
    Link<S> l;
    l.type = type;
    l.a = bob;
    l.anchor = vec<S>(0, kHeight, 0);
    l.length = num<S>(kLength);
    link = world.add(l);
    EXPECT_TRUE(link);
  }
  static ParticleSettings<S> settings(ParticleSolver solver, int substeps) {
    ParticleSettings<S> s = at_rate<S>(-10, 60, substeps);
    s.solver = solver;
    return s;
  }
  D3 place() const { return real(world.position(bob)) - D3{0, kHeight, 0}; }
  double energy() const {
    const D3 v = real(world.state().velocity[bob.slot]);
    return dot(v, v) / 2 + 10 * place().y;
  }
  /// [s] The time of `swings` whole swings, by interpolated crossings of x = 0 to the right.
  double period(int swings) {
    double before = place().x, first = -1;
    int crossings = 0;
    for (int i = 1; i < 60 * 60; ++i) {
      world.step();
      const double now = place().x;
      if (before < 0 && now >= 0) {
        const double at = (i - 1 + before / (before - now)) / 60;
        if (first < 0) first = at;
        else if (++crossings == swings) return (at - first) / swings;
      }
      before = now;
    }
    ADD_FAILURE() << "it does not swing";
    return 0;
  }
};
D3 hanging(double angle, double length) { return {length * std::sin(angle), -length * std::cos(angle), 0}; }

// O15. T = 2 pi sqrt(L / g) (1 + angle^2 / 16 + 11 angle^4 / 3072).
TYPED_TEST(ParticleLinkLaws, a_bob_on_a_rod_or_a_cable_swings_in_the_time_of_a_point) {
  using S = TypeParam;
  for (const ParticleSolver solver : kSolvers) {
    for (const LinkType type : {LinkType::rod, LinkType::cable}) {
      for (const double angle : {0.1, 0.5, 1.0}) {
        const double expected =
            2 * kPi * std::sqrt(Pendulum<S>::kLength / 10) * (1 + angle * angle / 16 + 11 * std::pow(angle, 4) / 3072);
        Pendulum<S> p(solver, type, hanging(angle, Pendulum<S>::kLength) + D3{0, Pendulum<S>::kHeight, 0});
        const double start = p.energy();
        const double found = p.period(4);
        EXPECT_NEAR(found, expected, pick<S>(0.005, 0.005, 0.01, 0.005) * expected) << name_of(solver) << angle;
        EXPECT_NEAR(length(p.place()), Pendulum<S>::kLength, 1e-3) << name_of(solver) << angle;
        // Turned velocities lose what lies along the link: it may only fall.
        EXPECT_LE(p.energy(), start + 1e-3) << name_of(solver) << angle;
        EXPECT_GE(p.energy(), start - 0.1 * (start + 20)) << name_of(solver) << angle;
      }
    }
  }
}

// O15. w^2 = g / (L cos(angle)).
TYPED_TEST(ParticleLinkLaws, a_bob_sent_round_draws_a_cone_in_its_time) {
  using S = TypeParam;
  for (const ParticleSolver solver : kSolvers) {
    for (const LinkType type : {LinkType::rod, LinkType::cable}) {
      const double angle = 0.6, rate = std::sqrt(10 / (Pendulum<S>::kLength * std::cos(angle)));
      const double radius = Pendulum<S>::kLength * std::sin(angle), height = -Pendulum<S>::kLength * std::cos(angle);
      Pendulum<S> p(solver, type, {-0.001, Pendulum<S>::kHeight + height, radius}, {radius * rate, 0, 0});
      EXPECT_NEAR(p.period(3), 2 * kPi / rate, pick<S>(0.005, 0.005, 0.01, 0.005) * 2 * kPi / rate);
      EXPECT_NEAR(p.place().y, height, 0.02) << name_of(solver);
      EXPECT_NEAR(length(p.place()), Pendulum<S>::kLength, 1e-3) << name_of(solver);
    }
  }
}

// A cable holds nothing until it is taut; then its bob goes back at e times its speed, as in O8 with an endless mass.
TYPED_TEST(ParticleLinkLaws, a_bob_flies_freely_to_the_end_of_its_cable_and_comes_back) {
  using S = TypeParam;
  for (const ParticleSolver solver : kSolvers) {
    for (const double e : {0.0, 0.5, 1.0}) {
      Pendulum<S> p(solver, LinkType::cable, {0.5, Pendulum<S>::kHeight, 0}, {6, 0, 0});
      ASSERT_TRUE(p.world.set_gravity(vec<S>(0, 0, 0)));
      Link<S> l = *p.world.find(p.link);
      l.restitution = num<S>(e);
      ASSERT_TRUE(p.world.set(p.link, l));
      for (int i = 1; i <= 14; ++i) {
        ASSERT_TRUE(p.world.step().clean());
        ASSERT_NEAR(p.place().x, 0.5 + 6 * i / 60.0, pick<S>(1e-6, 1e-14, 1e-4, 1e-8)) << name_of(solver) << i;
      }
      run(p.world, 6);
      EXPECT_NEAR(real(p.world.state().velocity[p.bob.slot]).x, -6 * e, 2 * speed_grain<S>(6)) << name_of(solver) << e;
      // It turned within the step of t = 0.25 s, and may have stood at the end for the rest of that step.
      const double late = e * 6 / 60 + 0.003;
      EXPECT_NEAR(p.place().x, 2 - e * 6 * (20 / 60.0 - 0.25), late) << name_of(solver) << e;
      EXPECT_LE(p.place().x, 2.003) << name_of(solver);
    }
  }
}

// O24. A dumbbell turns about its centre of mass, which flies straight: the rod's impulses are equal and opposite.
TYPED_TEST(ParticleLinkLaws, a_turning_dumbbell_keeps_its_momentum_and_its_length) {
  using S = TypeParam;
  for (const ParticleSolver solver : kSolvers) {
    ParticleSettings<S> settings = Pendulum<S>::settings(solver, 8);
    settings.gravity = vec<S>(0, 0, 0);
    ParticleWorld<S> w(settings);
    Link<S> rod;
    rod.type = LinkType::rod;
    rod.a = w.create(point<S>({-0.75, 0, 0}, {1, -0.75, 0.25}, 1));
    rod.b = w.create(point<S>({0.25, 0, 0}, {1, 0.25, 0.25}, 3));
    ASSERT_TRUE(w.add(rod));
    const auto turning = [&] {
      const D3 d = real(w.position(rod.b)) - real(w.position(rod.a));
      return cross(d, real(w.velocity(rod.b)) - real(w.velocity(rod.a))).z;
    };
    run(w, 240);
    const D3 a = real(w.position(rod.a)), b = real(w.position(rod.b));
    expect_near((a + b * 3.0) * 0.25, D3{4, 0, 1}, pick<S>(1e-5, 1e-13, 1e-3, 1e-6), name_of(solver));
    EXPECT_NEAR(length(b - a), 1, 1e-3) << name_of(solver);
    EXPECT_NEAR(turning(), 1, 0.02) << name_of(solver);
    EXPECT_LE(turning(), 1 + 1e-3) << name_of(solver);
  }
}

/// Fifty links between two posts.
template <class S> struct Chain {
  static constexpr int kLinks = 50;
  static constexpr double kSpan = 6, kLength = 8, kPiece = kLength / kLinks, kMass = 0.25;
  ParticleWorld<S> world;
  std::vector<ParticleId> ids;

  Chain(LinkType type, int substeps) : world(at_rate<S>(-10, 60, substeps)) {
    ParticleMaterial<S> m;
    m.damping = num<S>(0.25);
    const ParticleMaterialId material = world.add(m);
    // A parabola of about the right sag to begin with.
    for (int i = 1; i < kLinks; ++i) {
      const double x = kSpan * (double(i) / kLinks - 0.5);
      ids.push_back(
          world.create(point<S>({x, 2.2 * (4 * x * x / (kSpan * kSpan) - 1), 0}, {0, 0, 0}, kMass, material)));
    }
    for (int i = 0; i < kLinks; ++i) {
      Link<S> l;
      l.type = type;
      l.a = ids[static_cast<std::size_t>(std::min(i, kLinks - 2))];
      if (i > 0 && i < kLinks - 1) l.b = ids[static_cast<std::size_t>(i) - 1];
      l.anchor = vec<S>(i == 0 ? -kSpan / 2 : kSpan / 2, 0, 0);
      l.length = num<S>(kPiece);
      EXPECT_TRUE(world.add(l));
    }
  }
  D3 at(int i) const {
    if (i == 0 || i == kLinks) return {i == 0 ? -kSpan / 2 : kSpan / 2, 0, 0};
    return real(world.position(ids[static_cast<std::size_t>(i) - 1]));
  }
};
double bisect(double low, double high, double (*f)(double)) {
  for (int i = 0; i < 200; ++i) {
    const double middle = (low + high) / 2;
    (f(middle) > 0 ? low : high) = middle;
  }
  return low;
}

// O22. y = a cosh(x / a), where 2 a sinh(D / 2a) is the length; the horizontal tension is w a everywhere. A link of
// soft_step is a spring that gives by 0.4 h^2 of the acceleration that it holds back, here up to 30 g: at the default
// four sub-steps that is 3.9 % of the sag, at sixteen 0.3 %.
TYPED_TEST(ParticleLinkLaws, a_chain_of_fifty_links_hangs_as_a_catenary) {
  using S = TypeParam;
  using C = Chain<S>;
  const double a = bisect(0.1, 100, [](double x) { return 2 * x * std::sinh(C::kSpan / 2 / x) - C::kLength; });
  const double sag = a * (std::cosh(C::kSpan / 2 / a) - 1), part = pick<S>(0.01, 0.01, 0.02, 0.01);
  for (const LinkType type : {LinkType::rod, LinkType::cable}) {
    constexpr int kSubsteps = 16;
    C c(type, kSubsteps);
    run(c.world, 60 * 14);
    EXPECT_NEAR(-c.at(C::kLinks / 2).y, sag, part * sag) << kLinkNames[static_cast<int>(type)];
    const double pull = C::kMass * 10 / C::kPiece * a;  // [N]
    for (int i = 0; i < C::kLinks; ++i) {
      const D3 from = c.at(i), to = c.at(i + 1), way = to - from;
      EXPECT_NEAR(to.y, a * std::cosh(to.x / a) - a - sag, part * sag) << kLinkNames[static_cast<int>(type)] << i;
      // Impulses are changes of relative velocity: of two equal masses, or of one and the post.
      const double reduced = i == 0 || i == C::kLinks - 1 ? C::kMass : C::kMass / 2;
      const double impulse = to_double(c.world.state().link_impulses[static_cast<std::size_t>(i)]);
      const double tension = std::fabs(impulse) * reduced * 60 * kSubsteps;
      EXPECT_NEAR(tension * way.x / length(way), pull, 2 * part * pull) << kLinkNames[static_cast<int>(type)] << i;
    }
  }
}

// O22, at the default rate: what the springs of the links give goes with h^2.
TYPED_TEST(ParticleLinkLaws, the_stretch_of_a_hanging_link_falls_with_the_square_of_the_sub_step) {
  using S = TypeParam;
  for (const int substeps : {2, 4, 8}) {
    Pendulum<S> p(ParticleSolver::soft_step, LinkType::cable, {0, 1, 0}, {0, 0, 0}, substeps);
    run(p.world, 120);
    const double stretch = length(p.place()) - Pendulum<S>::kLength, h = 1.0 / (60 * substeps);
    EXPECT_NEAR(stretch, 0.4 * h * h * 10, pick<S>(0.1, 0.1, 0.4, 0.1) * 0.4 * h * h * 10 + 2 * grain<S>(4))
        << substeps;
  }
}

}  // namespace particle_links_test
}  // namespace isostep::test
