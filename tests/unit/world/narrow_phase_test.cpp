// NarrowPhase alone: contacts from pairs, what they inherit, and sensors.
// SPDX-License-Identifier: MIT

#include "isostep/world/narrow_phase.hpp"

#include "unit/world/rooms.hpp"

namespace isostep::test {
namespace {

template <class S> struct Phase {
  explicit Phase(const World<S>& world) : rooms(world) {
    tools.use_simd(Simd::scalar);
    rooms.find_pairs();
  }
  std::uint32_t update() { return phase.update(rooms.proxies.pairs(), tools); }

  Rooms<S> rooms;
  StepTools<S> tools = {};
  NarrowPhase<S> phase{rooms.state, rooms.map};
};

/// A grid of balls that touch their neighbours, on the ground.
template <class S> void add_grid(World<S>& world, int side) {
  add_ground(world);
  const ShapeId ball = add_ball(world, 0.5);
  for (int i = 0; i < side * side; ++i)
    world.create(moving<S>(ball, {0.9375 * (i % side), 0.5, 0.9375 * static_cast<double>(i / side)}));
}

template <class S> class NarrowPhases : public ::testing::Test {};
TYPED_TEST_SUITE(NarrowPhases, RoomScalars);

TYPED_TEST(NarrowPhases, a_box_on_the_ground_has_one_contact_of_four_points) {
  using S = TypeParam;
  World<S> w(settings<S>());
  add_ground(w);
  w.create(moving<S>(add_box(w, 0.5, 0.5, 0.5), {0, 0.5, 0}));
  Phase<S> of(w);
  EXPECT_EQ(of.update(), 0u);
  ASSERT_EQ(of.rooms.state.contacts.size(), 1u);
  EXPECT_EQ(of.rooms.state.contacts[0].count, 4u);
  ASSERT_EQ(of.phase.geometry().size(), 1u);
  EXPECT_EQ(of.phase.geometry()[0].row_a, 0u) << "the ground does not move";
  EXPECT_EQ(of.phase.geometry()[0].row_b, 1u);
  EXPECT_TRUE(of.phase.old_contacts().empty());
}

TYPED_TEST(NarrowPhases, a_contact_that_continues_keeps_its_impulses_and_flags) {
  using S = TypeParam;
  World<S> w(settings<S>());
  add_ground(w);
  w.create(moving<S>(add_box(w, 0.5, 0.5, 0.5), {0, 0.5, 0}));
  Phase<S> of(w);
  of.update();
  Contact<S>& contact = of.rooms.state.contacts[0];
  contact.normal_impulse[2] = Velocity<S>(3);
  contact.flags = contact_flag::kTouching;
  of.update();
  ASSERT_EQ(of.rooms.state.contacts.size(), 1u);
  EXPECT_EQ(of.rooms.state.contacts[0].normal_impulse[2], Velocity<S>(3));
  EXPECT_EQ(of.rooms.state.contacts[0].flags, contact_flag::kTouching);
}

TYPED_TEST(NarrowPhases, a_sensor_overlaps_and_has_no_contact) {
  using S = TypeParam;
  World<S> w(settings<S>());
  const ShapeId ball = add_ball(w, 0.5);
  const BodyId body = w.create(moving<S>(ball, {0.25, 0, 0}));
  BodyDefinition<S> d = still<S>(ball);
  d.sensor = true;
  const BodyId sensor = w.create(d);
  Phase<S> of(w);
  of.update();
  EXPECT_TRUE(of.rooms.state.contacts.empty());
  ASSERT_EQ(of.phase.overlaps().size(), 1u);
  EXPECT_EQ(of.phase.overlaps()[0], (SensorOverlap{sensor.slot, body.slot}));
}

/// Runs the task as often as it may, on the calling thread.
void run_here(void*, std::int32_t copies, TaskRunner::Task task, void* data) {
  for (std::int32_t i = 0; i < copies; ++i) task(data);
}

TYPED_TEST(NarrowPhases, shared_among_threads_it_finds_the_same) {
  using S = TypeParam;
  World<S> w(settings<S>());
  add_grid(w, 24);
  Phase<S> alone(w), shared(w);
  shared.tools.runner = {run_here, nullptr, 4};
  ASSERT_GE(alone.rooms.proxies.pairs().size(), 1024u) << "enough to be shared";
  for (Phase<S>* of : {&alone, &shared}) of->update();
  ASSERT_EQ(alone.rooms.state.contacts.size(), shared.rooms.state.contacts.size());
  for (std::size_t i = 0; i < alone.rooms.state.contacts.size(); ++i) {
    EXPECT_EQ(alone.rooms.state.contacts[i].key, shared.rooms.state.contacts[i].key);
    EXPECT_EQ(alone.phase.geometry()[i].points[0].separation, shared.phase.geometry()[i].points[0].separation);
  }
}

}  // namespace
}  // namespace isostep::test
