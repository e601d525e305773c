// Bodies of state_loader.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/world/state_loader.hpp"

namespace isostep {

namespace detail {
/// What a world was made with: gravity alone is changed by commands.
template <class S> bool same_making(const Settings<S>& a, const Settings<S>& b) {
  return a.hz == b.hz && a.substeps == b.substeps && a.allow_sleep == b.allow_sleep && a.solver == b.solver &&
         a.id_space == b.id_space && a.most_pairs == b.most_pairs && a.projection == b.projection &&
         a.restitution_threshold == b.restitution_threshold;
}
}  // namespace detail

template <class S> void StateLoader<S>::load(const WorldState<S>& from) {
  other_islands_.clear();
  state_.sleeping.each_difference(from.sleeping,
                                  [&](std::size_t i) { other_islands_.push_back(static_cast<std::uint32_t>(i)); });
  const bool other_static = !state_.static_bodies.is_same(from.static_bodies);
  const bool other_blobs = !state_.geometry.is_same(from.geometry);
  forget_places(other_static);
  state_ = from;
  if (other_blobs) map_.renew_contents();
  renew_places(other_static);
}

/// Of everything but the islands, and the static bodies, that stay.
template <class S> void StateLoader<S>::forget_places(bool other_static) {
  forgotten_.clear();
  if (other_static) forget(*state_.static_bodies, {});
  forget(state_.awake, state_.joints);
  for (const std::uint32_t i : other_islands_) {
    if (i >= state_.sleeping.size()) continue;
    forget(state_.sleeping[i]->bodies, state_.sleeping[i]->joints);
    map_.count_names(*state_.sleeping[i], ~0u);
  }
}
template <class S> void StateLoader<S>::forget(const BodySet<S>& bodies, const JointSet<S>& joints) {
  for (const BodyState<S>& body : bodies.states) {
    map_.place(body.slot, Location{});
    forgotten_.push_back(body.slot);
  }
  for (const JointState<S>& joint : joints.states) map_.place_joint(joint.slot, Location{});
}

/// Of the same in the new state; the broad phase changes only where a body differs from what it knew.
template <class S> void StateLoader<S>::renew_places(bool other_static) {
  map_.make_room();
  if (other_static) place(*state_.static_bodies, Location::kStatic);
  place(state_.awake, Location::kAwake);
  map_.relabel(state_.joints, Location::kAwake, 0);
  for (const std::uint32_t i : other_islands_) {
    if (i >= state_.sleeping.size()) continue;
    place(state_.sleeping[i]->bodies, i);
    map_.relabel(state_.sleeping[i]->joints, i, 0);
    map_.count_names(*state_.sleeping[i], 1);
  }
  for (const std::uint32_t slot : forgotten_) {
    if (map_.location(slot).set == Location::kNone) proxies_.remove(slot);
  }
}
template <class S> void StateLoader<S>::place(const BodySet<S>& bodies, std::uint32_t set) {
  map_.relabel(bodies, set, 0);
  for (std::size_t i = 0; i < bodies.states.size(); ++i)
    proxies_.place(bodies.states[i], bodies.properties[i], set == Location::kAwake);
}

}  // namespace isostep
