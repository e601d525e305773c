// The sum of forces: each kind's acceleration, and what is cut at the format's end.
// SPDX-License-Identifier: MIT
#include "isostep/particles/step/forces.hpp"

#include <limits>

#include "unit/particles/step_scene.hpp"

namespace isostep {
namespace forces_test {

template <class S> class ForcesTest : public testing::Test {
 protected:
  StepScene<S> scene_;
  FreeFlight<S> flight_{scene_.state, scene_.step};
  ParticleSprings<S> springs_{scene_.state, scene_.step};
  PairSearch<S> search_{scene_.state, scene_.step};
  ParticleForces<S> forces_{scene_.state, scene_.step, flight_, springs_};

  /// The end of sums: of floating formats at infinity, which velocities are then cut to their limit from.
  static S end() {
    if constexpr (kIsFixed<S>) return highest<S>();
    else return std::numeric_limits<S>::infinity();
  }
  void accelerate() {
    scene_.begin();
    forces_.begin_step();
    flight_.prepare();
    springs_.prepare();
    search_.begin_step();
    forces_.find_cohering(search_);
    forces_.accelerate();
  }
};
TYPED_TEST_SUITE(ForcesTest, Scalars);

TYPED_TEST(ForcesTest, AllKindsAddUp) {
  using S = TypeParam;
  StepScene<S>& scene = this->scene_;
  scene.state.settings.gravity = StepScene<S>::vec({0, -10, 0});
  const ParticleId a = scene.add(kNowhere, {0, 0, 3}, 2);
  EXPECT_FALSE(this->forces_.any());
  scene.state.springs.add(scene.spring(a, {}, 4, 1));  // of no length: no direction, no force
  ParticleForce<S> force;
  force.particle = a;
  force.acceleration = StepScene<S>::vec({1, 0, 0});
  scene.state.forces.add(force);
  force.type = ForceType::drag;
  force.linear_drag = S(2);
  force.quadratic_drag = S(1);
  scene.state.forces.add(force);
  force.type = ForceType::buoyancy;  // half under water
  force.max_depth = force.volume = S(1);
  force.density = S(8);
  scene.state.forces.add(force);
  scene.state.pushes.push_back({a.slot, 0, StepScene<S>::vec({5, 0, 0})});
  EXPECT_TRUE(this->forces_.any());
  this->accelerate();
  EXPECT_NEAR(scene.a(a).x, 6, 64 * grain<S>(6));
  EXPECT_NEAR(scene.a(a).y, -10 + 8 * 0.5 * 10 / 2, 64 * grain<S>(20));
  EXPECT_NEAR(scene.a(a).z, -(2 + 1 * 3) * 3 / 2.0, 64 * grain<S>(10));
  EXPECT_TRUE(scene.step.report.clean());
}

TYPED_TEST(ForcesTest, CohesionRepelsNearAndAttractsALittleApart) {
  using S = TypeParam;
  StepScene<S>& scene = this->scene_;
  const ParticleId a = scene.add(kNowhere), b = scene.add({0.5, 0, 0}), c = scene.add({0, 3, 0});
  Cohesion<S> cohesion;
  cohesion.material = scene.state.first_material();
  cohesion.repel_distance = cohesion.attract_start = S(1);
  cohesion.repel_force = S(4);
  cohesion.attract_end = S(4);
  cohesion.attract_force = S(6);
  scene.state.cohesions.add(cohesion);
  this->accelerate();
  EXPECT_NEAR(scene.a(a).y, 4, 64 * grain<S>(8));  // 6 N, two thirds between start and end
  EXPECT_LT(scene.a(a).x, -1.9);
  EXPECT_GT(scene.a(b).x, 1);
  EXPECT_LT(scene.a(c).y, -4);
}

/// Of a the sum alone leaves the format; of b a command was cut; of c nothing is.
TYPED_TEST(ForcesTest, WhatIsCutCountsOnceAParticleAndStep) {
  using S = TypeParam;
  StepScene<S>& scene = this->scene_;
  const ParticleId a = scene.add(kNowhere), b = scene.add(kRight), c = scene.add({2, 0, 0});
  const Vec3<S> most_of_all = {highest<S>() * S(0.75), S(0), S(0)};
  ParticleForce<S> force;
  force.particle = a;
  force.acceleration = most_of_all;
  scene.state.forces.add(force);
  scene.state.pushes.push_back({a.slot, 0, most_of_all});
  scene.state.pushes.push_back({b.slot, 1, StepScene<S>::vec(kRight)});
  scene.state.pushes.push_back({c.slot, 0, most_of_all});
  this->accelerate();
  this->forces_.accelerate();
  EXPECT_EQ(scene.step.report.clamped_force, 2u);
  EXPECT_EQ(scene.step.acceleration[a.slot].x, this->end());
  EXPECT_EQ(scene.step.acceleration[b.slot].x, S(1));
  EXPECT_EQ(scene.step.acceleration[c.slot].x, most_of_all.x);
  scene.state.pushes.clear();
  this->accelerate();
  EXPECT_EQ(scene.step.report.clamped_force, 0u) << "in the next step";
}

}  // namespace forces_test
}  // namespace isostep
