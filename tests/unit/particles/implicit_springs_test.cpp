// Implicit springs: against the recurrence of implicit Euler, a dense solve in double, and the laws that springs keep.
// SPDX-License-Identifier: MIT
#include "isostep/particles/implicit_springs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "unit/particles/spring_network.hpp"

namespace isostep {
namespace implicit_springs_test {

using test::inner;
using test::norm;
using test::real;
using test::SpringNetwork;

template <class S> class ImplicitSpringsOf : public testing::Test {
 protected:
  /// The error that one rounding of a velocity of size v may leave, and a little for a direction's own rounding.
  static double tolerance(double v) {
    if constexpr (kIsFixed<S>) return 1.01 * to_double(resolution<Velocity<S>>()) + 1e-14 * v;
    return 4 * to_double(resolution<S>()) * v + 1e-30;
  }
  ImplicitSprings<S> solver_;
};
using Scalars = testing::Types<float, double, Q16_16, Q32_32>;
TYPED_TEST_SUITE(ImplicitSpringsOf, Scalars);

TYPED_TEST(ImplicitSpringsOf, AnAnchoredSpringFollowsTheRecurrenceAndNeverGrows) {
  using S = TypeParam;
  constexpr double kRest = 0.5, kStart = 0.03125, kMass = 0.03125;
  for (const double ratio : {0.01, 1.0, 100.0, 1e4}) {  // k h^2 / m
    for (const double damping : {0.0, 0.25}) {
      SpringNetwork<S> net;
      net.rate = 8;
      const double h = 1.0 / net.rate;
      const ParticleId p = net.add({kRest + kStart, 0, 0}, kMass);
      net.hang(p, {0, 0, 0}, ratio * kMass / (h * h), damping, kRest);
      const double k = to_double(net.springs[0].stiffness) / kMass, c = damping / kMass;
      double x = kStart, v = 0;  // the recurrence on its own, in double
      for (int step = 0; step < 100; ++step) {
        const double v0 = to_double(net.velocity.x[0]);
        ASSERT_TRUE(net.solve(this->solver_));
        const double a = to_double(net.acceleration.x[0]);
        const double v1 = v0 + (h * a - h * h * k * v0) / (1 + h * c + h * h * k);
        const double size = std::abs(v0) + std::abs(h * a) + kStart / h;
        ASSERT_NEAR(to_double(net.velocity.x[0]), v1, this->tolerance(size)) << ratio << " at " << step;
        ASSERT_EQ(net.velocity.y[0], Velocity<S>(0));
        ASSERT_EQ(net.velocity.z[0], Velocity<S>(0));
        net.move();
        v = (v - h * k * x) / (1 + h * c + h * h * k);
        x += h * v;
        const double place = to_double(net.position.x[0]) - kRest;
        const double slack = kIsFixed<S> ? 100 * to_double(resolution<S>()) : 1e-6;
        ASSERT_NEAR(place, x, slack) << ratio << " at " << step;
        ASSERT_LE(std::abs(place), kStart) << ratio << " at " << step;
      }
      if (ratio >= 1) {
        EXPECT_LE(std::abs(to_double(net.position.x[0]) - kRest), 2 * to_double(resolution<S>()) + 1e-9);
      }
    }
  }
}

TYPED_TEST(ImplicitSpringsOf, AnAccelerationThatTheFormatCannotHoldMakesNothingGrow) {
  using S = TypeParam;
  for (const std::int32_t rate : {8, 60, 240}) {
    SpringNetwork<S> net;
    net.rate = rate;
    const ParticleId p = net.add({3, 2, 0}, 0.0078125, {1, -2, 3});
    net.hang(p, {1, 1, 1}, 32000, 0, 0);  // 9e6 m/s^2, of which Q16.16 is told 32767 an axis
    const double h = 1.0 / rate, start = norm({2, 1, -1}) + h * norm({1, -2, 3});
    double furthest = 0;
    for (int step = 0; step < 4 * rate; ++step) {
      ASSERT_TRUE(net.step(this->solver_));
      const double away = norm(net.distance(net.springs[0]));
      ASSERT_LE(away, start) << rate << " at " << step;
      furthest = step < 3 * rate ? 0 : std::max(furthest, away);
    }
    if (sizeof(S) > 4 || !kIsFixed<S>) {  // what is told of a weaker force brings a Q16.16 home later
      EXPECT_LE(furthest, 0.01) << rate;
    }
  }
}

/// dv of every unknown by elimination of the full matrix, in double, from the equation as it stands in the papers.
template <class S> std::vector<Vec3<double>> dense_solve(const SpringNetwork<S>& net) {
  const std::size_t n = net.inverse_mass.size() * 3;
  const double h = 1.0 / net.rate;
  std::vector<std::vector<double>> a(n, std::vector<double>(n + 1, 0.0));
  const auto moves = [&](ParticleId id) { return id && to_double(net.inverse_mass[id.slot]) > 0; };
  for (std::size_t i = 0; i < n; ++i) {
    const bool free = to_double(net.inverse_mass[i / 3]) > 0;
    a[i][i] = free ? net.mass(i / 3) : 1;
    if (free) a[i][n] = net.mass(i / 3) * h * real(net.acceleration[i / 3])[static_cast<int>(i % 3)];
  }
  for (const Spring<S>& spring : net.springs) {
    const Vec3<double> d = net.distance(spring), v = net.approach(spring);
    const double l = norm(d), rest = to_double(spring.rest_length);
    if (spring.type == SpringType::bungee && l <= rest) continue;
    const double across = l > rest ? 1 - rest / l : 0;
    const double n3[3] = {d.x / l, d.y / l, d.z / l}, v3[3] = {v.x, v.y, v.z};
    for (std::size_t r = 0; r < 3; ++r) {
      for (std::size_t s = 0; s < 3; ++s) {
        const double nn = n3[r] * n3[s];
        const double k = h * h * to_double(spring.stiffness) * (nn + across * ((r == s ? 1 : 0) - nn));
        const double whole = k + h * to_double(spring.damping) * nn;
        const std::size_t i = spring.a.slot * 3, j = spring.b.slot * 3;
        if (moves(spring.a)) a[i + r][i + s] += whole, a[i + r][n] -= k * v3[s];
        if (moves(spring.b)) a[j + r][j + s] += whole, a[j + r][n] += k * v3[s];
        if (moves(spring.a) && moves(spring.b)) a[i + r][j + s] -= whole, a[j + r][i + s] -= whole;
      }
    }
  }
  for (std::size_t p = 0; p < n; ++p) {
    for (std::size_t r = 0; r < n; ++r) {
      const double factor = r == p ? 0 : a[r][p] / a[p][p];
      for (std::size_t c = p; factor != 0 && c <= n; ++c) a[r][c] -= factor * a[p][c];
    }
  }
  std::vector<Vec3<double>> result;
  for (std::size_t i = 0; i < n; i += 3) {
    result.push_back({a[i][n] / a[i][i], a[i + 1][n] / a[i + 1][i + 1], a[i + 2][n] / a[i + 2][i + 2]});
  }
  return result;
}

/// Twenty particles at random, light and heavy, with springs of all kinds between them; in [0, 4]^3.
template <class S> SpringNetwork<S> tangle(double stiffness) {
  SpringNetwork<S> net;
  std::uint64_t state = 5;
  const auto draw = [&](double size) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    return size * static_cast<double>(state >> 52) / 4096;
  };
  std::vector<ParticleId> ids;
  for (int i = 0; i < 20; ++i) {
    const Vec3<double> at = {draw(4), draw(4), draw(4)};
    const Vec3<double> speed = {draw(2) - 1, draw(2) - 1, draw(2) - 1};
    const double mass = i % 5 == 0 ? 0 : std::ldexp(1, i % 7 - 3);
    ids.push_back(net.add(at, mass, mass > 0 ? speed : Vec3<double>{0, 0, 0}));
  }
  for (std::size_t i = 0; i < 60; ++i) {
    const std::size_t a = static_cast<std::size_t>(draw(20)), b = static_cast<std::size_t>(draw(20));
    if (a == b) continue;
    const bool hangs = i % 6 == 0;
    const double last = draw(hangs ? 2 : 4);
    const Vec3<double> at = hangs ? Vec3<double>{draw(4), draw(4), draw(4)} : Vec3<double>{0, 0, 0};
    const double rest = hangs ? 2 : draw(4), stiff = hangs ? stiffness : stiffness * (1 + draw(1));
    Spring<S>& spring = hangs ? net.hang(ids[a], at, stiff, rest, last) : net.tie(ids[a], ids[b], stiff, rest, last);
    if (i % 4 == 0) spring.type = SpringType::bungee;
  }
  net.gravity = {0, -10, 0};
  return net;
}

TYPED_TEST(ImplicitSpringsOf, ATangleAgreesWithADenseSolve) {
  using S = TypeParam;
  for (const double stiffness : {1.0, 100.0, 2000.0}) {
    SpringNetwork<S> net = tangle<S>(stiffness);
    const SpringNetwork<S> before = net;
    ASSERT_TRUE(net.solve(this->solver_));
    SpringNetwork<S> given = before;
    given.acceleration = net.acceleration;
    const std::vector<Vec3<double>> expected = dense_solve(given);
    double size = 0;
    for (const Vec3<double> dv : expected) size = std::max(size, norm(dv));
    // A spring's direction and length are the format's; what they lose, the stiff system's answer does too.
    const double loss = (kIsFixed<S> ? 20 : 200) * to_double(resolution<S>());
    for (std::size_t i = 0; i < expected.size(); ++i) {
      const Vec3<double> dv = real(net.velocity[i]) - real(before.velocity[i]);
      EXPECT_LE(norm(dv - expected[i]), loss * size + this->tolerance(1) + 1e-12) << stiffness << " " << i;
    }
  }
}

TYPED_TEST(ImplicitSpringsOf, TwoFreeParticlesKeepTheirMomentum) {
  using S = TypeParam;
  SpringNetwork<S> net;
  const ParticleId a = net.add({0, 0, 0}, 1, {1, 0.5, 0}), b = net.add({0.75, 1, 0.5}, 4, {0, -0.25, 1});
  net.tie(a, b, 30000, 8, 1.25);
  const Vec3<double> before = net.momentum();
  for (int step = 0; step < 100; ++step) {
    ASSERT_TRUE(net.step(this->solver_));
    // The acceleration that is given is rounded: to 2^-17 of 1 m/s^2, or half an ulp of thousands.
    const double rounding = kIsFixed<S> ? 5 * to_double(resolution<S>()) / 60 + 5 * to_double(resolution<Velocity<S>>())
                                        : 20 * to_double(resolution<S>());
    ASSERT_LE(norm(net.momentum() - before), rounding * (step + 1)) << step;
  }
  EXPECT_NEAR(norm(net.distance(net.springs[0])), 1.25, 0.01);
}

TYPED_TEST(ImplicitSpringsOf, AStiffNetInFreeFallFallsAsOne) {
  using S = TypeParam;
  SpringNetwork<S> net;
  net.rate = 8;
  test::weave(net, 8, 0.25, 0.0625, 30000, 4);  // k h^2 / m = 7500, twelve times over
  const Vec3<S> gravity = {S(1), S(-10), S(0.5)};
  for (std::size_t i = 0; i < net.inverse_mass.size(); ++i) {
    net.inverse_mass[i] = InverseMass<S>(16);
    net.acceleration.set(i, gravity);
  }
  ASSERT_TRUE(this->solver_.solve(net.springs, net.position, net.velocity, net.acceleration, net.inverse_mass, 8));
  for (std::size_t i = 0; i < net.inverse_mass.size(); ++i) {
    // In double the condition of 2^17 is felt.
    const double tolerance = this->tolerance(1.25) + 1e-10;
    ASSERT_NEAR(to_double(net.velocity.x[i]), 0.125, tolerance);
    ASSERT_NEAR(to_double(net.velocity.y[i]), -1.25, tolerance);
    ASSERT_NEAR(to_double(net.velocity.z[i]), 0.0625, tolerance);
  }
}

TYPED_TEST(ImplicitSpringsOf, AChainSwingsAtItsLengthAndGainsNoEnergy) {
  using S = TypeParam;
  SpringNetwork<S> net;
  net.gravity = {0, -10, 0};
  ParticleId last = net.add({0, 0, 0}, 0);
  for (int i = 1; i <= 10; ++i) {
    const ParticleId next = net.add({i * 0.5, 0, 0}, 0.125);
    net.tie(last, next, 20000, 8, 0.5);
    last = next;
  }
  double lowest = 0;
  for (int step = 0; step < 600; ++step) {
    ASSERT_TRUE(net.step(this->solver_));
    double energy = 0;
    for (const Spring<S>& spring : net.springs) {
      const double stretch = norm(net.distance(spring)) - 0.5;
      ASSERT_LE(std::abs(stretch), 0.02) << step;
      energy += 0.5 * 20000 * stretch * stretch;
    }
    for (std::size_t i = 1; i <= 10; ++i) {
      energy += 0.125 * (10 * to_double(net.position.y[i]) + 0.5 * inner(real(net.velocity[i]), real(net.velocity[i])));
    }
    ASSERT_LE(energy, 0.01) << step;  // of 31 J that it falls through
    lowest = std::min(lowest, to_double(net.position.y[10]));
  }
  EXPECT_EQ(net.position[0], (Vec3<S>{S(0), S(0), S(0)}));
  EXPECT_NEAR(lowest, -5, 0.15);
}

TYPED_TEST(ImplicitSpringsOf, AClothHangsFromItsCornersWithinItsSize) {
  using S = TypeParam;
  SpringNetwork<S> net;
  test::weave(net, 10, 0.25, 0.0625, 20000, 2);
  net.gravity = {0, -10, 3};
  const std::size_t corners[] = {90, 99};
  const Vec3<S> pinned[] = {net.position[90], net.position[99]};
  for (int step = 0; step < 100; ++step) {
    ASSERT_TRUE(net.step(this->solver_));
    for (int c = 0; c < 2; ++c) {
      ASSERT_EQ(net.position[corners[c]], pinned[c]);
      ASSERT_EQ(net.velocity[corners[c]], Vec3<Velocity<S>>::zero());
    }
    for (const Spring<S>& spring : net.springs) {
      ASSERT_LE(norm(net.distance(spring)), 1.1 * to_double(spring.rest_length)) << step;
    }
    for (std::size_t i = 0; i < net.inverse_mass.size(); ++i) {
      ASSERT_LE(norm(real(net.position[i]) - real(net.position[90])), 1.05 * 2.25 * std::sqrt(2.0)) << step;
    }
  }
}

TYPED_TEST(ImplicitSpringsOf, ASlackBungeeLeavesItsEndsAlone) {
  using S = TypeParam;
  SpringNetwork<S> net, alone;
  net.gravity = alone.gravity = {1, -10, 2};
  const ParticleId a = net.add({0, 0, 0}, 0.5, {1, 2, 3}), b = net.add({0.5, 0, 0}, 2, {-1, 0, 1});
  alone.add({0, 0, 0}, 0.5, {1, 2, 3});
  alone.add({0.5, 0, 0}, 2, {-1, 0, 1});
  net.tie(a, b, 30000, 100, 1).type = SpringType::bungee;
  ASSERT_TRUE(net.solve(this->solver_));
  ASSERT_TRUE(alone.solve(this->solver_));
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_LE(norm(real(net.velocity[i]) - real(alone.velocity[i])), kIsFixed<S> ? 0 : this->tolerance(4));
  }
}

