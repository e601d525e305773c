// NarrowPhase alone: contacts from pairs, what they inherit, and sensors.
// SPDX-License-Identifier: MIT

#include "isostep/systems/contacts/narrow_phase.hpp"

#include "isostep/state/hash.hpp"
#include "unit/world/systems.hpp"

namespace isostep::test {
namespace narrow_phase_test {

template <class S> struct Phase {
  explicit Phase(const World<S>& world) : systems(world) {
    tools.use_simd(Simd::scalar);
    systems.find_pairs();
  }
  std::uint32_t update() { return phase.update(systems.proxies.pairs(), tools); }

  Systems<S> systems;
  StepTools<S> tools = {};
  NarrowPhase<S> phase{systems.state, systems.map};
};

/// A grid of balls that touch their neighbours, on the ground; in the midst of it, and of the slots, a sensor.
template <class S> void add_grid(World<S>& world, int side) {
  add_ground(world);
  const ShapeId ball = add_ball(world, 0.5);
  for (int i = 0; i < side * side; ++i) {
    world.create(moving<S>(ball, {0.9375 * (i % side), 0.5, 0.9375 * static_cast<double>(i / side)}));
    if (i != side * side / 2) continue;
    BodyDefinition<S> sensor = still<S>(add_box(world, 3, 3, 3), {0.46875 * side, 0, 0.46875 * side});
    sensor.sensor = true;
    world.create(sensor);
  }
}

template <class S> class NarrowPhases : public ::testing::Test {};
TYPED_TEST_SUITE(NarrowPhases, SystemScalars);

TYPED_TEST(NarrowPhases, a_box_on_the_ground_has_one_contact_of_four_points) {
  using S = TypeParam;
  World<S> w(settings<S>());
  add_ground(w);
  w.create(moving<S>(add_box(w, 0.5, 0.5, 0.5), {0, 0.5, 0}));
  Phase<S> of(w);
  EXPECT_EQ(of.update(), 0u);
  ASSERT_EQ(of.systems.state.contacts.size(), 1u);
  EXPECT_EQ(of.systems.state.contacts[0].count, 4u);
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
  Contact<S>& contact = of.systems.state.contacts[0];
  contact.normal_impulse[2] = Velocity<S>(3);
  contact.flags = contact_flag::kTouching;
  of.update();
  ASSERT_EQ(of.systems.state.contacts.size(), 1u);
  EXPECT_EQ(of.systems.state.contacts[0].normal_impulse[2], Velocity<S>(3));
  EXPECT_EQ(of.systems.state.contacts[0].flags & contact_flag::kTouching, contact_flag::kTouching);
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
  EXPECT_TRUE(of.systems.state.contacts.empty());
  ASSERT_EQ(of.phase.overlaps().size(), 1u);
  EXPECT_EQ(of.phase.overlaps()[0], (SensorOverlap{sensor.slot, body.slot, 0, 0}));
}

/// Runs the task as often as it may, on the calling thread.
void run_here(void*, std::int32_t copies, TaskRunner::Task task, void* data) {
  for (std::int32_t i = 0; i < copies; ++i) task(data);
}

template <class S> void expect_same(const ContactGeometry<S>& x, const ContactGeometry<S>& y, std::uint32_t points) {
  EXPECT_EQ(x.row_a, y.row_a);
  EXPECT_EQ(x.row_b, y.row_b);
  EXPECT_EQ(x.normal, y.normal);
  EXPECT_EQ(x.material.friction, y.material.friction);
  for (std::uint32_t p = 0; p < points; ++p) {
    EXPECT_EQ(x.points[p].arm_a, y.points[p].arm_a);
    EXPECT_EQ(x.points[p].arm_b, y.points[p].arm_b);
    EXPECT_EQ(x.points[p].separation, y.points[p].separation);
  }
}
template <class S> void expect_same(const Phase<S>& x, const Phase<S>& y) {
  const std::vector<Contact<S>>&of_x = x.systems.state.contacts, &of_y = y.systems.state.contacts;
  ASSERT_EQ(of_x.size(), of_y.size());
  for (std::size_t i = 0; i < of_x.size(); ++i) {
    EXPECT_EQ(hash_records(&of_x[i], 1), hash_records(&of_y[i], 1)) << "contact " << i;
    expect_same(x.phase.geometry()[i], y.phase.geometry()[i], of_x[i].count);
  }
}

/// Between two updates contacts get impulses that tell their bodies, and every eighth ball leaves: no contact has the
/// place that it had.
TYPED_TEST(NarrowPhases, shared_among_threads_it_finds_the_same) {
  using S = TypeParam;
  using V = Velocity<S>;
  World<S> w(settings<S>());
  add_grid(w, 24);
  Phase<S> alone(w), shared(w);
  shared.tools.runner = {run_here, nullptr, 4};
  ASSERT_GE(alone.systems.proxies.pairs().size(), 1024u) << "enough to be shared";
  const auto impulse_of = [](const ContactKey& key) { return V(static_cast<int>(1 + (key.body_a + key.body_b) % 61)); };
  for (Phase<S>* of : {&alone, &shared}) of->update();
  expect_same(alone, shared);
  for (Phase<S>* of : {&alone, &shared}) {
    for (Contact<S>& contact : of->systems.state.contacts) {
      contact.normal_impulse[0] = impulse_of(contact.key);
      contact.friction_impulse = {-impulse_of(contact.key), V(2), V(3)};
      contact.twist_impulse = V(4);
      contact.flags = contact.key.body_b % 3 == 0 ? contact_flag::kTouching : 0u;
    }
    for (std::size_t i = 0; i < of->systems.state.awake.states.size(); i += 8)
      of->systems.state.awake.states[i].centre.y = S(9);
    of->update();
  }
  expect_same(alone, shared);
  EXPECT_LT(shared.systems.state.contacts.size(), shared.phase.old_contacts().size());
  for (const Contact<S>& contact : shared.systems.state.contacts) {
    EXPECT_EQ(contact.normal_impulse[0], impulse_of(contact.key));
    EXPECT_EQ(contact.friction_impulse.x, -impulse_of(contact.key));
    EXPECT_EQ(contact.flags & contact_flag::kTouching, contact.key.body_b % 3 == 0 ? contact_flag::kTouching : 0u);
  }
  EXPECT_GT(shared.phase.overlaps().size(), 30u);
  EXPECT_EQ(shared.phase.overlaps(), alone.phase.overlaps());
}

}  // namespace narrow_phase_test
}  // namespace isostep::test
