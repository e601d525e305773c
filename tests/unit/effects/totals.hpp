// Mass, centre and momenta of bodies together: what breaking them must keep (oracle O27).
// SPDX-License-Identifier: MIT
#pragma once

#include "unit/world/worlds.hpp"

namespace isostep::test {

/// All that must stay, by doubles from the world's own numbers.
struct Total {
  double mass = 0;
  D3 moment = {0, 0, 0};  // of mass about the origin
  D3 momentum = {0, 0, 0};
  D3 angular = {0, 0, 0};  // about a given point
  D3 centre() const { return moment * (1 / mass); }
};
template <class S> void add_body(Total& sum, const World<S>& world, BodyId body, D3 about) {
  const BodyView<S> view = world.view(body);
  const BodyProperties<S>& p = *view.properties;
  const double mass = to_double(p.mass);
  const D3 centre = real(view.state->centre), velocity = real(view.state->velocity);
  sum.mass += mass;
  sum.moment += centre * mass;
  sum.momentum += velocity * mass;
  sum.angular += cross(centre - about, velocity * mass);
  const D3 spin = real(view.state->angular_velocity), kappa = real(p.kappa);
  for (int i = 0; i < 3; ++i) {
    D3 unit = {0, 0, 0};
    unit[i] = 1;
    const D3 axis = rotated<S>(view.state->orientation, rotated<S>(p.principal, unit));
    sum.angular += axis * (mass / kappa[i] * dot(axis, spin));
  }
}

inline double relative(D3 a, D3 b) { return length(a - b) / length(b); }

}  // namespace isostep::test
