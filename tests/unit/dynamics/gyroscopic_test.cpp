// Free turning keeps angular momentum and energy, in every scalar, for as long as one looks and at any angular speed.
// SPDX-License-Identifier: MIT
#include "isostep/dynamics/gyroscopic.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "isostep/math/quat.hpp"

namespace isostep {
namespace gyroscopic_test {

template <class S> class FreeTurning : public testing::Test {};
using Scalars = testing::Types<float, double, Q16_16, Q32_32>;
TYPED_TEST_SUITE(FreeTurning, Scalars);

template <class T> Vec3<double> in_double(Vec3<T> v) { return {to_double(v.x), to_double(v.y), to_double(v.z)}; }

struct Change {
  double momentum = 0, gain = 0, loss = 0;  // [1] of the start's
};

/// Turns as a step does: angular velocity first, then the orientation by it. `inertia`: over the largest.
template <class S>
Change turn(Vec3<double> inertia, Vec3<double> start, std::int32_t rate, int steps, bool slowly = false) {
  using V = Velocity<S>;
  const Vec3<S> moments = {from_double<S>(inertia.x), from_double<S>(inertia.y), from_double<S>(inertia.z)};
  const Step<S> h = divide_to<Step<S>>(S(1), S(rate));
  Quat<Unit<S>> q = normalise(Quat<Unit<S>>{Unit<S>(0.1), Unit<S>(0.3), Unit<S>(0.3), Unit<S>(0.9)});
  Vec3<V> angular_velocity = {from_double<V>(start.x), from_double<V>(start.y), from_double<V>(start.z)};
  Change worst;
  Vec3<V> known = Vec3<V>::zero();
  for (int k = 0; k < 3; ++k) known[k] = round_to<V>(dot_sum(to_matrix(q).column(k), angular_velocity));
  Vec3<double> momentum0 = {0, 0, 0};
  double energy0 = 0;
  for (int i = 0; i <= steps; ++i) {
    const Mat3<Unit<S>> axes = to_matrix(q);
    Vec3<double> momentum = {0, 0, 0};
    for (int k = 0; k < 3; ++k) {
      const Vec3<double> axis = in_double(axes.column(k));
      momentum += axis * (inertia[k] * dot(axis, in_double(angular_velocity)));
    }
    const double energy = dot(momentum, in_double(angular_velocity));
    if (i == 0) {
      momentum0 = momentum;
      energy0 = energy;
    }
    const Vec3<double> change = momentum - momentum0;
    worst.momentum = std::max(worst.momentum, std::sqrt(dot(change, change) / dot(momentum0, momentum0)));
    worst.gain = std::max(worst.gain, energy / energy0 - 1);
    worst.loss = std::max(worst.loss, 1 - energy / energy0);
    const FreeTurn<S> free = {axes, moments, FreeTurn<S>::euler_of(moments), h};
    angular_velocity = slowly ? slow_turn(axes, free.euler, angular_velocity, h, S(0.5)).angular_velocity
                              : free.turn(angular_velocity, known, Pace::brisk);
    const auto angle = [&](V w) { return round_to<Unit<S>>(product(w, h)); };
    q = integrate(q, Vec3<Unit<S>>{angle(angular_velocity.x), angle(angular_velocity.y), angle(angular_velocity.z)});
  }
  return worst;
}

/// A box of 4 x 1 x 2 at 10 rad/s, ten seconds. First order in the rate.
TYPED_TEST(FreeTurning, KeepsAngularMomentumAndEnergy) {
  const Vec3<double> box = {5.0 / 20, 1, 17.0 / 20};
  const Change coarse = turn<TypeParam>(box, {6, 8, 3}, 240, 2400), fine = turn<TypeParam>(box, {6, 8, 3}, 960, 9600);
  EXPECT_LT(coarse.momentum, 0.03);
  EXPECT_LT(fine.momentum, 0.008);
  for (const Change& change : {coarse, fine}) {
    EXPECT_LT(change.gain, 1e-3);
    EXPECT_LT(change.loss, 1e-3);
  }
}

/// As fast as counts as slow at 60 steps a second, for a minute: 3.75 rad/s.
TYPED_TEST(FreeTurning, KeepsEnergyOfSlowSolidsByTheExplicitForm) {
  for (const Vec3<double> inertia :
       {Vec3<double>{0.25, 1, 0.85}, Vec3<double>{1, 0.9, 0.1}, Vec3<double>{1, 1, 0.01}}) {
    EXPECT_TRUE(FreeTurn<double>::is_solid(FreeTurn<double>::euler_of(inertia)));
    const Change one = turn<TypeParam>(inertia, {3.5, 3.7, 3.6}, 60, 3600, true);
    const Change eight = turn<TypeParam>(inertia, {3.5, 3.7, 3.6}, 480, 28800, true);
    EXPECT_LT(one.gain, 0.05);
    EXPECT_LT(eight.gain, 1e-3);
    EXPECT_LT(std::max(one.loss, eight.loss), 1e-3);
  }
  EXPECT_FALSE(FreeTurn<double>::is_solid(FreeTurn<double>::euler_of({1, 0.5, 0.1})));
}

/// Nearly a radian a step, half a minute: energy swings, and neither grows nor fades away.
TYPED_TEST(FreeTurning, IsStableAtTheGreatestAngularSpeed) {
  for (const Vec3<double> inertia :
       {Vec3<double>{0.25, 1, 0.85}, Vec3<double>{1, 0.9, 0.1}, Vec3<double>{1, 1, 0.01}}) {
    const Change change = turn<TypeParam>(inertia, {30, 35, 36}, 60, 1800);
    EXPECT_LT(change.gain, 0.25);
    EXPECT_LT(change.loss, 0.25);
  }
}

}  // namespace gyroscopic_test
}  // namespace isostep