TYPED_TEST(ImplicitSpringsOf, EndsThatMeetGiveNoNumberThatIsNone) {
  using S = TypeParam;
  for (const double rest : {0.0, 0.5}) {
    for (const SpringType type : {SpringType::spring, SpringType::bungee}) {
      SpringNetwork<S> net;
      const ParticleId a = net.add({1, 1, 1}, 1, {0.5, 0, 0}), b = net.add({1, 1, 1}, 1);
      net.tie(a, b, 1000, 10, rest).type = type;
      for (int step = 0; step < 10; ++step) ASSERT_TRUE(net.step(this->solver_));
      for (std::size_t i = 0; i < 2; ++i) EXPECT_TRUE(is_finite(net.velocity[i]) && is_finite(net.position[i]));
      EXPECT_NEAR(norm(net.momentum() - Vec3<double>{0.5, 0, 0}), 0, 1e-3);
    }
  }
}

TYPED_TEST(ImplicitSpringsOf, ParticlesThatNoSpringMovesGetTheirAcceleration) {
  using S = TypeParam;
  SpringNetwork<S> net;
  const ParticleId a = net.add({0, 0, 0}, 0), b = net.add({1, 0, 0}, 0), c = net.add({2, 0, 0}, 1, {1, 1, 1});
  net.tie(a, b, 1000, 1, 0.5);   // between two that keep their places
  net.tie(c, c, 1000, 1, 0.5);   // to itself
  net.tie({}, c, 1000, 1, 0.5);  // a free slot
  net.springs.pop_back();
  Spring<S> unused;
  net.springs.push_back(unused);
  for (std::size_t i = 0; i < 3; ++i) net.acceleration.set(i, {S(6), S(-12), S(60)});
  ASSERT_TRUE(this->solver_.solve(net.springs, net.position, net.velocity, net.acceleration, net.inverse_mass, 60));
  for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(net.velocity[i], Vec3<Velocity<S>>::zero());
  EXPECT_NEAR(to_double(net.velocity.x[2]), 1.1, this->tolerance(1));
  EXPECT_NEAR(to_double(net.velocity.y[2]), 0.8, this->tolerance(1));
  EXPECT_NEAR(to_double(net.velocity.z[2]), 2.0, this->tolerance(2));
}

