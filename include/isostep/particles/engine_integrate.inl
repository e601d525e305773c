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

namespace detail {
/// As long as the format allows: one force or their sum was cut there.
template <class S> ISO_INLINE bool is_cut(Vec3<S> a) {
  const S most = highest<S>();
  if (lies_within(a, most * S(0.5))) return false;  // the largest component of such a length is above 0.57 of it
  return !(length(a) < most - most * S(1.0 / 1024));
}
}  // namespace detail

/// All forces at the present positions and velocities.
template <class S> void ParticleEngine<S>::accelerate() {
  kernels_->accelerate(flight());
  if (!has_forces()) return;
  add_forces();
  for (std::uint32_t i = 0; i < state_.material.size(); ++i) {
    if (detail::is_cut(scratch_.acceleration[i])) note_cut_force(i);
  }
}
/// Counts each particle once a step.
template <class S> void ParticleEngine<S>::note_cut_force(std::uint32_t slot) {
  if (report_.clamped_force == 0) cut_forces_.clear();
  if (cut_forces_.insert(slot)) ++report_.clamped_force;
}

/// Where nothing joins particles, each goes through all sub-steps at once.
template <class S> void ParticleEngine<S>::fly_free() { kernels_->fly(flight()); }

/// Velocities become those with which particles move through the sub-step, and displacements follow them. With these
/// velocities constraints have to do; arrive() then makes them those of the sub-step's end. A second stage that saw
/// where forces alone would take the particles would feed the spring beside a rod with energy.
template <class S> void ParticleEngine<S>::integrate() {
  switch (state_.settings.integrator) {
    case Integrator::velocity_verlet: drift_verlet(); break;
    case Integrator::rk4: drift_rk4(); break;
    case Integrator::implicit_euler: integrate_implicit(); break;
    case Integrator::explicit_euler:
    case Integrator::semi_implicit_euler:
      accelerate();
      kernels_->advance(flight());
      break;
  }
  swing_stiff_springs();
  if (state_.settings.integrator != Integrator::rk4 || rows_.empty()) return;
  renew_positions();
  accelerate();
  scratch_.first = scratch_.acceleration;
}
/// Of the methods whose velocities at the end are not those of the way.
template <class S> void ParticleEngine<S>::arrive() {
  if (state_.settings.integrator == Integrator::velocity_verlet) return arrive_verlet();
  if (!rows_.empty()) turn_end();
  for (std::uint32_t i = 0; i < state_.material.size(); ++i) {
    const Vec3<V> changed = saturating_subtract(state_.velocity[i], scratch_.mean[i]);
    keep_velocity(i, held_within(saturating_add(scratch_.end[i], changed), passing_speed<S>()));
  }
}
/// A sub-step of particles that springs and forces join, but no constraint.
template <class S> void ParticleEngine<S>::fly_joined() {
  integrate();
  if (arrives()) arrive();
}
template <class S> bool ParticleEngine<S>::arrives() const {
  const Integrator integrator = state_.settings.integrator;
  return integrator == Integrator::velocity_verlet || integrator == Integrator::rk4;
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
}  // namespace detail

/// Velocity Verlet as kick, drift, kick: half of the accelerations at the start, the way, half of those at its end.
/// What depends on velocity is evaluated at the end with both halves of the first.
template <class S> void ParticleEngine<S>::drift_verlet() {
  accelerate();
  scratch_.first = scratch_.acceleration;
  const Step<S> half = h_ * Step<S>(0.5);
  for (std::uint32_t i = 0; i < state_.material.size(); ++i) {
    const Vec3<V> v = detail::pushed<S>(state_.velocity[i], scratch_.acceleration[i], half);
    scratch_.displacement.add(i, detail::travelled<S>(v, h_));
    state_.velocity.set(i, v);
  }
}
template <class S> void ParticleEngine<S>::arrive_verlet() {
  renew_positions();
  scratch_.start = state_.velocity;
  const Step<S> half = h_ * Step<S>(0.5);
  const auto count = static_cast<std::uint32_t>(state_.material.size());
  for (std::uint32_t i = 0; i < count; ++i)
    state_.velocity.set(i, detail::pushed<S>(scratch_.start[i], scratch_.first[i], half));
  accelerate();
  for (std::uint32_t i = 0; i < count; ++i) {
    state_.velocity.set(i, scratch_.start[i]);
    keep_velocity(i, detail::pushed<S>(scratch_.start[i], scratch_.acceleration[i], half));
  }
}

/// The classical fourth-order method of Kutta (1901): slopes at the start, twice in the middle, at the end. The mean of
/// the velocities is that of the way.
template <class S> void ParticleEngine<S>::drift_rk4() {
  const auto count = static_cast<std::uint32_t>(state_.material.size());
  scratch_.start = state_.velocity;
  scratch_.first_displacement = scratch_.displacement;
  scratch_.sum.resize(count);
  scratch_.mean.resize(count);
  scratch_.end.resize(count);
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
      const Vec3<V> of_mean = v * (outer ? U(1.0 / 6) : U(1.0 / 3));
      scratch_.sum.set(i, stage == 0 ? part : saturating_add(scratch_.sum[i], part));
      scratch_.mean.set(i, stage == 0 ? of_mean : scratch_.mean[i] + of_mean);
      if (stage == 3) continue;
      scratch_.displacement.set(i, scratch_.first_displacement[i] + detail::travelled<S>(v, ahead));
      state_.velocity.set(i, detail::pushed<S>(scratch_.start[i], a, ahead));
    }
    if (stage < 3) renew_positions();
  }
  for (std::uint32_t i = 0; i < count; ++i) {
    const bool moves = InverseMass<S>(0) < state_.inverse_mass[i];
    const Vec3<V> mean = moves ? scratch_.mean[i] : scratch_.start[i];
    scratch_.displacement.set(i, scratch_.first_displacement[i] + detail::travelled<S>(mean, h_));
    scratch_.mean.set(i, mean);
    scratch_.end.set(i, detail::pushed<S>(scratch_.start[i], scratch_.sum[i], h_));
    state_.velocity.set(i, mean);
  }
}

