// Measures of particle worlds.
// SPDX-License-Identifier: MIT
#include "particle_measure.hpp"

#include <algorithm>
#include <cmath>

#include "isostep/particles/particle_state.hpp"
#include "isostep/particles/scenery.hpp"

namespace isostep::scenes {
namespace {

struct Place {
  double x, y, z;
};
template <class T> Place place(const Vec3<T>& v) { return {to_double(v.x), to_double(v.y), to_double(v.z)}; }
double distance(Place a, Place b) { return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z); }
double length(Place a) { return distance(a, {0, 0, 0}); }
/// The length of a spring or link now.
template <class S, class Bond> double length_of(const ParticleState<S>& state, const Bond& bond) {
  const Place other = bond.b ? place(state.position[bond.b.slot]) : place(bond.anchor);
  return distance(place(state.position[bond.a.slot]), other);
}
template <class S> double radius_of(const ParticleState<S>& state, std::uint32_t slot) {
  return to_double(state.materials.all()[state.material[slot]].radius);
}
template <class S> double overlap_with_scenery(const ParticleState<S>& state, std::uint32_t slot) {
  double worst = 0;
  for (std::uint32_t i = 0; i < state.colliders.all().size(); ++i) {
    if (!state.colliders.is_taken(i)) continue;
    const double gap = to_double(distance_to(state.colliders.all()[i], state.position[slot]).distance);
    worst = std::max(worst, radius_of(state, slot) - gap);
  }
  return worst;
}

}  // namespace

template <class S> ParticleEnergy measure_energy(const ParticleWorld<S>& world) {
  const ParticleState<S>& state = world.state();
  const Place gravity = place(state.settings.gravity);
  ParticleEnergy energy;
  for (std::uint32_t slot = 0; slot < state.material.size(); ++slot) {
    const double inverse = to_double(state.inverse_mass[slot]);
    if (inverse == 0) continue;
    const double mass = 1 / inverse, speed = length(place(state.velocity[slot]));
    const double scale = to_double(state.materials.all()[state.material[slot]].gravity_scale);
    const Place p = place(state.position[slot]);
    energy.kinetic += 0.5 * mass * speed * speed;
    energy.potential -= mass * scale * (gravity.x * p.x + gravity.y * p.y + gravity.z * p.z);
  }
  for (const Spring<S>& spring : state.springs.all()) {
    if (!spring.a) continue;
    const double extension = length_of(state, spring) - to_double(spring.rest_length);
    if (spring.type == SpringType::bungee && extension < 0) continue;
    energy.elastic += 0.5 * to_double(spring.stiffness) * extension * extension;
  }
  return energy;
}

template <class S> double largest_link_error(const ParticleWorld<S>& world) {
  double worst = 0;
  for (const Link<S>& link : world.state().links.all()) {
    if (!link.a) continue;
    const double excess = length_of(world.state(), link) - to_double(link.length);
    worst = std::max(worst, link.type == LinkType::rod ? std::abs(excess) : excess);
  }
  return worst;
}

template <class S> double largest_overlap(const ParticleWorld<S>& world) {
  const ParticleState<S>& state = world.state();
  double worst = 0;
  for (std::uint32_t a = 0; a < state.material.size(); ++a) {
    if (!state.particles.is_taken(a)) continue;
    worst = std::max(worst, overlap_with_scenery(state, a));
    if (!state.materials.all()[state.material[a]].collides) continue;
    for (std::uint32_t b = a + 1; b < state.material.size(); ++b) {
      if (!state.particles.is_taken(b) || !state.materials.all()[state.material[b]].collides) continue;
      const double apart = distance(place(state.position[a]), place(state.position[b]));
      worst = std::max(worst, radius_of(state, a) + radius_of(state, b) - apart);
    }
  }
  return worst;
}

template <class S> double largest_speed(const ParticleWorld<S>& world) {
  double fastest = 0;
  for (std::uint32_t slot = 0; slot < world.state().material.size(); ++slot)
    fastest = std::max(fastest, length(place(world.state().velocity[slot])));
  return fastest;
}

#define ISO_INSTANTIATE(S)                                            \
  template ParticleEnergy measure_energy<S>(const ParticleWorld<S>&); \
  template double largest_link_error<S>(const ParticleWorld<S>&);     \
  template double largest_overlap<S>(const ParticleWorld<S>&);        \
  template double largest_speed<S>(const ParticleWorld<S>&);
ISO_FOR_EACH_SCALAR(ISO_INSTANTIATE)
#undef ISO_INSTANTIATE

}  // namespace isostep::scenes
