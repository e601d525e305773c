// Bodies of destruction.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/stable_sort.hpp"
#include "isostep/world/destruction.hpp"
#include "isostep/world/event_order.hpp"

namespace isostep {

template <class S> void Destruction<S>::mark(std::uint32_t slot) {
  wake_.wake(slot);
  wake_.wake_touching(slot);
  destroy_joints_of(slot);
  if (map_.properties_at(map_.location(slot)).type != BodyType::dynamic) wake_.wake_held_by(slot);
  remove_forces_of(slot);
  proxies_.remove(slot);
  marked_.push_back(slot);
  is_marked_.set(slot);
}

template <class S> void Destruction<S>::erase_marked() {
  if (marked_.empty()) return;
  tell_ends();
  erase_what_names_them();
  erase_records();
  for (const std::uint32_t slot : marked_) {
    state_.body_slots.give_back(slot);
    map_.place(slot, Location{});
    is_marked_.reset(slot);
  }
  marked_.clear();
}

template <class S> void Destruction<S>::part(std::uint32_t slot) {
  wake_.wake(slot);
  wake_.wake_touching(slot);
  wake_.wake_held_by(slot);
  is_marked_.set(slot);
  tell_ends();
  erase_what_names_them();
  is_marked_.reset(slot);
}

/// The next step reports that what touched the marked bodies, or was inside them, does so no more.
template <class S> void Destruction<S>::tell_ends() {
  const auto id = [&](std::uint32_t slot) { return state_.body_slots.template id_of<BodyId>(slot); };
  const auto ends = [&](std::uint32_t a, std::uint32_t b) { return is_marked(a) || is_marked(b); };
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

/// What names a marked body.
template <class S> void Destruction<S>::erase_what_names_them() {
  std::erase_if(state_.contacts,
                [&](const Contact<S>& c) { return is_marked(c.key.body_a) || is_marked(c.key.body_b); });
  std::erase_if(state_.overlaps, [&](SensorOverlap o) { return is_marked(o.sensor) || is_marked(o.other); });
  std::erase_if(state_.forces, [&](const PendingForce<S>& f) { return is_marked(f.slot); });
}

template <class S> void Destruction<S>::erase_records() {
  std::uint32_t first_awake = Location::kNone, first_static = Location::kNone;
  for (const std::uint32_t slot : marked_) {
    const Location at = map_.location(slot);
    std::uint32_t& first = at.set == Location::kStatic ? first_static : first_awake;
    first = min(first, at.index);
  }
  if (first_awake != Location::kNone) erase_records(state_.awake, Location::kAwake, first_awake);
  if (first_static != Location::kNone) erase_records(state_.static_bodies.change(), Location::kStatic, first_static);
}
template <class S> void Destruction<S>::erase_records(BodySet<S>& set, std::uint32_t name, std::size_t first) {
  std::size_t kept = first;
  for (std::size_t i = first; i < set.states.size(); ++i) {
    if (is_marked(set.states[i].slot)) continue;
    set.states[kept] = set.states[i];
    set.properties[kept++] = set.properties[i];
  }
  set.states.resize(kept);
  set.properties.resize(kept);
  map_.relabel(set, name, first);
}

template <class S> void Destruction<S>::destroy_joint(std::uint32_t slot) {
  wake_.wake_joint(slot);
  remove_records_of_joint(slot);
  map_.erase_joint(slot);
  state_.joint_slots.give_back(slot);
}

/// The records that name it.
template <class S> void Destruction<S>::remove_forces_of(std::uint32_t slot) {
  remove_records([slot](const auto& record) {
    const BodyId a = detail::first_body_of(record), b = detail::second_body_of(record);
    return (a && a.slot == slot) || (b && b.slot == slot);
  });
}
template <class S> void Destruction<S>::remove_records_of_joint(std::uint32_t slot) {
  remove_records([slot](const auto& record) {
    bool named = false;
    for (const JointId joint : detail::joints_of(record).all) named = named || (joint && joint.slot == slot);
    return named;
  });
}
template <class S> template <class Names> void Destruction<S>::remove_records(const Names& names) {
  const auto each = [&](const auto& registry, const auto& visit) {
    for (std::uint32_t i = 0; i < registry.all().size(); ++i) {
      if (names(registry.all()[i])) visit(i);
    }
  };
  bool any = false;
  ForceRecords<S>::members(
      [&](const char*, const auto& registry) { each(registry, [&](std::uint32_t) { any = true; }); },
      *state_.force_records);
  if (!any) return;
  ForceRecords<S>::members(
      [&](const char*, auto& registry) { each(registry, [&](std::uint32_t i) { registry.remove_at(i); }); },
      state_.force_records.change());
}

/// In order of their slots.
template <class S> void Destruction<S>::destroy_joints_of(std::uint32_t slot) {
  std::vector<std::uint64_t> found;
  const auto look = [&](const JointSet<S>& joints) {
    for (std::size_t i = 0; i < joints.states.size(); ++i) {
      if (joints.properties[i].body_a == slot || joints.properties[i].body_b == slot)
        found.push_back(joints.states[i].slot);
    }
  };
  look(state_.joints);
  if (map_.names(slot) != 0) {
    for (const auto& island : state_.sleeping) look(island->joints);
  }
  std::vector<std::uint64_t> scratch(found.size());
  stable_sort(found.data(), scratch.data(), static_cast<std::uint32_t>(found.size()), OwnKey{});
  for (const std::uint64_t joint : found) destroy_joint(static_cast<std::uint32_t>(joint));
}

}  // namespace isostep
