// Random commands for particle worlds: every kind, numbers tame or wild, ids that are held, stale or nobody's.
// SPDX-License-Identifier: MIT
#pragma once

#include <variant>

#include "unit/particles/particle_worlds.hpp"

namespace isostep::test {

template <class List> struct VariantOf;
template <class Unused, class... Commands> struct VariantOf<CommandTypes<Unused, Commands...>> {
  using Type = std::variant<Commands...>;
};
/// Any command of a particle world.
template <class S> using ParticleCommand = typename VariantOf<EveryParticleCommand<S>>::Type;

/// Returns whether the world accepted it.
template <class S> bool apply_any(ParticleWorld<S>& w, const ParticleCommand<S>& command) {
  return std::visit([&](const auto& one) { return static_cast<bool>(w.apply(one)); }, command);
}

/// A function of the seed, the world's state and `wild`: of 1000 numbers, enumerators and ids so many are not meant to
/// be taken. 0: those of a lively game.
template <class S> class RandomCommands {
 public:
  RandomCommands(const ParticleWorld<S>& world, std::uint64_t seed, std::uint32_t wild)
      : world_(world), chance_(seed), wild_(wild) {
    particles_ = world.particles();
  }
  Chance& chance() { return chance_; }

  /// Births are a third, so that a world without deaths grows.
  ParticleCommand<S> next() {
    switch (chance_.below(36)) {
      case 0: return destroy();
      case 1: return SetParticleMotion<S>{particle(), position(), velocity()};
      case 2: return SetParticleMass<S>{particle(), mass(), chance_.one_in(8)};
      case 3: return SetParticleMaterial{particle(), id_of<ParticleMaterialId>(world_.state().materials.slot_map())};
      case 4:
      case 5: return PushParticle<S>{particle(), vector(chance_.point(30), highest<S>())};
      case 6:
      case 7: return KickParticle<S>{particle(), vector(chance_.point(4), highest<S>())};
      case 8:
      case 9:
      case 10: return TouchParticle<S>{touch()};
      case 11: return SetParticleGravity<S>{vector(D3{0, -10, 0} + chance_.point(1), ParticleLimits<S>::speed())};
      case 12:
      case 13:
      case 14: return any_record<ParticleMaterialId>(world_.state().materials, material());
      case 15:
      case 16:
      case 17:
      case 18: return any_record<SpringId>(world_.state().springs, spring());
      case 19:
      case 20:
      case 21: return any_record<ForceId>(world_.state().forces, force());
      case 22: return any_record<CohesionId>(world_.state().cohesions, cohesion());
      case 23:
      case 24:
      case 25: return any_record<LinkId>(world_.state().links, link());
      case 26: return any_record<ColliderId>(world_.state().colliders, collider());
      default: return CreateParticle<S>{definition()};
    }
  }

 private:
  bool is_wild() { return chance_.below(1000) < wild_; }
  S number(double tame, S limit) {
    if (!is_wild()) return num<S>(tame);
    switch (chance_.below(9)) {
      case 0: return not_a_number<S>();
      case 1: return endless<S>();
      case 2: return -endless<S>();
      case 3: return highest<S>();
      case 4: return -highest<S>();
      case 5: return S(0);
      case 6: return resolution<S>();
      case 7: return -limit;
      default: return limit;
    }
  }
  Vec3<S> vector(D3 tame, S limit) {
    const S x = number(tame.x, limit), y = number(tame.y, limit), z = number(tame.z, limit);
    return {x, y, z};
  }
  Vec3<S> position() { return vector(chance_.point(3) + D3{0, 4, 0}, ParticleLimits<S>::position()); }
  Vec3<S> velocity() { return vector(chance_.point(3), ParticleLimits<S>::speed()); }
  S mass() {
    const S most = chance_.one_in(2) ? ParticleLimits<S>::mass() : ParticleLimits<S>::least_mass();
    return number(chance_.in(0.25, 4), most);
  }
  S size(double most) { return number(chance_.in(0, most), ParticleLimits<S>::position()); }
  S strength(double most) { return number(chance_.in(0, most), highest<S>()); }
  S share() { return number(chance_.in(0, 1), S(1)); }
  template <class E> E kind(std::uint32_t count) {
    return static_cast<E>(chance_.below(is_wild() ? count + 2 : count));
  }

  template <class IdType> IdType id_of(const SlotMap& slots) {
    const auto count = static_cast<std::uint32_t>(slots.entries().size());
    if (count == 0) return {};
    IdType id = slots.id_of<IdType>(chance_.below(count));
    if (is_wild()) id.generation += chance_.below(3) - 1u;
    if (is_wild()) id.slot += chance_.below(3) - 1u;
    return id;
  }
  ParticleId particle() {
    if (is_wild() || particles_.empty()) return id_of<ParticleId>(world_.state().particles);
    return particles_[chance_.below(static_cast<std::uint32_t>(particles_.size()))];
  }
  ParticleId second() { return chance_.one_in(4) ? ParticleId{} : particle(); }
  ParticleCommand<S> destroy() {
    // A world of few is left its particles, or it would soon be empty.
    if (particles_.size() < 24) return CreateParticle<S>{definition()};
    return DestroyParticle{particle()};
  }

  template <class IdType, class Records, class Record>
  ParticleCommand<S> any_record(const Records& records, const Record& record) {
    const IdType id = id_of<IdType>(records.slot_map());
    switch (chance_.below(records.all().size() < 16 ? 5 : 3)) {
      case 0: return SetRecord<Record, IdType>{id, record};
      case 1: return RemoveRecord<IdType>{id};
      default: return AddRecord<Record>{record};
    }
  }
  ParticleDefinition<S> definition() {
    ParticleDefinition<S> d;
    d.position = position();
    d.velocity = velocity();
    d.mass = mass();
    d.pinned = chance_.one_in(12);
    if (!chance_.one_in(4)) d.material = id_of<ParticleMaterialId>(world_.state().materials.slot_map());
    if (chance_.one_in(2)) d.lifetime = 1 + chance_.below(90);
    if (is_wild()) d.lifetime = 0xffffffffu;
    return d;
  }
  ParticleMaterial<S> material() {
    ParticleMaterial<S> m;
    m.gravity_scale = number(chance_.in(-0.5, 1.5), ParticleLimits<S>::speed());
    m.damping = share();
    m.linear_drag = strength(0.5);
    m.quadratic_drag = strength(0.125);
    m.radius = size(0.5);
    m.friction = number(chance_.in(0, 1), S(16));
    m.restitution = share();
    m.collides = chance_.one_in(2);
    return m;
  }
  Spring<S> spring() {
    Spring<S> s;
    s.type = kind<SpringType>(3);
    s.a = particle();
    s.b = second();
    s.anchor = position();
    s.stiffness = strength(100);
    s.damping = strength(4);
    const bool stiff = s.type == SpringType::stiff;
    s.rest_length = stiff ? S(0) : size(2);
    s.elastic_limit = stiff || chance_.one_in(2) ? S(0) : size(1);
    return s;
  }
  ParticleForce<S> force() {
    ParticleForce<S> f;
    f.type = kind<ForceType>(3);
    f.particle = particle();
    f.acceleration = vector(chance_.point(5), ParticleLimits<S>::speed());
    f.linear_drag = strength(1);
    f.quadratic_drag = strength(0.25);
    f.max_depth = number(chance_.in(0.125, 2), ParticleLimits<S>::position());
    f.volume = strength(0.5);
    f.surface_height = number(chance_.in(0, 2), ParticleLimits<S>::position());
    f.density = strength(20);
    return f;
  }
  Cohesion<S> cohesion() {
    Cohesion<S> c;
    c.material = id_of<ParticleMaterialId>(world_.state().materials.slot_map());
    c.repel_distance = size(0.5);
    c.repel_force = strength(20);
    c.attract_start = number(chance_.in(0.5, 0.75), ParticleLimits<S>::position());
    c.attract_end = number(chance_.in(0.75, 1.5), ParticleLimits<S>::position());
    c.attract_force = strength(10);
    return c;
  }
  Link<S> link() {
    Link<S> l;
    l.type = kind<LinkType>(2);
    l.a = particle();
    l.b = second();
    l.anchor = position();
    l.length = number(chance_.in(0.5, 3), ParticleLimits<S>::position());
    l.restitution = share();
    return l;
  }
  Vec3<Unit<S>> direction() {
    if (is_wild()) return {Unit<S>(0.5), Unit<S>(0), Unit<S>(0.5)};
    const D3 way = chance_.point(1) + D3{0, 2, 0};
    const double size = length(way);
    return {num<Unit<S>>(way.x / size), num<Unit<S>>(way.y / size), num<Unit<S>>(way.z / size)};
  }
  Collider<S> collider() {
    Collider<S> c;
    c.type = kind<ColliderType>(2);
    c.normal = direction();
    c.offset = number(chance_.in(-1, 0), ParticleLimits<S>::position());
    c.start = vector(chance_.point(2), ParticleLimits<S>::position());
    c.end = vector(chance_.point(2), ParticleLimits<S>::position());
    c.radius = size(0.5);
    return c;
  }
  ParticleTouch<S> touch() {
    ParticleTouch<S> t = {};
    t.particle = particle();
    t.normal = direction();
    t.separation = number(chance_.in(-0.125, 0.125), ParticleLimits<S>::position());
    t.surface_velocity = convert<Velocity<S>>(clamp_to_speed(velocity()));
    t.surface_acceleration = vector(chance_.point(10), ParticleLimits<S>::acceleration());
    t.inverse_mass = chance_.one_in(2) ? InverseMass<S>(0) : num<InverseMass<S>>(chance_.in(0, 2));
    t.friction = number(chance_.in(0, 1), S(16));
    t.restitution = share();
    return t;
  }
  /// Velocity<S> may hold less than S.
  static Vec3<S> clamp_to_speed(Vec3<S> v) {
    const S limit = ParticleLimits<S>::speed() + S(1);
    return {clamp(v.x, -limit, limit), clamp(v.y, -limit, limit), clamp(v.z, -limit, limit)};
  }

  const ParticleWorld<S>& world_;
  Chance chance_;
  std::uint32_t wild_;
  std::vector<ParticleId> particles_;
};

}  // namespace isostep::test
