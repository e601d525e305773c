// SensorMounts<S>: puts mounted sensors where their carriers are.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/instantiate.hpp"
#include "isostep/dynamics/records/sensor_mount.hpp"
#include "isostep/store/body_map.hpp"
#include "isostep/store/proxies.hpp"

namespace isostep {

/// Input:   the state as a step begins, and as it ends; its SensorMount records.
/// Output:  poses of the sensors that are enabled, their fat boxes and their proxies; velocities of these sensors
///          within the step, which are zero at its end.
/// Order:   any, since no carrier is itself carried.
/// Keeps:   nothing.
template <class S> class SensorMounts {
 public:
  ISO_INLINE SensorMounts(WorldState<S>& state, const BodyMap<S>& map, Proxies<S>& proxies)
      : state_(state), map_(map), proxies_(proxies) {}

  void begin_step();
  void end_step();

 private:
  template <class Visit> void for_each(const Visit& visit);
  void put(BodyState<S>& sensor, const BodyProperties<S>& body, const SensorMount<S>& mount);
  void give_velocity(BodyState<S>& sensor, const SensorMount<S>& mount) const;

  WorldState<S>& state_;
  const BodyMap<S>& map_;
  Proxies<S>& proxies_;
};

#define ISO_SENSOR_MOUNTS_OF(extern, S) extern template class SensorMounts<S>;
ISO_EXTERN_FOR_EACH_SCALAR(ISO_SENSOR_MOUNTS_OF)

}  // namespace isostep
