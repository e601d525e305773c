// A particle world's state made by hand, and what the systems of a step share, for tests that drive one system alone.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/particles/particle_state.hpp"
#include "isostep/particles/step/step.hpp"
#include "unit/particles/row_scene.hpp"

namespace isostep {
inline namespace step_scene {

/// A scene without gravity; its one material has no damping, and nothing collides. Numbers go in and come out as
/// doubles.
template <class S> struct StepScene {
  using V = Velocity<S>;
  ParticleState<S> state;
  ParticleStep<S> step;

  StepScene() {
    state.settings.gravity = vec(kNowhere);
    state.materials.add(ParticleMaterial<S>{});
  }

  static Vec3<S> vec(D3 a) { return {from_double<S>(a.x), from_double<S>(a.y), from_double<S>(a.z)}; }
  template <class T> static D3 real(Vec3<T> a) { return {to_double(a.x), to_double(a.y), to_double(a.z)}; }

  /// `m` kPinned: immovable.
  ParticleId add(D3 position, D3 velocity = kNowhere, double m = 1) {
    const auto id = state.particles.template take<ParticleId>();
    state.position.push_back(vec(position));
    state.velocity.push_back({from_double<V>(velocity.x), from_double<V>(velocity.y), from_double<V>(velocity.z)});
    state.inverse_mass.push_back(m == kPinned ? InverseMass<S>(0) : from_double<InverseMass<S>>(1 / m));
    state.material.push_back(0);
    return id;
  }
  Spring<S> spring(ParticleId a, ParticleId b, double stiffness, double rest_length) const {
    Spring<S> made;
    made.a = a;
    made.b = b;
    made.stiffness = from_double<S>(stiffness);
    made.rest_length = from_double<S>(rest_length);
    return made;
  }
  LinkId add_link(LinkType type, ParticleId a, ParticleId b, double length) {
    Link<S> link;
    link.type = type;
    link.a = a;
    link.b = b;
    link.length = from_double<S>(length);
    state.link_impulses.push_back(V(0));
    return state.links.add(link);
  }
  /// Makes everything balls from now on.
  void make_balls(double radius, double restitution = 0) {
    ParticleMaterial<S>& material = state.materials.change_all()[0];
    material.radius = from_double<S>(radius);
    material.restitution = from_double<S>(restitution);
    material.collides = true;
  }
  void begin() {
    step.begin(state.settings, state.material.size());
    step.now = state.position;
  }

  D3 v(ParticleId particle) const { return real(state.velocity[particle.slot]); }
  D3 d(ParticleId particle) const { return real(step.displacement[particle.slot]); }
  D3 a(ParticleId particle) const { return real(step.acceleration[particle.slot]); }
  double h() const { return 1.0 / (state.settings.hz * state.settings.substeps); }
};

/// The error that roundings may leave of numbers of this size, by the coarsest format that has them.
template <class S> double grain(double size) {
  return kIsFixed<S> ? to_double(resolution<S>()) : to_double(resolution<S>()) * size;
}

}  // namespace step_scene
}  // namespace isostep
