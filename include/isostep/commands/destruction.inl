// Bodies of destruction.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/commands/destruction.hpp"
#include "isostep/core/stable_sort.hpp"
#include "isostep/store/contact_ends.hpp"
#include "isostep/store/event_order.hpp"

namespace isostep {

template <class S> void Destruction<S>::mark(std::uint32_t slot) {
  wake_.wake(slot);
  wake_.wake_touching(slot);
  const bool holds = map_.properties_at(map_.location(slot)).type != BodyType::dynamic || map_.names(slot) != 0;
  if (holds) wake_.wake_held_by(slot);
  proxies_.remove(slot);
  if (ranks_.size() <= slot) ranks_.resize(slot + 1);
  ranks_[slot] = static_cast<std::uint32_t>(marked_.size());
  marked_.push_back(slot);
  is_marked_.set(slot);
  if (map_.location(slot).set == Location::kAwake) ++marked_awake_;
}

template <class S> void Destruction<S>::erase_marked() {
  if (marked_.empty()) return;
  tell_ends();
  erase_what_names_them();
  std::erase_if(state_.moves, [&](const PendingMove<S>& m) { return is_marked(m.slot); });
  erase_joints();
  remove_records([&](const auto& record) {
    Turn turn = min(turn_of_body(detail::first_body_of(record)), turn_of_body(detail::second_body_of(record)));
    for (const JointId joint : detail::joints_of(record).all) turn = min(turn, turn_of_joint(joint));
    return turn;
  });
  erase_records();
  for (const Going& joint : joints_) turns_[joint.slot] = kStays;
  for (const std::uint32_t slot : marked_) {
    state_.body_slots.give_back(slot);
    map_.place(slot, Location{});
    is_marked_.reset(slot);
  }
  marked_.clear();
  marked_awake_ = 0;
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

/// Notes for the next step's report that contacts and overlaps of the marked bodies have ended.
template <class S> void Destruction<S>::tell_ends() {
  const auto id = [&](std::uint32_t slot) { return state_.body_slots.template id_of<BodyId>(slot); };
  const auto ends = [&](std::uint32_t a, std::uint32_t b) { return is_marked(a) || is_marked(b); };
  std::uint64_t told = ~std::uint64_t{0};  // the last pair: its contacts stand side by side
  for (const Contact<S>& contact : state_.contacts) {
    constexpr std::uint32_t kBoth = contact_flag::kReported | contact_flag::kTouching;
    const std::uint32_t a = contact.key.body_a, b = contact.key.body_b;
    if ((contact.flags & kBoth) != kBoth || pair_key(a, b) == told || !ends(a, b)) continue;
    told = pair_key(a, b);
    state_.untold.contact_end.push_back(ends_of(state_, map_, contact.key));
  }
  for (const SensorOverlap overlap : state_.overlaps) {
    if (ends(overlap.sensor, overlap.other))
      state_.untold.sensor_end.push_back(
          {id(overlap.sensor), id(overlap.other), overlap.sensor_child, overlap.other_child});
  }
  detail::sort_ends(state_.untold.contact_end, contact_end_scratch_);
  detail::sort_ends(state_.untold.sensor_end, sensor_end_scratch_);
}

/// Erases contacts, overlaps and forces that name a marked body.
template <class S> void Destruction<S>::erase_what_names_them() {
  std::erase_if(state_.contacts,
                [&](const Contact<S>& c) { return is_marked(c.key.body_a) || is_marked(c.key.body_b); });
  std::erase_if(state_.overlaps, [&](SensorOverlap o) { return is_marked(o.sensor) || is_marked(o.other); });
  std::erase_if(state_.forces, [&](const PendingForce<S>& f) { return is_marked(f.slot); });
}

template <class S> void Destruction<S>::erase_records() {
  std::uint32_t first_awake = Location::kNone;
  for (const std::uint32_t slot : marked_) {
    const Location at = map_.location(slot);
    if (at.set == Location::kAwake) first_awake = min(first_awake, at.index);
    else map_.erase(slot);
  }
  if (first_awake == Location::kNone) return;
  BodySet<S>& set = state_.awake;
  std::size_t kept = first_awake;
  for (std::size_t i = first_awake; i < set.states.size(); ++i) {
    if (is_marked(set.states[i].slot)) {
      map_.shapes.count_use(set.properties[i].shape, ~0u);
      continue;
    }
    set.states[kept] = set.states[i];
    set.properties[kept++] = set.properties[i];
  }
  set.states.resize(kept);
  set.properties.resize(kept);
  map_.relabel(set, Location::kAwake, first_awake);
}

template <class S> void Destruction<S>::destroy_joint(std::uint32_t slot) {
  wake_.wake_joint(slot);
  remove_records([&](const auto& record) {
    bool named = false;
    for (const JointId joint : detail::joints_of(record).all) named = named || (joint && joint.slot == slot);
    return named ? Turn{0} : kStays;
  });
  map_.joints.erase(slot);
  state_.joint_slots.give_back(slot);
}

/// A body goes after its joints, which go by slot.
template <class S> auto Destruction<S>::turn_of_body(BodyId body) const -> Turn {
  return body && is_marked(body.slot) ? Turn{ranks_[body.slot]} << 33 | Turn{1} << 32 : kStays;
}
template <class S> auto Destruction<S>::turn_of_joint(JointId joint) const -> Turn {
  return joint && joint.slot < turns_.size() ? turns_[joint.slot] : kStays;
}

/// Erases the joints of marked bodies. They are awake: whatever slept and names such a body has been woken.
template <class S> void Destruction<S>::erase_joints() {
  joints_.clear();
  turns_.resize(state_.joint_slots.entries().size(), kStays);
  JointSet<S>& set = state_.joints;
  const auto rank = [&](std::uint32_t slot) {
    return slot != kNoBody && is_marked(slot) ? Turn{ranks_[slot]} : kStays >> 33;
  };
  std::size_t kept = 0;
  for (std::size_t i = 0; i < set.states.size(); ++i) {
    const std::uint32_t slot = set.states[i].slot;
    const Turn first = min(rank(set.properties[i].body_a), rank(set.properties[i].body_b));
    if (first != kStays >> 33) {
      wake_.wake_joint(slot);
      joints_.push_back({turns_[slot] = first << 33 | slot, slot});
      map_.joints.place(slot, Location{});
      continue;
    }
    if (kept != i) {
      set.states[kept] = set.states[i];
      set.properties[kept] = set.properties[i];
      map_.joints.place(slot, {Location::kAwake, static_cast<std::uint32_t>(kept)});
    }
    ++kept;
  }
  set.states.resize(kept);
  set.properties.resize(kept);
  sort(joints_);
  for (const Going& joint : joints_) state_.joint_slots.give_back(joint.slot);
}

/// Removes the records whose turn_of(record) is not kStays, in the order of their turns.
template <class S> template <class TurnOf> void Destruction<S>::remove_records(const TurnOf& turn_of) {
  const auto find = [&](const auto& registry) {
    records_.clear();
    for (std::uint32_t i = 0; i < registry.all().size(); ++i) {
      const Turn turn = registry.is_taken(i) ? turn_of(registry.all()[i]) : kStays;
      if (turn != kStays) records_.push_back({turn, i});
    }
    return !records_.empty();
  };
  bool any = false;
  RecordStore<S>::members([&](const char*, const auto& registry) { any = any || find(registry); }, *state_.records);
  if (!any) return;
  RecordStore<S>::members(
      [&]<class Record, class IdType>(const char*, Registry<Record, IdType>& registry) {
        if (!find(registry)) return;
        sort(records_);
        for (const Going& record : records_) {
          registry.remove_at(record.slot);
          detail::renew_parts<IdType>(state_.parts, record.slot);
        }
      },
      state_.records.change());
}

template <class S> void Destruction<S>::sort(std::vector<Going>& going) {
  scratch_.resize(going.size());
  stable_sort(going.data(), scratch_.data(), static_cast<std::uint32_t>(going.size()), ByTurn{});
}

}  // namespace isostep
