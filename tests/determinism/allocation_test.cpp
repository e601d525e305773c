// A warm world steps, saves, loads and hashes without asking for memory.
// SPDX-License-Identifier: MIT

#include "built.hpp"
#include "determinism/allocation_count.hpp"
#include "determinism/solver_scene.hpp"
#include "isostep/replay/session_recorder.hpp"
#include "isostep/store/state.hpp"

namespace isostep::test {
namespace allocation_test {

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
TYPED_TEST_SUITE(Allocation, AllocationScalars);

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
    if (left_out(SolverName{name}) != nullptr) continue;
    World<S> world(solver_settings<S>(static_cast<SolverName>(name)));
    const SolverScene<S> scene(world);
    for (std::uint64_t frame = 0; frame < 300; ++frame) scene.play(world, frame);
    EXPECT_GT(world.counts().contacts, 9u);
    EXPECT_EQ(world.counts().joints, 6u);
    const Count count;
    for (std::uint64_t frame = 300; frame < 330; ++frame) scene.play(world, frame);
    EXPECT_EQ(count.so_far(), 0u) << kSolverNames[name];
  }
}

TYPED_TEST(Allocation, AWarmSceneStepsWithoutAnyHoweverItsOverlapsEnd) {
  using S = TypeParam;
  ISO_NEEDS_BOOK();
  for (std::uint32_t projection = 0; projection < kProjections; ++projection) {
    Settings<S> settings = solver_settings<S>(SolverName::worst_first);
    settings.projection = static_cast<Projection>(projection);
    World<S> world(settings);
    const SolverScene<S> scene(world);
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
  for (int frame = 0; frame < 120; ++frame) this->world_.step();  // until grains have turned what they turn
  const Count count;
  for (int frame = 0; frame < 60; ++frame) this->world_.step();
  EXPECT_EQ(count.so_far(), 0u);
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
  play(0, 190);
  const std::size_t before = written;
  const Count count;
  play(190, 310);
  EXPECT_EQ(count.so_far(), 0u);
  EXPECT_GT(written, before);
  EXPECT_EQ(recorder.frames(), 310);
}

}  // namespace allocation_test
}  // namespace isostep::test