TYPED_TEST(ImplicitSpringsOf, TheAnswerKnowsNothingOfStepsBefore) {
  using S = TypeParam;
  SpringNetwork<S> one = tangle<S>(500), two = one;
  ImplicitSprings<S> moved;
  for (int step = 0; step < 30; ++step) {
    if (step == 10) one.springs[3].a = two.springs[3].a = {};  // removed
    if (step == 15) one.inverse_mass[7] = two.inverse_mass[7] = InverseMass<S>(0);
    if (step == 20) one.inverse_mass[7] = two.inverse_mass[7] = InverseMass<S>(1);
    ImplicitSprings<S> fresh;
    const SpringNetwork<S> keep = one;
    one.step(this->solver_);
    two.step(fresh);
    for (std::size_t i = 0; i < one.inverse_mass.size(); ++i) ASSERT_EQ(one.velocity[i], two.velocity[i]) << step;
    ImplicitSprings<S> copy(this->solver_);
    SpringNetwork<S> three = keep;
    three.step(copy);
    moved = std::move(copy);
    for (std::size_t i = 0; i < one.inverse_mass.size(); ++i) ASSERT_EQ(one.velocity[i], three.velocity[i]) << step;
  }
}

TYPED_TEST(ImplicitSpringsOf, ASystemOutOfReachIsToldAndTakenExplicitly) {
  using S = TypeParam;
  SpringNetwork<S> net;
  const ParticleId a = net.add({1, 0, 0}, 1), b = net.add({3, 0, 0}, 1);
  net.add({0, 0, 0}, 1);
  net.tie(a, b, 100, 0, 1);
  net.rate = 60;
  net.acceleration.set(0, {S(60), S(0), S(0)});
  net.acceleration.set(2, {S(120), S(0), S(0)});
  if constexpr (kIsFixed<S>) {
    if (sizeof(S) == 4) return;  // whatever fits the format is within reach
    net.rate = 1;
    net.springs[0].stiffness = highest<S>();
    net.inverse_mass[0] = highest<InverseMass<S>>();
  } else {
    net.acceleration.set(1, {std::numeric_limits<S>::quiet_NaN(), S(0), S(0)});
  }
  EXPECT_FALSE(
      this->solver_.solve(net.springs, net.position, net.velocity, net.acceleration, net.inverse_mass, net.rate));
  EXPECT_NEAR(to_double(net.velocity.x[0]), 60.0 / net.rate, 1e-6);
  EXPECT_NEAR(to_double(net.velocity.x[2]), 120.0 / net.rate, 1e-6);
}

TYPED_TEST(ImplicitSpringsOf, EnormousNumbersNeitherWrapNorHang) {
  using S = TypeParam;
  for (const double ratio : {1.0, 1000.0}) {
    SpringNetwork<S> net;
    net.rate = 16384;
    const double far = sizeof(S) == 4 ? 8000 : 1e6, fast = sizeof(S) == 4 ? 1000 : 1e5;
    const ParticleId a = net.add({far, 0, 0}, ratio, {fast, -fast, fast});
    const ParticleId b = net.add({-far, 1, 0}, 1, {-fast, fast, -fast}), c = net.add({0, far, far}, 1 / ratio);
    net.tie(a, b, 30000, 30000, 1);
    net.tie(b, c, 30000, 30000, 1);
    const double before = fast * 1.8;
    for (int step = 0; step < 20; ++step) {
      ASSERT_TRUE(net.solve(this->solver_));
      for (std::size_t i = 0; i < 3; ++i) {
        ASSERT_LE(norm(real(net.velocity[i])), 30 * before) << ratio << " " << i << " " << step;
      }
    }
  }
}

}  // namespace implicit_springs_test
}  // namespace isostep
