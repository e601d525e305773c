// Laws of spinning about a contact's normal: friction acts at a radius, so what turns on a point comes to rest.
// SPDX-License-Identifier: MIT

#include "built.hpp"
#include "unit/world/worlds.hpp"

namespace isostep::test {
namespace spin_resistance_test {

template <class S> class SpinResistance : public ::testing::Test {
 protected:
  static World<S> on_ground(SolverName solver, double resistance) {
    Settings<S> s = settings<S>();
    s.solver = solver;
    if (solver == SolverName::pgs) s.substeps = 32;
    World<S> w(s);
    BodyDefinition<S> d = still<S>(w.add_shape(HalfSpace<S>{{Unit<S>(0), Unit<S>(1), Unit<S>(0)}, S(0)}));
    d.material.friction = num<S>(0.5);
    d.material.spin_resistance = num<S>(resistance);
    w.create(d);
    return w;
  }
  /// A ball of radius 1/2 m, whose moment over its mass is 1/10 m^2.
  static BodyId add_spinning_ball(World<S>& w, double friction, double resistance, double spin) {
    BodyDefinition<S> d = moving<S>(add_ball(w, 0.5), {0, 0.5, 0});
    d.mass = num<S>(2);
    d.material.friction = num<S>(friction);
    d.material.spin_resistance = num<S>(resistance);
    d.angular_velocity = vec<S>(0, spin, 0);
    return w.create(d);
  }
  static double spin_of(World<S>& w, BodyId id) { return to_double(w.angular_velocity(id).y); }
};
TYPED_TEST_SUITE(SpinResistance, AllScalars);

TYPED_TEST(SpinResistance, slows_a_ball_by_friction_times_its_radius) {
  using S = TypeParam;
  const double slowing = 0.5 * 10 * 0.03125 / 0.1;  // [rad/s^2]
  for (const SolverName solver : kBuiltSolvers) {
    World<S> w = this->on_ground(solver, 0.03125);
    const BodyId id = this->add_spinning_ball(w, 0.5, 0.03125, 4);
    run(w, 6);  // until the ground bears it
    const double before = this->spin_of(w, id);
    run(w, 60);
    EXPECT_NEAR(before - this->spin_of(w, id), slowing, 0.03 * slowing) << kSolverNames[static_cast<int>(solver)];
    run(w, 120);
    EXPECT_NEAR(this->spin_of(w, id), 0, 1e-3) << kSolverNames[static_cast<int>(solver)];
    EXPECT_FALSE(w.is_awake(id)) << kSolverNames[static_cast<int>(solver)];
  }
}

TYPED_TEST(SpinResistance, is_the_root_of_the_product_and_nothing_without_friction) {
  using S = TypeParam;
  World<S> w = this->on_ground(SolverName::soft_step, 0.0625);
  const BodyId plain = this->add_spinning_ball(w, 0.5, 0.015625, 4);  // 1/32 m together
  run(w, 6);
  const double before = this->spin_of(w, plain);
  run(w, 30);
  EXPECT_NEAR(before - this->spin_of(w, plain), 0.5 * 10 * 0.03125 / 0.1 / 2, 0.03);
  for (const bool without_radius : {true, false}) {
    World<S> free = this->on_ground(SolverName::soft_step, 0.0625);
    const BodyId id = this->add_spinning_ball(free, without_radius ? 0.5 : 0, without_radius ? 0 : 1, 4);
    run(free, 120);
    EXPECT_NEAR(this->spin_of(free, id), 4, 0.01) << without_radius;
  }
}

/// Spheres and capsules of 5 cm to 1 m, at 5 rad/s and the material as it is made.
TYPED_TEST(SpinResistance, lets_what_spins_on_a_point_fall_asleep) {
  using S = TypeParam;
  for (const double size : {0.05, 0.25, 0.5}) {
    for (int kind = 0; kind < 2; ++kind) {
      World<S> w(settings<S>());
      add_ground(w);
      const ShapeId shape = kind == 0 ? add_ball(w, size) : w.add_shape(Capsule<S>{num<S>(size), num<S>(size / 2)});
      BodyDefinition<S> d = moving<S>(shape, {0, kind == 0 ? size : 1.5 * size, 0});
      d.angular_velocity = vec<S>(0, 5, 0);
      const BodyId id = w.create(d);
      int frames = 0;
      for (; frames < 60 * 20 && w.is_awake(id); ++frames) w.step();
      EXPECT_FALSE(w.is_awake(id)) << "size " << size << ", kind " << kind;
    }
  }
}

/// The patch of a large body may be small against it: a slab on a peg turns as friction at the peg's radius lets it.
TYPED_TEST(SpinResistance, acts_on_small_patches_below_large_bodies) {
  using S = TypeParam;
  World<S> w(settings<S>());
  BodyDefinition<S> peg = still<S>(add_box(w, 0.0625, 0.5, 0.0625), {0, -0.5, 0});
  peg.material.friction = num<S>(0.5);
  w.create(peg);
  BodyDefinition<S> d = moving<S>(add_box(w, 2, 0.0625, 2), {0, 0.0625, 0});
  d.material.friction = num<S>(0.5);
  d.angular_velocity = vec<S>(0, 1, 0);
  const BodyId id = w.create(d);
  run(w, 6);
  const double before = to_double(w.angular_velocity(id).y);
  run(w, 60);
  const double radius = 0.541 * 0.0625 * std::sqrt(2.0), moment = (16.0 + 16.0) / 12;
  const double slowing = 0.5 * 10 * radius / moment;
  EXPECT_NEAR(before - to_double(w.angular_velocity(id).y), slowing, 0.1 * slowing);
}

}  // namespace spin_resistance_test
}  // namespace isostep::test
