// WorldEngine: falling asleep and waking, whole islands at a time.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/stable_sort.hpp"
#include "isostep/state/members.hpp"
#include "isostep/world/engine.hpp"

namespace isostep {

namespace detail {
template <class S> inline constexpr S kSleepSpeed = S(0.05);  // [m/s], and [rad/s] times the body's size
inline constexpr std::uint32_t kStepsPerSleepDelay = 2;       // a second over this: half a second of rest

/// Merges two ascending runs from the back, in place: put(to, from_old, index) moves one record of either.
template <class OldIsLater, class Put>
void merge_from_back(std::size_t old, std::size_t more, const OldIsLater& old_is_later, const Put& put) {
  for (std::size_t to = old + more; more > 0; --to) {
    const bool from_old = old > 0 && old_is_later(old - 1, more - 1);
    put(to - 1, from_old, from_old ? --old : --more);
  }
}
struct WokenKey {
  template <class S> ISO_INLINE std::uint64_t operator()(const WokenRecord<S>& record) const { return record.key; }
};
}  // namespace detail

template <class S> void WorldEngine<S>::update_sleep() {
  if (!state_.settings.allow_sleep) return;
  update_sleep_clocks();
  const auto delay = static_cast<std::uint32_t>(state_.settings.hz) / detail::kStepsPerSleepDelay;
  for (std::size_t i = 0; i < state_.awake.states.size(); ++i) {
    if (state_.awake.states[i].sleep_clock < delay || state_.awake.properties[i].type != BodyType::dynamic) continue;
    freeze_ready_islands();
    return;
  }
}

template <class S> void WorldEngine<S>::update_sleep_clocks() {
  const Velocity<S> limit = convert<Velocity<S>>(detail::kSleepSpeed<S>);
  for (std::size_t i = 0; i < state_.awake.states.size(); ++i) {
    BodyState<S>& state = state_.awake.states[i];
    const BodyProperties<S>& body = state_.awake.properties[i];
    const bool may = (body.flags & body_flag::kAllowSleep) != 0;
    // A kinematic body rests when told to: however slow, it carries what lies on it.
    const bool still = state.velocity == Vec3<Velocity<S>>::zero() && state.spin == Vec3<Velocity<S>>::zero();
    const bool slow = max_abs(state.velocity) < limit && max_abs(state.spin) < limit;
    const bool rests = body.type == BodyType::kinematic ? still : slow;
    state.sleep_clock = may && rests ? state.sleep_clock + (state.sleep_clock < 0xffffffffu ? 1u : 0u) : 0u;
  }
  // What rests on something that moves is not at rest: a drum or a conveyor carries it.
  for (const Contact<S>& contact : state_.contacts) {
    const std::uint32_t slots[2] = {contact.key.body_a, contact.key.body_b};
    for (int side = 0; side < 2; ++side) {
      const Location at = locations_[slots[side]];
      const Location other = locations_[slots[1 - side]];
      if (other.set != Location::kAwake) continue;
      const BodyProperties<S>& body = properties_at(at);
      const bool driven = body.type == BodyType::kinematic && state_at(at).sleep_clock == 0;
      if (driven || !(body.material.surface_velocity == Vec3<S>::zero()))
        state_.awake.states[other.index].sleep_clock = 0;
    }
  }
}

/// Islands all of whose bodies have rested long enough, in order of their first body.
template <class S> void WorldEngine<S>::freeze_ready_islands() {
  const auto delay = static_cast<std::uint32_t>(state_.settings.hz) / detail::kStepsPerSleepDelay;
  const std::size_t count = state_.awake.states.size();
  const auto is_dynamic = [&](std::uint32_t slot) {
    const Location at = locations_[slot];
    return at.set == Location::kAwake && state_.awake.properties[at.index].type == BodyType::dynamic;
  };
  islands_.begin(count);
  const auto tie = [&](std::uint32_t a, std::uint32_t b) {
    if (is_dynamic(a) && is_dynamic(b)) islands_.join(locations_[a].index, locations_[b].index);
  };
  for (const Contact<S>& contact : state_.contacts) {
    const bool sensor =
        ((properties_at(locations_[contact.key.body_a]).flags | properties_at(locations_[contact.key.body_b]).flags) &
         body_flag::kSensor) != 0;
    if (!sensor) tie(contact.key.body_a, contact.key.body_b);
  }
  for (const JointProperties<S>& joint : state_.joints.properties) {
    if (joint.body_a != kNoBody && joint.body_b != kNoBody) tie(joint.body_a, joint.body_b);
  }
  island_clock_.assign(count, 0xffffffffu);
  for (std::size_t i = 0; i < count; ++i) {
    std::uint32_t& clock = island_clock_[islands_.find(static_cast<std::uint32_t>(i))];
    clock = min(clock, state_.awake.states[i].sleep_clock);
  }
  // A joint to something driven keeps an island awake as a contact does.
  for (const JointProperties<S>& joint : state_.joints.properties) {
    for (const auto& [here, there] : {std::pair{joint.body_a, joint.body_b}, std::pair{joint.body_b, joint.body_a}}) {
      if (here == kNoBody || there == kNoBody || is_dynamic(here) || !is_dynamic(there)) continue;
      if (locations_[here].set == Location::kAwake && state_at(locations_[here]).sleep_clock == 0) {
        island_clock_[islands_.find(locations_[there].index)] = 0;
      }
    }
  }
  std::vector<std::uint32_t>& ready = island_clock_;  // from here on: 1 for the roots that go
  bool any = false;
  for (std::size_t i = 0; i < count; ++i) {
    const bool root = islands_.find(static_cast<std::uint32_t>(i)) == i;
    const bool dynamic_body = state_.awake.properties[i].type == BodyType::dynamic;
    ready[i] = root && dynamic_body && ready[i] >= delay ? 1u : 0u;
    any = any || ready[i] != 0;
  }
  if (!any) return;
  freeze_marked();
}

/// Moves every marked island out of the awake image in one pass over each array.
template <class S> void WorldEngine<S>::freeze_marked() {
  const std::size_t count = state_.awake.states.size();
  std::vector<std::shared_ptr<FrozenIsland<S>>> islands(count);
  const auto island_of = [&](std::size_t index) -> FrozenIsland<S>* {
    const std::uint32_t root = islands_.find(static_cast<std::uint32_t>(index));
    if (island_clock_[root] == 0) return nullptr;
    if (islands[root] == nullptr) islands[root] = std::make_shared<FrozenIsland<S>>();
    return islands[root].get();
  };
  const auto island_of_slot = [&](std::uint32_t slot) -> FrozenIsland<S>* {
    if (slot == kNoBody || locations_[slot].set != Location::kAwake) return nullptr;
    return island_of(locations_[slot].index);
  };
  std::size_t kept = 0;
  for (const Contact<S>& contact : state_.contacts) {
    FrozenIsland<S>* island = island_of_slot(contact.key.body_a);
    if (island == nullptr) island = island_of_slot(contact.key.body_b);
    if (island != nullptr) island->contacts.push_back(contact);
    else state_.contacts[kept++] = contact;
  }
  state_.contacts.resize(kept);
  kept = 0;
  JointSet<S>& joints = state_.joints;
  for (std::size_t i = 0; i < joints.states.size(); ++i) {
    FrozenIsland<S>* island = island_of_slot(joints.properties[i].body_a);
    if (island == nullptr) island = island_of_slot(joints.properties[i].body_b);
    if (island != nullptr) {
      island->joints.states.push_back(joints.states[i]);
      island->joints.properties.push_back(joints.properties[i]);
    } else {
      joints.states[kept] = joints.states[i];
      joints.properties[kept++] = joints.properties[i];
    }
  }
  joints.states.resize(kept);
  joints.properties.resize(kept);
  kept = 0;
  BodySet<S>& awake = state_.awake;
  for (std::size_t i = 0; i < count; ++i) {
    FrozenIsland<S>* island = island_of(i);
    if (island != nullptr) {
      BodyState<S> still = awake.states[i];
      still.velocity = Vec3<Velocity<S>>::zero();
      still.spin = Vec3<Velocity<S>>::zero();
      island->bodies.states.push_back(still);
      island->bodies.properties.push_back(awake.properties[i]);
      events_.fell_asleep.push_back(state_.body_slots.template id_of<BodyId>(still.slot));
    } else {
      awake.states[kept] = awake.states[i];
      awake.properties[kept++] = awake.properties[i];
    }
  }
  awake.states.resize(kept);
  awake.properties.resize(kept);
  relabel(awake, Location::kAwake, 0);
  relabel_joints(joints, Location::kAwake, 0);
  for (const std::shared_ptr<FrozenIsland<S>>& island : islands) {
    if (island == nullptr) continue;
    island->hash = detail::hash_sections(*island);
    const auto name = static_cast<std::uint32_t>(state_.frozen.size());
    relabel(island->bodies, name, 0);
    relabel_joints(island->joints, name, 0);
    for (std::size_t i = 0; i < island->bodies.states.size(); ++i) {
      proxies_.place(island->bodies.states[i], island->bodies.properties[i], false);
    }
    count_names(*island, 1);
    state_.frozen.push_back(island);
  }
}

/// Counts what an island's contacts and joints name, `by` 1 or, modulo 2^32, -1.
template <class S> void WorldEngine<S>::count_names(const FrozenIsland<S>& island, std::uint32_t by) {
  for (const Contact<S>& contact : island.contacts) {
    named_[contact.key.body_a] += by;
    named_[contact.key.body_b] += by;
  }
  for (const JointProperties<S>& joint : island.joints.properties) {
    if (joint.body_a != kNoBody) named_[joint.body_a] += by;
    if (joint.body_b != kNoBody) named_[joint.body_b] += by;
  }
}

template <class S> void WorldEngine<S>::thaw_body(std::uint32_t slot) { thaw_bodies({&slot, 1}); }

/// Wakes the islands of those that sleep, one after another in this order, at the cost of one merge.
template <class S> void WorldEngine<S>::thaw_bodies(std::span<const std::uint32_t> slots) {
  for (const std::uint32_t slot : slots) {
    if (locations_[slot].is_frozen()) unlist(locations_[slot].set);
  }
  merge_woken();
}

/// Takes an island off the list; the last one takes its place. Its bodies count as awake but are nowhere until
/// `merge_woken`.
template <class S> void WorldEngine<S>::unlist(std::uint32_t frozen_index) {
  const std::shared_ptr<const FrozenIsland<S>> island = state_.frozen[frozen_index];
  const std::size_t last = state_.frozen.size() - 1;
  if (frozen_index != last) {
    const std::shared_ptr<const FrozenIsland<S>> moved = state_.frozen[last];
    state_.frozen.change(frozen_index) = moved;
    relabel(moved->bodies, frozen_index, 0);
    relabel_joints(moved->joints, frozen_index, 0);
  }
  state_.frozen.pop_back();
  count_names(*island, ~0u);
  for (const BodyState<S>& body : island->bodies.states) locations_[body.slot] = {Location::kAwake, 0};
  woken_.push_back(island);
}

/// Moves what was unlisted into the awake image, in canonical order and in one pass over each array.
template <class S> void WorldEngine<S>::merge_woken() {
  if (woken_.empty()) return;
  const auto sort_in = [&](const auto& array_of, const auto& key_of) {
    woken_records_.clear();
    for (const auto& island : woken_) {
      const auto& array = array_of(*island);
      for (std::size_t i = 0; i < array.size(); ++i) woken_records_.push_back({key_of(array[i]), island.get(), i});
    }
    woken_scratch_.resize(woken_records_.size());
    stable_sort(woken_records_.data(), woken_scratch_.data(), static_cast<std::uint32_t>(woken_records_.size()),
                detail::WokenKey{});
    return woken_records_.size();
  };
  const auto merge_set = [&](auto& into, const auto& set_of) {
    const std::size_t old = into.states.size();
    const std::size_t more = sort_in(
        [&](const FrozenIsland<S>& island) -> const auto& { return set_of(island).states; },
        [](const auto& state) { return std::uint64_t{state.slot}; });
    into.states.resize(old + more);
    into.properties.resize(old + more);
    detail::merge_from_back(
        old, more, [&](std::size_t i, std::size_t j) { return woken_records_[j].key < into.states[i].slot; },
        [&](std::size_t to, bool from_old, std::size_t i) {
          const auto& from = from_old ? into : set_of(*woken_records_[i].island);
          const std::size_t at = from_old ? i : woken_records_[i].index;
          into.states[to] = from.states[at];
          into.properties[to] = from.properties[at];
        });
  };
  merge_set(
      state_.awake, [](const FrozenIsland<S>& island) -> const auto& { return island.bodies; });
  merge_set(
      state_.joints, [](const FrozenIsland<S>& island) -> const auto& { return island.joints; });
  // Contacts of one pair lie in one island, ascending, and the sort keeps their order: the pair is key enough.
  const auto pair_of = [](const Contact<S>& contact) { return pair_key(contact.key.body_a, contact.key.body_b); };
  std::vector<Contact<S>>& contacts = state_.contacts;
  const std::size_t old = contacts.size();
  const std::size_t more = sort_in(
      [](const FrozenIsland<S>& island) -> const auto& { return island.contacts; }, pair_of);
  contacts.resize(old + more);
  detail::merge_from_back(
      old, more, [&](std::size_t i, std::size_t j) { return woken_records_[j].key < pair_of(contacts[i]); },
      [&](std::size_t to, bool from_old, std::size_t i) {
        contacts[to] = from_old ? contacts[i] : woken_records_[i].island->contacts[woken_records_[i].index];
      });
  relabel(state_.awake, Location::kAwake, 0);
  relabel_joints(state_.joints, Location::kAwake, 0);
  for (const auto& island : woken_) {
    for (const BodyState<S>& frozen : island->bodies.states) {
      const std::uint32_t index = locations_[frozen.slot].index;
      state_.awake.states[index].sleep_clock = 0;
      proxies_.place(state_.awake.states[index], state_.awake.properties[index], true);
      state_.untold.woke.push_back(state_.body_slots.template id_of<BodyId>(frozen.slot));
    }
  }
  woken_.clear();
}

}  // namespace isostep
