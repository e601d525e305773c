// One step of an articulation.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/articulation/articulation_engine.hpp"
#include "isostep/articulation/joint_work.inl"
#include "isostep/scalar/environment.hpp"

namespace isostep {

namespace detail {
/// Passes over the accelerations of a sub-step, each for the speeds that the one before leads to. Where a spin turns
/// speeds by z a sub-step, two passes let energy grow by z^4 / 4 a sub-step, three lose as much, four lose z^6 / 16.
/// Up to z = 1/32 two are enough, 2.4e-7 of the energy a sub-step at worst; beyond there are four. Where limits or
/// drives change there are more, up to the last; from the fifth on what holds is not released, so the search ends.
inline constexpr int kSlowPasses = 2, kFastPasses = 4, kReleasingPasses = 4, kMostPasses = 8;

/// q turned by w h / 2. The tangent of half the angle to fifth order: first order errs by a twelfth of its square.
template <class S> Quat<Unit<S>> turned(Quat<Unit<S>> q, Vec3<S> w, Step<S> h) {
  using U = Unit<S>;
  const auto part = [&](S x) { return round_to<U>(product(x, h)) * U(0.5); };
  const Vec3<U> turn = {part(w.x), part(w.y), part(w.z)};
  const U longer = U(1) + dot(turn, turn) * U(1.0 / 12);
  return integrate(q, turn * longer);
}
}  // namespace detail

template <class S> ArticulationReport Articulation<S>::Engine::step() {
  return pin_floats([&] {
    ArticulationReport report;
    links.prepare(*tree, state);
    report.clamped += links.spin(*tree, state.speeds) ? 0u : 1u;  // what was set between steps
    if (tree->free) {
      links.follow(*tree, state.speeds);
      free.begin(*tree, links, state);
    }
    for (std::int32_t i = 0; i < tree->definition.settings.substeps; ++i) substep(report);
    for (const detail::PreparedLink<S>& l : tree->links) {
      const std::size_t i = static_cast<std::size_t>(&l - tree->links.data());
      report.stopped += links.of(i).joint.stop != detail::Stop::none ? 1u : 0u;
    }
    state.loads.assign(state.loads.size(), LinkLoad<S>{Vec3<S>::zero(), Vec3<S>::zero()});
    ++state.tick;
    refresh();
    return report;
  });
}

template <class S> void Articulation<S>::Engine::substep(ArticulationReport& report) {
  before.coordinates = state.coordinates;
  before.rotations = state.rotations;
  drift();
  links.place(*tree, state);
  links.begin(*tree, state);
  find_accelerations();
  tell_loads();
  if (tree->free) free.push(*tree, links);
  bool fits = links.quicken(*tree, state.speeds, S(1), state.speeds);
  links.hold_limits(*tree, state.speeds);
  fits = links.spin(*tree, state.speeds) && fits;
  drift();
  if (tree->free) {
    links.place(*tree, state);
    links.spin(*tree, state.speeds);
    links.follow(*tree, state.speeds);
    free.finish(*tree, links, state);
    // Momentum that speeds within their limits cannot hold is lost.
    if (!links.spin(*tree, state.speeds)) {
      fits = false;
      links.follow(*tree, state.speeds);
      free.begin(*tree, links, state);
    }
  }
  report.clamped += fits ? 0u : 1u;
  if (is_finite_now()) return;
  ++report.lost;
  state.coordinates = before.coordinates;
  state.rotations = before.rotations;
  state.speeds.assign(state.speeds.size(), S(0));
}

template <class S> void Articulation<S>::Engine::find_accelerations() {
  middle = state.speeds;
  links.factor(*tree);
  int least = detail::kSlowPasses;
  for (int pass = 1; pass <= detail::kMostPasses; ++pass) {
    links.spin(*tree, middle);
    if (tree->rate < links.fastest() * S(32)) least = detail::kFastPasses;
    links.accelerate(*tree, middle);
    const bool changed = links.choose(*tree, pass <= detail::kReleasingPasses);
    if (!changed && pass >= least) return;
    links.quicken(*tree, state.speeds, S(0.5), middle);
    if (changed) links.factor(*tree);
  }
}

/// Advances coordinates by half a sub-step.
template <class S> void Articulation<S>::Engine::drift() {
  const Step<S> h = tree->h;
  for (const detail::PreparedLink<S>& l : tree->links) {
    S* const q = state.coordinates.data() + l.coordinate;
    const S* const v = state.speeds.data() + l.speed;
    const bool is_free = l.type == ArticulationJoint::free;
    if (detail::is_scalar(l.type)) q[0] += v[0] * h * S(0.5);
    if (l.type == ArticulationJoint::hinge && !l.limited) q[0] = detail::wrapped(q[0]);
    if (l.type == ArticulationJoint::slider) q[0] = clamp(q[0], -Limits<S>::position(), Limits<S>::position());
    if (detail::has_rotation(l.type)) {
      const S* const w = v + (is_free ? 3 : 0);
      Quat<Unit<S>>& rotation = state.rotations[l.rotation];
      rotation = detail::turned<S>(rotation, {w[0], w[1], w[2]}, h);
    }
    for (int k = 0; k < 3 && is_free; ++k) q[k] = clamp(q[k], -Limits<S>::position(), Limits<S>::position());
  }
}

template <class S> void Articulation<S>::Engine::tell_loads() {
  const S mass = tree->mass, unscale = tree->unscale;
  for (std::size_t i = 0; i < tree->links.size(); ++i) {
    const detail::LinkWork<S>& w = links.of(i);
    const detail::Wrench<S> given = w.whole * w.acceleration + w.bias;
    loads[i].force = detail::held_product(detail::held_product(given.force, unscale), mass);
    loads[i].torque =
        detail::held_product(detail::held_product(detail::held_product(given.torque, unscale), unscale), mass);
  }
}

template <class S> bool Articulation<S>::Engine::is_finite_now() const {
  for (const S q : state.coordinates) {
    if (!is_finite(q)) return false;
  }
  for (const S v : state.speeds) {
    if (!is_finite(v)) return false;
  }
  for (const Quat<Unit<S>>& q : state.rotations) {
    if (!is_finite(q.x) || !is_finite(q.y) || !is_finite(q.z) || !is_finite(q.w)) return false;
  }
  return true;
}

/// Updates poses and speeds for getters, after any change.
template <class S> void Articulation<S>::Engine::refresh() {
  pin_floats([&] {
    links.place(*tree, state);
    middle = state.speeds;
    links.spin(*tree, middle);
    links.follow(*tree, state.speeds);
  });
}

}  // namespace isostep
