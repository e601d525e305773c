// Bodies of energy_bound.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/body_inertia.hpp"
#include "isostep/dynamics/solvers/energy_bound.hpp"

namespace isostep {

template <class S> void EnergyBound<S>::begin(const StepContext<S>& context, Step<S> h, bool binds_joints) {
  h_ = h;
  const std::size_t bodies = context.states.size();
  kinds_.assign(bodies + 1, 0);
  leaders_.resize(bodies + 1);
  for (std::size_t row = 0; row <= bodies; ++row) leaders_[row] = static_cast<std::uint32_t>(row);
  for (std::size_t i = 0; i < context.contacts.size(); ++i) {
    const ContactGeometry<S>& g = context.geometry[i];
    tie(context, g.row_a, g.row_b, g.material.surface_velocity == Vec3<S>::zero() ? kNothing : kFree);
  }
  for (const Carried<S>& carried : context.carried) kinds_[carried.rider] |= kFree;
  for (const ContactResponse<S>& response : context.responses) {
    const ContactGeometry<S>& g = context.geometry[response.contact];
    tie(context, g.row_a, g.row_b, kFree);
  }
  for (std::size_t i = 0; i < context.joint_ends.size(); ++i) {
    const JointEnds<S>& ends = context.joint_ends[i];
    const bool is_driven = (context.joint_properties[i].flags & (joint_flag::kMotor | joint_flag::kSpring)) != 0;
    tie(context, ends.a.row, ends.b.row, is_driven || !binds_joints ? kFree : kHangs);
  }
  for (const JointAxisDrive<S>& axis : context.axis_drives) {
    const JointEnds<S>& ends = context.joint_ends[axis.joint];
    tie(context, ends.a.row, ends.b.row, kFree);
  }
  for (const std::uint32_t row : context.mechanisms.bodies) kinds_[row] |= kFree;
  find_groups(context);
  for (const Group group : groups_) weigh(context, group);
}

/// Ties two bodies. Of bodies that are not dynamic those that stand still do no work; all others drive the group.
template <class S>
void EnergyBound<S>::tie(const StepContext<S>& context, std::uint32_t a, std::uint32_t b, std::uint8_t kind) {
  bool is_one = true;
  for (const std::uint32_t row : {a, b}) {
    if (row != 0 && context.properties[row - 1].type == BodyType::dynamic) continue;
    is_one = false;
    const bool stands = row == 0 || (context.states[row - 1].velocity == Vec3<V>::zero() &&
                                     context.states[row - 1].angular_velocity == Vec3<V>::zero());
    kind |= stands ? kStands : kFree;
  }
  kinds_[a] |= kind;
  kinds_[b] |= kind;
  if (!is_one) return;
  const std::uint32_t of_a = leader_of(a), of_b = leader_of(b);
  leaders_[max(of_a, of_b)] = min(of_a, of_b);
}
template <class S> std::uint32_t EnergyBound<S>::leader_of(std::uint32_t row) {
  while (leaders_[row] != row) row = leaders_[row] = leaders_[leaders_[row]];
  return row;
}

template <class S> void EnergyBound<S>::find_groups(const StepContext<S>& context) {
  const std::size_t rows = kinds_.size();
  sizes_.assign(rows, 0);
  weights_.assign(rows - 1, V(0));
  groups_.clear();
  groups_.reserve(rows);
  members_.reserve(rows);
  for (std::uint32_t row = 1; row < rows; ++row) {
    const std::uint32_t leader = leader_of(row);
    leaders_[row] = leader;
    kinds_[leader] |= kinds_[row];
    ++sizes_[leader];
  }
  std::uint32_t count = 0;
  for (std::uint32_t row = 1; row < rows; ++row) {
    if (leaders_[row] != row) continue;
    const std::uint8_t kinds = kinds_[row];
    const bool is_bound = (kinds & (kStands | kFree)) == kStands && sizes_[row] <= kMost;
    if (!is_bound || context.properties[row - 1].type != BodyType::dynamic) {
      sizes_[row] = 0;
      continue;
    }
    groups_.push_back({count, count, (kinds & kHangs) != 0});
    count += sizes_[row];
    sizes_[row] = static_cast<std::uint32_t>(groups_.size());
  }
  members_.resize(count);
  for (std::uint32_t row = 1; row < rows; ++row) {
    const std::uint32_t group = sizes_[leaders_[row]];
    if (group != 0) members_[groups_[group - 1].end++] = row - 1;
  }
  radii_.resize(rows - 1);
  allowed_.resize(rows - 1);
  begin_.resize(rows - 1);
}

/// Finds the weights: roots of mass shares that sum to at most 1. The weight of a single body is 1.
template <class S> void EnergyBound<S>::weigh(const StepContext<S>& context, Group group) {
  S heaviest = S(0);
  for (std::uint32_t i = group.first; i < group.end; ++i)
    heaviest = max(heaviest, context.properties[members_[i]].mass);
  V part = V(1);
  for (std::uint32_t most = 1; most < group.end - group.first; most *= 4) part = part * V(0.5);
  for (std::uint32_t i = group.first; i < group.end; ++i) {
    const std::uint32_t body = members_[i];
    const S mass = context.properties[body].mass;
    weights_[body] = mass < heaviest ? part * convert<V>(sqrt(divide_to<Unit<S>>(mass, heaviest))) : part;
    const auto radius = [](S kappa) { return S(0) < kappa ? divide_to<S>(S(1), sqrt(kappa)) : S(0); };
    const Vec3<S> kappa = context.properties[body].kappa;
    radii_[body] = {radius(kappa.x), radius(kappa.y), radius(kappa.z)};
    const BodyState<S>& state = context.states[body];
    allowed_[body] = energy_of(motion_of(context, body, state.velocity, state.angular_velocity));
    begin_[body] = state.velocity;
  }
}

template <class S>
void EnergyBound<S>::add_work(const StepContext<S>& context, const SolverBodies<S>& rows, std::size_t first,
                              std::size_t end) {
  if (!any()) return;
  const auto over = [h = h_](const Vec3<S>& a) {
    return Vec3<V>{round_to<V>(product(a.x, h)), round_to<V>(product(a.y, h)), round_to<V>(product(a.z, h))};
  };
  for (std::size_t body = first; body < end; ++body) {
    const Acceleration<S>& asked = context.accelerations[body];
    const bool is_asked = !(asked.linear == Vec3<S>::zero()) || !(asked.angular == Vec3<S>::zero());
    if (weights_[body] == V(0) || !is_asked) continue;
    const MotionRow<V>& row = rows.velocity[body + 1];
    const Motion before = motion_of(context, body, row.linear, row.angular),
                 after = motion_of(context, body, row.linear + over(asked.linear), row.angular + over(asked.angular));
    allowed_[body] = allowed_[body] + energy_of(after) - energy_of(before);
  }
}

template <class S> void EnergyBound<S>::hold(const StepContext<S>& context, const SolverBodies<S>& rows) const {
  for (const Group group : groups_) hold_group(context, rows, group);
}
template <class S>
void EnergyBound<S>::hold_group(const StepContext<S>& context, const SolverBodies<S>& rows, Group group) const {
  Energy is = {}, gain = {}, most = {};
  V speed = V(0);
  for (std::uint32_t i = group.first; i < group.end; ++i) {
    const std::uint32_t body = members_[i];
    const BodyState<S>& state = context.states[body];
    const Motion motion = motion_of(context, body, state.velocity, state.angular_velocity);
    const Vec3<V> gravity = gravity_of(context, body);
    const Vec3<V> way = rows.displacement[body + 1].linear * weights_[body];
    // A fall of eight sub-steps is rounded by so much: without it the format would hold what begins to tip.
    const Energy rounding = product(max_abs(gravity), V(16) * convert<V>(resolution<S>()));
    const Energy energy = energy_of(motion);
    is = is + energy;
    gain = gain + energy - allowed_[body] - dot_sum(gravity, way + way) - rounding;
    if (group.hangs) gain = gain + lag_of(context, body);
    const V turn = min(length(state.angular_velocity) / convert<V>(S(context.hz)), V(1));
    const V radius = convert<V>(max_abs(radii_[body])) * weights_[body];
    most = most + energy_of({motion.v * turn, motion.u * turn}) + product(length(gravity) * turn, radius * turn);
    speed = length(Vec3<V>{speed, length(motion.v), length(motion.u)});
  }
  if (!group.hangs && most < gain) gain = most;
  if (!(Energy{} < gain)) return;
  V keep = V(0);
  if (gain < is && V(0) < speed) {
    const V x = min(divide_to<V>(divide_to<V>(saturate_to<V>(gain), speed), speed), V(1));
    keep = V(1) - V(0.5) * x * (V(1) + x);  // the root of 1 - x, or less
  }
  for (std::uint32_t i = group.first; i < group.end; ++i) {
    BodyState<S>& state = context.states[members_[i]];
    state.velocity = state.velocity * keep;
    state.angular_velocity = state.angular_velocity * keep;
  }
}

template <class S> Vec3<Velocity<S>> EnergyBound<S>::gravity_of(const StepContext<S>& context, std::size_t body) const {
  const S scale = context.properties[body].gravity_scale;
  const auto pull = [&](S g) { return saturate_to<V>(product(g, scale)) * weights_[body]; };
  return {pull(context.gravity.x), pull(context.gravity.y), pull(context.gravity.z)};
}
/// Returns by how much h g v has grown, except in free fall.
template <class S>
typename EnergyBound<S>::Energy EnergyBound<S>::lag_of(const StepContext<S>& context, std::size_t body) const {
  const auto over = [h = h_](V g) { return round_to<V>(product(g, h)); };
  const Vec3<V> g = gravity_of(context, body), step = {over(g.x), over(g.y), over(g.z)};
  const V steps = V(1) / convert<V>(S(context.hz)), little = max_abs(g) * steps * V(0.00390625);
  const Vec3<V> change = (context.states[body].velocity - begin_[body]) * weights_[body];
  if (max_abs(change - g * steps) <= little) return {};
  return dot_sum(step, change);
}

/// Holds it within a published limit, of which six squares fit: a pass may leave speeds beyond it.
template <class S>
typename EnergyBound<S>::Motion EnergyBound<S>::motion_of(const StepContext<S>& context, std::size_t body,
                                                          Vec3<V> velocity, Vec3<V> angular_velocity) const {
  const BodyProperties<S>& properties = context.properties[body];
  const V most = convert<V>(Limits<S>::surface_speed()), weight = weights_[body];
  Vec3<V> w = angular_velocity;
  if ((properties.flags & body_flag::kSpins) != 0)
    w = transposed_times(detail::world_axes(context.states[body].orientation, properties), w);
  const auto along = [](S radius, V speed) ISO_INLINE_LAMBDA { return saturate_to<V>(product(radius, speed)); };
  const Vec3<S> radii = radii_[body];
  const Vec3<V> u = {along(radii.x, w.x), along(radii.y, w.y), along(radii.z, w.z)};
  return {held_within(velocity, most) * weight, held_within(u, most) * weight};
}

}  // namespace isostep
