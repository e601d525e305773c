// Bodies are integrated to the same bits at every width, however they are cut into pieces; and as formulas say.
// SPDX-License-Identifier: MIT
#include "isostep/dynamics/solvers/body_rows.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <vector>

#include "isostep/core/random.hpp"
#include "unit/dynamics/scalar_name.hpp"

namespace isostep {
namespace {

constexpr std::int32_t kHz = 60, kRate = 240;
constexpr double kRapid = kHz / 16.0, kSubstep = 1.0 / kRate;

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
  void step(Simd simd, std::size_t pieces) {
    const StepContext<S> c = context(body_kernels<S>(simd));
    BodyRows<S> rows;
    rows.gather(c, kRate);
    const auto each = [&](const auto& act) {
      for (std::size_t k = 0; k < pieces; ++k) act(states.size() * k / pieces, states.size() * (k + 1) / pieces);
    };
    for (std::int32_t substep = 0; substep < c.substeps; ++substep) {
      each([&](std::size_t first, std::size_t end) { rows.integrate_velocities(c, first, end); });
      each([&](std::size_t first, std::size_t end) { rows.integrate_positions(c, first, end); });
    }
    each([&](std::size_t first, std::size_t end) { rows.store(c, first, end); });
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
  std::size_t cut = 0, turned = 0;
  for (std::uint64_t seed = 0; seed < 24; ++seed) {
    const std::size_t count = 1 + 7 * seed;
    const Scene<S> start = scene_of<S>(count, seed % 2 == 0, seed);
    Scene<S> one = start;
    one.step(Simd::scalar, 1);
    for (std::size_t i = 0; i < count; ++i) {
      cut += one.cut[i];
      turned += one.states[i].angular_velocity == start.states[i].angular_velocity ? 0u : 1u;
    }
    for (const Simd simd : {Simd::best, Simd::sse2, Simd::avx2, Simd::avx512, Simd::neon, Simd::wasm}) {
      if (body_kernels<S>(simd) == nullptr) continue;
      for (const std::size_t pieces : {1u, 3u}) {
        Scene<S> many = start;
        many.step(simd, pieces);
        ASSERT_EQ(std::memcmp(one.states.data(), many.states.data(), count * sizeof(BodyState<S>)), 0)
            << body_kernels<S>(simd)->name << " seed " << seed << " pieces " << pieces;
        ASSERT_EQ(one.cut, many.cut);
      }
    }
  }
  EXPECT_GT(cut, 100u);
  EXPECT_GT(turned, 1000u);
}

TYPED_TEST(BodyRowsOf, EachKindFollowsFromItsFormula) {
  using S = TypeParam;
  const double near = std::is_same_v<S, Q16_16> ? 0x1p-9 : 0x1p-16;
  const Scene<S> start = scene_of<S>(400, true, 99);
  Scene<S> end = start;
  end.step(Simd::best, 1);
  std::size_t kinematic = 0, locked = 0, damped = 0, slow = 0;
  for (std::size_t i = 0; i < start.states.size(); ++i) {
    const BodyProperties<S>& body = start.properties[i];
    const BodyState<S>&before = start.states[i], &after = end.states[i];
    if (body.type == BodyType::kinematic) {
      ++kinematic;
      if ((body.flags & body_flag::kAllLocks) == 0) EXPECT_EQ(after.velocity, before.velocity);
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
      EXPECT_NEAR(to_double(after.velocity[axis]), v, near * 20);
      EXPECT_NEAR(to_double(after.centre[axis]), x, near * 20);
    }
    const bool free = (body.flags & (body_flag::kSpins | body_flag::kAngularLocks)) == 0;
    if (!free || !(to_double(max_abs(before.angular_velocity)) < kRapid)) continue;
    ++slow;
    const double keep = 1 / (1 + to_double(body.angular_damping) * kSubstep);
    for (int axis = 0; axis < 3; ++axis) {
      double w = to_double(before.angular_velocity[axis]);
      for (int k = 0; k < kRate / kHz; ++k) w = (w + to_double(push.angular[axis]) * kSubstep) * keep;
      EXPECT_NEAR(to_double(after.angular_velocity[axis]), w, near * 4);
    }
  }
  EXPECT_GT(kinematic, 20u);
  EXPECT_GT(locked, 20u);
  EXPECT_GT(damped, 100u);
  EXPECT_GT(slow, 50u);
}

}  // namespace
}  // namespace isostep
