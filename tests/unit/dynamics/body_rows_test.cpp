// Bodies are integrated to the same bits at every width, however they are cut into pieces; and as formulas say.
// SPDX-License-Identifier: MIT
#include "isostep/dynamics/solvers/body_rows.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "isostep/core/random.hpp"
#include "unit/dynamics/scalar_name.hpp"

namespace isostep {
namespace body_rows_test {

constexpr std::int32_t kHz = 60, kRate = 240;
constexpr double kRapid = kHz / 16.0, kSubstep = 1.0 / kRate;

/// The rows that a step leaves beside the states.
template <class S> struct After {
  std::vector<MotionRow<Velocity<S>>> displacement;
  std::vector<SolverMass<S>> mass;
  std::uint32_t followed = 0;  // sub-steps after which contacts had to follow a body
};
template <class T> bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

template <class S> struct Scene {
  using V = Velocity<S>;
  std::vector<BodyState<S>> states;
  std::vector<BodyProperties<S>> properties;
  std::vector<Acceleration<S>> accelerations;
  std::vector<std::uint8_t> cut;

  StepContext<S> context(const BodyKernels<S>* kernels) {
    StepContext<S> c = {};
    c.states = states;
    c.properties = properties;
    c.accelerations = accelerations;
    c.gravity = {S(0), S(-10), S(0.5)};
    c.hz = kHz;
    c.substeps = kRate / kHz;
    cut.assign(states.size(), 0);
    c.cut = cut;
    c.body_kernels = kernels;
    return c;
  }
  /// A step without contacts or joints, each sub-step in that many pieces.
  After<S> step(Simd simd, std::size_t pieces) {
    const StepContext<S> c = context(body_kernels<S>(simd));
    BodyRows<S> rows;
    rows.gather(c, kRate, true);
    After<S> after;
    const auto each = [&](const auto& act) {
      for (std::size_t k = 0; k < pieces; ++k) act(states.size() * k / pieces, states.size() * (k + 1) / pieces);
    };
    for (std::int32_t substep = 0; substep < c.substeps; ++substep) {
      bool followed = false;
      each([&](std::size_t first, std::size_t end) { rows.integrate_velocities(c, first, end); });
      each([&](std::size_t first, std::size_t end) { followed = rows.integrate_positions(c, first, end) || followed; });
      after.followed += followed ? 1u : 0u;
    }
    each([&](std::size_t first, std::size_t end) { rows.store(c, first, end); });
    after.displacement = rows.rows().displacement;
    after.mass = rows.rows().mass;
    return after;
  }
};

template <class T> T between(Pcg32& random, double low, double high) {
  return from_double<T>(low + (high - low) * (random.next_u24() / 16777216.0));
}
template <class T> Vec3<T> vector(Pcg32& random, double most) {
  const T x = between<T>(random, -most, most), y = between<T>(random, -most, most), z = between<T>(random, -most, most);
  return {x, y, z};
}
template <class U> Quat<U> rotation(Pcg32& random) {
  const Vec3<U> v = vector<U>(random, 0.5);
  return normalise(Quat<U>{v.x, v.y, v.z, U(0.75)});
}

enum class Speed { slow, rapid, beyond_the_limit };

/// Every kind of body beside every other.
template <class S> Scene<S> scene_of(std::size_t count, bool forces, std::uint64_t seed) {
  using V = Velocity<S>;
  Pcg32 random = Pcg32::seeded(seed);
  Scene<S> scene;
  for (std::size_t i = 0; i < count; ++i) {
    BodyState<S> state = {};
    state.slot = static_cast<std::uint32_t>(i);
    state.centre = vector<S>(random, 50);
    state.orientation = rotation<Unit<S>>(random);
    state.velocity = vector<V>(random, 20);
    const auto speed = static_cast<Speed>(random.next() % 8 < 5 ? 0 : 1 + random.next() % 2);
    state.angular_velocity = vector<V>(random, speed == Speed::slow    ? kRapid
                                               : speed == Speed::rapid ? 8 * kRapid
                                                                       : 300.0);
    BodyProperties<S> body = {};
    body.type = random.next() % 8 == 0 ? BodyType::kinematic : BodyType::dynamic;
    body.mass = S(2);
    body.kappa = {S(1), S(1), S(1)};
    if (random.next() % 3 != 0) {
      body.flags |= body_flag::kSpins;
      body.kappa = {between<S>(random, 1, 1.9), between<S>(random, 1, 1.9), S(1)};
      if (random.next() % 8 == 0) body.kappa.z = S(0.0625);  // of no solid
    }
    if (random.next() % 6 == 0) body.flags |= body_flag::kLockX << random.next() % 6;
    body.principal = random.next() % 4 == 0 ? rotation<Unit<S>>(random) : Quat<Unit<S>>::identity();
    body.gravity_scale = random.next() % 4 == 0 ? S(0.5) : S(1);
    if (random.next() % 4 == 0) body.linear_damping = between<S>(random, 0, 2);
    if (random.next() % 4 == 0) body.angular_damping = between<S>(random, 0, 2);
    scene.states.push_back(state);
    scene.properties.push_back(body);
    if (forces) scene.accelerations.push_back({vector<S>(random, 5), vector<S>(random, 5)});
  }
  return scene;
}

template <class S> class BodyRowsOf : public testing::Test {};
using Scalars = testing::Types<float, double, Q16_16, Q32_32>;
TYPED_TEST_SUITE(BodyRowsOf, Scalars, ScalarName);

TYPED_TEST(BodyRowsOf, EveryWidthAndEveryPieceGiveTheBitsOfOneLane) {
  using S = TypeParam;
  std::size_t cut = 0, followed = 0, renewed = 0, wide = 0;
  for (std::uint64_t seed = 0; seed < 24; ++seed) {
    const std::size_t count = 1 + 7 * seed;
    const Scene<S> start = scene_of<S>(count, seed % 2 == 0, seed);
    Scene<S> one = start;
    const After<S> expected = one.step(Simd::scalar, 1);
    for (const std::uint8_t was : one.cut) cut += was;
    followed += expected.followed;
    BodyRows<S> begun;
    begun.gather(Scene<S>(start).context(nullptr), kRate, true);
    for (std::size_t i = 1; i <= count; ++i)
      renewed += begun.rows().mass[i].kappa.rows[0] == expected.mass[i].kappa.rows[0] ? 0u : 1u;
    for (const Simd simd : {Simd::best, Simd::sse2, Simd::avx2, Simd::avx512, Simd::neon, Simd::wasm}) {
      const BodyKernels<S>* kernels = body_kernels<S>(simd);
      if (kernels == body_kernels<S>(Simd::scalar)) continue;
      ++wide;
      for (const std::size_t pieces : {1u, 3u}) {
        Scene<S> many = start;
        const After<S> after = many.step(simd, pieces);
        const testing::Message where = testing::Message() << kernels->name << " seed " << seed << " pieces " << pieces;
        ASSERT_TRUE(same_bits(one.states, many.states)) << where;
        ASSERT_TRUE(same_bits(expected.displacement, after.displacement)) << where;
        ASSERT_TRUE(same_bits(expected.mass, after.mass)) << where;
        ASSERT_EQ(expected.followed, after.followed) << where;
        ASSERT_EQ(one.cut, many.cut) << where;
      }
    }
  }
  EXPECT_GT(cut, 100u);
  EXPECT_GT(followed, 10u);
  EXPECT_GT(renewed, 50u);
  if (body_kernels<S>(Simd::best)->width > 1) {
    EXPECT_GT(wide, 0u);
  }
}

/// [m/s] The rounding of a step: in Q16.16 a factor of damping is wrong by 2^-17, four times, of 20 m/s.
template <class S> constexpr double kRounding = std::is_same_v<S, Q16_16> ? 0x1p-10 : 0x1p-16;

TYPED_TEST(BodyRowsOf, MovesAndDampingFollowTheirFormulas) {
  using S = TypeParam;
  const Scene<S> start = scene_of<S>(400, true, 99);
  Scene<S> end = start;
  end.step(Simd::best, 1);
  std::size_t kinematic = 0, locked = 0, damped = 0, round = 0;
  double worst_v = 0, worst_x = 0, worst_w = 0;
  for (std::size_t i = 0; i < start.states.size(); ++i) {
    const BodyProperties<S>& body = start.properties[i];
    const BodyState<S>&before = start.states[i], &after = end.states[i];
    if (body.type == BodyType::kinematic) {
      ++kinematic;
      if ((body.flags & body_flag::kAllLocks) == 0) {
        EXPECT_EQ(after.velocity, before.velocity);
      }
      continue;
    }
    const Acceleration<S>& push = start.accelerations[i];
    const Vec3<S> gravity = end.context(nullptr).gravity;
    for (int axis = 0; axis < 3; ++axis) {
      if ((body.flags & (body_flag::kLockX << axis)) != 0) {
        ++locked;
        EXPECT_EQ(after.velocity[axis], Velocity<S>(0));
        EXPECT_EQ(after.centre[axis], before.centre[axis]);
        continue;
      }
      const double keep = 1 / (1 + to_double(body.linear_damping) * kSubstep);
      if (keep < 1) ++damped;
      const double a = to_double(gravity[axis]) * to_double(body.gravity_scale) + to_double(push.linear[axis]);
      double v = to_double(before.velocity[axis]), x = to_double(before.centre[axis]);
      for (int k = 0; k < kRate / kHz; ++k) {
        v = (v + a * kSubstep) * keep;
        x += v * kSubstep;
      }
      worst_v = std::max(worst_v, std::abs(to_double(after.velocity[axis]) - v));
      worst_x = std::max(worst_x, std::abs(to_double(after.centre[axis]) - x));
    }
    const bool free = (body.flags & (body_flag::kSpins | body_flag::kAngularLocks)) == 0;
    if (!free || !(to_double(max_abs(before.angular_velocity)) < kRapid)) continue;
    ++round;
    const double keep = 1 / (1 + to_double(body.angular_damping) * kSubstep);
    for (int axis = 0; axis < 3; ++axis) {
      double w = to_double(before.angular_velocity[axis]);
      for (int k = 0; k < kRate / kHz; ++k) w = (w + to_double(push.angular[axis]) * kSubstep) * keep;
      worst_w = std::max(worst_w, std::abs(to_double(after.angular_velocity[axis]) - w));
    }
  }
  EXPECT_LT(worst_v, kRounding<S>);
  EXPECT_LT(worst_x, kRounding<S>);
  EXPECT_LT(worst_w, kRounding<S>);
  EXPECT_GT(kinematic, 20u);
  EXPECT_GT(locked, 10u);
  EXPECT_GT(damped, 100u);
  EXPECT_GT(round, 50u);
}

/// Angular momentum over mass and a length squared, world [rad/s]: R diag(1 / kappa) R^T w.
template <class S> Vec3<double> momentum(const BodyState<S>& state, const BodyProperties<S>& body) {
  const Mat3<Unit<S>> axes = to_matrix(state.orientation * body.principal);
  Vec3<double> sum = {0, 0, 0};
  for (int k = 0; k < 3; ++k) {
    const Vec3<Unit<S>> column = axes.column(k);
    const Vec3<double> axis = {to_double(column.x), to_double(column.y), to_double(column.z)};
    const Vec3<Velocity<S>> w = state.angular_velocity;
    const double along = axis.x * to_double(w.x) + axis.y * to_double(w.y) + axis.z * to_double(w.z);
    sum += axis * (along / to_double(body.kappa[k]));
  }
  return sum;
}

TYPED_TEST(BodyRowsOf, WhatTurnsFreelyKeepsItsMomentum) {
  using S = TypeParam;
  const Scene<S> start = scene_of<S>(600, false, 5);
  Scene<S> end = start;
  end.step(Simd::best, 1);
  std::size_t free = 0;
  double worst = 0, turned = 0;
  for (std::size_t i = 0; i < start.states.size(); ++i) {
    const BodyProperties<S>& body = start.properties[i];
    const BodyState<S>&before = start.states[i], &after = end.states[i];
    const bool spins = (body.flags & (body_flag::kSpins | body_flag::kAllLocks)) == body_flag::kSpins;
    if (!spins || body.type != BodyType::dynamic || body.angular_damping > S(0)) continue;
    if (!(to_double(max_abs(before.angular_velocity)) < kRapid)) continue;
    ++free;
    const Vec3<double> was = momentum(before, body);
    BodyState<S> held = after;
    held.angular_velocity = before.angular_velocity;
    const Vec3<double> change = momentum(after, body) - was, if_held = momentum(held, body) - was;
    worst = std::max(worst, std::sqrt(dot(change, change) / dot(was, was)));
    turned = std::max(turned, std::sqrt(dot(if_held, if_held) / dot(was, was)));
  }
  EXPECT_LT(worst, 0.01);
  EXPECT_GT(turned, 0.1);  // as much is lost where angular velocity stays as it is
  EXPECT_GT(free, 50u);
}

}  // namespace body_rows_test
}  // namespace isostep
