// Bodies of carriers.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/lower_bound.hpp"
#include "isostep/dynamics/carriers.hpp"
#include "isostep/dynamics/solvers/step_context.hpp"

namespace isostep {

template <class S>
void Carriers<S>::update(std::span<const BodyState<S>> states, std::span<const BodyProperties<S>> properties,
                         std::span<const ContactGeometry<S>> geometry, std::int32_t rate) {
  find_carriers(states, properties, rate);
  carried_.clear();
  const auto count = static_cast<std::uint32_t>(carriers_.empty() ? 0 : geometry.size());
  for (std::uint32_t i = 0; i < count; ++i) {
    const ContactGeometry<S>& g = geometry[i];
    for (const bool on_b : {false, true}) {
      const std::uint32_t row = on_b ? g.row_b : g.row_a, rider = on_b ? g.row_a : g.row_b;
      const std::size_t at = lower_bound(carriers_.size(), [&](std::size_t k) { return carriers_[k].row < row; });
      if (at == carriers_.size() || carriers_[at].row != row) continue;
      const Vec3<S> a_to_b = g.points[0].arm_a - g.points[0].arm_b;
      carried_.push_back({i, rider, carriers_[at], on_b ? -a_to_b : a_to_b, g.material.surface_velocity, on_b});
      break;  // two carriers on each other move nothing
    }
  }
}

template <class S>
void Carriers<S>::find_carriers(std::span<const BodyState<S>> states, std::span<const BodyProperties<S>> properties,
                                std::int32_t rate) {
  using V = Velocity<S>;
  carriers_.clear();
  const V fastest = angular_speed_limit<S>(rate);
  const Step<S> h = divide_to<Step<S>>(S(1), S(rate));
  const auto turn = [&](V w) { return round_to<Unit<S>>(product(clamp(w, -fastest, fastest), h)); };
  for (std::size_t i = 0; i < states.size(); ++i) {
    const BodyProperties<S>& body = properties[i];
    if (body.type != BodyType::kinematic) continue;
    Vec3<V> angular_velocity = states[i].angular_velocity;
    for (int axis = 0; axis < 3; ++axis) {
      if ((body.flags & (body_flag::kLockAngularX << axis)) != 0) angular_velocity[axis] = V(0);
    }
    if (angular_velocity == Vec3<V>::zero()) continue;
    const Vec3<Unit<S>> turned = {turn(angular_velocity.x), turn(angular_velocity.y), turn(angular_velocity.z)};
    carriers_.push_back(Carrier<S>::of(static_cast<std::uint32_t>(i) + 1, angular_velocity, turned, rate));
  }
}

}  // namespace isostep
