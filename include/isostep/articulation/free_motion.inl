// Bodies of free_motion.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/articulation/free_motion.hpp"

namespace isostep::detail {

template <class S>
Vec3<S> FreeMotion<S>::centre_of(const ArticulatedTree<S>& tree, const ArticulatedDynamics<S>& links) {
  Vec3<S> centre = Vec3<S>::zero();
  for (std::size_t i = 0; i < tree.links.size(); ++i)
    centre += (links.of(i).place + links.of(i).centre) * tree.links[i].mass;
  return centre;
}

template <class S>
auto FreeMotion<S>::measured(const ArticulatedTree<S>& tree, const ArticulatedDynamics<S>& links) -> Measured {
  Measured m = {centre_of(tree, links), Vec3<S>::zero(), Vec3<S>::zero()};
  for (std::size_t i = 0; i < tree.links.size(); ++i) {
    const LinkWork<S>& w = links.of(i);
    const Vec3<S> moving = held_sum(w.moving, held_cross(w.spin, w.centre));
    const Vec3<S> momentum = moving * tree.links[i].mass;
    m.velocity = held_sum(m.velocity, momentum);
    // The moment is about the centre: the arms add up to nothing, so the velocity of the whole adds nothing either.
    const Vec3<S> arm = w.place + w.centre - m.centre;
    m.angular = held_sum(m.angular, held_sum(held_times(w.inertia, w.spin), held_cross(arm, momentum)));
  }
  return m;
}

template <class S>
Mat3<S> FreeMotion<S>::inertia(const ArticulatedTree<S>& tree, const ArticulatedDynamics<S>& links, Vec3<S> centre) {
  Mat3<S> whole = zero_matrix<S>();
  for (std::size_t i = 0; i < tree.links.size(); ++i) {
    const LinkWork<S>& w = links.of(i);
    whole = whole + inertia_of_body(tree.links[i].mass, w.place + w.centre - centre, w.inertia).angular;
  }
  return whole;
}

template <class S>
void FreeMotion<S>::begin(const ArticulatedTree<S>& tree, const ArticulatedDynamics<S>& links,
                          const ArticulationState<S>& state) {
  const Measured now = measured(tree, links);
  const S* const v = state.speeds.data() + tree.links[0].speed;
  const Vec3<S> own = links.of(0).frame * held_product(Vec3<S>{v[0], v[1], v[2]}, tree.scale);
  velocity_ = held_sum(own, now.velocity);
  angular_ = now.angular;
  centre_ = now.centre;
}

template <class S> void FreeMotion<S>::push(const ArticulatedTree<S>& tree, const ArticulatedDynamics<S>& links) {
  const Vec3<S> centre = centre_of(tree, links);
  Vec3<S> force = held_product(tree.definition.settings.gravity, tree.scale), torque = Vec3<S>::zero();
  for (std::size_t i = 0; i < tree.links.size(); ++i) {
    const LinkWork<S>& w = links.of(i);
    force = held_sum(force, w.load.force);
    torque = held_sum(torque, held_sum(w.load.torque, held_cross(w.place + w.centre - centre, w.load.force)));
  }
  const Vec3<S> before = velocity_;
  velocity_ = held_sum(velocity_, force * tree.h);
  angular_ = held_sum(angular_, torque * tree.h);
  way_ = held_product(held_sum(before, velocity_), S(0.5)) * tree.h;
}

template <class S>
void FreeMotion<S>::finish(const ArticulatedTree<S>& tree, const ArticulatedDynamics<S>& links,
                           ArticulationState<S>& state) {
  const Measured now = measured(tree, links);
  const PreparedLink<S>& l = tree.links[0];
  const Mat3<Unit<S>>& frame = links.of(0).frame;
  const Mat3<S> whole = inertia(tree, links, now.centre);
  const S least = S(16) * rounding_at(trace(whole));
  const Vec3<S> spin = Symmetric3<S>::of(whole, least).solve(held_sum(angular_, -now.angular));
  const Vec3<S> turn = transposed_times(frame, spin);
  const Vec3<S> others = held_sum(now.velocity, held_cross(spin, now.centre));
  const Vec3<S> own = held_product(transposed_times(frame, held_sum(velocity_, -others)), tree.unscale);
  const Vec3<S> way = held_product(transposed_times(frame, held_sum(way_, centre_ - now.centre)), tree.unscale);
  const S most = S(4) * tree.spin;
  for (int k = 0; k < 3; ++k) {
    const auto place = static_cast<std::uint32_t>(k);
    state.speeds[l.speed + place] = clamp(own[k], -Limits<S>::speed(), Limits<S>::speed());
    S& spinning = state.speeds[l.speed + 3 + place];
    spinning = clamp(saturating_add(spinning, turn[k]), -most, most);
    state.coordinates[l.coordinate + place] += way[k];
  }
  centre_ = now.centre;
}

}  // namespace isostep::detail
