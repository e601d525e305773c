// Bodies of particle_coupling.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/query/closest_point.hpp"
#include "isostep/dynamics/contact.hpp"
#include "isostep/effects/coupling_share.inl"
#include "isostep/geometry/limits.hpp"
#include "isostep/particles/limits.hpp"
#include "isostep/particles/particle_state.hpp"
#include "isostep/scalar/environment.hpp"
#include "isostep/store/state.hpp"

namespace isostep {

namespace detail {
/// [m/s] The speed that forces may give a particle within a step, more or less. What it meets sooner is found before.
template <class S> inline constexpr S kStraySpeed = S(2);
/// [1] The share of that way within which a particle counts as touching.
template <class S> inline constexpr S kTouchShare = S(0.125);
/// The steps of tracing a way to a surface. Each ends at the distance of the nearest point.
inline constexpr int kTraceSteps = 16;
}  // namespace detail

template <class S> ParticleCoupling<S>::ParticleCoupling(const CouplingSettings<S>& settings) : settings_(settings) {}

template <class S> bool ParticleCoupling<S>::before_step(const World<S>& bodies, ParticleWorld<S>& particles) {
  report_ = {};
  hz_ = 0;
  if (bodies.settings().hz != particles.settings().hz) return false;
  return pin_floats([&] {
    find_touches(bodies, particles);
    return true;
  });
}

template <class S> bool ParticleCoupling<S>::after_step(World<S>& bodies, const ParticleWorld<S>& particles) {
  const bool stepped = hz_ != 0 && particles.tick() == tick_ + 1 &&
                       first_touch_ + touching_.size() <= particles.events().touch_impulses.size();
  if (stepped) pin_floats([&] { push_bodies(bodies, particles); });
  hz_ = 0;
  return stepped;
}

// ---- finding

template <class S> void ParticleCoupling<S>::find_touches(const World<S>& bodies, ParticleWorld<S>& particles) {
  const ParticleState<S>& state = particles.state();
  hz_ = state.settings.hz;
  step_ = divide_to<Step<S>>(S(1), S(hz_));
  margin_ = detail::kStraySpeed<S> * step_;
  tick_ = state.tick;
  first_touch_ = state.touches.size();
  body_way_ = farthest_way(bodies);
  for (const Met& met : met_) met_of_slot_[met.body.slot] = 0;
  met_.clear();
  parts_.clear();
  touching_.clear();
  for (std::uint32_t slot = 0; slot < state.material.size(); ++slot) {
    if (!state.particles.is_taken(slot)) continue;
    find_bodies(bodies, {state.particles.template id_of<ParticleId>(slot), state.position[slot],
                         convert<S>(state.velocity[slot]), state.inverse_mass[slot],
                         &state.materials.all()[state.material[slot]]});
  }
  for (Met& met : met_) {
    if (met.first_touch == kNone) continue;
    foresee(met);
    share(met);
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < touching_.size(); ++i) {
    if (!particles.touch(touching_[i].touch)) ++report_.refused;
    else touching_[kept++] = touching_[i];
  }
  touching_.erase(touching_.begin() + static_cast<std::ptrdiff_t>(kept), touching_.end());
  report_.touches = static_cast<std::uint32_t>(kept);
  report_.bodies = static_cast<std::uint32_t>(met_.size());
}

/// [m] Returns how far points of awake bodies may move in the coming step: by so much their boxes are too small.
template <class S> S ParticleCoupling<S>::farthest_way(const World<S>& bodies) const {
  S most = S(0);
  for (const BodyState<S>& body : bodies.state().awake.states) {
    const S arm = max_abs(max(body.fat.high - body.centre, body.centre - body.fat.low));
    const auto turning = product(convert<S>(max_abs(body.angular_velocity)), arm);
    most = max(most, saturating_add(convert<S>(max_abs(body.velocity)), saturate_to<S>(turning + turning)));
  }
  return most * step_;
}

template <class S> void ParticleCoupling<S>::find_bodies(const World<S>& bodies, const Flier& flier) {
  const S reach = max_abs(flier.velocity) * step_ + margin_ + flier.material->radius + body_way_;
  found_.clear();
  bodies.overlap_aabb(Aabb<S>::around(flier.position, {reach, reach, reach}), found_, {settings_.filter.mask, false});
  for (const BodyId body : found_) {
    const std::uint32_t place = meet(bodies, body);
    const Met& met = met_[place];
    if (!met.collides || (!met.moves && flier.inverse_mass == InverseMass<S>(0))) continue;
    for (std::uint32_t i = 0; i < met.part_count; ++i) {
      Meeting meeting;
      const Part& part = parts_[met.first_part + i];
      if (find_meeting(met, part, flier, meeting)) add_touch(place, part.material, flier, meeting);
    }
  }
}

/// Returns the body's place in met_, where each body is entered once.
template <class S> std::uint32_t ParticleCoupling<S>::meet(const World<S>& bodies, BodyId body) {
  if (met_of_slot_.size() <= body.slot) met_of_slot_.resize(body.slot + 1, 0);
  if (met_of_slot_[body.slot] != 0) return met_of_slot_[body.slot] - 1;
  const BodyView<S> view = bodies.view(body);
  const BodyProperties<S>& properties = *view.properties;
  const bool awake = bodies.is_awake(body);
  Met met = {};
  met.body = body;
  met.moves = properties.type == BodyType::dynamic;
  met.rests = !awake || view.state->sleep_clock > 0;
  met.centre = view.state->centre;
  met.velocity = convert<S>(view.state->velocity);
  met.angular_velocity = convert<S>(view.state->angular_velocity);
  if (met.moves && awake) met.gravity = detail::saturating_product(bodies.settings().gravity, properties.gravity_scale);
  met.principal = to_matrix(view.state->orientation * properties.principal);
  met.mass = properties.mass;
  met.kappa = properties.kappa;
  met.first_touch = met.last_touch = kNone;
  met.locks = properties.flags & body_flag::kAllLocks;
  met.first_part = static_cast<std::uint32_t>(parts_.size());
  const Transform<S> placed = Transform<S>::of(view.pose);
  for (const Child<S>& child : view.children) {
    if (!parts_collide(PartTraits<S>{}, settings_.filter, child.traits, properties.filter)) continue;
    parts_.push_back({child.pose.is_identity() ? placed : compose(placed, Transform<S>::of(child.pose)),
                      view.contents.view(child.primitive), child.traits.material_or(properties.material)});
  }
  met.part_count = static_cast<std::uint32_t>(parts_.size()) - met.first_part;
  met.collides = (properties.flags & body_flag::kCollide) != 0 && met.part_count != 0;
  met_.push_back(met);
  met_of_slot_[body.slot] = static_cast<std::uint32_t>(met_.size());
  return met_of_slot_[body.slot] - 1;
}

/// Finds a near part's closest point. For a farther one traces the particle's way relative to the body, in steps that
/// no surface can lie within (Hart 1996, Sphere Tracing): a particle that flies past meets no plane of the part.
template <class S>
bool ParticleCoupling<S>::find_meeting(const Met& met, const Part& part, const Flier& flier, Meeting& meeting) const {
  const S radius = flier.material->radius;
  ClosestPoint<S> nearest = closest_point(part.shape, part.at, flier.position);
  S gap = nearest.distance - radius;
  if (margin_ < gap) {
    const Vec3<S> way = (flier.velocity - velocity_at(met, flier.position - met.centre)) * step_;
    const Direction<S> along = direction_of(way.x, way.y, way.z);
    const Vec3<U> u = {along.x, along.y, along.z};
    if (along.length + margin_ < gap) return false;
    const S touching = margin_ * detail::kTouchShare<S>;
    S gone = S(0);
    for (int i = 0; i < detail::kTraceSteps && touching < gap; ++i) {
      if (gone == along.length) return false;
      gone = min(gone + gap, along.length);
      nearest = closest_point(part.shape, part.at, flier.position + u * gone);
      gap = nearest.distance - radius;
      if (gone == along.length && gap <= margin_) break;
    }
    // The plane at the nearest place has the start behind it where the way has passed it; yet it overlaps nothing.
    gap = max(dot(nearest.normal, flier.position - nearest.point) - radius, S(0));
  }
  meeting = {nearest.point, nearest.normal, gap};
  return true;
}

/// [m/s] Returns the velocity of the body's matter.
template <class S> ISO_INLINE Vec3<S> ParticleCoupling<S>::velocity_at(const Met& met, Vec3<S> arm) const {
  return saturating_add(met.velocity, detail::saturating_moment(met.angular_velocity, arm));
}

template <class S>
void ParticleCoupling<S>::add_touch(std::uint32_t place, const Material<S>& material, const Flier& flier,
                                    const Meeting& meeting) {
  Met& met = met_[place];
  const Vec3<U> normal = -meeting.outward;
  const Vec3<S> arm = meeting.point - met.centre;
  // A belt runs along the surface, whatever it was told.
  const Vec3<S> belt = material.surface_velocity;
  const Vec3<S> surface = saturating_add(velocity_at(met, arm), belt - meeting.outward * dot(meeting.outward, belt));
  Material<S> own;
  own.friction = flier.material->friction;
  own.restitution = flier.material->restitution;
  const MixedMaterial<S> mixed = mix(own, material);
  // All fields at once: empty braces would call a constructor, a weak function that other objects have too.
  const Vec3<S> none = Vec3<S>::zero();
  const ParticleTouch<S> touch = {flier.id,       normal,
                                  meeting.gap,    convert<V>(held_within(surface, ParticleLimits<S>::speed())),
                                  none,           InverseMass<S>(0),
                                  mixed.friction, mixed.restitution};
  const Along still = {none, none, none};
  Touching touching = {
      touch, place, arm,  flier.inverse_mass, still, S(0), S(0), S(0), surface, S(0), S(0), S(0), S(0), S(0),
      S(0),  S(0),  kNone};
  const auto index = static_cast<std::uint32_t>(touching_.size());
  if (met.moves) {
    weigh(met, touching, surface, dot(normal, flier.velocity));
    if (met.first_touch == kNone) met.first_touch = index;
    else touching_[met.last_touch].next = index;
    met.last_touch = index;
  }
  touching_.push_back(touching);
}

// ---- pushing

template <class S> void ParticleCoupling<S>::push_bodies(World<S>& bodies, const ParticleWorld<S>& particles) {
  const std::vector<Vec3<S>>& impulses = particles.events().touch_impulses;
  for (std::size_t i = 0; i < touching_.size(); ++i) {
    Met& met = met_[touching_[i].met];
    const Vec3<S> impulse = impulses[first_touch_ + i];
    met.impulse = saturating_add(met.impulse, impulse);
    met.moment = saturating_add(met.moment, detail::saturating_moment(touching_[i].arm, impulse));
  }
  const Vec3<S> none = Vec3<S>::zero();
  for (const Met& met : met_) {
    if (!met.moves || (met.impulse == none && met.moment == none)) continue;
    if (is_unfelt(bodies, met)) {
      ++report_.unfelt;
      continue;
    }
    // The impulse that bears its weight acts over the step, as weight does, and rest is rest at every instant; the
    // remainder is a blow.
    const U share = bearing_share(met);
    const Vec3<S> borne = met.impulse * share, borne_moment = met.moment * share;
    const Vec3<S> blow = met.impulse - borne, blow_moment = met.moment - borne_moment;
    const S rate = S(hz_);
    bool pushed = false;
    if (U(0) < share) {
      pushed = bodies.apply_force(met.body, detail::saturating_product(borne, rate),
                                  detail::saturating_product(borne_moment, rate));
    }
    if (blow != none || blow_moment != none) pushed = bodies.apply_impulse(met.body, blow, blow_moment) || pushed;
    if (pushed) ++report_.pushed;
  }
}

/// [1] Returns the share of a body's impulse that is its weight within a step, if the impulse is upwards.
template <class S> Unit<S> ParticleCoupling<S>::bearing_share(const Met& met) const {
  if (!(dot(met.impulse, met.gravity) < S(0))) return U(0);
  const S weight = saturate_to<S>(product(max_abs(met.gravity) * step_, met.mass));
  const S got = length(met.impulse);
  return got <= weight ? U(1) : divide_to<U>(weight, got);
}

/// Returns true if the body rests and its impulse is below the unfelt share of its weight within a step: a body that
/// particles bear gets all of that.
template <class S> bool ParticleCoupling<S>::is_unfelt(const World<S>& bodies, const Met& met) const {
  if (!met.rests || !(S(0) < settings_.unfelt)) return false;
  const S gained = max_abs(bodies.settings().gravity) * step_;  // [m/s]
  return max_abs(met.impulse) <= saturate_to<S>(product(saturate_to<S>(product(gained, met.mass)), settings_.unfelt));
}

}  // namespace isostep
