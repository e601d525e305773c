// The records of a warm world ask for no memory.
// SPDX-License-Identifier: MIT

#include "determinism/allocation_count.hpp"
#include "determinism/solver_scene.hpp"
#include "isostep/store/state.hpp"

namespace isostep::test {
namespace record_allocation_test {

/// Three cars, of which one stands on a lorry, and six characters who walk into crates and back, all told what to do in
/// every frame.
template <class S> class Movers {
 public:
  explicit Movers(World<S>& world) : world_(world) {
    world_.create({.shape = world_.add_shape(HalfSpace<S>{{Unit<S>(0), Unit<S>(1), Unit<S>(0)}, S(0)})});
    const ShapeId chassis = world_.add_shape(Box{{0.75, 0.25, 1.5}}), bed = world_.add_shape(Box{{3, 0.25, 6}});
    add_vehicle(chassis, {S(0), S(1), S(0)}, S(0.5), S(1), S(200));
    add_vehicle(chassis, {S(8), S(1), S(0)}, S(0.5), S(1), S(200));
    add_vehicle(bed, {S(24), S(1), S(0)}, S(2.5), S(5), S(1000));
    add_vehicle(chassis, {S(24), S(2.25), S(0)}, S(0.5), S(1), S(200));
    const ShapeId crate = world_.add_shape(Box{{0.5, 0.5, 0.5}}), capsule = world_.add_shape(Capsule{0.25, 0.5});
    for (int i = 0; i < 6; ++i) {
      create(crate, {S(2 * i), S(0.5), S(12)}, BodyType::dynamic, S(20));
      CharacterSettings<S> walker;
      walker.body = create(capsule, {S(2 * i), S(0.875), S(10)}, BodyType::kinematic, S(0));
      walkers_.push_back(world_.add(walker));
    }
  }

  void play(int frame) {
    for (const VehicleId id : vehicles_) {
      VehicleInput<S> input;
      input.throttle = S(frame % 120 < 60 ? 1 : -1);
      input.steer = S(0.5);
      EXPECT_TRUE(world_.set_input(id, input));
    }
    for (const CharacterId id : walkers_) {
      CharacterInput<S> input;
      input.move = {S(0), S(0), S(frame % 60 < 40 ? 2 : -4)};
      EXPECT_TRUE(world_.set_input(id, input));
    }
    world_.step();
  }
  const std::vector<CharacterId>& walkers() const { return walkers_; }

 private:
  BodyId create(ShapeId shape, Vec3<S> at, BodyType type, S mass) {
    BodyDefinition<S> body;
    body.type = type;
    body.shape = shape;
    body.position = at;
    body.mass = mass;
    return world_.create(body);
  }
  void add_vehicle(ShapeId shape, Vec3<S> at, S side, S base, S mass) {
    VehicleSettings<S> vehicle;
    vehicle.body = create(shape, at, BodyType::dynamic, mass);
    vehicle.engine_torque = mass;
    vehicles_.push_back(world_.add(vehicle));
    for (int i = 0; i < 4; ++i) {
      WheelSettings<S> wheel;
      wheel.body = vehicle.body;
      wheel.hard_point = {i % 2 == 0 ? side : -side, S(0), i < 2 ? base : -base};
      wheel.stiffness = mass * S(25);
      wheel.damping = mass * S(2);
      wheel.inertia = mass * S(0.001953125);
      wheel.drive_share = S(1);
      wheel.steer_angle = i < 2 ? S(0.25) : S(0);
      EXPECT_TRUE(world_.add(wheel)) << describe(world_.fault());
    }
  }

  World<S>& world_;
  std::vector<VehicleId> vehicles_;
  std::vector<CharacterId> walkers_;
};

template <class S> class RecordAllocation : public testing::Test {};
TYPED_TEST_SUITE(RecordAllocation, AllocationScalars);

TYPED_TEST(RecordAllocation, VehiclesAndCharactersMoveWithoutAny) {
  using S = TypeParam;
  Settings<S> awake;
  awake.allow_sleep = false;
  World<S> world(awake);
  Movers<S> movers(world);
  for (int frame = 0; frame < 240; ++frame) movers.play(frame);
  std::uint32_t rolling = 0, walking = 0;
  for (const WheelState<S>& wheel : world.state().parts.wheel_states)
    rolling += wheel.contact_body && wheel.spin != S(0) ? 1u : 0u;
  for (const CharacterId id : movers.walkers()) walking += world.state(id)->footing == Footing::floor ? 1u : 0u;
  EXPECT_GT(rolling, 8u);
  EXPECT_GT(walking, 3u);
  const Count count;
  for (int frame = 240; frame < 360; ++frame) movers.play(frame);
  EXPECT_EQ(count.so_far(), 0u);
}

TYPED_TEST(RecordAllocation, BeltsAndReportsOfHitsNeedNone) {
  using S = TypeParam;
  for (std::uint32_t name = 0; name < kSolvers; ++name) {
    if (left_out(SolverName{name}) != nullptr) continue;
    World<S> world(solver_settings<S>(static_cast<SolverName>(name)));
    const ShapeId crate = add_box(world, 0.25, 0.25, 0.25);
    for (int i = 0; i < 4; ++i) {
      const BodyId table = world.create(still<S>(add_box(world, 8, 0.25, 1), {0, -0.25, 4.0 * i}));
      EXPECT_TRUE(world.add(SurfaceVelocity<S>{table, {S(0.25), S(0), S(0)}, {S(0), S(0.03125) * S(i), S(0)}}));
      EXPECT_TRUE(world.add(OneWay<S>{table}));
      EXPECT_TRUE(world.add(HitReport<S>{table, S(0)}));
      for (int k = 0; k < 5; ++k) world.create(moving<S>(crate, {1.0 * k - 3, 0.25, 4.0 * i}));
    }
    for (int frame = 0; frame < 120; ++frame) world.step();
    EXPECT_EQ(world.counts().contacts, 20u);
    const Count count;
    for (int frame = 0; frame < 60; ++frame) world.step();
    EXPECT_EQ(count.so_far(), 0u) << kSolverNames[name];
  }
}

TYPED_TEST(RecordAllocation, BeltsOfPartsAndMountedSensorsNeedNone) {
  using S = TypeParam;
  World<S> world(settings<S>());
  const ShapeId planks = add_two_boxes(world, {8, 0.25, 1}, {0, -0.25, 0}, {8, 0.25, 1}, {0, -0.25, 4});
  const BodyId body = world.create(still<S>(planks));
  EXPECT_TRUE(world.add(SurfaceVelocity<S>{body, {S(0.25), S(0), S(0)}, Vec3<S>::zero(), 0}));
  EXPECT_TRUE(world.add(SurfaceVelocity<S>{body, {S(-0.25), S(0), S(0)}, Vec3<S>::zero(), 1}));
  BodyDefinition<S> sensor = still<S>(add_ball(world, 1));
  sensor.type = BodyType::kinematic;
  sensor.sensor = true;
  for (int i = 0; i < 8; ++i) {
    SensorMount<S> mount;
    const ShapeId crate = add_box(world, 0.25, 0.25, 0.25);
    mount.on = world.create(moving<S>(crate, {i / 2 - 2.0, 0.25, 4.0 * (i % 2)}));
    mount.sensor = world.create(sensor);
    EXPECT_TRUE(world.add(mount));
    if (i == 0) world.set_enabled(mount.on, false);
  }
  for (int frame = 0; frame < 120; ++frame) world.step();
  EXPECT_EQ(world.counts().contacts, 7u);
  const Count count;
  for (int frame = 0; frame < 60; ++frame) world.step();
  EXPECT_EQ(count.so_far(), 0u);
}

TYPED_TEST(RecordAllocation, GhostsThatComeAndGoNeedNone) {
  using S = TypeParam;
  World<S> world(settings<S>(0));
  const BodyId platform = world.create(still<S>(add_box(world, 2, 0.125, 2)));
  const BodyId ball = world.create(moving<S>(add_ball(world, 0.25), {0, -1, 0}, {0, 4, 0}));
  EXPECT_TRUE(world.add(OneWay<S>{platform}));
  std::size_t ghosts = 0;
  const auto pass = [&] {
    world.set_pose(ball, {{S(0), S(-1), S(0)}, Quat<Unit<S>>::identity()});
    for (int frame = 0; frame < 60; ++frame) {
      world.step();
      for (const Ghost<S>& ghost : world.state().records->ghosts.all()) ghosts += ghost.a ? 1u : 0u;
    }
    EXPECT_GT(world.center_of_mass(ball).y, S(2));
  };
  pass();
  pass();
  ghosts = 0;
  const Count count;
  pass();
  EXPECT_EQ(count.so_far(), 0u);
  EXPECT_GT(ghosts, 0u);
}

}  // namespace record_allocation_test
}  // namespace isostep::test
