// Bodies of force_sums.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/force_bounds.hpp"
#include "isostep/systems/forces/force_sums.hpp"

namespace isostep {

namespace detail {
template <class S> ISO_INLINE Acceleration<S> difference(const Acceleration<S>& a, const Acceleration<S>& b) {
  return {saturating_subtract(a.linear, b.linear), saturating_subtract(a.angular, b.angular)};
}
}  // namespace detail

template <class S> void ForceSums<S>::begin_step(bool any_acts) {
  accelerations_.clear();
  pulls_.clear();
  cut_.clear();
  cut_count_ = 0;
  const Acceleration<S> none = {Vec3<S>::zero(), Vec3<S>::zero()};
  if (state_.forces.empty() && !any_acts) return;
  accelerations_.assign(state_.awake.states.size(), none);
  for (const PendingForce<S>& force : state_.forces) {
    const std::uint32_t index = map_.location(force.slot).index;
    accelerations_[index] = {force.linear, force.angular};
    note_cut(index + 1, force.cut != 0);
  }
  state_.forces.clear();
  asked_ = accelerations_;
}
template <class S> void ForceSums<S>::begin_substep() {
  accelerations_ = asked_;
  pulls_.assign(bodies_.when().is_last() ? accelerations_.size() : 0, {Vec3<S>::zero(), Vec3<S>::zero()});
}
template <class S> void ForceSums<S>::end_substep() {
  for (std::size_t i = 0; i < pulls_.size(); ++i) pulls_[i] = detail::difference(accelerations_[i], pulls_[i]);
}
template <class S> template <class Act> void ForceSums<S>::bear(const Act& act) {
  if (!bodies_.when().is_last()) return act();
  before_ = accelerations_;
  act();
  for (std::size_t i = 0; i < pulls_.size(); ++i) {
    const Acceleration<S> borne = detail::difference(accelerations_[i], before_[i]);
    pulls_[i] = {saturating_add(pulls_[i].linear, borne.linear), saturating_add(pulls_[i].angular, borne.angular)};
  }
}

template <class S> S ForceSums<S>::most() const {
  return detail::most_acceleration(bodies_.when().rate, Limits<S>::speed());
}
template <class S> S ForceSums<S>::most_turning(std::uint32_t row) const {
  return detail::most_acceleration(bodies_.when().rate, detail::most_angular_speed(bodies_.solid_box(row)));
}
template <class S> void ForceSums<S>::note_cut(std::uint32_t row, bool cut) {
  if (!cut || cut_.test(row - 1)) return;
  cut_.set(row - 1);
  ++cut_count_;
}

template <class S> void ForceSums<S>::accelerate(std::uint32_t row, Vec3<S> acceleration) {
  const S limit = most();
  detail::Bounder<S> bounder;
  Vec3<S>& linear = accelerations_[row - 1].linear;
  for (int axis = 0; axis < 3; ++axis) acceleration[axis] = bounder.held(acceleration[axis], limit);
  linear = bounder.sum(linear, acceleration, limit);
  note_cut(row, bounder.cut);
}
template <class S> void ForceSums<S>::push(std::uint32_t row, Vec3<S> force, Vec3<S> arm) {
  if (!bodies_.moves(row)) return;
  const SolverMass<S>& mass = bodies_.mass(row);
  const S limit = most(), limit_of_turning = most_turning(row);
  detail::Bounder<S> bounder;
  Acceleration<S>& sum = accelerations_[row - 1];
  sum.linear = bounder.sum(sum.linear, bounder.quotient(force, mass.mass, limit), limit);
  if (!(arm == Vec3<S>::zero())) {
    const Vec3<S> moment = detail::saturated_cross(arm, force);
    const Vec3<S> turning = bounder.turning(mass.kappa, moment, mass.mass, limit_of_turning);
    sum.angular = bounder.sum(sum.angular, turning, limit_of_turning);
  }
  note_cut(row, bounder.cut);
}
template <class S> void ForceSums<S>::slow(std::uint32_t row, Vec3<S> motion, S rate) {
  const auto part = [rate](S x) { return saturate_to<S>(product(x, rate)); };
  accelerate(row, -Vec3<S>{part(motion.x), part(motion.y), part(motion.z)});
}
template <class S> void ForceSums<S>::slow_turning(std::uint32_t row, Vec3<S> turning, S rate) {
  Acceleration<S>& sum = accelerations_[row - 1];
  const S limit = detail::most_acceleration(bodies_.when().rate, Limits<S>::angular_speed());
  detail::Bounder<S> bounder;
  const auto against = [&](S x) { return bounder.rounded(product(x, -rate), limit); };
  const Vec3<S> change = {against(turning.x), against(turning.y), against(turning.z)};
  sum.angular = bounder.sum(sum.angular, change, limit);
  note_cut(row, bounder.cut);
}

}  // namespace isostep
