// Bodies of energy_bound.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/solvers/energy_bound.hpp"

namespace isostep {

template <class S> void EnergyBound<S>::find(const StepContext<S>& context, std::size_t bodies) {
  kinds_.assign(bodies + 1, 0);
  begin_.resize(bodies);
  for (std::size_t i = 0; i < context.contacts.size(); ++i) {
    const ContactGeometry<S>& g = context.geometry[i];
    const MixedMaterial<S>& m = g.material;
    const bool stands = (g.row_a == 0 || g.row_b == 0) && m.surface_velocity == Vec3<S>::zero();
    const std::uint8_t kind = stands && !(S(0) < m.restitution) ? kTouches : kFree;
    kinds_[g.row_a] |= kind;
    kinds_[g.row_b] |= kind;
  }
  for (const Carried<S>& carried : context.carried) kinds_[carried.rider] |= kFree;
  for (const JointEnds<S>& ends : context.joint_ends) {
    kinds_[ends.a.row] |= kFree;
    kinds_[ends.b.row] |= kFree;
  }
}

template <class S>
void EnergyBound<S>::begin(std::size_t body, const BodyState<S>& state, const BodyProperties<S>& properties,
                           const Mat3<Unit<S>>& axes) {
  begin_[body] = energy_of(motion_of(state.velocity, state.angular_velocity, properties, axes));
}

template <class S>
void EnergyBound<S>::hold(const StepContext<S>& context, std::size_t body, Vec3<V> displacement,
                          const Mat3<Unit<S>>& axes, MotionRow<V>& row) const {
  const BodyProperties<S>& properties = context.properties[body];
  if (!context.accelerations.empty()) {
    const Acceleration<S>& asked = context.accelerations[body];
    if (!(asked.linear == Vec3<S>::zero()) || !(asked.angular == Vec3<S>::zero())) return;
  }
  const Motion motion = motion_of(row.linear, row.angular, properties, axes);
  const auto pull = [&](S g) ISO_INLINE_LAMBDA { return saturate_to<V>(product(g, properties.gravity_scale)); };
  const Vec3<V> gravity = {pull(context.gravity.x), pull(context.gravity.y), pull(context.gravity.z)};
  const Energy is = energy_of(motion), gain = is - begin_[body] - dot_sum(gravity, displacement + displacement);
  // A fall of eight sub-steps is rounded by so much: without it the format would hold what begins to tip.
  const Energy rounding = product(max_abs(gravity), V(16) * convert<V>(resolution<S>()));
  if (!(rounding < gain)) return;
  const V speed = length(Vec3<V>{length(motion.v), length(motion.u), V(0)});
  V keep = V(0);
  if (gain < is && V(0) < speed) {
    const V x = min(divide_to<V>(divide_to<V>(saturate_to<V>(gain), speed), speed), V(1));
    keep = V(1) - V(0.5) * x * (V(1) + x);  // the root of 1 - x, or less
  }
  row.linear = row.linear * keep;
  row.angular = row.angular * keep;
}

/// Held within a published limit, of which six squares fit: a pass may leave speeds beyond it.
template <class S>
typename EnergyBound<S>::Motion EnergyBound<S>::motion_of(Vec3<V> velocity, Vec3<V> angular_velocity,
                                                          const BodyProperties<S>& body, const Mat3<Unit<S>>& axes) {
  const V most = convert<V>(Limits<S>::surface_speed());
  const Vec3<V> w = (body.flags & body_flag::kSpins) != 0 ? transposed_times(axes, angular_velocity) : angular_velocity;
  const auto along = [](S kappa, V speed) ISO_INLINE_LAMBDA {
    return S(0) < kappa ? saturate_to<V>(product(divide_to<S>(S(1), sqrt(kappa)), speed)) : V(0);
  };
  const Vec3<V> u = {along(body.kappa.x, w.x), along(body.kappa.y, w.y), along(body.kappa.z, w.z)};
  return {held_within(velocity, most), held_within(u, most)};
}

}  // namespace isostep
