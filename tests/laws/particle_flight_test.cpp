// Laws of free flight: projectiles, damping, drag. Each against its recurrence in a wider format and against the motion
// without time steps.
// SPDX-License-Identifier: MIT

#include "laws/particle_laws.hpp"

namespace isostep::test {
namespace particle_flight_test {

template <class S> class ParticleFlightLaws : public ::testing::Test {};
TYPED_TEST_SUITE(ParticleFlightLaws, AllScalars);

constexpr int kSteps = 640;  // 10 s
constexpr Wide kStep = 1.0L / 64;
const D3 kFrom = {-40.3, 1.7, 20.1}, kSpeed = {9.1, 47.3, -5.7};

/// The rates have one sub-step, in one piece a step or in four.
struct Rate {
  std::int32_t hz, substeps;
};
constexpr Rate kRates[] = {{64, 1}, {16, 4}};

template <class S> ParticleWorld<S> world_of(Integrator integrator, Rate rate, double gravity = -9.81) {
  ParticleSettings<S> s = at_rate<S>(gravity, rate.hz, rate.substeps);
  s.integrator = integrator;
  return ParticleWorld<S>(s);
}

// O1. Velocity first: x_n = x_0 + n h v_0 + a h^2 n (n + 1) / 2; position first: n (n - 1); second order and more: n^2.
TYPED_TEST(ParticleFlightLaws, a_projectile_follows_the_recurrence_of_its_integrator) {
  using S = TypeParam;
  struct Order {
    Integrator integrator;
    int more;  // n (n + more)
  };
  for (const Order order : {Order{Integrator::semi_implicit_euler, 1}, Order{Integrator::explicit_euler, -1},
                            Order{Integrator::velocity_verlet, 0}, Order{Integrator::rk4, 0}}) {
    for (const Rate rate : kRates) {
      ParticleWorld<S> w = world_of<S>(order.integrator, rate);
      const ParticleId id = w.create(point<S>(kFrom, kSpeed));
      run(w, kSteps / rate.substeps);
      const Wide g = held<S>(-9.81), n = kSteps;
      const Wide fall = g * kStep * kStep * n * (n + order.more) / 2;
      // Verlet rounds a h / 2 twice where the others round a h once.
      const double bound = pick<S>(4e-3, 6e-12, 3e-2, 2e-7);
      const char* name = kIntegratorNames[static_cast<int>(order.integrator)];
      EXPECT_NEAR(to_double(w.position(id).x), held<S>(kFrom.x) + 10 * held<S>(kSpeed.x), bound) << name;
      EXPECT_NEAR(to_double(w.position(id).y), double(held<S>(kFrom.y) + 10 * held<S>(kSpeed.y) + fall), bound) << name;
      EXPECT_NEAR(to_double(w.position(id).z), held<S>(kFrom.z) + 10 * held<S>(kSpeed.z), bound) << name;
      EXPECT_NEAR(to_double(w.velocity(id).y), double(held<S>(kSpeed.y) + g * 10), bound) << name;
    }
  }
}

// O1, continuous. After 10 s a first-order arc is off by |a| h T / 2: 0.77 m, half of that at twice the rate. Every
// sub-step adds the same rounded a h, so that what rounding does grows with their number.
TYPED_TEST(ParticleFlightLaws, the_error_of_a_projectile_halves_with_the_sub_step) {
  using S = TypeParam;
  const double exact = kFrom.y + 10 * kSpeed.y - 9.81 * 50;
  for (const int substeps : {1, 2, 4, 8}) {
    ParticleWorld<S> w(at_rate<S>(-9.81, 64, substeps));
    const ParticleId id = w.create(point<S>(kFrom, kSpeed));
    run(w, kSteps);
    const double gap = 9.81 * 10 / (64.0 * substeps) / 2;
    EXPECT_NEAR(to_double(w.position(id).y), exact - gap, pick<S>(1e-2, 5e-11, 3e-2, 4e-6)) << substeps;
  }
}

// O2. v' = (v + a h) d^h, x' = x + v' h; continuous with k = ln d: x = x_0 + (v_0 + a/k) (e^kt - 1) / k - a t / k.
TYPED_TEST(ParticleFlightLaws, a_damped_projectile_keeps_its_share_of_speed_a_second) {
  using S = TypeParam;
  for (const double damping : {0.99, 0.95, 0.5}) {
    for (const Rate rate : kRates) {
      ParticleWorld<S> w = world_of<S>(Integrator::semi_implicit_euler, rate);
      ParticleMaterial<S> m;
      m.damping = num<S>(damping);
      const ParticleId id = w.create(point<S>(kFrom, kSpeed, 1, w.add(m)));
      run(w, kSteps / rate.substeps);
      const Wide d = held<S>(damping), g = held<S>(-9.81), keep = std::pow(d, kStep), k = std::log(d);
      Wide v[2] = {held<S>(kSpeed.x), held<S>(kSpeed.y)}, x[2] = {held<S>(kFrom.x), held<S>(kFrom.y)};
      const Wide exact = x[1] + (v[1] + g / k) * std::expm1(10 * k) / k - 10 * g / k;
      for (int i = 0; i < kSteps; ++i) {
        v[0] *= keep;
        v[1] = (v[1] + g * kStep) * keep;
        x[0] += v[0] * kStep;
        x[1] += v[1] * kStep;
      }
      const double bound = pick<S>(2e-3, 1e-11, 3e-2, 7e-7);
      EXPECT_NEAR(to_double(w.position(id).x), double(x[0]), bound) << damping;
      EXPECT_NEAR(to_double(w.position(id).y), double(x[1]), bound) << damping;
      EXPECT_NEAR(to_double(w.velocity(id).y), double(v[1]), bound) << damping;
      // The book's gap of a first-order method; damping only narrows it.
      EXPECT_NEAR(to_double(w.position(id).y), double(exact), 0.78 + bound) << damping;
    }
  }
}

// O2. Of every integrator damping leaves d a second, whatever the rate: to within the rounding of d^h, which the
// sub-steps multiply.
TYPED_TEST(ParticleFlightLaws, without_forces_a_second_leaves_the_damping_of_the_speed) {
  using S = TypeParam;
  for (const Integrator integrator : {Integrator::explicit_euler, Integrator::semi_implicit_euler,
                                      Integrator::velocity_verlet, Integrator::rk4, Integrator::implicit_euler}) {
    for (const Rate rate : {Rate{64, 1}, Rate{60, 4}, Rate{100, 7}}) {
      ParticleWorld<S> w = world_of<S>(integrator, rate, 0);
      ParticleMaterial<S> m;
      m.damping = num<S>(0.9);
      const ParticleId id = w.create(point<S>({0, 0, 0}, {16, -8, 4}, 1, w.add(m)));
      run(w, 3 * rate.hz);
      const double left = std::pow(held<S>(0.9), 3.0), bound = pick<S>(6e-4, 1e-11, 1e-3, 1e-6);
      expect_near(real(w.velocity(id)), D3{16, -8, 4} * left, bound, kIntegratorNames[static_cast<int>(integrator)]);
    }
  }
}

/// m v' = m g - k1 v - k2 v^2, downwards.
struct Drag {
  double linear, quadratic, mass;
  Wide terminal(Wide g) const {
    if (quadratic == 0) return mass * g / linear;
    const Wide k1 = linear, k2 = quadratic;
    return (-k1 + std::sqrt(k1 * k1 + 4 * k2 * mass * g)) / (2 * k2);
  }
};

/// The drag is in its material, or a force of its own.
template <class S> ParticleId dragged(ParticleWorld<S>& w, const Drag& drag, bool of_material, D3 velocity) {
  ParticleMaterial<S> m;
  if (of_material) {
    m.linear_drag = num<S>(drag.linear);
    m.quadratic_drag = num<S>(drag.quadratic);
  }
  const ParticleId id = w.create(point<S>({0, 0, 0}, velocity, drag.mass, w.add(m)));
  if (of_material) return id;
  ParticleForce<S> f;
  f.type = ForceType::drag;
  f.particle = id;
  f.linear_drag = num<S>(drag.linear);
  f.quadratic_drag = num<S>(drag.quadratic);
  EXPECT_TRUE(w.add(f));
  return id;
}

// O3. The terminal speed is a fixed point of every integrator. Numbers of every format, so that none is rounded.
TYPED_TEST(ParticleFlightLaws, what_falls_through_air_ends_at_its_terminal_speed) {
  using S = TypeParam;
  for (const Integrator integrator :
       {Integrator::explicit_euler, Integrator::semi_implicit_euler, Integrator::velocity_verlet, Integrator::rk4}) {
    for (const bool of_material : {true, false}) {
      for (const Drag drag : {Drag{0.75, 0, 0.5}, Drag{0, 0.25, 2}, Drag{0.5, 0.125, 1}, Drag{2, 1, 8}}) {
        ParticleWorld<S> w = world_of<S>(integrator, {64, 1}, -10);
        const ParticleId id = dragged(w, drag, of_material, {0, 0, 0});
        run(w, 64 * 20);
        const double v = double(drag.terminal(10)), bound = pick<S>(1e-4, 1e-10, 1e-2, 1e-6);
        EXPECT_NEAR(to_double(w.velocity(id).y), -v, bound * v)
            << kIntegratorNames[static_cast<int>(integrator)] << " " << drag.linear << " " << drag.quadratic;
      }
    }
  }
}

// O3. With k1 = 0: v = v_t tanh(g t / v_t). Tight against the recurrence, loose against the curve; tighter by RK4.
TYPED_TEST(ParticleFlightLaws, speed_through_air_follows_the_hyperbolic_tangent) {
  using S = TypeParam;
  for (const bool of_material : {true, false}) {
    const Drag drag = {0, 0.25, 2};
    ParticleWorld<S> w = world_of<S>(Integrator::semi_implicit_euler, {64, 1}, -10);
    ParticleWorld<S> fine = world_of<S>(Integrator::rk4, {64, 1}, -10);
    const ParticleId id = dragged(w, drag, of_material, {0, 0, 0}),
                     id_fine = dragged(fine, drag, of_material, {0, 0, 0});
    Wide v = 0, x = 0;
    const Wide terminal = drag.terminal(10);
    for (int i = 1; i <= 128; ++i) {
      w.step();
      fine.step();
      v += (10 - drag.quadratic * v * v / drag.mass) * kStep;
      x += v * kStep;
      const double curve = double(terminal * std::tanh(10 * i * kStep / terminal));
      ASSERT_NEAR(to_double(w.velocity(id).y), double(-v), pick<S>(2e-5, 1e-13, 1e-3, 1e-7)) << i;
      ASSERT_NEAR(to_double(w.position(id).y), double(-x), pick<S>(2e-5, 1e-13, 1e-3, 1e-7)) << i;
      ASSERT_NEAR(to_double(w.velocity(id).y), -curve, 0.06) << i;
      ASSERT_NEAR(to_double(fine.velocity(id_fine).y), -curve, pick<S>(2e-5, 1e-6, 2e-3, 1e-6)) << i;
    }
  }
}

// Drag acts against the velocity, whatever its heading: the path stays straight and the speed is that of one axis.
TYPED_TEST(ParticleFlightLaws, drag_slows_a_coasting_particle_along_its_path) {
  using S = TypeParam;
  for (const bool of_material : {true, false}) {
    ParticleWorld<S> w = world_of<S>(Integrator::semi_implicit_euler, {64, 1}, 0);
    const ParticleId id = dragged(w, {0.25, 0.125, 2}, of_material, {8, -4, 1});  // 9 m/s
    Wide v = 9, x = 0;
    for (int i = 0; i < 256; ++i) {
      v -= (0.25L * v + 0.125L * v * v) / 2 * kStep;
      x += v * kStep;
    }
    run(w, 256);
    const double bound = pick<S>(1e-4, 1e-12, 4e-3, 1e-7);
    expect_near(real(w.velocity(id)), D3{8, -4, 1} * double(v / 9), bound, "velocity");
    expect_near(real(w.position(id)), D3{8, -4, 1} * double(x / 9), bound, "position");
  }
}

}  // namespace particle_flight_test
}  // namespace isostep::test
