// Boxes, and platforms that are told where to be, of the laws of bodies that change.
// SPDX-License-Identifier: MIT
#pragma once

#include "laws/exact_rollback.hpp"

namespace isostep::test {

template <class S> class BodyChanges : public ::testing::Test {
 protected:
  BodyId box(D3 at, D3 half = {0.5, 0.5, 0.5}) { return w.create(moving<S>(add_box(w, half.x, half.y, half.z), at)); }
  BodyId mover(D3 at, D3 half = {2, 0.125, 2}) {
    BodyDefinition<S> d = still<S>(add_box(w, half.x, half.y, half.z), at);
    d.type = BodyType::kinematic;
    return w.create(d);
  }
  D3 at(BodyId body) const { return real(w.center_of_mass(body)); }
  D3 speed(BodyId body) const { return real(w.velocity(body)); }
  double slack() const { return 64 * grain<S>(4); }

  World<S> w{settings<S>()};
};

}  // namespace isostep::test
