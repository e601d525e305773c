// Bodies of body_forces.hpp: explosions.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/query/closest_point.hpp"
#include "isostep/collision/query/ray_cast.hpp"
#include "isostep/systems/forces/body_forces.hpp"

namespace isostep {
namespace detail {

/// [m] The wave's profile from its front, -w - k w, to y: rises over k w, stands for w, falls over k w. A force that
/// passes by at speed s gives force / s times the difference.
template <class S> S wave_passed(S y, S width, S ramp) {
  const S length = width * ramp;
  const auto half_square = [&](S part)
                               ISO_INLINE_LAMBDA { return S(0) < length ? S(0.5) * (part * (part / length)) : S(0); };
  if (y <= -width - length) return S(0);
  if (y < -width) return half_square(y + width + length);
  const S risen = S(0.5) * length;
  if (y < S(0)) return risen + y + width;
  if (y < length) return risen + width + risen - half_square(length - y);
  return risen + width + risen;
}
/// [1/s^0] Seconds since an explosion's begin, as a sub-step finds it; below 0: it is still to come.
template <class S>
S seconds_since(std::uint64_t begin, std::uint64_t tick, std::int32_t hz, std::uint32_t substep, std::int32_t rate) {
  if (tick < begin) return S(-1);
  const std::uint64_t steps = tick - begin, whole = steps / static_cast<std::uint32_t>(hz);
  const auto rest = static_cast<std::int32_t>(steps % static_cast<std::uint32_t>(hz));
  const std::int32_t part = rest * (rate / hz) + static_cast<std::int32_t>(substep);
  constexpr std::uint64_t kMost = 16384;  // [s] more than any explosion lasts
  return S(static_cast<int>(min(whole, kMost))) + divide_to<S>(S(part), S(rate));
}

}  // namespace detail

/// The nearest point of a body's surface, from its centre of mass.
template <class S> Vec3<S> BodyForces<S>::exposed_point(std::uint32_t row, Vec3<S> from) const {
  const BodyState<S>& state = state_.awake.states[row - 1];
  const BodyProperties<S>& body = state_.awake.properties[row - 1];
  const Mat3<U> turn = to_matrix(state.orientation);
  const Transform<S> origin = {-(turn * body.local_centre), turn};
  const Vec3<S> query = from - state.centre;
  Vec3<S> nearest = Vec3<S>::zero();
  S least = highest<S>();
  for (const Child<S>& child : map_.children_of(body.shape)) {
    const Transform<S> at = compose(origin, Transform<S>::of(child.pose));
    const ClosestPoint<S> found = closest_point<S>(map_.contents().view(child.primitive), at, query);
    if (!(found.distance < least)) continue;
    least = found.distance;
    nearest = found.point;
  }
  return S(0) < least ? nearest : Vec3<S>::zero();
}

/// Whether a static body stands between two points.
template <class S> bool BodyForces<S>::is_shielded(Vec3<S> from, Vec3<S> to) const {
  bool hit = false;
  const Vec3<S> way = to - from;
  proxies_.boxes().sweep(Sweep<S>{from, way, Vec3<S>::zero(), U(1)}, [&](std::uint32_t slot, U most) {
    const Location location = map_.location(slot);
    if (hit || location.set != Location::kStatic) return most;
    const BodyProperties<S>& body = map_.properties_at(location);
    if ((body.flags & body_flag::kCollide) == 0 || (body.flags & body_flag::kSensor) != 0) return most;
    const Transform<S> placed = Transform<S>::of(BodyMap<S>::origin_pose(map_.state_at(location), body));
    for (const Child<S>& child : map_.children_of(body.shape)) {
      RayHit<S> found;
      const Transform<S> at = compose(placed, Transform<S>::of(child.pose));
      hit = hit ||
            (ray_cast<S>(map_.contents().view(child.primitive), at, from, way, S(1), found, true) && !found.inside);
    }
    return most;
  });
  return hit;
}

/// [N] outwards on a point so far from the centre, which flees at that speed, over a sub-step that begins `t` after
/// the blast. `above` [m]: of the point over the centre; `aside` [m] of it from the axis.
template <class S> S BodyForces<S>::blast(const Explosion<S>& e, S t, S distance, S fleeing, S above, S aside) const {
  SumOf<S, S> force = product(S(0), S(0));
  if (t < e.implosion_duration) {
    if (e.implosion_least < distance && distance < e.implosion_most) force = force - product(e.implosion_force, S(1));
    return saturate_to<S>(force);
  }
  const S since = t - e.implosion_duration;
  if (since < e.wave_duration) {
    const S before = e.wave_speed * since - distance, travelled = e.wave_speed * h_;
    const S passed = detail::wave_passed(before + travelled, e.wave_width, e.wave_ramp) -
                     detail::wave_passed(before, e.wave_width, e.wave_ramp);
    const S fade = S(1) - since / e.wave_duration;
    const S chase = max(S(0), S(1) - clamp(fleeing / e.wave_speed, S(-1), S(1)));
    force = force + product(e.wave_force, (passed / travelled) * (fade * chase));
  }
  if (since < e.chimney_duration && aside < e.chimney_radius && S(0) < above && above < e.chimney_height)
    force = force + product(e.chimney_force, S(1) - aside / e.chimney_radius);
  return saturate_to<S>(force);
}

template <class S> void BodyForces<S>::act(const Explosion<S>& explosion) {
  const S t = detail::seconds_since<S>(explosion.begin, state_.tick, state_.settings.hz, substep_, rate_);
  if (t < S(0) || explosion.duration() <= t) return;
  const Vec3<U> up = -heading_of(state_.settings.gravity).direction;
  for (std::uint32_t row = 1; row < bodies_->mass.size(); ++row) {
    if (!is_pushed(row, explosion.mask)) continue;
    const Vec3<S> arm = exposed_point(row, explosion.centre), centre = state_.awake.states[row - 1].centre;
    const Vec3<S> from_blast = centre + arm - explosion.centre;
    const Heading<S> way = heading_of(from_blast);
    if (!(S(0) < way.length)) continue;
    const MotionRow<Velocity<S>>& v = bodies_->velocity[row];
    const S fleeing = dot(convert<S>(v.linear) + cross(convert<S>(v.angular), arm), way.direction);
    const S above = up == Vec3<U>::zero() ? S(-1) : dot(up, from_blast);
    const S force = blast(explosion, t, way.length, fleeing, above, length(from_blast - up * above));
    if (force == S(0) || (explosion.is_shielded && is_shielded(explosion.centre, centre + arm))) continue;
    push(row, way.direction * force, arm);
  }
}

/// Explosions that ended with this step are gone.
template <class S> void BodyForces<S>::remove_ended() {
  const auto& explosions = state_.records->explosions;
  for (std::uint32_t slot = 0; slot < explosions.all().size(); ++slot) {
    if (!explosions.is_taken(slot)) continue;
    const Explosion<S>& e = explosions.all()[slot];
    const S t = detail::seconds_since<S>(e.begin, state_.tick + 1, state_.settings.hz, 0, state_.settings.hz);
    if (e.duration() <= t) state_.records.change().explosions.remove_at(slot);
  }
}

}  // namespace isostep
