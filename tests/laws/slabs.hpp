// Slabs on a ground that gravity meets at an angle: what the laws of friction and of grains share.
// SPDX-License-Identifier: MIT
#pragma once

#include "unit/world/worlds.hpp"

namespace isostep::test::slabs {

inline constexpr double kG = 10;  // [m/s^2]

/// A flat ground that gravity meets at an angle, as a slope does that falls along x.
template <class S> World<S> tilted(double angle, SolverName solver = SolverName::soft_step) {
  Settings<S> s = settings<S>();
  s.gravity = vec<S>(kG * std::sin(angle), -kG * std::cos(angle), 0);
  s.allow_sleep = false;
  s.solver = solver;
  return World<S>(s);
}
template <class S> Material<S> material(double friction, double static_friction = 0, D3 anisotropy = {1, 1, 1}) {
  Material<S> m;
  m.friction = num<S>(friction);
  m.static_friction = num<S>(static_friction);
  m.anisotropy = vec<S>(anisotropy);
  return m;
}
template <class S> BodyId add_floor(World<S>& w, const Material<S>& material) {
  BodyDefinition<S> d = still<S>(w.add_shape(HalfSpace<S>{{Unit<S>(0), Unit<S>(1), Unit<S>(0)}, S(0)}));
  d.material = material;
  return w.create(d);
}
template <class S> BodyId add_slab(World<S>& w, const Material<S>& material, D3 velocity = {0, 0, 0}, double yaw = 0) {
  BodyDefinition<S> d = moving<S>(add_box(w, 0.5, 0.125, 0.5), {0, 0.125, 0}, velocity);
  d.orientation = turn<S>({0, 1, 0}, yaw);
  d.material = material;
  return w.create(d);
}
/// The part of an acceleration by which what slides may be off.
template <class S> double off() { return pick<S>(0.02, 0.02, 0.06, 0.02); }

}  // namespace isostep::test::slabs
