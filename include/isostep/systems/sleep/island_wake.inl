// Bodies of island_wake.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/continuous/shape_impact.hpp"
#include "isostep/core/stable_sort.hpp"
#include "isostep/geometry/bounds.hpp"
#include "isostep/store/body_frames.hpp"
#include "isostep/store/fat_box.hpp"
#include "isostep/store/ghosts.hpp"
#include "isostep/systems/sleep/island_wake.hpp"

namespace isostep {

namespace detail {
/// Merges two ascending runs from the back, in place. put(to, from_old, index) moves one record of either.
template <class OldIsLater, class Put>
void merge_from_back(std::size_t old, std::size_t more, const OldIsLater& old_is_later, const Put& put) {
  for (std::size_t to = old + more; more > 0; --to) {
    const bool from_old = old > 0 && old_is_later(old - 1, more - 1);
    put(to - 1, from_old, from_old ? --old : --more);
  }
}
/// Sorts slots into the order in which islands wake.
inline void sort_slots(std::vector<std::uint32_t>& slot_list) {
  std::vector<std::uint32_t> scratch(slot_list.size());
  stable_sort(slot_list.data(), scratch.data(), static_cast<std::uint32_t>(slot_list.size()), OwnKey{});
}
}  // namespace detail

template <class S> void IslandWake<S>::wake(std::uint32_t slot) { wake({&slot, 1}); }
template <class S> void IslandWake<S>::wake(std::span<const std::uint32_t> slot_list) {
  for (const std::uint32_t slot : slot_list) {
    const Location at = map_.location(slot);
    if (at.is_asleep()) start_waking(at.set);
  }
  merge_woken();
}
template <class S> void IslandWake<S>::wake_all() {
  while (!state_.sleeping.empty()) start_waking(static_cast<std::uint32_t>(state_.sleeping.size() - 1));
  merge_woken();
  for (BodyState<S>& state : state_.awake.states) state.sleep_clock = 0;
}

template <class S> bool IslandWake<S>::wake_touched() {
  if (state_.sleeping.empty()) return false;
  touched_.clear();
  for (const std::uint64_t pair : proxies_.pairs()) {
    if (!is_touched(pair)) continue;
    touched_.push_back(map_.location(pair_a(pair)).is_asleep() ? pair_a(pair) : pair_b(pair));
  }
  for (std::size_t i = 0; i < state_.awake.states.size(); ++i) find_run_over(i);
  detail::for_each_standing_wheel(state_, [&](BodyId body, const WheelState<S>& wheel) {
    if (map_.location(body.slot).set != Location::kAwake) return;
    if (map_.location(wheel.contact_body.slot).is_asleep()) touched_.push_back(wheel.contact_body.slot);
  });
  wake(touched_);
  return !touched_.empty();
}
/// Finds sleepers in the way of a kinematic body that moves by its thickness or more in the step: it would be beyond
/// them before they touch.
template <class S> void IslandWake<S>::find_run_over(std::size_t index) {
  const BodyProperties<S>& body = state_.awake.properties[index];
  if (body.type != BodyType::kinematic || !map_.shapes.has_contacts(body)) return;
  const BodyState<S>& state = state_.awake.states[index];
  const Step<S> h = divide_to<Step<S>>(S(1), S(state_.settings.hz));
  const Vec3<S> way = convert<S>(state.velocity) * h;
  if (!(detail::kSpeculativeDistance<S> < max_abs(way))) return;  // it touches first
  S thick = Limits<S>::extent();
  for (const Child<S>& child : map_.shapes.children_of(body.shape)) {
    if (!child.traits.has(part_flag::kSensor))
      thick = min(thick, thickness<S>(map_.shapes.contents().view(child.primitive)));
  }
  if (max_abs(way) < thick) return;
  const Aabb<S> there = {saturating_add(state.fat.low, way), saturating_add(state.fat.high, way)};
  const Aabb<S> swept = merge(state.fat, there);
  std::vector<std::uint32_t> met;
  proxies_.boxes().query(swept, [&](std::uint32_t other) {
    const Location at = map_.location(other);
    if (!at.is_asleep() || !overlap(swept, map_.state_at(at).fat)) return true;
    const BodyProperties<S>& sleeper = map_.properties_at(at);
    const bool collides = should_collide(map_.shapes.filter_of(body), map_.shapes.filter_of(sleeper));
    if (map_.shapes.has_contacts(sleeper) && collides && may_run_over(state, way, other) &&
        !are_ghosts(state_, map_, state.slot, other))
      met.push_back(other);
    return true;
  });
  detail::sort_slots(met);
  touched_.insert(touched_.end(), met.begin(), met.end());
}
/// Returns true if a part of the kinematic body comes near a part of the sleeper that it collides with. Skips the test
/// if no part of them has traits of its own.
template <class S>
bool IslandWake<S>::may_run_over(const BodyState<S>& state, Vec3<S> way, std::uint32_t sleeper) const {
  const BodyProperties<S>& body = map_.properties_at(map_.location(state.slot));
  const BodyProperties<S>& other = map_.properties_at(map_.location(sleeper));
  if ((map_.shapes.traits_of(body.shape).flags | map_.shapes.traits_of(other.shape).flags) == 0) return true;
  const Transform<S> own_frame = Transform<S>::of(map_.origin_pose_at(state.slot));
  const Transform<S> other_frame = Transform<S>::of(map_.origin_pose_at(sleeper));
  for (const Child<S>& part : map_.shapes.children_of(body.shape)) {
    const Aabb<S> here = bounds(part, own_frame, map_.shapes.contents());
    const Aabb<S> there = {saturating_add(here.low, way), saturating_add(here.high, way)};
    const Aabb<S> swept = grow(merge(here, there), detail::kFatMargin<S>);
    for (const Child<S>& met : map_.shapes.children_of(other.shape)) {
      if (parts_collide(part.traits, body.filter, met.traits, other.filter) &&
          overlap(swept, bounds(met, other_frame, map_.shapes.contents())))
        return true;
    }
  }
  return false;
}
/// Returns true if one of the two sleeps, and the other is awake, moves and touches it.
template <class S> bool IslandWake<S>::is_touched(std::uint64_t pair) const {
  const Location a = map_.location(pair_a(pair)), b = map_.location(pair_b(pair));
  if (a.is_asleep() == b.is_asleep()) return false;
  const Location mover = a.is_asleep() ? b : a;
  if (mover.set != Location::kAwake) return false;
  const BodyState<S>& state = state_.awake.states[mover.index];
  const BodyProperties<S>& body = state_.awake.properties[mover.index];
  const bool still = state.velocity == Vec3<Velocity<S>>::zero() && state.angular_velocity == Vec3<Velocity<S>>::zero();
  if (body.type == BodyType::kinematic && still) return false;
  if (map_.shapes.is_sensor(body) || map_.shapes.is_sensor(map_.properties_at(a.is_asleep() ? a : b))) return false;
  return bodies_touch(map_, pair_a(pair), pair_b(pair), ByParts::solid) &&
         !are_ghosts(state_, map_, pair_a(pair), pair_b(pair));
}

/// Returns true if the body is a sensor: it detects others and touches none.
template <class S> bool IslandWake<S>::is_sensor(std::uint32_t slot) const {
  return map_.shapes.is_sensor(map_.properties_at(map_.location(slot)));
}
template <class S> void IslandWake<S>::wake_touching(std::uint32_t slot) {
  if (!proxies_.present(slot)) return;
  const Location at = map_.location(slot);
  wake_touching(detail::solid_box(map_, map_.state_at(at), map_.properties_at(at)), slot);
}
template <class S> void IslandWake<S>::wake_touching(const Aabb<S>& box, std::uint32_t slot) {
  if (!state_.settings.allow_sleep) return;  // nobody sleeps, nor counts the time
  const bool is_still = map_.location(slot).set == Location::kStatic;
  if (is_still && map_.shapes.senses(map_.properties_at(map_.location(slot))))
    state_.untold.sensors.push_back(state_.body_slots.template id_of<BodyId>(slot));
  if (is_sensor(slot)) return;
  if (state_.awake.states.empty() && state_.sleeping.empty()) return;  // a level before anything is in it
  std::vector<std::uint32_t> met;
  proxies_.boxes().query(box, [&](std::uint32_t other) {
    if (map_.location(other).is_asleep()) met.push_back(other);
    else if (other != slot) reset_clock(other);
    return true;
  });
  detail::sort_slots(met);
  wake(met);
}

template <class S> void IslandWake<S>::wake_held_by(std::uint32_t slot) {
  for (std::uint32_t i = static_cast<std::uint32_t>(state_.sleeping.size()); map_.names(slot) != 0 && i-- > 0;) {
    const SleepingIsland<S>& island = *state_.sleeping[i];
    bool held = false;
    for (const JointProperties<S>& joint : island.joints.properties)
      held = held || joint.body_a == slot || joint.body_b == slot;
    for (const Contact<S>& contact : island.contacts)
      held = held || contact.key.body_a == slot || contact.key.body_b == slot;
    if (held) start_waking(i);
  }
  merge_woken();
  for (const BodySpring<S>& spring : state_.records->body_springs.all()) {
    if (spring.a && spring.b && (spring.a.slot == slot || spring.b.slot == slot))
      wake(spring.a.slot == slot ? spring.b.slot : spring.a.slot);
  }
  detail::for_each_standing_wheel(state_, [&](BodyId body, const WheelState<S>& wheel) {
    if (wheel.contact_body.slot == slot) wake(body.slot);
  });
}

template <class S> void IslandWake<S>::wake_wheels_on(std::uint32_t slot, const Aabb<S>& box) {
  detail::for_each_standing_wheel(state_, [&](BodyId body, const WheelState<S>& wheel) {
    const bool is_on = wheel.contact_body.slot == slot;
    if (is_on && overlap(box, {wheel.contact_point, wheel.contact_point})) wake(body.slot);
  });
}

template <class S> std::uint32_t IslandWake<S>::wake_joint(std::uint32_t slot) {
  const Location at = map_.joints.location(slot);
  if (at.is_asleep()) {
    start_waking(at.set);
    merge_woken();
  }
  const std::uint32_t index = map_.joints.location(slot).index;
  const JointProperties<S>& properties = state_.joints.properties[index];
  reset_clock(properties.body_a);
  reset_clock(properties.body_b);
  return index;
}

template <class S> BodyState<S>& IslandWake<S>::wake_for_change(std::uint32_t slot) {
  wake(slot);
  BodyState<S>& state = state_.awake.states[map_.location(slot).index];
  state.sleep_clock = 0;
  return state;
}

template <class S> void IslandWake<S>::reset_clock(std::uint32_t slot) {
  if (slot != kNoBody && map_.location(slot).set == Location::kAwake)
    state_.awake.states[map_.location(slot).index].sleep_clock = 0;
}

/// Takes an island off the list, and the last one fills its place. Its bodies count as awake, but are in no array until
/// `merge_woken`.
template <class S> void IslandWake<S>::start_waking(std::uint32_t index) {
  const std::shared_ptr<const SleepingIsland<S>> island = state_.sleeping[index];
  const std::size_t last = state_.sleeping.size() - 1;
  if (index != last) {
    const std::shared_ptr<const SleepingIsland<S>> moved = state_.sleeping[last];
    state_.sleeping.change(index) = moved;
    map_.relabel(moved->bodies, index, 0);
    map_.joints.relabel(moved->joints, index, 0);
  }
  state_.sleeping.pop_back();
  map_.count_names(*island, ~0u);
  for (const BodyState<S>& body : island->bodies.states) map_.place(body.slot, {Location::kAwake, 0});
  woken_.push_back(island);
}

/// Merges the bodies, joints and contacts of woken islands into the awake ones, in canonical order and in one pass over
/// each array.
template <class S> void IslandWake<S>::merge_woken() {
  if (woken_.empty()) return;
  merge_set(
      state_.awake, [](const SleepingIsland<S>& island) -> const auto& { return island.bodies; });
  merge_set(
      state_.joints, [](const SleepingIsland<S>& island) -> const auto& { return island.joints; });
  merge_contacts();
  map_.relabel(state_.awake, Location::kAwake, 0);
  map_.joints.relabel(state_.joints, Location::kAwake, 0);
  for (const auto& island : woken_) {
    for (const BodyState<S>& asleep : island->bodies.states) {
      const std::uint32_t index = map_.location(asleep.slot).index;
      state_.awake.states[index].sleep_clock = 0;
      proxies_.place(state_.awake.states[index], state_.awake.properties[index], true);
      state_.untold.woke.push_back(state_.body_slots.template id_of<BodyId>(asleep.slot));
    }
  }
  woken_.clear();
}

/// Fills `records_` with one array of every woken island, in order. Returns the number of records.
template <class S>
template <class ArrayOf, class KeyOf>
std::size_t IslandWake<S>::sort_records(const ArrayOf& array_of, const KeyOf& key_of) {
  records_.clear();
  for (const auto& island : woken_) {
    const auto& array = array_of(*island);
    for (std::size_t i = 0; i < array.size(); ++i) records_.push_back({key_of(array[i]), island.get(), i});
  }
  scratch_.resize(records_.size());
  stable_sort(records_.data(), scratch_.data(), static_cast<std::uint32_t>(records_.size()), ByKey{});
  return records_.size();
}

template <class S> template <class Set, class SetOf> void IslandWake<S>::merge_set(Set& into, const SetOf& set_of) {
  const std::size_t old = into.states.size();
  const std::size_t more = sort_records(
      [&](const SleepingIsland<S>& island) -> const auto& { return set_of(island).states; },
      [](const auto& state) { return std::uint64_t{state.slot}; });
  into.states.resize(old + more);
  into.properties.resize(old + more);
  detail::merge_from_back(
      old, more, [&](std::size_t i, std::size_t j) { return records_[j].key < into.states[i].slot; },
      [&](std::size_t to, bool from_old, std::size_t i) {
        const auto& from = from_old ? into : set_of(*records_[i].island);
        const std::size_t at = from_old ? i : records_[i].index;
        into.states[to] = from.states[at];
        into.properties[to] = from.properties[at];
      });
}

/// Merges contacts. Those of a pair lie in one island, ascending, and the sort is stable: the pair suffices as key.
template <class S> void IslandWake<S>::merge_contacts() {
  const auto pair_of = [](const Contact<S>& contact) { return pair_key(contact.key.body_a, contact.key.body_b); };
  std::vector<Contact<S>>& contacts = state_.contacts;
  const std::size_t old = contacts.size();
  const std::size_t more = sort_records(
      [](const SleepingIsland<S>& island) -> const auto& { return island.contacts; }, pair_of);
  contacts.resize(old + more);
  detail::merge_from_back(
      old, more, [&](std::size_t i, std::size_t j) { return records_[j].key < pair_of(contacts[i]); },
      [&](std::size_t to, bool from_old, std::size_t i) {
        contacts[to] = from_old ? contacts[i] : records_[i].island->contacts[records_[i].index];
      });
}

}  // namespace isostep
