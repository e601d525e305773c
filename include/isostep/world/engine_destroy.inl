// WorldEngine: destroying bodies, one or many, with all that names them.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/stable_sort.hpp"
#include "isostep/world/engine.hpp"

namespace isostep {

template <class S> bool WorldEngine<S>::execute(const DestroyBody& command) {
  const bool known = doom(command.body);
  bury_doomed();
  return known;
}

/// As many commands; a stale id is a fault, and the others go on.
template <class S>
template <class Accepted>
std::size_t WorldEngine<S>::destroy_all(std::span<const BodyId> bodies, const Accepted& accepted) {
  std::size_t count = 0;
  for (const BodyId body : bodies) {
    if (!doom(body)) continue;
    accepted(DestroyBody{body});
    ++count;
    // Sleepers are woken to be destroyed: so that the awake stay few, those that are gone leave now and then.
    if (doomed_.size() > 64 && doomed_.size() > state_.awake.states.size() / 4) bury_doomed();
  }
  bury_doomed();
  return count;
}

/// All of destroying a body but what takes a pass over the world: its records stay, unreachable, until `bury_doomed`.
template <class S> bool WorldEngine<S>::doom(BodyId body) {
  const Location at = locate(body);
  if (at.set == Location::kNone) return refuse(Fault::stale_id);
  const std::uint32_t slot = body.slot;
  if (at.is_frozen()) thaw_body(slot);
  wake_touching(slot);
  destroy_joints_of(slot);
  if (properties_at(locations_[slot]).type != BodyType::dynamic) wake_held_by(slot);
  proxies_.remove(slot);
  state_.body_slots.give_back(slot);
  doomed_.push_back(slot);
  is_doomed_.set(slot);
  return true;
}

/// Drops the records of doomed bodies and all that names them, in one pass over each array.
template <class S> void WorldEngine<S>::bury_doomed() {
  if (doomed_.empty()) return;
  const auto gone = [&](std::uint32_t slot) { return is_doomed_.test(slot); };
  std::erase_if(state_.contacts, [&](const Contact<S>& c) { return gone(c.key.body_a) || gone(c.key.body_b); });
  std::erase_if(state_.overlaps, [&](SensorOverlap o) { return gone(o.sensor) || gone(o.other); });
  std::erase_if(state_.forces, [&](const PendingForce<S>& f) { return gone(f.slot); });
  std::uint32_t first_awake = Location::kNone, first_fixed = Location::kNone;
  for (const std::uint32_t slot : doomed_) {
    const Location at = locations_[slot];
    std::uint32_t& first = at.set == Location::kFixed ? first_fixed : first_awake;
    first = min(first, at.index);
  }
  const auto erase = [&](BodySet<S>& set, std::uint32_t name, std::size_t first) {
    std::size_t kept = first;
    for (std::size_t i = first; i < set.states.size(); ++i) {
      if (gone(set.states[i].slot)) continue;
      set.states[kept] = set.states[i];
      set.properties[kept++] = set.properties[i];
    }
    set.states.resize(kept);
    set.properties.resize(kept);
    relabel(set, name, first);
  };
  if (first_awake != Location::kNone) erase(state_.awake, Location::kAwake, first_awake);
  if (first_fixed != Location::kNone) erase(state_.fixed.change(), Location::kFixed, first_fixed);
  for (const std::uint32_t slot : doomed_) {
    locations_[slot] = Location{};
    is_doomed_.reset(slot);
  }
  doomed_.clear();
}

/// In order of their slots.
template <class S> void WorldEngine<S>::destroy_joints_of(std::uint32_t slot) {
  std::vector<std::uint64_t> found;
  const auto look = [&](const JointSet<S>& joints) {
    for (std::size_t i = 0; i < joints.states.size(); ++i) {
      if (joints.properties[i].body_a == slot || joints.properties[i].body_b == slot)
        found.push_back(joints.states[i].slot);
    }
  };
  look(state_.joints);
  if (named_[slot] != 0) {
    for (const auto& island : state_.frozen) look(island->joints);
  }
  std::vector<std::uint64_t> scratch(found.size());
  stable_sort(found.data(), scratch.data(), static_cast<std::uint32_t>(found.size()), OwnKey{});
  for (const std::uint64_t joint : found)
    execute(DestroyJoint{state_.joint_slots.template id_of<JointId>(static_cast<std::uint32_t>(joint))});
}

}  // namespace isostep
