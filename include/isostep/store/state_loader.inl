// Bodies of state_loader.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/store/state_loader.hpp"

namespace isostep {

template <class S> void StateLoader<S>::find_differences(const WorldState<S>& from) {
  other_islands_.clear();
  state_.sleeping.each_difference(from.sleeping,
                                  [&](std::size_t i) { other_islands_.push_back(static_cast<std::uint32_t>(i)); });
  other_pages_.clear();
  const std::size_t own_pages = state_.static_bodies.pages(), its_pages = from.static_bodies.pages();
  for (std::size_t p = 0; p < (own_pages < its_pages ? its_pages : own_pages); ++p) {
    if (!state_.static_bodies.shares_page(p, from.static_bodies)) other_pages_.push_back(static_cast<std::uint32_t>(p));
  }
  bool other_shapes = state_.shapes.size() != from.shapes.size();
  for (std::size_t p = 0; p < from.shapes.pages(); ++p)
    other_shapes = other_shapes || !state_.shapes.shares_page(p, from.shapes);
  if (other_shapes) map_.shapes.forget_thickness();
}

template <class S> void StateLoader<S>::load(const WorldState<S>& from) {
  find_differences(from);
  const bool other_blobs = !state_.geometry.is_same(from.geometry);
  forget_places();
  state_ = from;
  if (other_blobs) map_.shapes.renew_contents();
  renew_places();
}

/// Forgets all places but those of islands and of pages of static bodies that stay.
template <class S> void StateLoader<S>::forget_places() {
  forgotten_.clear();
  for (const std::uint32_t p : other_pages_) {
    if (p < state_.static_bodies.pages()) forget(state_.static_bodies.page(p));
  }
  forget(state_.awake);
  forget(state_.joints);
  for (const std::uint32_t i : other_islands_) {
    if (i >= state_.sleeping.size()) continue;
    forget(state_.sleeping[i]->bodies);
    forget(state_.sleeping[i]->joints);
    map_.count_names(*state_.sleeping[i], ~0u);
  }
}
template <class S> void StateLoader<S>::forget(const BodySet<S>& bodies) {
  for (std::size_t i = 0; i < bodies.states.size(); ++i) {
    map_.place(bodies.states[i].slot, Location{});
    map_.shapes.count_use(bodies.properties[i].shape, ~0u);
    forgotten_.push_back(bodies.states[i].slot);
  }
}
template <class S> void StateLoader<S>::forget(const JointSet<S>& joints) {
  for (const JointState<S>& joint : joints.states) map_.joints.place(joint.slot, Location{});
}

/// Renews those places from the new state. The broad phase changes only where a body differs from what it knew.
template <class S> void StateLoader<S>::renew_places() {
  map_.make_room();
  map_.joints.make_room();
  for (const std::uint32_t p : other_pages_) {
    if (p >= state_.static_bodies.pages()) continue;
    map_.relabel_static(p);
    place(state_.static_bodies.page(p), false);
  }
  map_.relabel(state_.awake, Location::kAwake, 0);
  place(state_.awake, true);
  map_.joints.relabel(state_.joints, Location::kAwake, 0);
  for (const std::uint32_t i : other_islands_) {
    if (i >= state_.sleeping.size()) continue;
    map_.relabel(state_.sleeping[i]->bodies, i, 0);
    place(state_.sleeping[i]->bodies, false);
    map_.joints.relabel(state_.sleeping[i]->joints, i, 0);
    map_.count_names(*state_.sleeping[i], 1);
  }
  for (const std::uint32_t slot : forgotten_) {
    if (map_.location(slot).set == Location::kNone) proxies_.remove(slot);
  }
}
template <class S> void StateLoader<S>::place(const BodySet<S>& bodies, bool awake) {
  for (std::size_t i = 0; i < bodies.states.size(); ++i) {
    map_.shapes.count_use(bodies.properties[i].shape, 1);
    proxies_.place(bodies.states[i], bodies.properties[i], awake);
  }
}

}  // namespace isostep
