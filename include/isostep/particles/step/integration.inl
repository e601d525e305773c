// ParticleIntegration: explicit and semi-implicit Euler, velocity Verlet, Runge-Kutta, implicit Euler.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/particles/step/integration.hpp"

namespace isostep {

template <class S>
ParticleIntegration<S>::ParticleIntegration(ParticleState<S>& state, ParticleStep<S>& step, FreeFlight<S>& flight,
                                            ParticleForces<S>& forces, StiffSprings<S>& stiff_springs)
    : state_(state), step_(step), flight_(flight), forces_(forces), stiff_springs_(stiff_springs) {}

template <class S> void ParticleIntegration<S>::integrate(bool constrained) {
  switch (state_.settings.integrator) {
    case Integrator::velocity_verlet: drift_verlet(); break;
    case Integrator::rk4: drift_rk4(); break;
    case Integrator::implicit_euler: integrate_implicit(); break;
    case Integrator::explicit_euler:
    case Integrator::semi_implicit_euler:
      forces_.accelerate();
      flight_.advance();
      break;
  }
  stiff_springs_.swing();
  if (state_.settings.integrator != Integrator::rk4 || !constrained) return;
  flight_.place();
  forces_.accelerate();
  first_ = step_.acceleration;
}
template <class S> void ParticleIntegration<S>::arrive(bool constrained) {
  if (state_.settings.integrator == Integrator::velocity_verlet) return arrive_verlet();
  if (constrained) turn_end();
  for (std::uint32_t i = 0; i < state_.material.size(); ++i) {
    const Vec3<V> changed = saturating_subtract(state_.velocity[i], mean_[i]);
    flight_.keep_velocity(i, held_within(saturating_add(end_[i], changed), passing_speed<S>()));
  }
}
template <class S> void ParticleIntegration<S>::fly() {
  integrate(false);
  if (arrives()) arrive(false);
}
template <class S> void ParticleIntegration<S>::accelerate_all() {
  flight_.place();
  forces_.accelerate();
  stiff_springs_.pull();
}

/// Velocity Verlet as kick, drift, kick: half of the accelerations at the start, the way, half of those at the end.
/// Terms that depend on velocity are evaluated at the end with both halves of the first.
template <class S> void ParticleIntegration<S>::drift_verlet() {
  forces_.accelerate();
  first_ = step_.acceleration;
  const Step<S> half = step_.h * Step<S>(0.5);
  for (std::uint32_t i = 0; i < state_.material.size(); ++i) {
    const Vec3<V> v = detail::pushed<S>(state_.velocity[i], step_.acceleration[i], half);
    step_.displacement.add(i, detail::travelled<S>(v, step_.h));
    state_.velocity.set(i, v);
  }
}
template <class S> void ParticleIntegration<S>::arrive_verlet() {
  flight_.place();
  start_ = state_.velocity;
  const Step<S> half = step_.h * Step<S>(0.5);
  const auto count = static_cast<std::uint32_t>(state_.material.size());
  for (std::uint32_t i = 0; i < count; ++i) state_.velocity.set(i, detail::pushed<S>(start_[i], first_[i], half));
  forces_.accelerate();
  for (std::uint32_t i = 0; i < count; ++i) {
    state_.velocity.set(i, start_[i]);
    flight_.keep_velocity(i, detail::pushed<S>(start_[i], step_.acceleration[i], half));
  }
}

/// The classical fourth-order method of Kutta (1901): slopes at the start, twice in the middle, at the end. The mean of
/// the velocities is that of the way.
template <class S> void ParticleIntegration<S>::drift_rk4() {
  const auto count = static_cast<std::uint32_t>(state_.material.size());
  start_ = state_.velocity;
  first_displacement_ = step_.displacement;
  sum_.resize(count);
  mean_.resize(count);
  end_.resize(count);
  for (int stage = 0; stage < 4; ++stage) {
    forces_.accelerate();
    add_stage(stage);
    if (stage < 3) flight_.place();
  }
  for (std::uint32_t i = 0; i < count; ++i) {
    const bool moves = InverseMass<S>(0) < state_.inverse_mass[i];
    const Vec3<V> mean = moves ? mean_[i] : start_[i];
    step_.displacement.set(i, first_displacement_[i] + detail::travelled<S>(mean, step_.h));
    mean_.set(i, mean);
    end_.set(i, detail::pushed<S>(start_[i], sum_[i], step_.h));
    state_.velocity.set(i, mean);
  }
}
/// Adds a stage's slopes to the means, and moves on to where the next stage is evaluated.
template <class S> void ParticleIntegration<S>::add_stage(int stage) {
  const bool outer = stage == 0 || stage == 3;
  const Step<S> ahead = stage == 2 ? step_.h : step_.h * Step<S>(0.5);
  for (std::uint32_t i = 0; i < state_.material.size(); ++i) {
    const Vec3<V> v = state_.velocity[i];
    const Vec3<S> a = step_.acceleration[i];
    // Weights of a sixth and a third, taken one by one so that the sum stays within the format.
    const Vec3<S> part = outer ? a * S(1.0 / 6) : a * S(1.0 / 3);
    const Vec3<V> of_mean = v * (outer ? U(1.0 / 6) : U(1.0 / 3));
    sum_.set(i, stage == 0 ? part : saturating_add(sum_[i], part));
    mean_.set(i, stage == 0 ? of_mean : mean_[i] + of_mean);
    if (stage == 3) continue;
    step_.displacement.set(i, first_displacement_[i] + detail::travelled<S>(v, ahead));
    state_.velocity.set(i, detail::pushed<S>(start_[i], a, ahead));
  }
}
/// rk4's end velocities are those of the forces alone. What forces add elsewhere counts half, as in Verlet.
template <class S> void ParticleIntegration<S>::turn_end() {
  flight_.place();
  forces_.accelerate();
  const Step<S> half = step_.h * Step<S>(0.5);
  for (std::uint32_t i = 0; i < state_.material.size(); ++i) {
    const Vec3<S> more = saturating_subtract(step_.acceleration[i], first_[i]);
    end_.set(i, detail::pushed<S>(end_[i], more, half));
  }
}

/// Integrates springs implicitly, by one system; everything else like semi-implicit Euler.
template <class S> void ParticleIntegration<S>::integrate_implicit() {
  forces_.accelerate();
  const std::int32_t rate = state_.settings.hz * state_.settings.substeps;
  const bool solved = implicit_springs_.solve(state_.springs.all(), step_.now, state_.velocity, step_.acceleration,
                                              state_.inverse_mass, rate);
  if (!solved) ++step_.report.unsolved;
  for (std::uint32_t i = 0; i < state_.material.size(); ++i) {
    flight_.keep_velocity(i, detail::pushed<S>(state_.velocity[i], Vec3<S>::zero(), step_.h));
    step_.displacement.add(i, detail::travelled<S>(state_.velocity[i], step_.h));
  }
}

}  // namespace isostep
