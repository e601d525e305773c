// ParticleEngine: the integrators. Each takes velocities and displacements over one sub-step as if nothing held the
// particles; constraints correct both afterwards.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/particles/particle_engine.hpp"
#include "isostep/particles/stiff_spring.hpp"

namespace isostep {

/// What materials mean for a sub-step of this length.
template <class S> void ParticleEngine<S>::prepare_flight() {
  const std::int32_t rate = state_.settings.hz * state_.settings.substeps;
  rate_ = S(rate);
  h_ = divide_to<Step<S>>(S(1), rate_);
  const Vec3<S> g = state_.settings.gravity;
  const S most = ParticleLimits<S>::acceleration();
  flight_rows_.resize(state_.materials.all().size());
  for (std::size_t i = 0; i < flight_rows_.size(); ++i) {
    const ParticleMaterial<S>& m = state_.materials.all()[i];
    const auto scaled = [&](S part) { return clamp(saturate_to<S>(product(part, m.gravity_scale)), -most, most); };
    flight_rows_[i] = {
        {scaled(g.x), scaled(g.y), scaled(g.z)}, m.linear_drag, m.quadratic_drag, power_to<Step<S>>(m.damping, h_)};
  }
}

template <class S> FlightRun<S> ParticleEngine<S>::flight(std::uint32_t first) {
  return {flight_rows_.data(),
          state_.material.data(),
          state_.inverse_mass.data(),
          view_of(state_.position),
          view_of(scratch_.now),
          view_of(state_.velocity),
          view_of(scratch_.displacement),
          view_of(scratch_.acceleration),
          first,
          static_cast<std::uint32_t>(state_.material.size()),
          h_,
          rate_,
          state_.settings.substeps,
          state_.settings.integrator == Integrator::explicit_euler};
}

/// All forces at the present positions and velocities.
template <class S> void ParticleEngine<S>::accelerate() {
  kernels_->accelerate(flight());
  if (has_forces()) add_forces();
}

/// Where nothing joins particles, each goes through all sub-steps at once.
template <class S> void ParticleEngine<S>::fly_free() { kernels_->fly(flight()); }

template <class S> void ParticleEngine<S>::integrate() {
  switch (state_.settings.integrator) {
    case Integrator::velocity_verlet: integrate_verlet(); break;
    case Integrator::rk4: integrate_rk4(); break;
    case Integrator::implicit_euler: integrate_implicit(); break;
    case Integrator::explicit_euler:
    case Integrator::semi_implicit_euler:
      accelerate();
      kernels_->advance(flight());
      break;
  }
  swing_stiff_springs();
}

namespace detail {
/// v + a h, as far as velocities go.
template <class S> ISO_INLINE Velocity<S> pushed(Velocity<S> v, S a, Step<S> h) {
  using V = Velocity<S>;
  const V limit = passing_speed<S>();
  const V speed = convert<V>(ParticleLimits<S>::speed());
  const V most = speed + speed;
  return clamp(v + clamp(saturate_to<V>(product(a, h)), -most, most), -limit, limit);
}
template <class S> ISO_INLINE Vec3<Velocity<S>> pushed(Vec3<Velocity<S>> v, Vec3<S> a, Step<S> h) {
  return {pushed<S>(v.x, a.x, h), pushed<S>(v.y, a.y, h), pushed<S>(v.z, a.z, h)};
}
template <class S> ISO_INLINE Vec3<Velocity<S>> travelled(Vec3<Velocity<S>> v, Step<S> h) {
  return {v.x * h, v.y * h, v.z * h};
}
/// The mean of two, which may add up beyond the format.
template <class S> ISO_INLINE Vec3<S> mean(Vec3<S> a, Vec3<S> b) {
  const S half = S(0.5);
  return saturating_add(a * half, b * half);
}
}  // namespace detail

/// Velocity Verlet: positions by v h + a h^2 / 2, velocities by the mean of both ends' accelerations; what depends on
/// velocity is evaluated at the end with v + a h.
template <class S> void ParticleEngine<S>::integrate_verlet() {
  accelerate();
  scratch_.first = scratch_.acceleration;
  scratch_.start = state_.velocity;
  const auto count = static_cast<std::uint32_t>(state_.material.size());
  for (std::uint32_t i = 0; i < count; ++i) {
    const Vec3<V> v = state_.velocity[i];
    const Vec3<V> next = detail::pushed<S>(v, scratch_.acceleration[i], h_);
    scratch_.displacement.add(i, detail::travelled<S>(detail::mean(v, next), h_));
    state_.velocity.set(i, next);
  }
  renew_positions();
  accelerate();
  for (std::uint32_t i = 0; i < count; ++i) {
    const Vec3<S> a = detail::mean(scratch_.first[i], scratch_.acceleration[i]);
    keep_velocity(i, detail::pushed<S>(scratch_.start[i], a, h_));
  }
}

/// The classical fourth-order method of Kutta (1901): slopes at the start, twice in the middle, at the end.
template <class S> void ParticleEngine<S>::integrate_rk4() {
  const auto count = static_cast<std::uint32_t>(state_.material.size());
  scratch_.start = state_.velocity;
  scratch_.first_displacement = scratch_.displacement;
  scratch_.sum.resize(count);
  scratch_.velocity_sum.resize(count);
  const Step<S> half = h_ * Step<S>(0.5);
  for (int stage = 0; stage < 4; ++stage) {
    accelerate();
    const bool outer = stage == 0 || stage == 3;
    const Step<S> ahead = stage == 2 ? h_ : half;
    for (std::uint32_t i = 0; i < count; ++i) {
      const Vec3<V> v = state_.velocity[i];
      const Vec3<S> a = scratch_.acceleration[i];
      // Weights of a sixth and a third, taken one by one so that the sum stays within the format.
      const Vec3<S> part = outer ? a * S(1.0 / 6) : a * S(1.0 / 3);
      const Vec3<V> way = detail::travelled<S>(outer ? v * V(1.0 / 6) : v * V(1.0 / 3), h_);
      scratch_.sum.set(i, stage == 0 ? part : saturating_add(scratch_.sum[i], part));
      scratch_.velocity_sum.set(i, stage == 0 ? way : scratch_.velocity_sum[i] + way);
      if (stage == 3) continue;
      scratch_.displacement.set(i, scratch_.first_displacement[i] + detail::travelled<S>(v, ahead));
      state_.velocity.set(i, detail::pushed<S>(scratch_.start[i], a, ahead));
    }
    if (stage < 3) renew_positions();
  }
  for (std::uint32_t i = 0; i < count; ++i) {
    scratch_.displacement.set(i, scratch_.first_displacement[i] + scratch_.velocity_sum[i]);
    keep_velocity(i, detail::pushed<S>(scratch_.start[i], scratch_.sum[i], h_));
  }
}

/// Springs implicitly, by one system; all else as semi-implicit Euler has it.
template <class S> void ParticleEngine<S>::integrate_implicit() {
  accelerate();
  const std::int32_t rate = state_.settings.hz * state_.settings.substeps;
  const bool solved = implicit_springs_.solve(state_.springs.all(), scratch_.now, state_.velocity,
                                              scratch_.acceleration, state_.inverse_mass, rate);
  if (!solved) ++report_.unsolved;
  for (std::uint32_t i = 0; i < state_.material.size(); ++i) {
    keep_velocity(i, detail::pushed<S>(state_.velocity[i], Vec3<S>::zero(), h_));
    scratch_.displacement.add(i, detail::travelled<S>(state_.velocity[i], h_));
  }
}

template <class S> void ParticleEngine<S>::prepare_springs() {
  spring_rows_.begin(state_.springs.all().size());
  oscillators_.clear();
  springs_yield_ = false;
  const auto particles = static_cast<std::uint32_t>(state_.material.size());
  for (const Spring<S>& spring : state_.springs.all()) {
    if (!spring.a) continue;
    const InverseMass<S> of_a = state_.inverse_mass[spring.a.slot];
    const InverseMass<S> of_b = spring.b ? state_.inverse_mass[spring.b.slot] : InverseMass<S>(0);
    const InverseMass<S> both = saturating_add(of_a, of_b);
    if (S(0) < spring.elastic_limit) springs_yield_ = true;
    if (spring.type == SpringType::stiff)
      oscillators_.push_back(oscillator_step(spring.stiffness, spring.damping, both, rate_));
    else if (InverseMass<S>(0) < both) spring_rows_.add(spring, particles, of_a, of_b);
  }
  if (spring_rows_.count > 0) spring_rows_.place_anchors(particles);
}
/// After everything else has moved its ends as if it were not there, a stiff spring moves them on by what its exact
/// motion differs from that.
template <class S> void ParticleEngine<S>::swing_stiff_springs() {
  if (oscillators_.empty()) return;
  std::size_t next = 0;
  const Axes<V>& displacement = scratch_.displacement;
  for (const Spring<S>& spring : state_.springs.all()) {
    if (!spring.a || spring.type != SpringType::stiff) continue;
    const OscillatorStep<S>& step = oscillators_[next++];
    const std::uint32_t a = spring.a.slot, b = spring.b.slot;
    const InverseMass<S> of_a = state_.inverse_mass[a];
    const InverseMass<S> of_b = spring.b ? state_.inverse_mass[b] : InverseMass<S>(0);
    const InverseMass<S> both = saturating_add(of_a, of_b);
    if (!(InverseMass<S>(0) < both)) continue;
    const Vec3<S> rest = state_.position[a] - (spring.b ? state_.position[b] : spring.anchor);
    const Vec3<V> moved = saturating_subtract(displacement[a], spring.b ? displacement[b] : Vec3<V>::zero());
    const Vec3<V> v = state_.velocity[a] - (spring.b ? state_.velocity[b] : Vec3<V>::zero());
    const Vec3<V> ahead = detail::travelled<S>(v, h_);
    const U share_a = divide_to<U>(of_a, both), share_b = divide_to<U>(of_b, both);
    Vec3<V> way = Vec3<V>::zero(), change = way;
    for (int axis = 0; axis < 3; ++axis) {
      const V before = saturating_subtract(moved[axis], ahead[axis]);
      const S d = rest[axis] + convert<S>(before);
      const V far = saturate_to<V>(product(d, Unit<S>(1)));
      // (dd - 1) of a length in the coarse format and its fine rest, (dv - 1) of the way that v made.
      way.set(axis, saturating_add(saturating_subtract(saturate_to<V>(product(d, step.dd)), far),
                                   ahead[axis] * step.dv - ahead[axis]));
      change.set(axis,
                 saturating_add(saturate_to<V>(product(d, step.vd)), saturating_subtract(v[axis] * step.vv, v[axis])));
    }
    way = held_within(way, highest<V>());  // but for the lowest, which has no negative
    change = held_within(change, highest<V>());
    swing(a, way * share_a, change * share_a);
    if (spring.b) swing(b, -(way * share_b), -(change * share_b));
  }
}
template <class S> ISO_INLINE void ParticleEngine<S>::swing(std::uint32_t slot, Vec3<V> way, Vec3<V> change) {
  move_on(slot, way);
  state_.velocity.set(slot, held_within(saturating_add(state_.velocity[slot], change), passing_speed<S>()));
}

template <class S> ISO_INLINE void ParticleEngine<S>::move_on(std::uint32_t slot, Vec3<V> way) {
  const Vec3<V> displacement = saturating_add(scratch_.displacement[slot], way);
  scratch_.displacement.set(slot, held_within(displacement, passing_distance<S>()));
}

/// Of a particle that moves freely, with its material's damping.
template <class S> ISO_INLINE void ParticleEngine<S>::keep_velocity(std::uint32_t slot, Vec3<V> velocity) {
  if (!(InverseMass<S>(0) < state_.inverse_mass[slot])) return;
  const Step<S> keep = flight_rows_[state_.material[slot]].keep;
  state_.velocity.set(slot, {velocity.x * keep, velocity.y * keep, velocity.z * keep});
}

template <class S> void ParticleEngine<S>::renew_positions() { kernels_->place(flight()); }

}  // namespace isostep
