// Bodies of sensor_mounts.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/checks.hpp"
#include "isostep/dynamics/force_bounds.hpp"
#include "isostep/dynamics/solvers/step_context.hpp"
#include "isostep/math/shortened.hpp"
#include "isostep/store/fat_box.hpp"
#include "isostep/systems/motion/sensor_mounts.hpp"

namespace isostep {

template <class S> void SensorMounts<S>::begin_step() {
  for_each([&](BodyState<S>& sensor, const BodyProperties<S>& body, const SensorMount<S>& mount) {
    put(sensor, body, mount);
    give_velocity(sensor, mount);
  });
}

template <class S> void SensorMounts<S>::end_step() {
  for_each([&](BodyState<S>& sensor, const BodyProperties<S>& body, const SensorMount<S>& mount) {
    put(sensor, body, mount);
    sensor.velocity = Vec3<Velocity<S>>::zero();
    sensor.angular_velocity = Vec3<Velocity<S>>::zero();
  });
}

/// Calls visit(state, properties, record) for enabled sensors. They are kinematic, so they never sleep.
template <class S> template <class Visit> void SensorMounts<S>::for_each(const Visit& visit) {
  for (const SensorMount<S>& mount : state_.records->sensor_mounts.all()) {
    if (!mount.sensor) continue;
    const Location at = map_.location(mount.sensor.slot);
    if (at.set == Location::kAwake) visit(state_.awake.states[at.index], state_.awake.properties[at.index], mount);
  }
}

template <class S>
void SensorMounts<S>::put(BodyState<S>& sensor, const BodyProperties<S>& body, const SensorMount<S>& mount) {
  const Pose<S> origin = compose(map_.origin_pose_at(mount.on.slot), mount.frame);
  const Pose<S> to = centre_pose(origin, body.local_centre);
  const Vec3<S> centre = held_within(to.position, Limits<S>::position());
  if (sensor.centre == centre && sensor.orientation == to.orientation) return;
  sensor.centre = centre;
  sensor.orientation = to.orientation;
  detail::renew_fat_box(map_, sensor, body, false);
  proxies_.place(sensor, body, true);
}

/// Gives the sensor its carrier's velocity at the sensor's centre, within the limits. Zero if the carrier is not awake.
template <class S> void SensorMounts<S>::give_velocity(BodyState<S>& sensor, const SensorMount<S>& mount) const {
  using V = Velocity<S>;
  const Settings<S>& s = state_.settings;
  const Location at = map_.location(mount.on.slot);
  sensor.velocity = sensor.angular_velocity = Vec3<V>::zero();
  if (at.set != Location::kAwake) return;
  const BodyState<S>& carrier = state_.awake.states[at.index];
  const S speed = Limits<S>::speed();
  const Vec3<S> arm = sensor.centre - carrier.centre;
  const Vec3<S> turned = held_within(detail::saturated_cross(convert<S>(carrier.angular_velocity), arm), speed);
  const Vec3<S> velocity = held_within(held_within(convert<S>(carrier.velocity), speed) + turned, speed);
  const V fastest = min(convert<V>(detail::most_angular_speed(sensor.fat)),
                        angular_speed_limit<S>(integration_rate(s.solver, s.hz, s.substeps)));
  sensor.velocity = detail::shortened(convert<V>(velocity), convert<V>(speed));
  sensor.angular_velocity = detail::shortened(carrier.angular_velocity, fastest);
}

}  // namespace isostep
