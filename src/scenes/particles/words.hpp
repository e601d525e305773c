// Short words for the scripts of particle scenes.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/particles/particle_state.hpp"
#include "isostep/particles/particle_world.hpp"

namespace isostep::scenes {

/// Particles, materials and colliders by the place in their order of creation, while none of them was removed before.
template <class S> ParticleId particle_at(const ParticleWorld<S>& world, std::uint32_t slot) {
  return world.state().particles.template id_of<ParticleId>(slot);
}
template <class S> ParticleMaterialId material_at(const ParticleWorld<S>& world, std::uint32_t slot) {
  return world.state().materials.slot_map().template id_of<ParticleMaterialId>(slot);
}

/// The steps in a time in seconds.
template <class S> std::uint32_t steps_of(const ParticleWorld<S>& world, std::uint32_t seconds) {
  return seconds * static_cast<std::uint32_t>(world.settings().hz);
}

/// All at n.x < offset is solid, with the axis (sign 1 or -1) as n.
template <class S> ColliderId add_plane(ParticleWorld<S>& world, int axis, int sign, S offset) {
  Collider<S> plane;
  plane.normal = {Unit<S>(axis == 0 ? sign : 0), Unit<S>(axis == 1 ? sign : 0), Unit<S>(axis == 2 ? sign : 0)};
  plane.offset = offset;
  return world.add(plane);
}
template <class S> ColliderId add_ground(ParticleWorld<S>& world, S height = S(0)) {
  return add_plane(world, 1, 1, height);
}
template <class S> ColliderId add_line(ParticleWorld<S>& world, Vec3<S> start, Vec3<S> end, S radius) {
  Collider<S> line;
  line.type = ColliderType::line;
  line.start = start;
  line.end = end;
  line.radius = radius;
  return world.add(line);
}

}  // namespace isostep::scenes
