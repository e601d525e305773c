// The range contract of articulations: whatever is asked of them, no intermediate of a step overflows.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "isostep/articulation/articulation.inl"
#include "random/articulation.hpp"

namespace isostep {

using TrappingQ32 = Fixed<std::int64_t, 32, Overflow::trap>;
template class Articulation<TrappingQ32>;

namespace test {
namespace articulation_range_test {

using S = TrappingQ32;

/// Trees of any size and mass, driven, thrown and torn at as hard as commands allow.
void torment(unsigned seed, double lengths, double masses, double violence) {
  TreeDice dice(seed);
  TreeOptions options;
  options.free = seed % 2 == 0;
  options.springs = options.limits = options.damping = options.drives = true;
  ArticulationDefinition<S> d = dice.tree<S>(options);
  d.settings.hz = seed % 3 == 0 ? 10 : 60;
  d.settings.substeps = seed % 5 == 0 ? 1 : 8;
  const S by = number<S>(lengths), kilos = number<S>(masses);
  for (ArticulationLink<S>& l : d.links) {
    l.frame_a.position = l.frame_a.position * by;
    l.frame_b.position = l.frame_b.position * by;
    l.mass.centre = l.mass.centre * by;
    l.mass.mass = l.mass.mass * kilos;
    l.mass.inertia = l.mass.inertia * kilos * by * by;
    l.drive.max_force = min(l.drive.max_force * number<S>(violence * violence), number<S>(0x1p28));
    l.drive.damping = min(l.drive.damping * number<S>(violence), number<S>(0x1p28));
    l.stiffness = min(l.stiffness * number<S>(violence), number<S>(0x1p28));
    if (l.type == ArticulationJoint::slider) {
      l.lower = l.lower * by;
      l.upper = l.upper * by;
    }
  }
  Articulation<S> a = built(d);
  if (a.links() == 0) return;
  dice.set_going(a, std::min(10 * violence, 1000.0));
  for (int i = 0; i < 60; ++i) {
    const auto link = static_cast<std::uint32_t>(dice.below(static_cast<int>(a.links())));
    const D3 force = dice.point(std::min(1e4 * violence * violence, 2e8));
    const D3 torque = dice.point(std::min(1e4 * violence * violence, 2e8));
    a.apply_force(link, vector<S>(force), a.link_centre(link));
    a.apply_torque(link, vector<S>(torque));
    a.step();
    motion_of(a);
    a.joint_load(link);
  }
}

TEST(ArticulationRange, NothingOverflowsAtAnySizeMassOrForce) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    for (const double violence : {1.0, 30.0, 1000.0}) {
      torment(seed, 1, 1, violence);
      torment(seed, 0.02, 0.01, violence);
      torment(seed, 0.02, 1000, violence);
      torment(seed, 100, 0.01, violence);
      torment(seed, 100, 1000, violence);
    }
  }
}

}  // namespace articulation_range_test
}  // namespace test
}  // namespace isostep
