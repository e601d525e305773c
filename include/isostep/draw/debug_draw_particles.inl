// Drawing: worlds of particles.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/draw/debug_draw_sketch.inl"
#include "isostep/particles/particle_state.hpp"
#include "isostep/scalar/math.hpp"

namespace isostep::detail {

/// One call of draw on a world of particles.
template <class S> class ParticleSketch {
 public:
  ISO_INLINE ParticleSketch(const ParticleWorld<S>& world, DebugDraw& to, const DrawOptions& options)
      : state_(world.state()), to_(to), sketch_(options) {}

  ISO_INLINE void draw_particles() const {
    for (std::uint32_t slot = 0; slot < state_.material.size(); ++slot) {
      if (!state_.particles.is_taken(slot)) continue;
      DrawnParticle drawn = {};
      drawn.particle = state_.particles.template id_of<ParticleId>(slot);
      drawn.material = state_.material[slot];
      drawn.pinned = state_.inverse_mass[slot] == InverseMass<S>(0);
      sketch_.point(state_.position[slot], drawn.position);
      sketch_.vector(state_.velocity[slot], drawn.velocity);
      drawn.radius = sketch_.number(state_.materials.all()[drawn.material].radius);
      to_.particle(drawn);
    }
  }
  ISO_INLINE void draw_springs() const {
    for (std::uint32_t slot = 0; slot < state_.springs.all().size(); ++slot) {
      if (!state_.springs.is_taken(slot)) continue;
      const Spring<S>& spring = state_.springs.all()[slot];
      DrawnSpring drawn = {};
      drawn.spring = state_.springs.slot_map().template id_of<SpringId>(slot);
      drawn.type = spring.type;
      drawn.a = spring.a;
      drawn.b = spring.b;
      draw_ends(spring, drawn.from, drawn.to);
      drawn.rest_length = sketch_.number(spring.rest_length);
      to_.spring(drawn);
    }
  }
  ISO_INLINE void draw_links() const {
    for (std::uint32_t slot = 0; slot < state_.links.all().size(); ++slot) {
      if (!state_.links.is_taken(slot)) continue;
      const Link<S>& link = state_.links.all()[slot];
      DrawnLink drawn = {};
      drawn.link = state_.links.slot_map().template id_of<LinkId>(slot);
      drawn.type = link.type;
      drawn.a = link.a;
      drawn.b = link.b;
      const Vec3<S> apart = draw_ends(link, drawn.from, drawn.to);
      const S excess = length(apart) - link.length;
      drawn.error = sketch_.number(link.type == LinkType::cable ? max(excess, S(0)) : excess);
      to_.link(drawn);
    }
  }
  ISO_INLINE void draw_colliders() const {
    for (std::uint32_t slot = 0; slot < state_.colliders.all().size(); ++slot) {
      if (!state_.colliders.is_taken(slot)) continue;
      const Collider<S>& collider = state_.colliders.all()[slot];
      DrawnCollider drawn = {};
      drawn.collider = state_.colliders.slot_map().template id_of<ColliderId>(slot);
      drawn.type = collider.type;
      if (collider.type == ColliderType::line) {
        sketch_.point(collider.start, drawn.start);
        sketch_.point(collider.end, drawn.end);
        drawn.radius = sketch_.number(collider.radius);
      } else {
        draw_plane(collider, drawn);
      }
      to_.collider(drawn);
    }
  }

 private:
  /// Draws both ends of a spring or link. Returns the vector [m] from a to b.
  template <class Bond> ISO_INLINE Vec3<S> draw_ends(const Bond& bond, float (&from)[3], float (&to)[3]) const {
    const Vec3<S> a = state_.position[bond.a.slot], b = bond.b ? state_.position[bond.b.slot] : bond.anchor;
    sketch_.point(a, from);
    sketch_.point(b, to);
    return b - a;
  }
  ISO_INLINE void draw_plane(const Collider<S>& plane, DrawnCollider& drawn) const {
    sketch_.vector(plane.normal, drawn.normal);
    double height = -to_double(plane.offset);  // [m] of the origin above the plane
    for (int i = 0; i < 3; ++i) height += to_double(plane.normal[i]) * sketch_.origin()[i];
    for (int i = 0; i < 3; ++i) drawn.start[i] = static_cast<float>(-height * to_double(plane.normal[i]));
  }

  const ParticleState<S>& state_;
  DebugDraw& to_;
  Sketch<S> sketch_;
};

}  // namespace isostep::detail
