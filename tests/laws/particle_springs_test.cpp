// Laws of springs and floats: oscillators of every integrator, stiff springs in their three regimes, hanging chains,
// buoyancy.
// SPDX-License-Identifier: MIT

#include <algorithm>

#include "laws/particle_laws.hpp"

namespace isostep::test {
namespace particle_springs_test {

template <class S> class ParticleSpringLaws : public ::testing::Test {};
TYPED_TEST_SUITE(ParticleSpringLaws, AllScalars);

constexpr Wide kStep = 1.0L / 64;

/// The map of (x, v) by one sub-step.
struct Propagator {
  Wide xx, xv, vx, vv;
  void apply(Wide& x, Wide& v) const {
    const Wide next = xx * x + xv * v;
    v = vx * x + vv * v;
    x = next;
  }
};
/// The map of x'' = -w^2 x over h, by the definition of each method: z' = A z with A = (0 1; -w^2 0), A^2 = -w^2.
Propagator propagator(Integrator integrator, Wide w, Wide h) {
  const Wide q = w * w * h * h;  // RK4: the series of e^(A h) as far as h^4
  switch (integrator) {
    case Integrator::explicit_euler: return {1, h, -w * w * h, 1};
    case Integrator::semi_implicit_euler: return {1 - q, h, -w * w * h, 1};
    case Integrator::velocity_verlet: return {1 - q / 2, h, -w * w * h * (1 - q / 4), 1 - q / 2};
    case Integrator::rk4: break;
    case Integrator::implicit_euler: return {1 / (1 + q), h / (1 + q), -w * w * h / (1 + q), 1 / (1 + q)};
  }
  const Wide even = 1 - q / 2 + q * q / 24, odd = 1 - q / 6;
  return {even, h * odd, -w * w * h * odd, even};
}

/// A particle on a spring along x about the origin.
template <class S> struct Oscillator {
  ParticleWorld<S> world;
  ParticleId bob;

  Oscillator(const ParticleSettings<S>& settings, SpringType type, double mass, double stiffness, double damping,
             double x, double v = 0, double rest = 0)
      : world(settings) {
    bob = world.create(point<S>({x, 0, 0}, {v, 0, 0}, mass));
    Spring<S> s;
    s.type = type;
    s.a = bob;
    s.anchor = vec<S>(-rest, 0, 0);
    s.rest_length = num<S>(rest);
    s.stiffness = num<S>(stiffness);
    s.damping = num<S>(damping);
    EXPECT_TRUE(world.add(s));
  }
  double x() const { return to_double(world.position(bob).x); }
  double v() const { return to_double(world.velocity(bob).x); }
  double energy(double rate) const { return (v() * v() + rate * rate * x() * x()) / 2; }
};
template <class S>
ParticleSettings<S> weightless(Integrator integrator = Integrator::semi_implicit_euler, int hz = 64) {
  ParticleSettings<S> s = at_rate<S>(0, hz, 1);
  s.integrator = integrator;
  return s;
}

// O4. w = 10 /s, w h = 0.16. A rest length that the bob never gets through keeps the spring's direction.
TYPED_TEST(ParticleSpringLaws, an_oscillator_follows_the_recurrence_of_its_integrator) {
  using S = TypeParam;
  for (const Integrator integrator : {Integrator::explicit_euler, Integrator::semi_implicit_euler,
                                      Integrator::velocity_verlet, Integrator::rk4, Integrator::implicit_euler}) {
    for (const double rest : {0.0, 2.0}) {
      Oscillator<S> o(weightless<S>(integrator), SpringType::spring, 1, 100, 0, 1, 0, rest);
      const Propagator p = propagator(integrator, 10, kStep);
      Wide x = 1, v = 0;
      // The explicit one swings 1.2 % wider every step.
      const int steps = integrator == Integrator::explicit_euler ? 48 : 640;
      for (int i = 0; i < steps; ++i) {
        ASSERT_TRUE(o.world.step().clean());
        p.apply(x, v);
        // A spring through its anchor has a direction that rounds; with a rest length |d| - rest cancels.
        const double bound = pick<S>(2e-5, 1e-12, 4e-4, 1e-7);
        ASSERT_NEAR(o.x(), double(x), bound)
            << kIntegratorNames[static_cast<int>(integrator)] << " " << rest << " " << i;
        ASSERT_NEAR(o.v(), double(v), 10 * bound) << kIntegratorNames[static_cast<int>(integrator)] << " " << i;
      }
    }
  }
}

// O4. x_n = cos(w' n h) to first order, with w' = (2/h) asin(w h / 2): the period is that of no continuous spring.
TYPED_TEST(ParticleSpringLaws, a_semi_implicit_oscillator_is_as_fast_as_its_recurrence_says) {
  using S = TypeParam;
  for (const Integrator integrator : {Integrator::semi_implicit_euler, Integrator::velocity_verlet}) {
    Oscillator<S> o(weightless<S>(integrator), SpringType::spring, 2, 200, 0, 1);
    int crossings = 0;
    double before = o.x(), first = 0, last = 0;
    for (int i = 1; i <= 640; ++i) {
      o.world.step();
      if (before < 0 && o.x() >= 0) {
        last = i - 1 + before / (before - o.x());
        if (crossings++ == 0) first = last;
      }
      before = o.x();
    }
    ASSERT_GT(crossings, 10);
    const double rate = 2 * kPi * (crossings - 1) / (last - first) * 64;
    const double discrete = 2 * 64 * std::asin(10.0 / 64 / 2);  // 10.0102
    EXPECT_NEAR(rate, discrete, 1e-3);
    EXPECT_NEAR(rate, 10, 0.02);
  }
}

// O4. E/E_0 stays within 1/(1 +- w h / 2) = 0.928..1.085 for an hour: what swings does neither rise nor fall.
TYPED_TEST(ParticleSpringLaws, the_energy_of_a_semi_implicit_oscillator_has_no_trend_over_an_hour) {
  using S = TypeParam;
  Oscillator<S> o(weightless<S>(), SpringType::spring, 1, 100, 0, 1);
  const double start = o.energy(10), half = 10.0 / 64 / 2, slack = pick<S>(1e-4, 1e-11, 6e-2, 1e-6);
  double early = 0, late = 0;
  constexpr int kHour = 64 * 3600, kMinute = 64 * 60;
  for (int i = 0; i < kHour; ++i) {
    o.world.step();
    const double e = o.energy(10) / start;
    ASSERT_GE(e, 1 / (1 + half) - slack) << i;
    ASSERT_LE(e, 1 / (1 - half) + slack) << i;
    if (i < kMinute) early += e / kMinute;
    if (i >= kHour - kMinute) late += e / kMinute;
  }
  EXPECT_NEAR(late, early, slack + 1e-3);
}

/// The exact motion of m x'' = -k x - c x' from (x, v), long after the book's three regimes.
Wide exact(Wide k, Wide c, Wide x, Wide v, Wide t) {
  const Wide b = c / 2, q = k - b * b;  // per unit of mass
  if (q > 0) {
    const Wide g = std::sqrt(q);
    return std::exp(-b * t) * (x * std::cos(g * t) + (v + b * x) / g * std::sin(g * t));
  }
  if (q == 0) return std::exp(-b * t) * (x + (v + b * x) * t);
  const Wide g = std::sqrt(-q), slow = k / (b + g), fast = b + g;
  return ((v + fast * x) * std::exp(-slow * t) - (v + slow * x) * std::exp(-fast * t)) / (2 * g);
}

// O5. Below, at and above critical damping; anchored, and between two particles, whose reduced mass is 1.5 kg.
TYPED_TEST(ParticleSpringLaws, a_stiff_spring_follows_the_exact_motion_in_all_three_regimes) {
  using S = TypeParam;
  for (const double c : {0.0, 2.0, 20.0, 50.0}) {
    Oscillator<S> o(weightless<S>(), SpringType::stiff, 2, 200, 2 * c, 1, -3);
    ParticleWorld<S> pair(weightless<S>());
    Spring<S> s;
    s.type = SpringType::stiff;
    s.a = pair.create(point<S>({0.75, 1, 0}, {-2.25, 0, 0}, 2));
    s.b = pair.create(point<S>({-0.25, 1, 0}, {0.75, 0, 0}, 6));
    s.stiffness = S(150);
    s.damping = num<S>(1.5 * c);
    ASSERT_TRUE(pair.add(s));
    // Without damping every rounding is carried on for 10 s. In Q16.16 a slow creep ends where a step's way is below
    // half a unit of the position: 2^-17 m in 1/64 s.
    const double bound = c == 0 ? pick<S>(2e-5, 5e-14, 4e-4, 2e-7) : pick<S>(8e-7, 3e-15, 3e-4, 1e-8);
    for (int i = 1; i <= 640; ++i) {
      ASSERT_TRUE(o.world.step().clean());
      ASSERT_TRUE(pair.step().clean());
      const double expected = double(exact(100, c, 1, -3, i * kStep));
      ASSERT_NEAR(o.x(), expected, bound) << "c " << c << " step " << i;
      const double a = to_double(pair.position(s.a).x), b = to_double(pair.position(s.b).x);
      ASSERT_NEAR(a - b, expected, 2 * bound) << "c " << c << " step " << i;
      // Every step rounds both speeds: by half a unit each, at worst always the same way.
      const double u = real(pair.state().velocity[s.a.slot]).x, v = real(pair.state().velocity[s.b.slot]).x;
      ASSERT_NEAR(2 * u + 6 * v, 0, i * (2 + 6) * speed_grain<S>(2) / 2) << "c " << c << " step " << i;
    }
  }
}

// O6. k h^2 / m from 10 to 10^4: from rest at A it stays within A, and within A e^(-c t / 2 m) / sqrt(1 - z^2) where it
// is damped by z of critical. At 10 steps a second and 1/64 kg the stiffest are numbers of Q16.16.
TYPED_TEST(ParticleSpringLaws, stiff_springs_never_leave_their_envelope_at_any_stiffness) {
  using S = TypeParam;
  constexpr double kFar = 0.25, kMass = 1.0 / 64;
  for (const double kappa : {10.0, 100.0, 1000.0, 10000.0}) {
    for (const double part : {0.0, 0.1, 0.5, 4.0}) {  // of critical
      const double k = kappa * 100 * kMass, b = part * std::sqrt(kappa) * 10;
      Oscillator<S> o(weightless<S>(Integrator::semi_implicit_euler, 10), SpringType::stiff, kMass, k, 2 * b * kMass,
                      kFar);
      // A thousand steps multiply what rounding leaves of the propagator's determinant.
      const double slack = pick<S>(2e-5, 1e-13, 1e-3, 1e-7);
      double far = 0;
      for (int i = 1; i <= 1000; ++i) {
        ASSERT_TRUE(o.world.step().clean());
        const double t = i / 10.0;
        const double envelope = part < 1 ? kFar * std::exp(-b * t) / std::sqrt(1 - part * part) : kFar;
        ASSERT_LE(std::fabs(o.x()), envelope + slack) << "kappa " << kappa << " damping " << part << " step " << i;
        if (i > 900) far = std::max(far, std::fabs(o.x()));
      }
      // What is not damped still swings: bounded is not the same as dead.
      EXPECT_GT(far, part == 0 ? 0.9 * kFar : -1) << kappa;
    }
  }
}

// O6, for the springs that are solved by implicit Euler: (x, v)' = (1 - h A)^-1 (x, v), whose energy falls every step.
TYPED_TEST(ParticleSpringLaws, implicit_euler_damps_springs_of_any_stiffness_by_its_recurrence) {
  using S = TypeParam;
  constexpr double kMass = 1.0 / 64;
  for (const double kappa : {10.0, 100.0, 1000.0, 10000.0}) {
    for (const double rest : {0.0, 1.0}) {
      // k x / m, the acceleration of a spring alone, has to be a number of Q16.16: 10^6 x < 2^15 m/s^2.
      const double kFar = kappa < 5000 ? 0.25 : 1.0 / 64;
      const double k = kappa * 100 * kMass, rate = std::sqrt(kappa) * 10;
      Oscillator<S> o(weightless<S>(Integrator::implicit_euler, 10), SpringType::spring, kMass, k, 0, kFar, 0, rest);
      const Propagator p = propagator(Integrator::implicit_euler, rate, 0.1L);
      Wide x = kFar, v = 0;
      double before = o.energy(rate);
      for (int i = 1; i <= 100; ++i) {
        ASSERT_TRUE(o.world.step().clean());
        p.apply(x, v);
        ASSERT_NEAR(o.x(), double(x), pick<S>(2e-6, 1e-13, 4e-4, 1e-8)) << "kappa " << kappa << " step " << i;
        ASSERT_NEAR(o.v(), double(v), pick<S>(2e-5, 1e-12, 4e-3, 1e-7)) << "kappa " << kappa << " step " << i;
        ASSERT_LE(o.energy(rate), before * (1 + 1e-6) + k / kMass * pick<S>(1e-14, 1e-30, 1e-9, 1e-18)) << kappa << i;
        before = o.energy(rate);
      }
    }
  }
}

// O7. Of a chain of N springs the i-th from the top bears N - i + 1 weights.
TYPED_TEST(ParticleSpringLaws, a_hanging_chain_stretches_link_by_link_as_its_weight_says) {
  using S = TypeParam;
  constexpr int kLinks = 8;
  constexpr double kMass = 0.5, kStiff = 64, kRest = 0.5, kTop = 4;
  for (const Integrator integrator :
       {Integrator::semi_implicit_euler, Integrator::velocity_verlet, Integrator::rk4, Integrator::implicit_euler}) {
    ParticleSettings<S> settings = at_rate<S>(-10);
    settings.integrator = integrator;
    ParticleWorld<S> w(settings);
    ParticleMaterial<S> still;
    still.damping = num<S>(1.0 / 64);  // the slowest mode is close to critical
    const ParticleMaterialId material = w.add(still);
    std::vector<ParticleId> ids;
    for (int i = 0; i < kLinks; ++i) {
      ids.push_back(w.create(point<S>({0, kTop - kRest * (i + 1), 0}, {0, 0, 0}, kMass, material)));
      Spring<S> s;
      s.a = ids.back();
      if (i > 0) s.b = ids[static_cast<std::size_t>(i) - 1];
      s.anchor = vec<S>(0, kTop, 0);
      s.rest_length = num<S>(kRest);
      s.stiffness = num<S>(kStiff);
      ASSERT_TRUE(w.add(s));
    }
    run(w, 64 * 25);
    const double bound = pick<S>(1e-4, 1e-9, 1e-2, 1e-6);
    double above = kTop;
    for (int i = 0; i < kLinks; ++i) {
      const double at = to_double(w.position(ids[static_cast<std::size_t>(i)]).y);
      const double expected = (kLinks - i) * kMass * 10 / kStiff;
      EXPECT_NEAR(above - at - kRest, expected, bound * expected)
          << kIntegratorNames[static_cast<int>(integrator)] << i;
      above = at;
    }
    const double total = kMass * 10 * kLinks * (kLinks + 1) / (2 * kStiff);
    EXPECT_NEAR(kTop - above - kLinks * kRest, total, bound * total);
  }
}

/// A float of 1 kg that displaces as much as 2^-9 m^3 of water weigh: it swims with 0.512 under the surface.
template <class S> struct Float {
  static constexpr double kDensity = 1000, kVolume = 1.0 / 512, kDepth = 0.5, kSurface = 3;
  static constexpr double kShare = 1 / (kDensity * kVolume);
  static constexpr double kLevel = kSurface + kDepth - 2 * kDepth * kShare;  // [m]
  ParticleWorld<S> world;
  ParticleId id;

  Float(double height, double damping, D3 up = {0, 1, 0}) : world(settings(up)) {
    ParticleMaterial<S> m;
    m.damping = num<S>(damping);
    id = world.create(point<S>(up * height, {0, 0, 0}, 1, world.add(m)));
    ParticleForce<S> f;
    f.type = ForceType::buoyancy;
    f.particle = id;
    f.density = num<S>(kDensity);
    f.volume = num<S>(kVolume);
    f.max_depth = num<S>(kDepth);
    f.surface_height = num<S>(kSurface);
    EXPECT_TRUE(world.add(f));
  }
  static ParticleSettings<S> settings(D3 up) {
    ParticleSettings<S> s = at_rate<S>(0);
    s.gravity = vec<S>(up * -10.0);
    return s;
  }
};

// O21.
TYPED_TEST(ParticleSpringLaws, a_float_comes_to_rest_with_its_own_weight_of_water_displaced) {
  using S = TypeParam;
  for (const D3 up : {D3{0, 1, 0}, D3{0, 0, -1}, D3{0.6, 0.8, 0}}) {
    Float<S> f(4, 0.03125, up);
    run(f.world, 64 * 20);
    expect_near(real(f.world.position(f.id)), up * f.kLevel, pick<S>(1e-4, 1e-8, 1e-2, 1e-6));
  }
}

// O21. Within the surface's depth the force is that of a spring: w^2 = rho V g / (2 max_depth m).
TYPED_TEST(ParticleSpringLaws, a_float_bobs_with_the_frequency_of_the_surface) {
  using S = TypeParam;
  constexpr double kAmplitude = 0.25;
  Float<S> f(Float<S>::kLevel + kAmplitude, 1);
  const Wide rate = std::sqrt(Wide(10) * f.kDensity * f.kVolume / (2 * f.kDepth));
  const Propagator p = propagator(Integrator::semi_implicit_euler, rate, kStep);
  Wide x = held<S>(Float<S>::kLevel + kAmplitude) - f.kLevel, v = 0;
  for (int i = 1; i <= 128; ++i) {
    f.world.step();
    p.apply(x, v);
    const double off = to_double(f.world.position(f.id).y) - f.kLevel;
    ASSERT_NEAR(off, double(x), pick<S>(1e-4, 1e-12, 1e-2, 1e-6)) << i;
    // To first order, whose phase is ahead by w h / 2.
    ASSERT_NEAR(off, kAmplitude * std::cos(double(rate) * i / 64), kAmplitude * 0.04) << i;
  }
}

// O21. All of it under water it rises at (rho V / m - 1) g, all of it above it falls at g.
TYPED_TEST(ParticleSpringLaws, a_float_feels_the_whole_of_its_buoyancy_below_and_nothing_above) {
  using S = TypeParam;
  Float<S> deep(-2, 1), high(6, 1);
  run(deep.world, 16);
  run(high.world, 16);
  const double rise = (Float<S>::kDensity * Float<S>::kVolume - 1) * 10 / 4, bound = pick<S>(1e-5, 1e-13, 1e-4, 1e-8);
  EXPECT_NEAR(to_double(deep.world.velocity(deep.id).y), rise, bound);
  EXPECT_NEAR(to_double(high.world.velocity(high.id).y), -2.5, bound);
}

}  // namespace particle_springs_test
}  // namespace isostep::test
