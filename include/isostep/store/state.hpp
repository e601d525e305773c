// Everything that shapes a world's future, in flat arrays: what is saved, hashed, written and compared.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "isostep/collision/broadphase/child_tree.hpp"
#include "isostep/core/fields.hpp"
#include "isostep/core/paged_array.hpp"
#include "isostep/core/shared.hpp"
#include "isostep/core/slot_map.hpp"
#include "isostep/dynamics/contact.hpp"
#include "isostep/dynamics/joints/joint_record.hpp"
#include "isostep/dynamics/records/record_store.hpp"
#include "isostep/dynamics/settings.hpp"
#include "isostep/geometry/geometry_store.hpp"
#include "isostep/geometry/shape.hpp"
#include "isostep/store/body_set.hpp"
#include "isostep/store/events.hpp"

namespace isostep {

/// A shape, never changed once made: worlds and snapshots share it. The shape of a free slot has no children.
template <class S> struct StoredShape {
  std::vector<Child<S>> children;
  std::uint64_t hash = 0;  // of them
  // It is no state of its own: it follows from the children and the content that they name.
  std::shared_ptr<const ChildTree<S>> tree;  // null: the shape has few children
  S thinnest = S(0);                         // [m] of the thickness() of each child that is no sensor
  ShapeTraits traits;                        // of all children

  static constexpr std::size_t kLeastWritten = 4;  // [bytes] one count

  template <class Visitor, class Self> static ISO_INLINE void sections(Visitor&& visit, Self&& self) {
    visit("children", self.children);
  }
};
/// Shapes by slot, shared a page at a time.
template <class S> using StoredShapes = PagedArray<std::shared_ptr<const StoredShape<S>>, 64>;
/// Joints side by side, ascending by slot.
template <class S> struct JointSet {
  std::vector<JointState<S>> states;
  std::vector<JointProperties<S>> properties;
};

/// A force or torque that was asked for since the last step, as acceleration. Ascending by slot, one per body.
template <class S> struct PendingForce {
  std::uint32_t slot;
  std::uint32_t cut;  // 1: more was asked for than bodies can take, an impulse included; the step reports it
  Vec3<S> linear;     // [m/s^2]
  Vec3<S> angular;    // [rad/s^2]

  ISO_FIELDS(slot, cut, linear, angular)
};
static_assert(kHasNoPadding<PendingForce<float>> && kHasNoPadding<PendingForce<double>>);

/// The pose to which the next step carries a kinematic body, by move_to. Ascending by slot, one per body.
template <class S> struct PendingMove {
  std::uint32_t slot;
  std::uint32_t reserved;  // 0: keeps records of 8-byte scalars without padding
  Pose<S> pose;            // of the body's origin, world

  ISO_FIELDS(slot, reserved, pose)
};
static_assert(kHasNoPadding<PendingMove<float>> && kHasNoPadding<PendingMove<double>>);

/// A part of a body inside a part of a sensor. Ascending by (sensor, other, sensor_child, other_child).
struct SensorOverlap {
  std::uint32_t sensor, other;              // slots
  std::uint32_t sensor_child, other_child;  // parts of their shapes

  ISO_INLINE constexpr std::uint64_t bodies() const { return std::uint64_t{sensor} << 32 | other; }
  ISO_INLINE constexpr std::uint64_t parts() const { return std::uint64_t{sensor_child} << 32 | other_child; }
  friend ISO_INLINE constexpr bool operator==(SensorOverlap a, SensorOverlap b) {
    return a.bodies() == b.bodies() && a.parts() == b.parts();
  }
  friend ISO_INLINE constexpr bool operator<(SensorOverlap a, SensorOverlap b) {
    return a.bodies() != b.bodies() ? a.bodies() < b.bodies() : a.parts() < b.parts();
  }
  ISO_FIELDS(sensor, other, sensor_child, other_child)
};

/// Bodies that sleep together, with their contacts and joints. Never changed once made: worlds and snapshots share it.
/// Its cost for a step, a save and a hash does not depend on its size.
template <class S> struct SleepingIsland {
  BodySet<S> bodies;
  std::vector<Contact<S>> contacts;
  JointSet<S> joints;
  std::uint64_t hash = 0;  // of all the above

  static constexpr std::size_t kLeastWritten = 20;  // [bytes] five counts

  /// Calls visit("name", array) in a fixed order.
  template <class Visitor, class Self> static ISO_INLINE void sections(Visitor&& visit, Self&& self) {
    visit("bodies", self.bodies.states);
    visit("properties", self.bodies.properties);
    visit("contacts", self.contacts);
    visit("joints", self.joints.states);
    visit("joint_properties", self.joints.properties);
  }
};

/// Copies share them a page at a time, for there may be more of them than awake bodies.
template <class S> using SleepingIslands = PagedArray<std::shared_ptr<const SleepingIsland<S>>, 256>;

template <class S> struct WorldState {
  Settings<S> settings;
  std::uint64_t tick = 0;  // steps taken
  SlotMap body_slots, shape_slots, joint_slots;
  // Only commands change these: copies have them in common until one of them does.
  StoredShapes<S> shapes;
  Shared<GeometryStore> geometry;  // what their children name
  StaticBodies<S> static_bodies;
  BodySet<S> awake;
  std::vector<Contact<S>> contacts;  // ascending by key
  JointSet<S> joints;
  std::vector<PendingForce<S>> forces;
  std::vector<PendingMove<S>> moves;
  Shared<RecordStore<S>> records;
  RecordParts<S> parts;  // of the records: inputs and states
  std::vector<SensorOverlap> overlaps;
  UntoldEvents untold;
  SleepingIslands<S> sleeping;

  /// Visits all members in the order of the hash and of the portable form: state/members.hpp.
  template <class Visitor, class Self> static ISO_INLINE void members(Visitor&& visit, Self&& self) {
    visit("settings", self.settings);
    visit("tick", self.tick);
    visit("body_slots", self.body_slots);
    visit("shape_slots", self.shape_slots);
    visit("joint_slots", self.joint_slots);
    visit.islands("shapes", self.shapes);
    visit.bodies_in_pages(self.static_bodies);
    visit("bodies", self.awake.states);
    visit("properties", self.awake.properties);
    visit("contacts", self.contacts);
    visit("joints", self.joints.states);
    visit("joint_properties", self.joints.properties);
    visit("forces", self.forces);
    visit("moves", self.moves);
    visit("overlaps", self.overlaps);
    visit("untold_contact_end", self.untold.contact_end);
    visit("untold_sensor_end", self.untold.sensor_end);
    visit("untold_woke", self.untold.woke);
    visit("untold_sensors", self.untold.sensors);
    visit.islands("sleeping", self.sleeping);
    visit.records(self.records, self.parts);
    visit.store("blobs", self.geometry);
  }
};

namespace detail {
/// Calls visit(wheel's body, its state) for each wheel that stands on something; both bodies exist.
template <class S, class Visit>
ISO_INLINE void for_each_standing_wheel(const WorldState<S>& state, const Visit& visit) {
  const std::vector<WheelSettings<S>>& wheels = state.records->wheels.all();
  for (std::uint32_t slot = 0; slot < wheels.size(); ++slot) {
    const WheelState<S>& wheel = state.parts.wheel_states[slot];
    if (state.body_slots.holds(wheels[slot].body) && state.body_slots.holds(wheel.contact_body))
      visit(wheels[slot].body, wheel);
  }
}
}  // namespace detail

}  // namespace isostep
