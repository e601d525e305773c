// A warm world steps, saves, loads and hashes without asking for memory, and so do coarse structures what they do. The
// executable counts every operator new.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdlib>
#include <new>

#include "determinism/solver_scene.hpp"
#include "isostep/collision/broadphase/broad_phases.hpp"
#include "isostep/core/random.hpp"
#include "isostep/effects/articulation/articulation.hpp"
#include "isostep/particles/particle_world.hpp"
#include "isostep/world/session_recorder.hpp"
#include "isostep/world/state.hpp"

namespace {
bool counting = false;
std::size_t allocations = 0;

void* counted(std::size_t size, std::size_t alignment) {
  if (counting) ++allocations;
  const std::size_t whole = (size + alignment - 1) / alignment * alignment;
  void* memory = std::aligned_alloc(alignment, whole == 0 ? alignment : whole);
  if (memory == nullptr) std::abort();
  return memory;
}
}  // namespace

// Not inlined: gcc would take one half of a pair for a mismatch with the other.
#define NOT_INLINED __attribute__((noinline))
NOT_INLINED void* operator new(std::size_t size) { return counted(size, alignof(std::max_align_t)); }
NOT_INLINED void* operator new(std::size_t size, std::align_val_t alignment) {
  return counted(size, std::size_t(alignment));
}
NOT_INLINED void operator delete(void* memory) noexcept { std::free(memory); }
NOT_INLINED void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
NOT_INLINED void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
NOT_INLINED void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }

namespace isostep {
namespace {

/// Counts from here to the end of the scope.
class Count {
 public:
  Count() {
    allocations = 0;
    counting = true;
  }
  ~Count() { counting = false; }
  std::size_t so_far() const { return allocations; }
};

template <class S> class Allocation : public testing::Test {
 protected:
  /// 100 spheres and 100 boxes in columns of five that touch, awake for good.
  Allocation() : world_(settings()) {
    const ShapeId ground = world_.add_shape(HalfSpace<S>{{Unit<S>(0), Unit<S>(1), Unit<S>(0)}, S(0)});
    const ShapeId ball = world_.add_shape(Sphere{0.5});
    const ShapeId crate = world_.add_shape(Box{{0.5, 0.5, 0.5}});
    world_.create({.shape = ground});
    for (int i = 0; i < 200; ++i) {
      BodyDefinition<S> body;
      body.type = BodyType::dynamic;
      body.shape = i / 5 % 2 == 0 ? ball : crate;
      body.position = {S(i / 5 % 8) - S(4), S(0.5) + S(i % 5) * S(1.03125), S(i / 40)};
      bodies_.push_back(world_.create(body));
    }
    for (int frame = 0; frame < 480; ++frame) world_.step();  // balls have rolled apart
  }

  static Settings<S> settings() {
    Settings<S> settings;
    settings.allow_sleep = false;
    return settings;
  }

  World<S> world_;
  std::vector<BodyId> bodies_;
};
using Scalars = testing::Types<float, double, Q16_16, Q32_32>;
TYPED_TEST_SUITE(Allocation, Scalars);

TYPED_TEST(Allocation, TheCounterCounts) {
  const Count count;
  this->world_.add_shape(Sphere{0.25});
  EXPECT_GT(count.so_far(), 0u);
}

TYPED_TEST(Allocation, ASettledPileStepsWithoutAny) {
  EXPECT_EQ(this->world_.counts().awake, 200u);
  EXPECT_GT(this->world_.counts().contacts, 200u);
  const Count count;
  for (int frame = 0; frame < 60; ++frame) this->world_.step();
  EXPECT_EQ(count.so_far(), 0u);
}

TYPED_TEST(Allocation, AWarmSceneStepsWithoutAnyWhateverItsSolver) {
  using S = TypeParam;
  for (std::uint32_t name = 0; name < kSolvers; ++name) {
    World<S> world(test::solver_settings<S>(static_cast<SolverName>(name)));
    const test::SolverScene<S> scene(world);
    for (std::uint64_t frame = 0; frame < 240; ++frame) scene.play(world, frame);
    EXPECT_GT(world.counts().contacts, 9u);
    EXPECT_EQ(world.counts().joints, 6u);
    const Count count;
    for (std::uint64_t frame = 240; frame < 270; ++frame) scene.play(world, frame);
    EXPECT_EQ(count.so_far(), 0u) << kSolverNames[name];
  }
}

TYPED_TEST(Allocation, AWarmSceneStepsWithoutAnyHoweverItsOverlapsEnd) {
  using S = TypeParam;
  for (std::uint32_t projection = 0; projection < kProjections; ++projection) {
    Settings<S> settings = test::solver_settings<S>(SolverName::worst_first);
    settings.projection = static_cast<Projection>(projection);
    World<S> world(settings);
    const test::SolverScene<S> scene(world);
    for (std::uint64_t frame = 0; frame < 240; ++frame) scene.play(world, frame);
    const Count count;
    for (std::uint64_t frame = 240; frame < 270; ++frame) scene.play(world, frame);
    EXPECT_EQ(count.so_far(), 0u) << kProjectionNames[projection];
  }
}

TYPED_TEST(Allocation, PairsOfMaterialsAreFoundWithoutAny) {
  using S = TypeParam;
  for (std::uint32_t i = 0; i < this->bodies_.size(); ++i) {
    Material<S> material;
    material.kind = i % 50;
    material.anisotropy = {S(0.25), S(1), S(1)};
    this->world_.set_material(this->bodies_[i], material);
    MaterialPair<S> pair;
    pair.kind_a = 1 + i;
    pair.kind_b = 1 + i / 2;
    EXPECT_TRUE(this->world_.add(pair));
  }
  this->world_.step();
  const Count count;
  for (int frame = 0; frame < 60; ++frame) this->world_.step();
  EXPECT_EQ(count.so_far(), 0u);
}

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
      Character<S> walker;
      walker.body = create(capsule, {S(2 * i), S(0.875), S(10)}, BodyType::kinematic, S(0));
      walkers_.push_back(world_.add(walker));
    }
  }

  void play(int frame) {
    for (const VehicleId id : vehicles_) {
      Vehicle<S> vehicle = *world_.find(id);
      vehicle.throttle = S(frame % 120 < 60 ? 1 : -1);
      vehicle.steer = S(0.5);
      EXPECT_TRUE(world_.set(id, vehicle));
    }
    for (const CharacterId id : walkers_) {
      Character<S> walker = *world_.find(id);
      walker.move = {S(0), S(0), S(frame % 60 < 40 ? 2 : -4)};
      EXPECT_TRUE(world_.set(id, walker));
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
    Vehicle<S> vehicle;
    vehicle.body = create(shape, at, BodyType::dynamic, mass);
    vehicle.engine_torque = mass;
    vehicles_.push_back(world_.add(vehicle));
    for (int i = 0; i < 4; ++i) {
      Wheel<S> wheel;
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

TYPED_TEST(Allocation, VehiclesAndCharactersMoveWithoutAny) {
  using S = TypeParam;
  World<S> world(this->settings());
  Movers<S> movers(world);
  for (int frame = 0; frame < 240; ++frame) movers.play(frame);
  std::uint32_t rolling = 0, walking = 0;
  const ForceRecords<S>& records = *world.state().force_records;
  for (const Wheel<S>& wheel : records.wheels.all()) rolling += wheel.contact_body && wheel.spin != S(0) ? 1u : 0u;
  for (const CharacterId id : movers.walkers()) walking += world.find(id)->footing == Footing::floor ? 1u : 0u;
  EXPECT_GT(rolling, 8u);
  EXPECT_GT(walking, 3u);
  const Count count;
  for (int frame = 240; frame < 360; ++frame) movers.play(frame);
  EXPECT_EQ(count.so_far(), 0u);
}

TYPED_TEST(Allocation, BeltsAndReportsOfHitsNeedNone) {
  using S = TypeParam;
  for (std::uint32_t name = 0; name < kSolvers; ++name) {
    World<S> world(test::solver_settings<S>(static_cast<SolverName>(name)));
    const ShapeId crate = test::add_box(world, 0.25, 0.25, 0.25);
    for (int i = 0; i < 4; ++i) {
      const BodyId table = world.create(test::still<S>(test::add_box(world, 8, 0.25, 1), {0, -0.25, 4.0 * i}));
      EXPECT_TRUE(world.add(SurfaceVelocity<S>{table, {S(0.25), S(0), S(0)}, {S(0), S(0.03125) * S(i), S(0)}}));
      EXPECT_TRUE(world.add(OneWay<S>{table}));
      EXPECT_TRUE(world.add(HitReport<S>{table, S(0)}));
      for (int k = 0; k < 5; ++k) world.create(test::moving<S>(crate, {1.0 * k - 3, 0.25, 4.0 * i}));
    }
    for (int frame = 0; frame < 120; ++frame) world.step();
    EXPECT_EQ(world.counts().contacts, 20u);
    const Count count;
    for (int frame = 0; frame < 60; ++frame) world.step();
    EXPECT_EQ(count.so_far(), 0u) << kSolverNames[name];
  }
}

TYPED_TEST(Allocation, BeltsOfPartsAndMountedSensorsNeedNone) {
  using S = TypeParam;
  World<S> world(test::settings<S>());
  const ShapeId planks = test::add_two_boxes(world, {8, 0.25, 1}, {0, -0.25, 0}, {8, 0.25, 1}, {0, -0.25, 4});
  const BodyId body = world.create(test::still<S>(planks));
  EXPECT_TRUE(world.add(SurfaceVelocity<S>{body, {S(0.25), S(0), S(0)}, Vec3<S>::zero(), 0}));
  EXPECT_TRUE(world.add(SurfaceVelocity<S>{body, {S(-0.25), S(0), S(0)}, Vec3<S>::zero(), 1}));
  BodyDefinition<S> sensor = test::still<S>(test::add_ball(world, 1));
  sensor.type = BodyType::kinematic;
  sensor.sensor = true;
  for (int i = 0; i < 8; ++i) {
    SensorMount<S> mount;
    const ShapeId crate = test::add_box(world, 0.25, 0.25, 0.25);
    mount.on = world.create(test::moving<S>(crate, {i / 2 - 2.0, 0.25, 4.0 * (i % 2)}));
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

TYPED_TEST(Allocation, GhostsThatComeAndGoNeedNone) {
  using S = TypeParam;
  World<S> world(test::settings<S>(0));
  const BodyId platform = world.create(test::still<S>(test::add_box(world, 2, 0.125, 2)));
  const BodyId ball = world.create(test::moving<S>(test::add_ball(world, 0.25), {0, -1, 0}, {0, 4, 0}));
  EXPECT_TRUE(world.add(OneWay<S>{platform}));
  std::size_t ghosts = 0;
  const auto pass = [&] {
    world.set_pose(ball, {{S(0), S(-1), S(0)}, Quat<Unit<S>>::identity()});
    for (int frame = 0; frame < 60; ++frame) {
      world.step();
      for (const Ghost<S>& ghost : world.state().force_records->ghosts.all()) ghosts += ghost.a ? 1u : 0u;
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

TYPED_TEST(Allocation, AWarmSnapshotIsSavedLoadedAndHashedWithoutAny) {
  typename World<TypeParam>::Snapshot frame;
  this->world_.save(frame);
  this->world_.step();
  this->world_.load(frame);
  const Count count;
  for (int round = 0; round < 10; ++round) {
    this->world_.save(frame);
    const std::uint64_t before = this->world_.hash();
    this->world_.step();
    this->world_.load(frame);
    EXPECT_EQ(this->world_.hash(), before);
  }
  EXPECT_EQ(count.so_far(), 0u);
}

TYPED_TEST(Allocation, CommandsThatChangeNoCountNeedNone) {
  const BodyId body = this->bodies_[7];
  this->world_.apply_impulse(body, {TypeParam(0), TypeParam(1), TypeParam(0)});
  this->world_.apply_force(body, {TypeParam(0), TypeParam(1), TypeParam(0)});
  for (int frame = 0; frame < 60; ++frame) this->world_.step();
  const Count count;
  this->world_.apply_impulse(body, {TypeParam(0), TypeParam(0.125), TypeParam(0)});
  this->world_.apply_force(body, {TypeParam(0), TypeParam(0.125), TypeParam(0)});
  this->world_.set_velocity(body, Vec3<TypeParam>::zero(), Vec3<TypeParam>::zero());
  this->world_.set_user_data(body, 9);
  this->world_.step();
  EXPECT_EQ(count.so_far(), 0u);
}

TYPED_TEST(Allocation, AWarmSessionIsKeptAndRecordedWithoutAny) {
  FrameHistory<TypeParam> history(this->world_, {.frames = 8, .states = true, .stages = true});
  std::size_t written = 0;
  const auto count_bytes = [](void* context, const std::uint8_t*, std::size_t size) {
    *static_cast<std::size_t*>(context) += size;
    return true;
  };
  SessionRecorder<TypeParam> recorder(history, {count_bytes, &written}, "pile");
  const auto play = [&](Frame first, Frame end) {
    for (Frame frame = first; frame < end; ++frame) {
      history.before_step(frame);
      recorder.before_step(frame);
      this->world_.set_user_data(this->bodies_[3], static_cast<std::uint64_t>(frame));
      this->world_.step();
      history.after_step(frame);
      history.confirmed(frame, 0);
      recorder.confirmed(frame, 0);
    }
  };
  play(0, 70);
  const std::size_t before = written;
  const Count count;
  play(70, 190);
  EXPECT_EQ(count.so_far(), 0u);
  EXPECT_GT(written, before);
  EXPECT_EQ(recorder.frames(), 190);
}

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
TYPED_TEST_SUITE(ParticleAllocation, Scalars);

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

/// Four hundred boxes that move, go and come, with all that is asked of a structure after each frame.
template <class S, class Structure> class CoarseFrames {
 public:
  explicit CoarseFrames(std::uint32_t seed) : random_(Pcg32::seeded(seed)) {}

  /// From the same random numbers each time.
  std::size_t run() {
    Pcg32 random = random_;
    structure_.clear();
    pairs_.clear();
    std::size_t found = 0;
    for (int frame = 0; frame < 20; ++frame) {
      for (std::uint32_t slot = 0; slot < 400; ++slot) move(random, slot);
      if (frame % 2 == 0) structure_.optimise();
      pairs_.update(structure_, Any{});
      all_pairs(structure_, all_);
      found += all_.keys.size();
    }
    return found;
  }

 private:
  struct Any {
    bool operator()(std::uint32_t, std::uint32_t) const { return true; }
  };
  void move(Pcg32& random, std::uint32_t slot) {
    const std::uint32_t what = random_below(random, 8);
    if (what > 4) return;
    pairs_.mark_moved(slot);
    if (what == 4 && structure_.contains(slot)) return structure_.remove(slot);
    const S x = S(random_between(random, -50, 50)) * S(0.25);
    const S y = S(random_between(random, -50, 50)) * S(0.25);
    const S z = S(random_between(random, -50, 50)) * S(0.25);
    const S side = slot % 100 == 0 ? S(10) : S(1);
    const Aabb<S> box = {{x, y, z}, {x + side, y + side, z + side}};
    if (structure_.contains(slot)) structure_.update(slot, box);
    else structure_.insert(slot, box);
  }

  Pcg32 random_;
  Structure structure_;
  PairSet<S> pairs_;
  AllPairs<S> all_;
};
template <class S, class Structure> void hold_warm_frames(const char* name) {
  CoarseFrames<S, Structure> frames(3);
  const std::size_t found = frames.run();
  EXPECT_GT(found, 1000u) << name;
  frames.run();  // what a structure builds in a cleared memory may need a little more than in a fresh one
  Count count;
  EXPECT_EQ(frames.run(), found) << name;
  EXPECT_EQ(count.so_far(), 0u) << name;
}
TYPED_TEST(Allocation, AWarmCoarseStructureAsksForNoMemory) {
#define ISO_HOLD(name, Structure) hold_warm_frames<TypeParam, Structure<TypeParam>>(#name);
  ISO_FOR_EACH_BROAD_PHASE(ISO_HOLD)
#undef ISO_HOLD
}

template <class S> void run_an_articulation() {
  ArticulationDefinition<S> definition;
  ArticulationLink<S> link;
  link.type = ArticulationJoint::free;
  link.mass.inertia = {S(1), S(1), S(1)};
  definition.links.push_back(link);
  for (const ArticulationJoint type : {ArticulationJoint::ball, ArticulationJoint::hinge, ArticulationJoint::slider}) {
    link.type = type;
    link.parent = static_cast<std::uint32_t>(definition.links.size() - 1);
    link.frame_a.position = {S(0), S(-1), S(0)};
    link.limited = true;
    link.lower = type == ArticulationJoint::ball ? S(0) : S(-0.5);
    link.upper = S(0.5);
    link.drive.damping = link.drive.max_force = S(100);
    link.drive.speed = {S(5), S(5), S(5)};
    definition.links.push_back(link);
  }
  Articulation<S> tree;
  ASSERT_TRUE(tree.build(definition).ok());
  Snapshot<Articulation<S>> kept;
  tree.step();
  tree.save(kept);
  const Count count;
  std::uint64_t hash = 0;
  for (int i = 0; i < 60; ++i) {
    tree.apply_force(2, {S(10), S(0), S(0)}, tree.link_centre(2));
    tree.step();
    if (i == 30) tree.load(kept);
    tree.save(kept);
    hash ^= tree.hash();
  }
  EXPECT_EQ(count.so_far(), 0u);
  EXPECT_NE(hash, 0u);
}
TEST(ArticulationAllocation, ABuiltTreeAsksForNoMemory) {
  run_an_articulation<float>();
  run_an_articulation<double>();
  run_an_articulation<Q32_32>();
}

}  // namespace
}  // namespace isostep
