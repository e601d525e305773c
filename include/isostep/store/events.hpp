// Events: what a step reports to the game, output of one step, in canonical order, never state. What commands end and
// wake the next step reports; until then it is state (UntoldEvents).
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/core/fault.hpp"
#include "isostep/core/fields.hpp"
#include "isostep/core/id.hpp"
#include "isostep/math/vec3.hpp"

namespace isostep {

/// Two bodies began to press on each other by parts that report: their body has `report_contacts`, or they have
/// part_flag::kReportContacts themselves.
template <class S> struct ContactBegin {
  BodyId a, b;
  std::uint32_t child_a, child_b;  // the first parts of their shapes in contact
  S impulse;  // [kg m/s] that reported contacts gave over the step along their normals; held at the format's end
  Vec3<Unit<S>> normal;  // [1] from a to b, of those parts

  ISO_FIELDS(a, b, child_a, child_b, impulse, normal)
};
struct ContactEnd {
  BodyId a, b;
  std::uint32_t child_a, child_b;  // the first of their parts that were in contact

  ISO_FIELDS(a, b, child_a, child_b)
};
/// A part of a body began or ceased to overlap a part of a sensor.
struct SensorEvent {
  BodyId sensor, other;
  std::uint32_t sensor_child, other_child;  // parts of their shapes

  ISO_FIELDS(sensor, other, sensor_child, other_child)
};

/// A contact broke a body: its Breakable record is marked.
template <class S> struct Broke {
  BodyId body;
  S impulse;  // [kg m/s] that all points of the pair gave over the step along their normals; held at the format's end
  Vec3<S> point;            // [m]
  Vec3<Unit<S>> direction;  // [1] of the blow, into the body

  ISO_FIELDS(body, impulse, point, direction)
};

/// A joint bore more than its JointLoad allows, and is gone.
template <class S> struct JointBroke {
  JointId joint;
  BodyId a, b;  // null: the world
  std::uint64_t user_data;
  S force;   // [N] as JointLoad has them
  S torque;  // [N m]

  ISO_FIELDS(joint, a, b, user_data, force, torque)
};

/// A contact of a body with a HitReport began fast.
template <class S> struct ContactHit {
  BodyId a, b;
  std::uint32_t child_a, child_b;  // parts of their shapes
  Vec3<S> point;                   // [m] where they closed fastest, where b has it as the step ends
  Vec3<Unit<S>> normal;            // [1] from a to b
  S speed;                         // [m/s] of approach along the normal, as the step began

  ISO_FIELDS(a, b, child_a, child_b, point, normal, speed)
};

/// A point of a contact of a body with a ContactReport. One that is only near has a separation and no impulse.
template <class S> struct ContactPoint {
  BodyId a, b;
  std::uint32_t child_a, child_b;        // parts of their shapes
  std::uint32_t triangle_a, triangle_b;  // of a mesh or height field; else 0
  Vec3<S> point;                         // [m] where b has it as the step ends
  Vec3<Unit<S>> normal;                  // [1] from a to b
  S separation;                          // [m] as the step began; negative: overlap
  S impulse;  // [kg m/s] that it gave over the step along the normal; held at the format's end

  ISO_FIELDS(a, b, child_a, child_b, triangle_a, triangle_b, point, normal, separation, impulse)
};

template <class S> struct Events {
  std::vector<ContactBegin<S>> contact_begin;
  std::vector<ContactEnd> contact_end;
  std::vector<SensorEvent> sensor_begin, sensor_end;
  std::vector<Broke<S>> broke;             // ascending by record
  std::vector<JointBroke<S>> joint_broke;  // ascending by record
  std::vector<ContactHit<S>> hits;         // ascending by slots
  std::vector<ContactPoint<S>> contacts;   // ascending by slots, parts, points
  std::vector<BodyId> fell_asleep, woke;

  ISO_INLINE void clear() {
    contact_begin.clear();
    contact_end.clear();
    sensor_begin.clear();
    sensor_end.clear();
    broke.clear();
    joint_broke.clear();
    hits.clear();
    contacts.clear();
    fell_asleep.clear();
    woke.clear();
  }
};

/// Ends and wakings that commands caused since the last step, which the next step reports. They are state, for a game
/// that counts events must count the same after a load. They have ids, since bodies may be gone and slots reused.
struct UntoldEvents {
  std::vector<ContactEnd> contact_end;  // ascending by slots
  std::vector<SensorEvent> sensor_end;  // ascending by slots, then parts
  std::vector<BodyId> woke;             // as they woke, or commands put them to sleep
  std::vector<BodyId> sensors;          // as commands changed them: sensors that lie still, for who sleeps in them
};

/// Counts what a step had to correct. It is identical on every peer.
struct StepReport {
  std::uint32_t clamped_speed = 0;     // bodies whose speed was cut to Limits<S>, or whose turn to a radian a sub-step
  std::uint32_t clamped_force = 0;     // bodies whose forces or impulses were cut: they would leave its range at once
  std::uint32_t clamped_position = 0;  // bodies held at the edge of the world
  std::uint32_t stopped = 0;           // bodies put back and stopped because a number was not finite
  std::uint32_t crowded = 0;           // bodies that did not find all their pairs: beyond Settings::most_pairs
  std::uint32_t cut_compounds = 0;     // pairs of bodies some of whose parts were left out, by the same budget
  std::uint32_t unsolved = 0;          // islands left too early: by `direct`, `admm` or a pass of `worst_first`
  /// Returns true if nothing was lost. What is unsolved is only less exact.
  ISO_INLINE constexpr bool clean() const {
    return clamped_speed == 0 && clamped_force == 0 && clamped_position == 0 && stopped == 0 && crowded == 0 &&
           cut_compounds == 0;
  }
  ISO_FIELDS(clamped_speed, clamped_force, clamped_position, stopped, crowded, cut_compounds, unsolved)
};

}  // namespace isostep
