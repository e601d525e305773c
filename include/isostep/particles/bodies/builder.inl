// BodyBuilder: makes a body command by command, and unmakes it at the first fault.
// SPDX-License-Identifier: MIT
#pragma once

#include <utility>

#include "isostep/particles/bodies/particle_body.hpp"
#include "isostep/particles/checks.hpp"
#include "isostep/scalar/environment.hpp"
#include "isostep/scalar/math.hpp"

namespace isostep {

template <class S> void remove(ParticleWorld<S>& world, ParticleBody& body) {
  if (body.cohesion) world.remove(body.cohesion);
  for (std::size_t i = body.links.size(); i-- > 0;) world.remove(body.links[i]);
  for (std::size_t i = body.springs.size(); i-- > 0;) world.remove(body.springs[i]);
  for (std::size_t i = body.particles.size(); i-- > 0;) world.destroy(body.particles[i]);
  if (body.material) world.remove(body.material);
  const Fault fault = body.fault;
  body = ParticleBody{};
  body.fault = fault;
}

namespace detail {

/// Returns the point `step` of `steps` on the way from a to b, and b itself at the end.
template <class S> Vec3<S> on_the_way(Vec3<S> a, Vec3<S> b, std::uint32_t step, std::uint32_t steps) {
  if (step == 0) return a;
  return step == steps ? b : a + (b - a) * divide_to<Unit<S>>(S(step), S(steps));
}

/// Makes a body by commands. After a refused command the others do nothing.
template <class S> class BodyBuilder {
 public:
  explicit BodyBuilder(ParticleWorld<S>& world) : world_(world) {}

  bool good() const { return body_.fault == Fault::none; }
  void demand(bool condition) { fail_unless(condition, Fault::bad_argument); }
  /// Checks places and edges before they are added.
  void demand_places(std::initializer_list<Vec3<S>> places) {
    for (const Vec3<S> place : places) fail_unless(fault_of_position(place) == Fault::none, fault_of_position(place));
  }

  void particle(Vec3<S> position, S mass, bool pinned, ParticleMaterialId material) {
    if (!good()) return;
    ParticleDefinition<S> d;
    d.position = position;
    d.mass = mass;
    d.pinned = pinned;
    d.material = material;
    keep(body_.particles, world_.create(d));
    positions_.push_back(position);
  }
  ParticleId particle(std::size_t i) const { return body_.particles[i]; }
  void link(const Link<S>& link) {
    if (good()) keep(body_.links, world_.add(link));
  }
  /// Adds a link between particles by their order, `length` long or, for 0, as far as they are apart now.
  void link(LinkType type, std::size_t a, std::size_t b, S length = S(0), S restitution = S(0)) {
    if (!good()) return;
    Link<S> l;
    l.type = type;
    l.a = body_.particles[a];
    l.b = body_.particles[b];
    l.length = length == S(0) ? distance(positions_[a], positions_[b]) : length;
    l.restitution = restitution;
    link(l);
  }
  /// Adds a spring whose rest length is the distance now.
  void spring(const SpringKind<S>& kind, std::size_t a, std::size_t b) {
    if (!good() || !kind.present) return;
    Spring<S> s;
    s.a = body_.particles[a];
    s.b = body_.particles[b];
    s.stiffness = kind.stiffness;
    s.damping = kind.damping;
    s.rest_length = distance(positions_[a], positions_[b]);
    keep(body_.springs, world_.add(s));
  }
  ParticleMaterialId material(const ParticleMaterial<S>& material) {
    if (good()) body_.material = world_.add(material);
    fail_unless(static_cast<bool>(body_.material), world_.fault().fault);
    return body_.material;
  }
  void cohesion(const Cohesion<S>& cohesion) {
    if (good()) body_.cohesion = world_.add(cohesion);
    fail_unless(static_cast<bool>(body_.cohesion), world_.fault().fault);
  }
  /// The kind with its numbers, for a share of k h^2/m: see SpringKind.
  SpringKind<S> resolve(const SpringKind<S>& kind, S mass, S share) const {
    if (!(kind.stiffness == S(0))) return kind;
    const S rate = S(world_.settings().hz * world_.settings().substeps);
    const S damping = saturate_to<S>(product(mass * share, rate));
    return {kind.present, saturate_to<S>(product(damping, rate)), damping * S(0.25)};
  }
  ParticleBody finish() {
    if (!good()) remove(world_, body_);
    return std::move(body_);
  }

 private:
  void fail_unless(bool condition, Fault fault) {
    if (good() && !condition) body_.fault = fault;
  }
  template <class Id> void keep(std::vector<Id>& ids, Id id) {
    fail_unless(static_cast<bool>(id), world_.fault().fault);
    if (id) ids.push_back(id);
  }

  ParticleWorld<S>& world_;
  ParticleBody body_;
  std::vector<Vec3<S>> positions_;
};

}  // namespace detail
}  // namespace isostep
