// StiffSprings: which motion each takes, and the motion.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/particles/step/stiff_springs.hpp"
#include "isostep/scalar/math.hpp"

namespace isostep {

template <class S>
StiffSprings<S>::StiffSprings(ParticleState<S>& state, ParticleStep<S>& step) : state_(state), step_(step) {}

/// Counts what holds each particle besides forces: stiff springs and constraints.
template <class S> void StiffSprings<S>::count_holds(std::span<const ParticleConstraint<S>> rows) {
  holds_.assign(state_.material.size(), 0);
  const auto hold = [this](std::uint32_t slot) { holds_[slot] = min(holds_[slot] + 1u, 2u); };
  for (const std::uint32_t slot : slots_) {
    const Spring<S>& spring = state_.springs.all()[slot];
    hold(spring.a.slot);
    if (spring.b) hold(spring.b.slot);
  }
  for (const ParticleConstraint<S>& row : rows) {
    hold(row.a);
    if (row.b != kNoParticle) hold(row.b);
  }
}
template <class S> void StiffSprings<S>::prepare(std::span<const ParticleConstraint<S>> rows) {
  slots_.clear();
  oscillators_.clear();
  const std::vector<Spring<S>>& springs = state_.springs.all();
  for (const Spring<S>& spring : springs) {
    if (spring.type == SpringType::stiff && spring.a)
      slots_.push_back(static_cast<std::uint32_t>(&spring - springs.data()));
  }
  if (slots_.empty()) return;
  count_holds(rows);
  for (const std::uint32_t slot : slots_) {
    const Spring<S>& spring = springs[slot];
    const InverseMass<S> of_a = state_.inverse_mass[spring.a.slot];
    const InverseMass<S> of_b = spring.b ? state_.inverse_mass[spring.b.slot] : InverseMass<S>(0);
    const InverseMass<S> both = saturating_add(of_a, of_b);
    const bool alone = holds_[spring.a.slot] == 1 && (!spring.b || holds_[spring.b.slot] == 1);
    oscillators_.push_back(
        (alone ? oscillator_step<S> : implicit_oscillator_step<S>)(spring.stiffness, spring.damping, both, step_.rate));
  }
}

template <class S> void StiffSprings<S>::swing() {
  for (std::size_t i = 0; i < slots_.size(); ++i) swing(state_.springs.all()[slots_[i]], oscillators_[i]);
}
template <class S> ISO_INLINE void StiffSprings<S>::swing(const Spring<S>& spring, const OscillatorStep<S>& motion) {
  const std::uint32_t a = spring.a.slot, b = spring.b.slot;
  const InverseMass<S> of_a = state_.inverse_mass[a];
  const InverseMass<S> of_b = spring.b ? state_.inverse_mass[b] : InverseMass<S>(0);
  const InverseMass<S> both = saturating_add(of_a, of_b);
  if (!(InverseMass<S>(0) < both)) return;
  const Axes<V>& displacement = step_.displacement;
  const Vec3<S> rest = state_.position[a] - (spring.b ? state_.position[b] : spring.anchor);
  const Vec3<V> moved = saturating_subtract(displacement[a], spring.b ? displacement[b] : Vec3<V>::zero());
  const Vec3<V> v = state_.velocity[a] - (spring.b ? state_.velocity[b] : Vec3<V>::zero());
  const Vec3<V> ahead = detail::travelled<S>(v, step_.h);
  const U share_a = divide_to<U>(of_a, both), share_b = divide_to<U>(of_b, both);
  Vec3<V> way = Vec3<V>::zero(), change = way;
  for (int axis = 0; axis < 3; ++axis) {
    const V before = saturating_subtract(moved[axis], ahead[axis]);
    const S d = rest[axis] + convert<S>(before);
    const V distant = saturate_to<V>(product(d, Unit<S>(1)));
    // (dd - 1) of a length in the coarse format and its fine rest, (dv - 1) of the way that v made.
    way[axis] = saturating_add(saturating_subtract(saturate_to<V>(product(d, motion.dd)), distant),
                               ahead[axis] * motion.dv - ahead[axis]);
    change[axis] =
        saturating_add(saturate_to<V>(product(d, motion.vd)), saturating_subtract(v[axis] * motion.vv, v[axis]));
  }
  way = held_within(way, highest<V>());  // but for the lowest, which has no negative
  change = held_within(change, highest<V>());
  move_end(a, way * share_a, change * share_a);
  if (spring.b) move_end(b, -(way * share_b), -(change * share_b));
}
template <class S> ISO_INLINE void StiffSprings<S>::move_end(std::uint32_t slot, Vec3<V> way, Vec3<V> change) {
  step_.move_on(slot, way);
  state_.velocity.set(slot, held_within(saturating_add(state_.velocity[slot], change), passing_speed<S>()));
}

template <class S> void StiffSprings<S>::pull() {
  for (const std::uint32_t slot : slots_) {
    const Spring<S>& spring = state_.springs.all()[slot];
    const Vec3<S> d = (spring.b ? step_.now[spring.b.slot] : spring.anchor) - step_.now[spring.a.slot];
    const auto tension = [&](S part) { return saturate_to<S>(product(spring.stiffness, part)); };
    const Vec3<S> force = held_within<S>({tension(d.x), tension(d.y), tension(d.z)}, highest<S>());
    const auto push = [&](std::uint32_t end, Vec3<S> f) {
      const InverseMass<S> w = state_.inverse_mass[end];
      const auto part = [w](S x) { return saturate_to<S>(product(x, w)); };
      step_.add_acceleration(end, {part(f.x), part(f.y), part(f.z)});
    };
    push(spring.a.slot, force);
    if (spring.b) push(spring.b.slot, -force);
  }
}

}  // namespace isostep
