// What a step tells the game: output of one step, in canonical order, never state. What a command takes away ends
// without an event; what it wakes is told by the next step.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/core/id.hpp"
#include "isostep/math/vec3.hpp"

namespace isostep {

/// Two bodies began to press on each other.
template <class S> struct ContactBegin {
  BodyId a, b;
  S impulse;  // [kg m/s] that all points together gave over the step along their normals; held at the format's end
  Vec3<Unit<S>> normal;  // [1] from a to b, of the first parts in contact
};
struct ContactEnd {
  BodyId a, b;
};
struct SensorEvent {
  BodyId sensor, other;
};

template <class S> struct Events {
  std::vector<ContactBegin<S>> contact_begin;
  std::vector<ContactEnd> contact_end;
  std::vector<SensorEvent> sensor_begin, sensor_end;
  std::vector<BodyId> fell_asleep, woke;

  /// All but what woke: commands wake too, before the step that tells.
  ISO_INLINE void clear_step() {
    contact_begin.clear();
    contact_end.clear();
    sensor_begin.clear();
    sensor_end.clear();
    fell_asleep.clear();
  }
  ISO_INLINE void clear() {
    clear_step();
    woke.clear();
  }
};

/// Why something was refused, or what a step had to mend. Identical on every peer.
enum class Fault : std::uint32_t {
  none,
  stale_id,      // the id names nothing any more
  not_finite,    // NaN or infinity where a number is expected
  out_of_range,  // beyond Limits<S>
  bad_shape,     // sizes, normals or parts that make no shape
  bad_mass,      // mass or inertia that no body can have
  bad_argument,  // a flag, count or enumerator that is not one
  shape_in_use,  // bodies still name the shape
  not_dynamic,   // forces on a body that no force moves
};
const char* fault_text(Fault fault);

struct StepReport {
  std::uint32_t clamped_speed = 0;     // bodies whose speed was cut to Limits<S>
  std::uint32_t clamped_position = 0;  // bodies held at the edge of the world
  std::uint32_t stopped = 0;           // bodies put back and stopped because a number was not finite
  ISO_INLINE constexpr bool clean() const { return clamped_speed == 0 && clamped_position == 0 && stopped == 0; }
};

}  // namespace isostep
