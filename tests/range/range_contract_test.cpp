// The range contract: inside Limits<S> no intermediate of a step overflows. The engine runs here over scalars that stop
// the program where an exact answer does not fit; what would wrap silently elsewhere kills these tests.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "isostep/core/random.hpp"
#include "isostep/geometry/limits.hpp"
#include "isostep/world/world.hpp"
#include "sample.hpp"

namespace isostep {
namespace range_contract_test {

using test::sampled;

using TrappingQ16 = Fixed<std::int32_t, 16, Overflow::trap>;
using TrappingQ32 = Fixed<std::int64_t, 32, Overflow::trap>;

template <class S> class RangeWorld : public ::testing::Test {
 public:
  explicit RangeWorld(SolverName solver, Projection projection = Projection::nonlinear)
      : world(settings(solver, projection)) {}
  static Settings<S> settings(SolverName solver, Projection projection) {
    Settings<S> settings;
    settings.solver = solver;
    settings.projection = projection;
    return settings;
  }

  World<S> world;
  std::vector<BodyId> bodies;

  ShapeId floor() {
    const ShapeId shape = world.add_shape(Box{{50, 1, 50}});
    world.create({.shape = shape, .position = {0, -1, 0}});
    return shape;
  }
  BodyId add(ShapeId shape, Vec3<S> position, S mass) {
    const BodyId body = world.create({.type = dynamic, .shape = shape, .position = position, .mass = mass});
    EXPECT_TRUE(body) << describe(world.fault());
    bodies.push_back(body);
    return body;
  }
  /// Fault-free, and something touched.
  void step(int frames) {
    std::uint32_t points = 0;
    for (int i = 0; i < frames; ++i) {
      world.step();
      points = max(points, world.counts().points);
    }
    EXPECT_GT(points, 0u);
  }
};
template <class S, SolverName kName, Projection kWay = Projection::nonlinear> struct Solved {
  using Scalar = S;
  static constexpr SolverName kSolver = kName;
  static constexpr Projection kProjection = kWay;
};
template <class S, Projection kWay> using Projected = Solved<S, SolverName::worst_first, kWay>;
template <class Case> class RangeContract : public RangeWorld<typename Case::Scalar> {
 public:
  RangeContract() : RangeWorld<typename Case::Scalar>(Case::kSolver, Case::kProjection) {}
  void SetUp() override {
    if (const char* why = left_out(Case::kSolver)) GTEST_SKIP() << why;
  }
};
using Cases =
    ::testing::Types<Solved<TrappingQ16, SolverName::soft_step>, Solved<TrappingQ32, SolverName::soft_step>,
                     Solved<TrappingQ16, SolverName::pgs>, Solved<TrappingQ32, SolverName::pgs>,
                     Solved<TrappingQ16, SolverName::worst_first>, Solved<TrappingQ32, SolverName::worst_first>,
                     Projected<TrappingQ16, Projection::linear>, Projected<TrappingQ32, Projection::linear>,
                     Projected<TrappingQ16, Projection::relaxed>, Projected<TrappingQ32, Projection::relaxed>,
                     Projected<TrappingQ16, Projection::velocity_based>,
                     Projected<TrappingQ32, Projection::velocity_based>, Solved<TrappingQ16, SolverName::direct>,
                     Solved<TrappingQ32, SolverName::direct>>;
TYPED_TEST_SUITE(RangeContract, Cases);

TYPED_TEST(RangeContract, APileOfEveryShapeSettles) {
  using S = typename TypeParam::Scalar;
  this->floor();
  const ShapeId shapes[3] = {this->world.add_shape(Box{{0.25, 0.375, 0.5}}), this->world.add_shape(Sphere{0.25}),
                             this->world.add_shape(Capsule{0.25, 0.25})};
  for (int i = 0, count = sampled(60, 24); i < count; ++i) {
    const S x = S(i % 4) * S(0.75) + S(i % 3) * S(0.0625), z = S(i / 4 % 4) * S(0.75);
    this->add(shapes[i % 3], {x, S(1 + i / 16), z}, S(1 + i % 5));
  }
  this->step(sampled(240, 120));
}

TYPED_TEST(RangeContract, MassesAtTheRatioLimitPress) {
  using S = typename TypeParam::Scalar;
  this->floor();
  const ShapeId box = this->world.add_shape(Box{{0.5, 0.5, 0.5}});
  this->add(box, {0, S(0.5), 0}, S(1));
  this->add(box, {0, S(1.5), 0}, Limits<S>::mass_ratio());
  this->add(box, {5, S(0.5), 0}, Limits<S>::mass());
  this->add(box, {5, S(1.5), 0}, Limits<S>::mass());
  this->step(120);
}

TYPED_TEST(RangeContract, BodiesAtTheSpeedLimitCollide) {
  using S = typename TypeParam::Scalar;
  this->floor();
  const ShapeId ball = this->world.add_shape(Sphere{0.5});
  const S speed = Limits<S>::speed() * S(0.5);  // each: they close at the limit
  for (int i = 0; i < 8; ++i) {
    const S gap = S(0.5) + speed * S(2.0 / 60) * S(i) * S(0.125);
    const BodyId left = this->add(ball, {-gap, S(1 + 2 * i), 0}, S(1)),
                 right = this->add(ball, {gap, S(1 + 2 * i), 0}, S(3));
    this->world.set_velocity(left, {speed, 0, 0}, {0, 0, Limits<S>::angular_speed()});
    this->world.set_velocity(right, {-speed, 0, 0}, {0, Limits<S>::angular_speed(), 0});
  }
  this->step(60);
}

TYPED_TEST(RangeContract, MaterialsAtTheirLimitsSlideAtTheSpeedLimit) {
  using S = typename TypeParam::Scalar;
  const ShapeId floor = this->floor();
  const ShapeId box = this->world.add_shape(Box{{0.5, 0.125, 0.5}});
  Material<S> belt;
  belt.friction = belt.static_friction = S(16);
  belt.anisotropy = {S(1), S(1), S(1.0 / 64)};
  belt.surface_velocity = {Limits<S>::speed(), 0, 0};
  belt.kind = 1;
  this->world.create({.shape = floor, .position = {0, -1, 0}, .material = belt});
  Material<S> runners = belt;
  runners.anisotropy = {S(1.0 / 64), S(1.0 / 64), S(1)};
  runners.surface_velocity = {0, 0, Limits<S>::speed()};
  for (int i = 0; i < 8; ++i) {
    const BodyId body = this->add(box, {S(2 * i), S(0.125), 0}, S(1));
    runners.kind = i % 2 == 0 ? 0u : 1u;
    this->world.set_material(body, runners);
    const S speed = Limits<S>::speed() * S(0.5);
    this->world.set_velocity(body, {-speed, 0, i % 3 == 0 ? -speed : S(i)}, {0, Limits<S>::angular_speed(), 0});
  }
  MaterialPair<S> pair;
  pair.kind_a = pair.kind_b = 1;
  pair.friction = pair.static_friction = S(16);
  EXPECT_TRUE(this->world.add(pair));
  this->step(60);
}

TYPED_TEST(RangeContract, BeltsTurnAndRunAtTheirLimitsOnOneWayBodies) {
  using S = typename TypeParam::Scalar;
  const ShapeId floor = this->floor();
  const ShapeId box = this->world.add_shape(Box{{0.5, 0.125, 0.5}});
  Material<S> rough;
  rough.friction = S(16);
  rough.surface_velocity = {Limits<S>::speed(), 0, 0};
  const BodyId belt = this->world.create({.shape = floor, .position = {0, -1, 0}, .material = rough});
  EXPECT_TRUE(
      this->world.add(SurfaceVelocity<S>{belt, {Limits<S>::speed(), 0, 0}, {0, Limits<S>::angular_speed(), 0}}));
  EXPECT_TRUE(this->world.add(OneWay<S>{belt}));
  for (int i = 0; i < 8; ++i) {
    const BodyId body = this->add(box, {S(2 * i), S(0.125), S(i)}, S(1));
    this->world.set_material(body, rough);
    EXPECT_TRUE(this->world.add(HitReport<S>{body, S(0)}));
    SurfaceVelocity<S> wheel = {body, {0, 0, -Limits<S>::speed()}, {-Limits<S>::angular_speed(), 0, 0}};
    if (i % 2 != 0) wheel.linear = wheel.angular = Vec3<S>::zero();
    EXPECT_TRUE(this->world.add(wheel));
    this->world.set_velocity(body, {-Limits<S>::speed() * S(0.5), 0, S(i)}, {0, Limits<S>::angular_speed(), 0});
  }
  this->step(60);
}

TYPED_TEST(RangeContract, DeepOverlapsArePushedApart) {
  using S = typename TypeParam::Scalar;
  this->floor();
  const ShapeId box = this->world.add_shape(Box{{1, 1, 1}});
  for (int i = 0; i < 5; ++i) this->add(box, {S(i) * S(0.125), S(1), S(0)}, S(1));
  this->step(120);
}

/// Overlap times rate is what a contact asks for at first: at the highest rate it fits no 16 bits.
TYPED_TEST(RangeContract, DeepOverlapsArePushedApartAtTheHighestRate) {
  using S = typename TypeParam::Scalar;
  Settings<S> fast = this->settings(TypeParam::kSolver, TypeParam::kProjection);
  fast.hz = 240;
  fast.substeps = 64;
  this->world = World<S>(fast);
  this->floor();
  const ShapeId box = this->world.add_shape(Box{{1, 1, 1}});
  this->add(box, {S(-3), S(0.75), 0}, S(1));
  this->add(box, {S(3), S(0.375), 0}, S(1));
  this->step(240);
  for (const BodyId body : this->bodies) {
    EXPECT_GT(to_double(this->world.center_of_mass(body).y), 0.875);
    EXPECT_LT(to_double(this->world.center_of_mass(body).y), 2);
  }
}

TYPED_TEST(RangeContract, SmallAndLargeBodiesMeet) {
  using S = typename TypeParam::Scalar;
  this->floor();
  const ShapeId crumb = this->world.add_shape(Sphere{0.03125}), slab = this->world.add_shape(Box{{20, 0.25, 20}});
  this->add(slab, {0, S(0.25), 0}, S(100));
  for (int i = 0; i < 10; ++i) this->add(crumb, {S(i), S(1), S(0)}, S(1));
  this->step(120);
}

TYPED_TEST(RangeContract, JointsOfEveryKindCarryLoad) {
  using S = typename TypeParam::Scalar;
  const ShapeId link = this->world.add_shape(Capsule{0.125, 0.25}), weight = this->world.add_shape(Sphere{0.5});
  BodyId last = {};
  for (int i = 0; i < 12; ++i) {
    const BodyId body = this->add(i < 11 ? link : weight, {S(i), S(10), 0}, i < 11 ? S(1) : S(20));
    JointProperties<S> joint = this->world.joint_at(static_cast<JointType>(i % static_cast<int>(kJointTypes)), last,
                                                    body, {{S(i) - S(0.5), S(10), 0}, Quat<Unit<S>>::identity()});
    if (joint.type == JointType::distance) joint.upper = S(0.5);
    EXPECT_TRUE(this->world.create(joint)) << describe(this->world.fault());
    last = body;
  }
  for (int i = 0; i < 120; ++i) this->world.step();
  EXPECT_LT(this->world.center_of_mass(last).y, S(9));
}

TYPED_TEST(RangeContract, DrivesOfEveryAxisCarryLoad) {
  using S = typename TypeParam::Scalar;
  const ShapeId link = this->world.add_shape(Capsule{0.125, 0.25}), weight = this->world.add_shape(Sphere{0.5});
  BodyId last = {};
  for (int i = 0; i < 12; ++i) {
    const BodyId body = this->add(i < 11 ? link : weight, {S(i), S(10), 0}, i < 11 ? S(1) : S(20));
    SixAxisDefinition<S> joint;
    joint.a = last;
    joint.b = body;
    joint.frame.position = {S(i) - S(0.5), S(10), 0};
    joint.locks = (i % 3 == 0 ? joint_flag::kLockPoint : joint_flag::kLockX) | (i % 2 == 0 ? joint_flag::kCone : 0u);
    for (const JointAxis axis :
         {JointAxis::y, JointAxis::z, JointAxis::swing_x, JointAxis::swing_y, JointAxis::twist}) {
      if ((joint.locks & lock_of(axis)) != 0) continue;
      AxisDrive<S>& drive = joint.drives[joint.drive_count++];
      drive.axis = axis;
      drive.limited = true;
      drive.upper = S(0.0625) * S(1 + i % 5);
      drive.lower = -drive.upper;
      drive.motor = i % 4 == 1;
      drive.motor_speed = S(20);
      drive.spring_frequency = i % 4 > 1 ? S(30) : S(0);
      drive.max_force = S(i % 4 == 2 ? 0 : 20000);
    }
    EXPECT_TRUE(this->world.create(six_axis(joint))) << describe(this->world.fault());
    last = body;
  }
  for (int i = 0, frames = sampled(120, 60); i < frames; ++i) this->world.step();
  EXPECT_GT(abs(this->world.center_of_mass(last).y - S(10)), S(0.1));  // it falls, or such motors throw it
}

TYPED_TEST(RangeContract, ChainsOfBallJointsCarryLoad) {
  using S = typename TypeParam::Scalar;
  const ShapeId link = this->world.add_shape(Capsule{0.125, 0.25}), weight = this->world.add_shape(Sphere{0.5}),
                bead = this->world.add_shape(Sphere{0.0625});
  for (const ShapeId shape : {link, bead}) {  // beads turn easily: their tension is taken implicitly
    BodyId last = {};
    for (int i = 0; i < 12; ++i) {
      const S z = shape == bead ? S(4) : S(0);
      const BodyId body = this->add(i < 11 ? shape : weight, {S(i), S(10), z}, i < 11 ? S(1) : S(20));
      const JointProperties<S> joint =
          this->world.joint_at(JointType::ball, last, body, {{S(i) - S(0.5), S(10), z}, Quat<Unit<S>>::identity()});
      EXPECT_TRUE(this->world.create(joint)) << describe(this->world.fault());
      last = body;
    }
    this->world.set_velocity(last, {0, Limits<S>::speed() * S(0.25), 0}, {0, 0, 0});
  }
  for (int i = 0; i < 120; ++i) this->world.step();
}

TYPED_TEST(RangeContract, TheEdgeOfTheWorldHolds) {
  using S = typename TypeParam::Scalar;
  const ShapeId ball = this->world.add_shape(Sphere{0.5});
  const S edge = Limits<S>::position();
  const BodyId body = this->add(ball, {edge - S(1), 0, S(1) - edge}, S(1));
  const S fast = Limits<S>::speed() * S(0.5);  // its length is within the limit
  this->world.set_velocity(body, {fast, 0, -fast}, {0, 0, 0});
  std::uint32_t clamped = 0;
  for (int i = 0; i < 60; ++i) clamped += this->world.step().clamped_position;
  EXPECT_GT(clamped, 0u);
  EXPECT_LE(this->world.center_of_mass(body).x, edge);
}

}  // namespace range_contract_test
}  // namespace isostep
