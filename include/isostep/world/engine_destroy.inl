// WorldEngine: destroying bodies, one or many, with all that names them.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/stable_sort.hpp"
#include "isostep/world/engine.hpp"
#include "isostep/world/engine_contacts.inl"

namespace isostep {

template <class S> bool WorldEngine<S>::execute(const DestroyBody& command) {
  const bool known = doom(command.body);
  bury_doomed();
  return known;
}

/// As many commands; a stale id is a fault, and the others go on. Returns how many were destroyed.
template <class S> std::size_t WorldEngine<S>::destroy_all(std::span<const BodyId> bodies) {
  std::size_t count = 0;
  for (const BodyId body : bodies) {
    if (!doom(body)) {
      journal_.sign(kCommandNames[detail::IndexOf<DestroyBody, Command>::kValue]);
      continue;
    }
    journal_.record<Command>(DestroyBody{body});
    ++count;
    // Sleepers are woken to be destroyed: so that the awake stay few, those that are gone leave now and then.
    if (doomed_.size() > 64 && doomed_.size() > state_.awake.states.size() / 4) bury_doomed();
  }
  bury_doomed();
  return count;
}

/// All of destroying a body but what takes a pass over the world: its id and its records stay until `bury_doomed`.
template <class S> bool WorldEngine<S>::doom(BodyId body) {
  if (!known(body)) return false;
  if (is_doomed_.test(body.slot)) return journal_.refuse({Fault::stale_id, "", "body", ""});
  const std::uint32_t slot = body.slot;
  const Location at = locations_[slot];
  if (at.is_frozen()) thaw_body(slot);
  wake_touching(slot);
  destroy_joints_of(slot);
  if (properties_at(locations_[slot]).type != BodyType::dynamic) wake_held_by(slot);
  proxies_.remove(slot);
  doomed_.push_back(slot);
  is_doomed_.set(slot);
  return true;
}

/// The next step tells that what touched the doomed, or was inside them, does so no more.
template <class S> void WorldEngine<S>::end_touches_of_doomed() {
  const auto id = [&](std::uint32_t slot) { return state_.body_slots.template id_of<BodyId>(slot); };
  const auto ends = [&](std::uint32_t a, std::uint32_t b) { return is_doomed_.test(a) || is_doomed_.test(b); };
  std::uint64_t told = ~std::uint64_t{0};  // the last pair: its contacts stand side by side
  for (const Contact<S>& contact : state_.contacts) {
    const std::uint32_t a = contact.key.body_a, b = contact.key.body_b;
    if ((contact.flags & contact_flag::kTouching) == 0 || pair_key(a, b) == told || !ends(a, b)) continue;
    told = pair_key(a, b);
    state_.untold.contact_end.push_back({id(a), id(b)});
  }
  for (const SensorOverlap overlap : state_.overlaps) {
    if (ends(overlap.sensor, overlap.other))
      state_.untold.sensor_end.push_back({id(overlap.sensor), id(overlap.other)});
  }
  detail::sort_ends(state_.untold.contact_end, contact_end_scratch_);
  detail::sort_ends(state_.untold.sensor_end, sensor_end_scratch_);
}

/// Drops the ids and records of doomed bodies and all that names them, in one pass over each array.
template <class S> void WorldEngine<S>::bury_doomed() {
  if (doomed_.empty()) return;
  end_touches_of_doomed();
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
    state_.body_slots.give_back(slot);
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
