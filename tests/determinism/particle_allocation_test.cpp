// A warm world of particles steps, saves, loads and hashes without asking for memory.
// SPDX-License-Identifier: MIT

#include "determinism/allocation_count.hpp"
#include "isostep/particles/particle_world.hpp"

namespace isostep::test {
namespace particle_allocation_test {

/// 60 balls in a heap, a net of springs, a chain; every way to step.
template <class S> class ParticleAllocation : public testing::Test {
 protected:
  static ParticleSettings<S> settings(std::uint32_t way) {
    ParticleSettings<S> settings;
    settings.integrator = static_cast<Integrator>(way % 4);  // the implicit one apart
    settings.solver = way / 4 > 0 ? ParticleSolver::worst_first : ParticleSolver::soft_step;
    settings.stepping = way / 4 == 2 ? Stepping::time_division : Stepping::fixed;
    return settings;
  }
  static ParticleWorld<S> heap(const ParticleSettings<S>& settings) {
    ParticleWorld<S> world(settings);
    ParticleMaterial<S> ball;
    ball.radius = S(0.25);
    ball.friction = S(0.5);
    ball.collides = true;
    const ParticleMaterialId balls = world.add(ball);
    ParticleMaterial<S> thread;
    thread.damping = S(0.5);
    world.set(world.default_material(), thread);
    world.add(Collider<S>{});
    for (int i = 0; i < 60; ++i) {
      ParticleDefinition<S> d;
      d.position = {S(i % 4) * S(0.5), S(0.25) + S(i / 16) * S(0.5), S(i / 4 % 4) * S(0.5)};
      d.material = balls;
      world.create(d);
    }
    ParticleId last;
    for (int i = 0; i < 16; ++i) {
      ParticleDefinition<S> d;
      d.position = {S(5 + i % 4), S(5), S(i / 4)};
      d.pinned = i % 4 == 0;
      const ParticleId next = world.create(d);
      if (i % 4 > 0) {
        Spring<S> spring;
        spring.a = last;
        spring.b = next;
        spring.stiffness = S(50);
        spring.rest_length = S(1);
        world.add(spring);
        world.add(Link<S>{LinkType::cable, last, next, {}, S(1.5), S(0)});
      }
      last = next;
    }
    Cohesion<S> blob = {balls, S(0.25), S(1), S(0.5), S(0.75), S(1)};
    world.add(blob);
    for (int frame = 0; frame < 60; ++frame) world.step();
    EXPECT_GT(world.counts().contacts, 40u);
    return world;
  }
};
TYPED_TEST_SUITE(ParticleAllocation, AllocationScalars);

TYPED_TEST(ParticleAllocation, AWarmHeapStepsWithoutAnyWhicheverWayItIsStepped) {
  for (std::uint32_t way = 0; way < 12; ++way) {
    ParticleWorld<TypeParam> world = this->heap(this->settings(way));
    const Count count;
    for (int frame = 0; frame < 20; ++frame) world.step();
    EXPECT_EQ(count.so_far(), 0u) << kIntegratorNames[way % 4] << ", way " << way;
  }
}

TYPED_TEST(ParticleAllocation, AWarmSnapshotIsSavedLoadedAndHashedWithoutAny) {
  ParticleWorld<TypeParam> world = this->heap(this->settings(1));
  typename ParticleWorld<TypeParam>::Snapshot frame;
  world.save(frame);
  world.step();
  world.load(frame);
  world.save(frame);
  const Count count;
  for (int round = 0; round < 10; ++round) {
    world.save(frame);
    const std::uint64_t before = world.hash();
    world.step();
    world.load(frame);
    EXPECT_EQ(world.hash(), before);
  }
  EXPECT_EQ(count.so_far(), 0u);
}

TYPED_TEST(ParticleAllocation, TheImplicitIntegratorNeedsNoneForASmallNetwork) {
  ParticleSettings<TypeParam> settings = this->settings(1);
  settings.integrator = Integrator::implicit_euler;
  ParticleWorld<TypeParam> world = this->heap(settings);
  const Count count;
  for (int frame = 0; frame < 30; ++frame) world.step();
  EXPECT_EQ(count.so_far(), 0u);
}

}  // namespace particle_allocation_test
}  // namespace isostep::test
