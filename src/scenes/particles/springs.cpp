// Every force and every spring at work, and every command: what a replay of it proves, no command escapes.
// SPDX-License-Identifier: MIT
#include "particle_scene.hpp"
#include "words.hpp"

namespace isostep::scenes::particle_scripts {
namespace {

/// A particle in its own alley, `x` along.
template <class S>
ParticleId add_at(ParticleWorld<S>& world, S x, S y, S mass = S(1), ParticleMaterialId material = {}) {
  ParticleDefinition<S> d;
  d.position = {x, y, S(0)};
  d.mass = mass;
  d.material = material;
  return world.create(d);
}
template <class S> SpringId add_spring(ParticleWorld<S>& world, SpringType type, ParticleId a, ParticleId b, S limit) {
  Spring<S> s;
  s.type = type;
  s.a = a;
  s.b = b;
  const Vec3<S> at = world.position(a);
  s.anchor = b ? Vec3<S>{S(0), S(0), S(0)} : Vec3<S>{at.x, S(6), S(0.5)};
  s.stiffness = type == SpringType::stiff ? S(4000) : S(30);
  s.damping = S(0.5);
  s.rest_length = type == SpringType::stiff ? S(0) : S(1);
  s.elastic_limit = limit;
  return world.add(s);
}

/// Alleys 0 to 5: each type between two particles, then from a fixed point. Springs 0 to 6, the last of which yields.
template <class S> void add_springs(ParticleWorld<S>& world) {
  const SpringType types[] = {SpringType::spring, SpringType::bungee, SpringType::stiff};
  int alley = 0;
  for (const SpringType type : types) {
    const ParticleId a = add_at(world, S(alley), S(4)), b = add_at(world, S(alley), S(2), S(2));
    add_spring(world, type, a, b, S(0));
    world.place(a, world.position(a), {S(0), S(8), S(1)});
    alley += 1;
  }
  for (const SpringType type : types) {
    add_spring(world, type, add_at(world, S(alley), S(5)), {}, S(0));
    alley += 1;
  }
  add_spring(world, SpringType::spring, add_at(world, S(alley), S(4.5), S(8)), {}, S(0.5));
}
/// Alleys 7 to 9: particles 10 to 12, forces 0 to 2.
template <class S> void add_forces(ParticleWorld<S>& world) {
  ParticleForce<S> up;
  up.type = ForceType::gravity;
  up.particle = add_at(world, S(7), S(3));
  up.acceleration = {S(0), S(9), S(0.5)};
  world.add(up);
  ParticleForce<S> drag;
  drag.type = ForceType::drag;
  drag.particle = add_at(world, S(8), S(6));
  drag.linear_drag = S(0.5);
  drag.quadratic_drag = S(0.25);
  world.add(drag);
  ParticleForce<S> water;
  water.type = ForceType::buoyancy;
  water.particle = add_at(world, S(9), S(1.5), S(4));
  water.max_depth = S(0.5);
  water.volume = S(0.0078125);
  water.surface_height = S(1);
  water.density = S(1000);
  world.add(water);
}
/// Particles 13 to 16 hold together.
template <class S> void add_drop(ParticleWorld<S>& world) {
  ParticleMaterial<S> material;
  material.radius = S(0.1);
  material.damping = S(0.3);
  Cohesion<S> cohesion;
  cohesion.material = world.add(material);
  cohesion.repel_distance = S(0.3);
  cohesion.repel_force = S(10);
  cohesion.attract_start = S(0.5);
  cohesion.attract_end = S(1);
  cohesion.attract_force = S(10);
  world.add(cohesion);
  for (int i = 0; i < 4; ++i)
    add_at(world, S(11) + S(i % 2) * S(0.7), S(2) + S(i / 2) * S(0.25), S(1), cohesion.material);
}

template <class S> void build_springs(ParticleWorld<S>& world) {
  ParticleMaterial<S> air;
  air.damping = S(0.8);
  world.set(world.default_material(), air);
  add_springs(world);
  add_forces(world);
  add_drop(world);
  add_ground(world);
}

template <class IdType, class Slots> IdType any(const Slots& slots, std::uint32_t slot) {
  return slots.template id_of<IdType>(slot);
}

template <class S, class IdType, class Change> void edit(ParticleWorld<S>& world, IdType id, const Change& change) {
  auto record = *world.find(id);
  change(record);
  world.set(id, record);
}

/// One change every twelve steps.
template <class S> void change_springs(ParticleWorld<S>& world) {
  if (world.tick() % 12 != 6) return;
  const ParticleState<S>& state = world.state();
  const auto particle = [&](std::uint32_t slot) { return particle_at(world, slot); };
  const auto spring = any<SpringId>(state.springs.slot_map(), 3);
  const auto force = any<ForceId>(state.forces.slot_map(), 1);
  const auto cohesion = any<CohesionId>(state.cohesions.slot_map(), 0);
  const auto link = [&] { return any<LinkId>(state.links.slot_map(), 0); };  // there is none at first
  const auto ground = any<ColliderId>(state.colliders.slot_map(), 0);
  switch (world.tick() / 12) {
    case 1: world.apply_impulse(particle(10), {S(0), S(1), S(-2)}); break;
    case 2: world.apply_force(particle(11), {S(20), S(0), S(0)}); break;
    case 3: edit(world, spring, [](Spring<S>& stronger) { stronger.stiffness = S(60); }); break;
    case 4: world.remove(any<SpringId>(state.springs.slot_map(), 1)); break;
    case 5: world.set_gravity({S(1), S(-9), S(0)}); break;
    case 6: world.set_mass(particle(0), S(3)); break;
    case 7: world.set_mass(particle(1), S(2), true); break;
    case 8: edit(world, force, [](ParticleForce<S>& thinner) { thinner.quadratic_drag = S(0); }); break;
    case 9: world.remove(force); break;
    case 10: world.destroy(particle(7)); break;  // and its spring
    case 11: edit(world, cohesion, [](Cohesion<S>& weaker) { weaker.attract_force = S(5); }); break;
    case 12: {
      ParticleTouch<S> touch{};
      touch.particle = particle(12);
      touch.normal = {Unit<S>(0), Unit<S>(-1), Unit<S>(0)};
      touch.surface_velocity = {Velocity<S>(0), Velocity<S>(2), Velocity<S>(0)};
      world.touch(touch);
      break;
    }
    case 13: {
      Link<S> rod;
      rod.type = LinkType::rod;
      rod.a = particle(10);
      rod.b = particle(11);
      rod.length = S(2);
      world.add(rod);
      break;
    }
    case 14: {
      ParticleDefinition<S> guest;
      guest.position = {S(10), S(3), S(0)};
      guest.lifetime = 40;
      world.create(guest);
      break;
    }
    case 15: edit(world, link(), [](Link<S>& rod) { rod.type = LinkType::cable; }); break;
    case 16: world.remove(cohesion); break;
    case 17: {
      const ParticleMaterialId sticky = world.material(particle(13));
      for (std::uint32_t slot = 13; slot < 17; ++slot) world.set_material(particle(slot), world.default_material());
      world.remove(sticky);
      break;
    }
    case 18: edit(world, ground, [](Collider<S>& higher) { higher.offset = S(0.25); }); break;
    case 19: world.remove(link()); break;
    case 20: world.remove(ground); break;
    default: break;
  }
}

}  // namespace

template <class S> ParticleScript<S> springs() { return {{}, build_springs<S>, change_springs<S>, nullptr}; }

#define ISO_INSTANTIATE(S) template ParticleScript<S> springs();
ISO_FOR_EACH_SCALAR(ISO_INSTANTIATE)
#undef ISO_INSTANTIATE

}  // namespace isostep::scenes::particle_scripts
