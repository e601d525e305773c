// Laws of joints between bodies that spin freely: without gravity and contacts their energy is what they came with.
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <string>

#include "built.hpp"
#include "laws/awake.hpp"
#include "random/dice.hpp"
#include "sample.hpp"
#include "scenes/measure.hpp"

namespace isostep::test {
namespace spinning_joints_test {

template <class S> class SpinningJoints : public ::testing::Test {
 protected:
  static ShapeId shape_of(World<S>& w, std::uint32_t form, double size) {
    if (form == 0) return w.add_shape(Capsule<S>{num<S>(0.3 * size), num<S>(size)});
    if (form == 1) return add_box(w, size, 0.4 * size, 0.6 * size);
    return w.add_shape(Cylinder<S>{num<S>(size), num<S>(0.3 * size)});
  }
  /// [1] By how much two bodies gain in ten seconds, a cube and another of up to a hundredth of its mass that spins at
  /// up to `fastest` [rad/s], on a ball joint at the cube's side.
  static double gain(SolverName solver, std::uint64_t seed, double fastest) {
    Dice dice(seed * 41 + 29);
    World<S> w(awake<S>(solver, 0));
    const double half = dice.in(0.15, 0.5), size = dice.in(0.1, 0.3);
    const double ratio = dice.magnitude(1, pick<S>(100, 100, 20, 100)), spin = dice.magnitude(4, fastest);
    const auto direction = [&] { return D3{dice.in(-1, 1), dice.in(-1, 1), dice.in(-1, 1)}; };
    const D3 drawn = direction(), to = drawn * (1 / std::max(length(drawn), 0.1)), turning = direction() * spin;
    const D3 joint = to * (1.2 * half), place = to * (1.5 * (half + size)), slow = direction() * 2.0;
    BodyDefinition<S> d = moving<S>(add_box(w, half, half, half), {0, 0, 0});
    d.mass = S(5);
    d.angular_velocity = vec<S>(slow);
    d.filter = {0, 0, 0};
    const BodyId cube = w.create(d);
    d = moving<S>(shape_of(w, dice.below(3), size), place, cross(slow, joint) - cross(turning, joint - place));
    d.mass = num<S>(5 / ratio);
    d.angular_velocity = vec<S>(turning);
    d.filter = {0, 0, 0};
    const BodyId other = w.create(d);
    const Pose<S> frame = {vec<S>(joint), Quat<Unit<S>>::identity()};
    EXPECT_TRUE(w.create(ball<S>({.a = cube, .b = other, .frame = frame}))) << describe(w.fault());
    const double given = scenes::measure_energy(w).total();
    double most = given;
    for (int frame_number = 0; frame_number < 600; ++frame_number) {
      w.step();
      most = std::max(most, scenes::measure_energy(w).total());
    }
    return most / given - 1;
  }
};
TYPED_TEST_SUITE(SpinningJoints, AllScalars);

/// A joint that turned bodies by their inertia of a step before gave them up to forty times their energy, and so did
/// one of which one arm bent and the other did not: eight in a hundred gained 2 % and more. Few do yet, by little.
/// Joints that avbd leaves apart stretch as they turn, and gain up to a fifth.
TYPED_TEST(SpinningJoints, of_two_free_bodies_gain_little) {
  using S = TypeParam;
  const int seeds = sampled(400, 60);
  for (const SolverName solver : all_but({SolverName::avbd})) {
    int gaining = 0;
    for (int seed = 0; seed < seeds; ++seed) {
      SCOPED_TRACE(named(solver, "seed " + std::to_string(seed)));
      const double slow = this->gain(solver, static_cast<std::uint64_t>(seed), 20);
      const double fast = this->gain(solver, static_cast<std::uint64_t>(seed), 100);
      EXPECT_LT(slow, pick<S>(0.1, 0.1, 0.2, 0.1));
      EXPECT_LT(fast, pick<S>(0.6, 0.6, 1.5, 0.6));
      gaining += (0.02 < slow ? 1 : 0) + (0.02 < fast ? 1 : 0);
    }
    EXPECT_LE(gaining, 2 * seeds / 25) << named(solver, "of both speeds");
  }
}

}  // namespace spinning_joints_test
}  // namespace isostep::test
