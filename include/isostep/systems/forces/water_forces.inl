// Bodies of body_forces.hpp: what floats.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/geometry/submersion.hpp"
#include "isostep/systems/forces/body_forces.hpp"

namespace isostep {
namespace detail {

inline constexpr double kTurn = 2 * kPi;

/// Where in its circle a wave is after so many sub-steps of h [s]: the same error after an hour as after a second,
/// for a sub-step's part of a turn is rounded once, to 2^-32 of it.
template <class S> S wave_angle(std::uint64_t substeps, Step<S> h, S period) {
  const auto part = static_cast<std::uint64_t>(nearest_scaled(divide_to<Unit<S>>(h, period), 32));
  return from_lattice<S>(static_cast<std::int64_t>(substeps * part & 0xffffffffu), 32) * S(kTurn);
}

}  // namespace detail

/// The water's plane above or below a point.
template <class S> typename BodyForces<S>::Surface BodyForces<S>::surface_at(const Water<S>& water, Vec3<S> at) const {
  const Vec3<U> up = -heading_of(state_.settings.gravity).direction;
  const S depth = water.surface_height - dot(up, at);
  if (!(S(0) < water.wave_height)) return {up, depth, water.current};
  const Vec3<U> along = water.wave_direction - up * dot(up, water.wave_direction);
  const S number = S(detail::kTurn) / water.wave_length, speed = S(detail::kTurn) / water.wave_period;
  const S phase = saturate_to<S>(product(dot(along, at), number)) -
                  detail::wave_angle<S>(state_.tick * substeps_ + substep_, h_, water.wave_period);
  const SinCos<S> wave = sin_cos(phase);
  const S height = water.wave_height, slope = saturate_to<S>(product(height * number, wave.cos));
  const Vec3<U> normal = normalise(convert<S>(up) - along * slope);
  // Of deep water, at its surface: circles, forward on the crest.
  const Vec3<S> circling = along * (height * speed * wave.sin) - up * (height * speed * wave.cos);
  return {normal, (depth + height * wave.sin) * dot(normal, up), saturating_add(water.current, circling)};
}

/// What a body displaces at a sub-step's pose, all its parts together; overlaps count twice, as in its mass.
template <class S>
typename BodyForces<S>::Wet BodyForces<S>::wet_part(std::uint32_t row, S density, const Surface& surface) const {
  const BodyState<S>& state = state_.awake.states[row - 1];
  const BodyProperties<S>& body = state_.awake.properties[row - 1];
  const Mat3<U> turn = to_matrix(state.orientation);
  const Transform<S> origin = {-(turn * body.local_centre), turn};
  Wet wet = {S(0), Vec3<S>::zero(), row, nullptr, Vec3<S>::zero()};
  for (const Child<S>& child : map_.children_of(body.shape)) {
    const Transform<S> at = compose(origin, Transform<S>::of(child.pose));
    const ShapeView<S> part = map_.contents().view(child.primitive);
    const Vec3<U> up = transposed_times(at.rotation, surface.normal);
    const Submersion<S> sunk = submersion<S>(part, up, surface.depth - dot(surface.normal, at.position));
    if (!(U(0) < sunk.share)) continue;
    const S whole = visit_shape(part, [&](const auto& shape) { return shape.mass(density); });
    const S mass = whole * sunk.share;
    if (!(S(0) < mass)) continue;
    wet.mass = saturating_add(wet.mass, mass);
    wet.arm += (at.position + at.rotation * sunk.centre - wet.arm) * divide_to<U>(mass, wet.mass);
  }
  return wet;
}

template <class S> void BodyForces<S>::act(const Water<S>& water) {
  const Heading<S> down = heading_of(state_.settings.gravity);
  if (!(S(0) < down.length)) return;
  for (std::uint32_t row = 1; row < bodies_->mass.size(); ++row) {
    if (!is_pushed(row, water.mask)) continue;
    const BodyState<S>& state = state_.awake.states[row - 1];
    const Aabb<S> box = water.replaces ? Aabb<S>{state.centre, state.centre} : state.fat;
    if (!in_region(water, box) || is_dry(row, water.priority, state.centre)) continue;
    const Surface surface = surface_at(water, state.centre);
    // The box is where the step began, with its margin: what of it is dry stays so for a sub-step's motion.
    const Vec3<S> reach = max(abs(state.fat.high - state.centre), abs(state.fat.low - state.centre));
    if (surface.depth <= -dot(abs(surface.normal), reach)) continue;
    Wet wet = wet_part(row, water.density, surface);
    if (!(S(0) < wet.mass)) continue;
    const S weight = saturate_to<S>(product(wet.mass, down.length));
    push(row, surface.normal * weight, wet.arm);
    wet.water = &water, wet.flow = surface.velocity;
    wet_.push_back(wet);
  }
}
template <class S> void BodyForces<S>::resist(const Wet& wet) {
  const Water<S>& water = *wet.water;
  const MotionRow<Velocity<S>>& v = bodies_->velocity[wet.row];
  const End end = {wet.row, state_.awake.states[wet.row - 1].centre + wet.arm, wet.arm,
                   convert<S>(v.linear) + cross(convert<S>(v.angular), wet.arm)};
  const S speed = length(end.velocity - wet.flow);
  const S rate = saturating_add(water.linear_drag, saturate_to<S>(product(water.quadratic_drag, speed)));
  if (S(0) < rate) {
    const S c = -saturate_to<S>(product(rate, wet.mass));
    const Vec3<S> next = next_velocity(wet.row) + cross(next_angular_velocity(wet.row), wet.arm) - wet.flow;
    push(end, settled(end, Mat3<U>::identity(), Mat3<S>::diagonal({c, c, c}), next));
  }
  if (!(S(0) < water.angular_drag)) return;
  const S share = wet.mass / max(bodies_->mass[wet.row].mass, wet.mass);
  slow_turning(wet.row, next_angular_velocity(wet.row), water.angular_drag * share);
}

/// Whether a zone or a higher water keeps water of a priority away from a point of a body.
template <class S> bool BodyForces<S>::is_dry(std::uint32_t row, std::int32_t priority, Vec3<S> point) const {
  const std::uint32_t category = state_.awake.properties[row - 1].filter.category;
  if (is_hidden(zone_effect::kWater, priority, category, point)) return true;
  const auto& waters = state_.records->waters;
  for (std::size_t i = water_ranks_.size(); i-- > 0;) {
    const Water<S>& water = waters.all()[water_ranks_[i] & 0xffffffffu];
    if (water.priority <= priority) return false;
    if (water.replaces && (category & water.mask) != 0 && in_region<S>(water, {point, point})) return true;
  }
  return false;
}
/// Whether a point of a body is under water, and how that flows.
template <class S> bool BodyForces<S>::is_under_water(std::uint32_t row, Vec3<S> point, Vec3<S>& velocity) const {
  bool under = false;
  velocity = Vec3<S>::zero();
  if (state_.settings.gravity == Vec3<S>::zero()) return false;
  const std::uint32_t category = state_.awake.properties[row - 1].filter.category;
  for_each_taken(state_.records->waters, [&](const Water<S>& water) {
    if ((category & water.mask) == 0) return;
    if (!in_region(water, Aabb<S>{point, point}) || is_dry(row, water.priority, point)) return;
    const Surface surface = surface_at(water, point);
    if (!(S(0) < surface.depth)) return;
    under = true;
    velocity = saturating_add(velocity, surface.velocity);
  });
  velocity = held_within(velocity, Limits<S>::speed());
  return under;
}

}  // namespace isostep
