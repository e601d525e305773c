// Rules for the numbers of a particle world: the same for commands and for states read from files.
// SPDX-License-Identifier: MIT
#pragma once

#include <initializer_list>

#include "isostep/core/fault.hpp"
#include "isostep/particles/cohesion.hpp"
#include "isostep/particles/collider.hpp"
#include "isostep/particles/force.hpp"
#include "isostep/particles/limits.hpp"
#include "isostep/particles/link.hpp"
#include "isostep/particles/spring.hpp"
#include "isostep/particles/touch.hpp"

namespace isostep::detail {

/// A friction coefficient of 16 is far beyond any pair of materials.
template <class S> inline constexpr S kMostFriction = S(16);

template <class S> ISO_INLINE bool all_finite(std::initializer_list<S> numbers) {
  for (const S number : numbers) {
    if (!is_finite(number)) return false;
  }
  return true;
}
template <class S> ISO_INLINE bool none_negative(std::initializer_list<S> numbers) {
  for (const S number : numbers) {
    if (number < S(0)) return false;
  }
  return true;
}
/// x lies from -limit to limit. Both sides are compared: the lowest fixed-point number has no magnitude.
template <class S> ISO_INLINE bool lies_within(S x, S limit) { return -limit <= x && x <= limit; }
template <class S> ISO_INLINE bool lies_within(Vec3<S> v, S limit) {
  return lies_within(v.x, limit) && lies_within(v.y, limit) && lies_within(v.z, limit);
}
template <class S> ISO_INLINE bool is_share(S x) { return S(0) <= x && x <= S(1); }

template <class S> ISO_INLINE Fault fault_of_position(Vec3<S> position) {
  if (!is_finite(position)) return Fault::not_finite;
  return lies_within(position, ParticleLimits<S>::position()) ? Fault::none : Fault::out_of_range;
}
template <class S> ISO_INLINE Fault fault_of_velocity(Vec3<S> velocity) {
  if (!is_finite(velocity)) return Fault::not_finite;
  return lies_within(velocity, ParticleLimits<S>::speed()) ? Fault::none : Fault::out_of_range;
}
template <class S> ISO_INLINE Fault fault_of_particle_mass(S mass) {
  if (!is_finite(mass)) return Fault::not_finite;
  const bool good = ParticleLimits<S>::least_mass() <= mass && mass <= ParticleLimits<S>::mass();
  return good ? Fault::none : mass <= S(0) ? Fault::bad_mass : Fault::out_of_range;
}

template <class S> ISO_INLINE Fault fault_of(const ParticleMaterial<S>& m) {
  if (!all_finite({m.gravity_scale, m.damping, m.linear_drag, m.quadratic_drag, m.radius, m.friction, m.restitution}))
    return Fault::not_finite;
  if (!lies_within(m.gravity_scale, ParticleLimits<S>::speed()) || kMostFriction<S> < m.friction ||
      ParticleLimits<S>::position() < m.radius) {
    return Fault::out_of_range;
  }
  const bool good = is_share(m.damping) && is_share(m.restitution) &&
                    none_negative({m.linear_drag, m.quadratic_drag, m.radius, m.friction});
  return good ? Fault::none : Fault::bad_argument;
}

/// Both ends, but for whether their ids are held.
template <class S> ISO_INLINE Fault fault_of_ends(ParticleId a, ParticleId b, Vec3<S> anchor) {
  if (!a || a == b) return Fault::bad_argument;
  return fault_of_position(anchor);
}
template <class S> ISO_INLINE Fault fault_of(const Spring<S>& s) {
  if (!all_finite({s.stiffness, s.damping, s.rest_length, s.elastic_limit})) return Fault::not_finite;
  if (const Fault fault = fault_of_ends(s.a, s.b, s.anchor); fault != Fault::none) return fault;
  if (ParticleLimits<S>::position() < s.rest_length) return Fault::out_of_range;
  const bool good = s.type <= SpringType::stiff &&
                    none_negative({s.stiffness, s.damping, s.rest_length, s.elastic_limit}) &&
                    (s.type != SpringType::stiff || (s.rest_length == S(0) && s.elastic_limit == S(0)));
  return good ? Fault::none : Fault::bad_argument;
}
template <class S> ISO_INLINE Fault fault_of(const ParticleForce<S>& f) {
  if (!is_finite(f.acceleration) ||
      !all_finite({f.linear_drag, f.quadratic_drag, f.max_depth, f.volume, f.surface_height, f.density})) {
    return Fault::not_finite;
  }
  if (!lies_within(f.acceleration, ParticleLimits<S>::speed()) ||
      !lies_within(f.surface_height, ParticleLimits<S>::position()) || ParticleLimits<S>::position() < f.max_depth) {
    return Fault::out_of_range;
  }
  const bool good = f.type <= ForceType::buoyancy && static_cast<bool>(f.particle) &&
                    none_negative({f.linear_drag, f.quadratic_drag, f.volume, f.density}) &&
                    (f.type != ForceType::buoyancy || S(0) < f.max_depth);
  return good ? Fault::none : Fault::bad_argument;
}
template <class S> ISO_INLINE Fault fault_of(const Cohesion<S>& c) {
  if (!all_finite({c.repel_distance, c.repel_force, c.attract_start, c.attract_end, c.attract_force}))
    return Fault::not_finite;
  if (ParticleLimits<S>::position() < c.attract_end || ParticleLimits<S>::position() < c.repel_distance)
    return Fault::out_of_range;
  const bool good = static_cast<bool>(c.material) &&
                    none_negative({c.repel_distance, c.repel_force, c.attract_start, c.attract_end, c.attract_force}) &&
                    c.repel_distance <= c.attract_start && c.attract_start <= c.attract_end;
  return good ? Fault::none : Fault::bad_argument;
}
template <class S> ISO_INLINE Fault fault_of(const Link<S>& l) {
  if (!all_finite({l.length, l.restitution})) return Fault::not_finite;
  if (const Fault fault = fault_of_ends(l.a, l.b, l.anchor); fault != Fault::none) return fault;
  if (ParticleLimits<S>::position() < l.length) return Fault::out_of_range;
  return l.type <= LinkType::rod && S(0) < l.length && is_share(l.restitution) ? Fault::none : Fault::bad_argument;
}
/// A length of 1, to a thousandth. A component may be beyond 1 by what a turn rounds.
template <class S> ISO_INLINE bool near_unit(Vec3<Unit<S>> n) {
  if (!is_finite(n)) return false;
  const S length = dot(convert<S>(n), convert<S>(n));
  return S(0.998) < length && length < S(1.002);
}
template <class S> ISO_INLINE Fault fault_of(const Collider<S>& c) {
  if (!is_finite(c.normal) || !is_finite(c.start) || !is_finite(c.end) || !all_finite({c.offset, c.radius}))
    return Fault::not_finite;
  const S edge = ParticleLimits<S>::position();
  if (!lies_within(c.offset, edge) || !lies_within(c.start, edge) || !lies_within(c.end, edge) || edge < c.radius)
    return Fault::out_of_range;
  const bool good = c.type == ColliderType::plane  ? near_unit<S>(c.normal)
                    : c.type == ColliderType::line ? S(0) <= c.radius
                                                   : false;
  return good ? Fault::none : Fault::bad_shape;
}
template <class S> ISO_INLINE Fault fault_of(const ParticleTouch<S>& t) {
  if (!is_finite(t.normal) || !is_finite(t.surface_velocity) || !is_finite(t.surface_acceleration) ||
      !is_finite(t.inverse_mass) || !all_finite({t.separation, t.friction, t.restitution})) {
    return Fault::not_finite;
  }
  const S edge = ParticleLimits<S>::position();
  const Velocity<S> speed = convert<Velocity<S>>(ParticleLimits<S>::speed());
  const InverseMass<S> most = divide_to<InverseMass<S>>(S(1), ParticleLimits<S>::least_mass());
  if (!lies_within(t.separation, edge) || !lies_within(t.surface_velocity, speed) ||
      !lies_within(t.surface_acceleration, ParticleLimits<S>::acceleration()) || most < t.inverse_mass ||
      kMostFriction<S> < t.friction) {
    return Fault::out_of_range;
  }
  const bool good = static_cast<bool>(t.particle) && near_unit<S>(t.normal) && InverseMass<S>(0) <= t.inverse_mass &&
                    S(0) <= t.friction && is_share(t.restitution);
  return good ? Fault::none : Fault::bad_argument;
}

}  // namespace isostep::detail