/// rk4's velocities at the end are of where forces alone lead. What forces do elsewhere counts half, as Verlet has it.
template <class S> void ParticleEngine<S>::turn_end() {
  renew_positions();
  accelerate();
  const Step<S> half = h_ * Step<S>(0.5);
  for (std::uint32_t i = 0; i < state_.material.size(); ++i) {
    const Vec3<S> more = saturating_subtract(scratch_.acceleration[i], scratch_.first[i]);
    scratch_.end.set(i, detail::pushed<S>(scratch_.end[i], more, half));
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

/// What holds each particle besides forces: stiff springs and constraints.
template <class S> void ParticleEngine<S>::count_holds() {
  bool any = false;
  for (const Spring<S>& spring : state_.springs.all()) any = any || (spring.a && spring.type == SpringType::stiff);
  if (!any) return;
  holds_.assign(state_.material.size(), 0);
  const auto hold = [this](std::uint32_t slot) { holds_[slot] = min(holds_[slot] + 1u, 2u); };
  for (const Spring<S>& spring : state_.springs.all()) {
    if (!spring.a || spring.type != SpringType::stiff) continue;
    hold(spring.a.slot);
    if (spring.b) hold(spring.b.slot);
  }
  for (const ParticleConstraint<S>& row : rows_) {
    hold(row.a);
    if (row.b != kNoParticle) hold(row.b);
  }
}
template <class S> void ParticleEngine<S>::prepare_springs() {
  spring_rows_.begin(state_.springs.all().size());
  oscillators_.clear();
  springs_yield_ = false;
  const auto particles = static_cast<std::uint32_t>(state_.material.size());
  count_holds();
  for (const Spring<S>& spring : state_.springs.all()) {
    if (!spring.a) continue;
    const InverseMass<S> of_a = state_.inverse_mass[spring.a.slot];
    const InverseMass<S> of_b = spring.b ? state_.inverse_mass[spring.b.slot] : InverseMass<S>(0);
    const InverseMass<S> both = saturating_add(of_a, of_b);
    if (S(0) < spring.elastic_limit) springs_yield_ = true;
    if (spring.type == SpringType::stiff) {
      const bool alone = holds_[spring.a.slot] == 1 && (!spring.b || holds_[spring.b.slot] == 1);
      oscillators_.push_back(
          (alone ? oscillator_step<S> : implicit_oscillator_step<S>)(spring.stiffness, spring.damping, both, rate_));
    } else if (InverseMass<S>(0) < both) spring_rows_.add(spring, particles, of_a, of_b);
  }
  if (spring_rows_.count > 0) spring_rows_.place_anchors(particles);
}
/// After everything else has moved its ends as if it were not there, a stiff spring moves them on by what its motion
/// differs from that: the exact one where nothing else holds its ends. A constraint would undo the velocity of the
/// exact motion's end, which says nothing about the way, and give the energy back as displacement: there the spring is
/// taken by backward Euler, whose end velocity is that of the way.
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
      way[axis] = saturating_add(saturating_subtract(saturate_to<V>(product(d, step.dd)), far),
                                 ahead[axis] * step.dv - ahead[axis]);
      change[axis] =
          saturating_add(saturate_to<V>(product(d, step.vd)), saturating_subtract(v[axis] * step.vv, v[axis]));
    }
    way = held_within(way, highest<V>());  // but for the lowest, which has no negative
    change = held_within(change, highest<V>());
    swing(a, way * share_a, change * share_a);
    if (spring.b) swing(b, -(way * share_b), -(change * share_b));
  }
}
/// As forces, which accelerate() leaves out.
template <class S> void ParticleEngine<S>::pull_stiff_springs() {
  if (oscillators_.empty()) return;
  for (const Spring<S>& spring : state_.springs.all()) {
    if (!spring.a || spring.type != SpringType::stiff) continue;
    const Vec3<S> d = (spring.b ? scratch_.now[spring.b.slot] : spring.anchor) - scratch_.now[spring.a.slot];
    const auto tension = [&](S part) { return saturate_to<S>(product(spring.stiffness, part)); };
    const Vec3<S> force = held_within<S>({tension(d.x), tension(d.y), tension(d.z)}, highest<S>());
    const auto pull = [&](std::uint32_t slot, Vec3<S> f) {
      const InverseMass<S> w = state_.inverse_mass[slot];
      const auto part = [w](S x) { return saturate_to<S>(product(x, w)); };
      add_acceleration(slot, {part(f.x), part(f.y), part(f.z)});
    };
    pull(spring.a.slot, force);
    if (spring.b) pull(spring.b.slot, -force);
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
