// SensorMount: a sensor that goes with a body, as a shape of it would.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/fields.hpp"
#include "isostep/core/id.hpp"
#include "isostep/dynamics/records/record_rules.hpp"
#include "isostep/math/transform.hpp"

namespace isostep {

using SensorMountId = Id<struct SensorMountTag>;

/// Mounts a sensor on a carrier: at `on`'s pose times the frame, as a step begins and ends. So a body gets a sensor
/// with a filter and an id of its own in SensorEvents, without mass and contacts. The carrier keeps every bit of its
/// motion. During the step the sensor has the carrier's velocity at its place, between steps it stands still. Other
/// motion of the sensor - a pose or velocity that is set, a move, a character - has no effect.
/// Seen:    as for any sensor, what is there as the step begins: if a carrier is put elsewhere, its sensor sees that
///          place in the next step. Never the carrier itself. While that is disabled the sensor sees nothing.
/// Sleep:   a sensor is always awake, so it sees on while its carrier sleeps, and wakes nobody.
/// Rules:   the sensor is a kinematic body with BodyDefinition::sensor; one record a sensor; a carrier is not mounted
///          itself. The record ends with either body; then the sensor stays where it is. While the sensor is disabled
///          the record waits. At the edge of the world its centre is held within Limits::position().
template <class S> struct SensorMount {
  BodyId sensor = {};
  BodyId on = {};                       // the carrier: of any type
  Pose<S> frame = Pose<S>::identity();  // of the sensor's origin in the carrier's frame

  ISO_FIELDS(sensor, on, frame)
};

}  // namespace isostep

namespace isostep::detail {

template <class S> struct RecordRules<SensorMount<S>> : RecordDefaults<S> {
  static constexpr bool kSeesOthers = true;
  static constexpr Acts kActs = Acts::not_here;
  static constexpr Wakes kWakes = Wakes::none;
  static FaultReport fault(const SensorMount<S>& m) {
    return Checklist()
        .proper(!(m.sensor == m.on), "on", "another body than sensor")
        .finite(m.frame.position, "frame.position")
        .in_range(within(m.frame.position, Limits<S>::extent()), "frame.position", "components up to Limits::extent()")
        .proper(is_unit<S>(m.frame.orientation), "frame.orientation", kUnitLength)
        .report();
  }
  static constexpr NamedBodies<S> bodies(const SensorMount<S>& m) {
    return {{{m.sensor, "sensor", false, MustBe::kinematic, Vec3<S>::zero(), ""},
             {m.on, "on", false, MustBe::any, Vec3<S>::zero(), ""}},
            2};
  }
  static constexpr OnlyOne only_one(const SensorMount<S>&) { return {"sensor", "a sensor that has no record yet"}; }
  static RecordKey key(const SensorMount<S>& m) { return {m.sensor.slot}; }
  /// A body cannot be both mounted and a carrier.
  static constexpr const char* kNoCarrier[] = {"a sensor that carries none", "a body that is not mounted itself"};
  static FaultReport fault_at(const SensorMount<S>&, const RecordPlace<S>& place) {
    return Checklist()
        .proper((place.bodies[0]->flags & body_flag::kSensor) != 0, "sensor", "a body that is a sensor")
        .report();
  }
};

}  // namespace isostep::detail
