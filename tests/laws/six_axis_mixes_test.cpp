// Six-axis joints with every mix of free, limited and locked swings and twist hold however b is thrown.
// ISOSTEP_SIX_AXIS_MIXES=200 throws each mix so many times; without it twice.
// SPDX-License-Identifier: MIT
#include <algorithm>

#include "isostep/core/random.hpp"
#include "laws/six_axis.hpp"
#include "random/asked.hpp"

namespace isostep::test {
namespace six_axis_mixes_test {

enum class Way { free, limited, locked };

/// [rad] b's z axis seen from a: its tilts out of the planes across x and y, and its turns about x and y.
struct Seen {
  double tilt[2], turn[2], swing;
};
template <class S> Seen seen(const World<S>& w, BodyId a, BodyId b) {
  const auto axes = [&](BodyId body) { return to_matrix(joint_angles_detail::wide(w.pose(body).orientation)); };
  const D3 d = transposed_times(axes(a), axes(b).column(2));
  const auto asin = [](double x) { return std::atan2(x, std::sqrt(std::max(0.0, 1 - x * x))); };
  return {
      {asin(-d.y), asin(d.x)}, {std::atan2(-d.y, d.z), std::atan2(d.x, d.z)}, std::atan2(std::hypot(d.x, d.y), d.z)};
}

template <class S> class SixAxisMixes : public SixAxis<S> {
 protected:
  struct Mix {
    Way ways[3];                // of swing_x, swing_y, twist
    double lower[3], upper[3];  // [rad]
  };
  struct Thrown {
    double past = 0;  // [rad] the most beyond a limit or off a lock
    double gain = 0;  // [1] of energy
  };
  static JointAxis axis(int i) { return static_cast<JointAxis>(3 + i); }

  Thrown thrown(const Mix& mix, Pcg32& random) {
    const auto draw = [&](double most) { return most * random_between(random, -1000, 1000) / 1000; };
    World<S> w(this->with(SolverName::soft_step));
    const BodyId a = this->box(w, {0, 0, 0}, 10, 0.5, 0.5, 0.5), b = this->box(w, {0, 0, 1.5}, 2, 0.4, 0.4, 0.4);
    SixAxisDefinition<S> d;
    d.a = a;
    d.b = b;
    d.frame = this->at({0, 0, 0.75});
    d.locks = joint_flag::kLockPoint;
    for (int i = 0; i < 3; ++i) {
      if (mix.ways[i] == Way::locked) d.locks |= joint_flag::kLockSwingX << i;
      if (mix.ways[i] == Way::limited) d.drives[d.drive_count++] = this->limit(axis(i), mix.lower[i], mix.upper[i]);
    }
    const JointId joint = w.create(six_axis<S>(d));
    EXPECT_TRUE(joint) << describe(w.fault());
    w.set_velocity(b, Vec3<S>::zero(), vec<S>(draw(12), draw(12), draw(6)));
    w.step();
    const auto energy = [&] { return kinetic_energy(w.view(a)) + kinetic_energy(w.view(b)); };
    const double start = energy();
    Thrown found;
    for (int frame = 0; frame < 200; ++frame) {
      w.step();
      measure(w, mix, joint, a, b, found);
      found.gain = std::max(found.gain, energy() / start - 1);
    }
    return found;
  }
  static void measure(const World<S>& w, const Mix& mix, JointId joint, BodyId a, BodyId b, Thrown& found) {
    const Seen now = seen(w, a, b);
    for (int i = 0; i < 3; ++i) {
      if (mix.ways[i] == Way::limited) {
        const double place = to_double(w.joint_position(joint, axis(i)));
        found.past = std::max({found.past, mix.lower[i] - place, place - mix.upper[i]});
      }
      // Narrow limits and locks keep the z axis near a plane, by whatever angle they are measured.
      if (i == 2 || mix.ways[i] == Way::free) continue;
      const double most = mix.ways[i] == Way::locked ? 0 : std::max(-mix.lower[i], mix.upper[i]);
      if (most < 1.5) found.past = std::max(found.past, std::abs(now.tilt[i]) - most);
    }
  }
};
using MixScalars = ::testing::Types<float, double, Q32_32>;
TYPED_TEST_SUITE(SixAxisMixes, MixScalars);

TYPED_TEST(SixAxisMixes, hold_their_limits_within_a_fiftieth_of_a_radian_and_gain_no_energy) {
  const auto throws = asked("ISOSTEP_SIX_AXIS_MIXES", 2);
  int tried = 0, fell = 0, gained = 0;
  double worst = 0;
  for (int kind = 0; kind < 27; ++kind) {
    for (std::uint64_t n = 0; n < throws; ++n) {
      Pcg32 random = Pcg32::seeded(1000 * static_cast<std::uint64_t>(kind) + n);
      typename TestFixture::Mix mix = {};
      for (int i = 0, rest = kind; i < 3; ++i, rest /= 3) {
        mix.ways[i] = static_cast<Way>(rest % 3);
        const double most = n % 2 == 0 ? 0.3 : 0.1 + 0.1 * random_between(random, 0, 10);
        mix.upper[i] = most;
        mix.lower[i] = n % 3 == 0 ? -most : -0.5 * most;
      }
      const auto found = this->thrown(mix, random);
      ++tried;
      worst = std::max(worst, found.past);
      fell += found.past > 0.02;
      gained += found.gain > 0.02;
      EXPECT_LT(found.past, 0.02) << "mix " << kind << ", throw " << n;
      EXPECT_LT(found.gain, 0.02) << "mix " << kind << ", throw " << n;
    }
  }
  std::printf("%s: of %d throws %d past their limits, at most by %.4f rad, %d gained energy\n",
              ScalarTraits<TypeParam>::kName, tried, fell, worst, gained);
}

/// What a swing without limits is beside one with: a turn that nothing stops.
TYPED_TEST(SixAxisMixes, a_free_swing_beside_a_limited_one_goes_round) {
  using S = TypeParam;
  for (int free = 0; free < 2; ++free) {
    World<S> w(this->with(SolverName::soft_step));
    const BodyId b = this->box(w, {0, 0, 0});
    SixAxisDefinition<S> d;
    d.b = b;
    d.locks = joint_flag::kLockPoint;
    d.drives[d.drive_count++] = this->limit(this->axis(1 - free), -0.3, 0.3);
    const JointId joint = w.create(six_axis<S>(d));
    ASSERT_TRUE(joint);
    D3 spin = {0, 0, 0};
    spin[free] = 3;
    spin[1 - free] = 0.05;
    w.set_velocity(b, Vec3<S>::zero(), vec<S>(spin));
    double turned = 0, last = 0;
    for (int frame = 0; frame < 300; ++frame) {
      w.step();
      const double now = to_double(w.joint_position(joint, this->axis(free)));
      turned += std::remainder(now - last, 2 * kPi);
      last = now;
    }
    EXPECT_NEAR(turned, 15, 0.3) << free;
  }
}

/// Limits far beyond a right angle, of one swing or of both.
TYPED_TEST(SixAxisMixes, wide_limits_hold_where_the_axes_are_nearly_opposite) {
  using S = TypeParam;
  for (const double limit : {1.8, 2.2, 2.6}) {
    for (int limited = 0; limited < 2; ++limited) {
      for (const bool locked : {false, true}) {
        World<S> w(this->with(SolverName::soft_step));
        const BodyId b = this->box(w, {0, 0, 0});
        SixAxisDefinition<S> d;
        d.b = b;
        d.locks = joint_flag::kLockPoint | (locked ? joint_flag::kLockSwingX << (1 - limited) : 0u);
        d.drives[d.drive_count++] = this->limit(this->axis(limited), -limit, limit);
        const JointId joint = w.create(six_axis<S>(d));
        ASSERT_TRUE(joint);
        D3 spin = {0, 0, 0};
        spin[limited] = 4;
        w.set_velocity(b, Vec3<S>::zero(), vec<S>(spin));
        for (int frame = 0; frame < 240; ++frame) {
          w.step();
          ASSERT_LT(std::abs(to_double(w.joint_position(joint, this->axis(limited)))), limit + 0.02)
              << limit << ", axis " << limited << ", frame " << frame;
        }
      }
    }
  }
}

}  // namespace six_axis_mixes_test
}  // namespace isostep::test
