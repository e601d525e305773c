// ArticulatedDynamics: where links are and how fast they spin and move.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/articulation/articulated_dynamics.hpp"

namespace isostep::detail {

template <class S> void ArticulatedDynamics<S>::reset(const ArticulatedTree<S>& tree) {
  work_.assign(tree.links.size() + 1, LinkWork<S>{});
  LinkWork<S>& base = work_[0];
  base.orientation = normalise(tree.definition.settings.base.orientation);
  base.turn = base.frame = to_matrix(base.orientation);
  base.place = base.arm = base.spin = base.moving = Vec3<S>::zero();
  base.acceleration = {Vec3<S>::zero(), -held_product(tree.definition.settings.gravity, tree.scale)};
}

template <class S>
void ArticulatedDynamics<S>::place_link(const ArticulatedTree<S>& tree, const ArticulationState<S>& state,
                                        std::size_t link) {
  const PreparedLink<S>& l = tree.links[link];
  LinkWork<S>& w = work_[link + 1];
  const LinkWork<S>& parent = work_[l.parent];
  Quat<Unit<S>> q = parent.orientation * l.before;
  w.frame = to_matrix(q);
  w.axis = w.frame * l.axis;
  w.arm = parent.turn * l.offset;
  if (l.type == ArticulationJoint::hinge) q = q * rotation<S>(l.axis, state.coordinates[l.coordinate]);
  if (has_rotation(l.type)) q = q * state.rotations[l.rotation];
  if (l.type == ArticulationJoint::slider)
    w.arm +=
        w.axis * clamp(held_product(state.coordinates[l.coordinate], tree.scale), -kMostSlideWay<S>, kMostSlideWay<S>);
  w.orientation = normalise(q * l.after);
  w.turn = to_matrix(w.orientation);
  w.place = parent.place + w.arm;
  w.centre = w.turn * l.centre;
  w.inertia = rotate_diagonal(to_matrix(w.orientation * l.principal), l.inertia);
}

template <class S>
void ArticulatedDynamics<S>::place(const ArticulatedTree<S>& tree, const ArticulationState<S>& state) {
  for (std::size_t i = 0; i < tree.links.size(); ++i) place_link(tree, state, i);
}

/// Computes spins. Returns the share of all speeds at which every spin keeps its limit, at most 1.
template <class S> S ArticulatedDynamics<S>::spin_links(const ArticulatedTree<S>& tree, const std::vector<S>& speeds) {
  S share = S(1);
  fastest_ = S(0);
  const auto within = [&](S fastest, S most) {
    if (most < fastest) share = min(share, divide_to<S>(most, fastest));
  };
  for (std::size_t i = 0; i < tree.links.size(); ++i) {
    const PreparedLink<S>& l = tree.links[i];
    LinkWork<S>& w = work_[i + 1];
    w.spin = work_[l.parent].spin;
    const S* const v = speeds.data() + l.speed;
    if (l.type == ArticulationJoint::hinge) w.spin += w.axis * v[0];
    if (l.type == ArticulationJoint::slider) within(abs(held_product(v[0], tree.scale)), kMostSlideSpeed<S>);
    if (has_rotation(l.type)) {
      const int first = l.type == ArticulationJoint::free ? 3 : 0;
      w.spin += w.frame * Vec3<S>{v[first], v[first + 1], v[first + 2]};
    }
    fastest_ = max(fastest_, max_abs(w.spin));
  }
  within(fastest_, tree.spin);
  return share;
}

template <class S> bool ArticulatedDynamics<S>::spin(const ArticulatedTree<S>& tree, std::vector<S>& speeds) {
  const S share = spin_links(tree, speeds);
  if (!(share < S(1))) return true;
  // Twice the share of a fixed-point rounding less: what is held stays held.
  const S less = share - (rounding_at(share) + rounding_at(share));
  for (const PreparedLink<S>& l : tree.links) {
    const bool free = l.type == ArticulationJoint::free;
    const std::uint32_t first = l.speed + (free ? 3u : 0u);
    const std::uint32_t count = is_scalar(l.type) ? 1u : has_rotation(l.type) ? 3u : 0u;
    for (std::uint32_t k = 0; k < count; ++k) speeds[first + k] = speeds[first + k] * less;
  }
  spin_links(tree, speeds);
  return false;
}

template <class S> void ArticulatedDynamics<S>::follow(const ArticulatedTree<S>& tree, const std::vector<S>& speeds) {
  for (std::size_t i = 0; i < tree.links.size(); ++i) {
    const PreparedLink<S>& l = tree.links[i];
    LinkWork<S>& w = work_[i + 1];
    const LinkWork<S>& parent = work_[l.parent];
    w.moving = held_sum(parent.moving, held_cross(parent.spin, w.arm));
    if (l.type == ArticulationJoint::slider)
      w.moving = held_sum(w.moving, w.axis * held_product(speeds[l.speed], tree.scale));
  }
}

template <class S>
void ArticulatedDynamics<S>::prepare(const ArticulatedTree<S>& tree, const ArticulationState<S>& state) {
  for (std::size_t i = 0; i < tree.links.size(); ++i) {
    LinkWork<S>& w = work_[i + 1];
    w.joint.prepare(tree, tree.links[i], state.drives[i]);
    const LinkLoad<S>& load = state.loads[i];
    const auto over = [&](Vec3<S> v, int lengths) {
      return Vec3<S>{tree.over_mass(v.x, lengths), tree.over_mass(v.y, lengths), tree.over_mass(v.z, lengths)};
    };
    w.load = {over(load.torque, 2), over(load.force, 1)};
  }
}

template <class S>
void ArticulatedDynamics<S>::begin(const ArticulatedTree<S>& tree, const ArticulationState<S>& state) {
  for (std::size_t i = 0; i < tree.links.size(); ++i)
    work_[i + 1].joint.begin(tree, tree.links[i], state, state.drives[i]);
}

}  // namespace isostep::detail
