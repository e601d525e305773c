// Bodies of carriers.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/lower_bound.hpp"
#include "isostep/dynamics/carriers.hpp"
#include "isostep/dynamics/solvers/step_context.hpp"

namespace isostep {

namespace detail {
/// [1] Returns the turn of a sub-step.
template <class S> Vec3<Unit<S>> turn_at(Vec3<Velocity<S>> angular_velocity, std::int32_t rate) {
  using V = Velocity<S>;
  const V fastest = angular_speed_limit<S>(rate);
  const Step<S> h = divide_to<Step<S>>(S(1), S(rate));
  const auto turn = [&](V w) { return round_to<Unit<S>>(product(clamp(w, -fastest, fastest), h)); };
  return {turn(angular_velocity.x), turn(angular_velocity.y), turn(angular_velocity.z)};
}
}  // namespace detail

template <class S>
void Carriers<S>::update(std::span<const BodyState<S>> states, std::span<const BodyProperties<S>> properties,
                         std::span<const ContactGeometry<S>> geometry, std::int32_t rate,
                         std::span<const Contact<S>> contacts, const Belts<S>* belts) {
  find_carriers(states, properties, rate);
  carried_.clear();
  belts_ = belts != nullptr && belts->any_turns() ? belts : nullptr;
  if (carriers_.empty() && belts_ == nullptr) return;
  for (std::uint32_t i = 0; i < geometry.size(); ++i) {
    const std::size_t before = carried_.size();
    const bool added = add_on_carrier(i, geometry[i]);
    if (belts_ == nullptr) continue;
    if (!added) add_on_belt(i, contacts[i].key, geometry[i], rate);
    if (before < carried_.size()) spin_on_belts(contacts[i].key, carried_.back());
  }
}

template <class S> bool Carriers<S>::add_on_carrier(std::uint32_t contact, const ContactGeometry<S>& g) {
  for (const bool on_b : {false, true}) {
    const std::uint32_t row = on_b ? g.row_b : g.row_a, rider = on_b ? g.row_a : g.row_b;
    const std::size_t at = lower_bound(carriers_.size(), [&](std::size_t k) { return carriers_[k].row < row; });
    if (at == carriers_.size() || carriers_[at].row != row) continue;
    const Vec3<S> a_to_b = g.points[0].arm_a - g.points[0].arm_b;
    carried_.push_back({contact, rider, carriers_[at], on_b ? -a_to_b : a_to_b, g.material.surface_velocity, on_b});
    return true;  // two carriers on each other move nothing
  }
  return false;
}

/// Adds a contact on a turning belt. Of two belts on each other the first carries along its arc.
template <class S>
void Carriers<S>::add_on_belt(std::uint32_t contact, const ContactKey& key, const ContactGeometry<S>& g,
                              std::int32_t rate) {
  for (const bool on_b : {false, true}) {
    const Belt<S>* const belt = on_b ? belts_->find(key.body_b, key.child_b) : belts_->find(key.body_a, key.child_a);
    if (belt == nullptr || !belt->turns()) continue;
    const std::uint32_t row = on_b ? g.row_b : g.row_a, rider = on_b ? g.row_a : g.row_b;
    const Vec3<Velocity<S>> w = convert<Velocity<S>>(belt->angular);
    const Vec3<S> a_to_b = g.points[0].arm_a - g.points[0].arm_b;
    carried_.push_back({contact, rider, Carrier<S>::of(row, w, detail::turn_at<S>(w, rate), rate),
                        (on_b ? -a_to_b : a_to_b) + belt->from_origin, g.material.surface_velocity, on_b});
    return;
  }
}

template <class S> void Carriers<S>::spin_on_belts(const ContactKey& key, Carried<S>& carried) const {
  const Belt<S>*a = belts_->find(key.body_a, key.child_a), *b = belts_->find(key.body_b, key.child_b);
  Vec3<S> spin = b != nullptr ? b->angular : Vec3<S>::zero();
  if (a != nullptr) spin -= a->angular;
  carried.spin = convert<Velocity<S>>(held_within(spin, Limits<S>::angular_speed()));
}

template <class S>
void Carriers<S>::find_carriers(std::span<const BodyState<S>> states, std::span<const BodyProperties<S>> properties,
                                std::int32_t rate) {
  using V = Velocity<S>;
  carriers_.clear();
  for (std::size_t i = 0; i < states.size(); ++i) {
    const BodyProperties<S>& body = properties[i];
    if (body.type != BodyType::kinematic) continue;
    Vec3<V> angular_velocity = states[i].angular_velocity;
    for (int axis = 0; axis < 3; ++axis) {
      if ((body.flags & (body_flag::kLockAngularX << axis)) != 0) angular_velocity[axis] = V(0);
    }
    if (angular_velocity == Vec3<V>::zero()) continue;
    carriers_.push_back(Carrier<S>::of(static_cast<std::uint32_t>(i) + 1, angular_velocity,
                                       detail::turn_at<S>(angular_velocity, rate), rate));
  }
}

}  // namespace isostep
