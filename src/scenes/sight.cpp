// Sights of our own worlds.
// SPDX-License-Identifier: MIT
#include "sight.hpp"

#include <algorithm>

#include "isostep/store/state.hpp"

namespace isostep::scenes {

/// User data is a body's place in the order of creation.
template <class S> Sight sight_of(const World<S>& world, int faults) {
  Sight sight;
  sight.time = static_cast<double>(world.tick()) / world.settings().hz;
  std::vector<BodyId> bodies = world.bodies();
  std::stable_sort(bodies.begin(), bodies.end(),
                   [&](BodyId a, BodyId b) { return world.user_data(a) < world.user_data(b); });
  for (const BodyId body : bodies) {
    sight.bodies.push_back({in_double(world.center_of_mass(body)), in_double(world.pose(body).orientation),
                            in_double(world.velocity(body)), in_double(world.angular_velocity(body)),
                            world.type(body) == BodyType::dynamic, world.is_awake(body)});
  }
  if (!world.state().joint_slots.entries().empty()) sight.joint_error = largest_joint_error(world);
  sight.energy = measure_energy(world);
  sight.faults = faults;
  return sight;
}

#define ISO_INSTANTIATE(S) template Sight sight_of<S>(const World<S>&, int);
ISO_FOR_EACH_SCALAR(ISO_INSTANTIATE)
#undef ISO_INSTANTIATE

}  // namespace isostep::scenes
