// WorldEngine: who touches whom: waking what is touched, sensor overlaps, events of contacts.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/stable_sort.hpp"
#include "isostep/world/engine.hpp"
#include "isostep/world/engine_manifolds.inl"

namespace isostep {

namespace detail {
/// No two ends have the same slots: a body that took another's slot has not been through a step.
struct EndKey {
  ISO_INLINE std::uint64_t operator()(const ContactEnd& end) const { return pair_key(end.a.slot, end.b.slot); }
  ISO_INLINE std::uint64_t operator()(const SensorEvent& end) const {
    return std::uint64_t{end.sensor.slot} << 32 | end.other.slot;
  }
};
template <class End> void sort_ends(std::vector<End>& ends, std::vector<End>& scratch) {
  scratch.resize(ends.size());
  stable_sort(ends.data(), scratch.data(), static_cast<std::uint32_t>(ends.size()), EndKey{});
}
}  // namespace detail

template <class S> std::uint32_t WorldEngine<S>::row_of(std::uint32_t slot) const {
  if (slot == kNoBody) return 0;
  const Location at = locations_[slot];
  return at.set == Location::kAwake ? at.index + 1 : 0;
}

template <class S> void WorldEngine<S>::find_pairs() {
  update_pairs();
  wake_touched_islands();
  report_.crowded = proxies_.bodies_left_out();
}
template <class S> void WorldEngine<S>::update_pairs() {
  proxies_.update(state_.contacts, static_cast<std::size_t>(state_.settings.most_pairs));
}

template <class S> bool WorldEngine<S>::bodies_touch(std::uint32_t slot_a, std::uint32_t slot_b) const {
  constexpr S kMargin = detail::kSpeculativeDistance<S>;
  const BodyFrame<S> a = frame_at(locations_[slot_a]), b = frame_at(locations_[slot_b]);
  bool touch = false;
  std::uint64_t looks = ~std::uint64_t{0};
  visit_parts(a, b, kMargin, looks, [&](std::uint32_t i, std::uint32_t j) {
    Manifold<S> manifold;
    collide_parts(a, i, b, j, kMargin, manifold);
    touch = manifold.count > 0;
    return !touch;
  });
  return touch;
}

/// An island wakes when something awake that moves has a contact with it. Waking brings new pairs, so until none is
/// left.
template <class S> void WorldEngine<S>::wake_touched_islands() {
  if (state_.frozen.empty()) return;
  std::vector<std::uint32_t>& touched = slots_;
  do {
    touched.clear();
    for (const std::uint64_t key : proxies_.pairs()) {
      const Location a = locations_[pair_a(key)], b = locations_[pair_b(key)];
      if (a.is_frozen() == b.is_frozen()) continue;
      const Location mover = a.is_frozen() ? b : a;
      if (mover.set != Location::kAwake) continue;
      const BodyState<S>& state = state_.awake.states[mover.index];
      const BodyProperties<S>& body = state_.awake.properties[mover.index];
      const bool still = state.velocity == Vec3<Velocity<S>>::zero() && state.spin == Vec3<Velocity<S>>::zero();
      if (body.type == BodyType::kinematic && still) continue;
      if (((body.flags | properties_at(a.is_frozen() ? a : b).flags) & body_flag::kSensor) != 0) continue;
      if (bodies_touch(pair_a(key), pair_b(key))) touched.push_back(a.is_frozen() ? pair_a(key) : pair_b(key));
    }
    thaw_bodies(touched);
    if (!touched.empty()) update_pairs();
  } while (!touched.empty());
}

/// Overlaps of bodies that both lie still are kept: nobody looked, because nothing moved.
template <class S> void WorldEngine<S>::update_sensors() {
  for (const SensorOverlap& old : state_.overlaps) {
    const bool watched =
        locations_[old.sensor].set == Location::kAwake || locations_[old.other].set == Location::kAwake;
    if (!watched) new_overlaps_.push_back(old);
  }
  overlap_scratch_.resize(new_overlaps_.size());
  struct ByPair {
    ISO_INLINE std::uint64_t operator()(SensorOverlap o) const { return std::uint64_t{o.sensor} << 32 | o.other; }
  };
  stable_sort(new_overlaps_.data(), overlap_scratch_.data(), static_cast<std::uint32_t>(new_overlaps_.size()),
              ByPair{});
  const auto event = [&](SensorOverlap o) {
    return SensorEvent{state_.body_slots.template id_of<BodyId>(o.sensor),
                       state_.body_slots.template id_of<BodyId>(o.other)};
  };
  const bool told = !events_.sensor_end.empty();
  std::size_t i = 0, j = 0;
  while (i < state_.overlaps.size() || j < new_overlaps_.size()) {
    const bool old_first =
        j == new_overlaps_.size() || (i < state_.overlaps.size() && state_.overlaps[i] < new_overlaps_[j]);
    const bool new_first =
        i == state_.overlaps.size() || (j < new_overlaps_.size() && new_overlaps_[j] < state_.overlaps[i]);
    if (old_first) events_.sensor_end.push_back(event(state_.overlaps[i++]));
    else if (new_first) events_.sensor_begin.push_back(event(new_overlaps_[j++]));
    else ++i, ++j;
  }
  state_.overlaps.swap(new_overlaps_);
  if (told) detail::sort_ends(events_.sensor_end, sensor_end_scratch_);
}

/// Two bodies touch when any of their contacts carried an impulse. Both lists ascend, so the events do, but for ends
/// that commands made.
template <class S> void WorldEngine<S>::emit_contact_events() {
  const std::vector<Contact<S>>& now = state_.contacts;
  const auto id = [&](std::uint32_t slot) { return state_.body_slots.template id_of<BodyId>(slot); };
  constexpr std::uint64_t kNone = ~std::uint64_t{0};
  const auto pair_at = [&](const std::vector<Contact<S>>& list, std::size_t at) {
    return at < list.size() ? pair_key(list[at].key.body_a, list[at].key.body_b) : kNone;
  };
  const auto touching = [](const Contact<S>& c) { return (c.flags & contact_flag::kTouching) != 0; };
  const bool told = !events_.contact_end.empty();
  std::size_t i = 0, j = 0;
  std::uint64_t old_pair = pair_at(old_contacts_, 0), new_pair = pair_at(now, 0);
  while (min(old_pair, new_pair) != kNone) {
    const std::uint64_t pair = min(old_pair, new_pair);
    const std::size_t first = j;
    bool was = false, is = false;
    for (; old_pair == pair; old_pair = pair_at(old_contacts_, ++i)) was = was || touching(old_contacts_[i]);
    for (; new_pair == pair; new_pair = pair_at(now, ++j)) is = is || touching(now[j]);
    if (was && !is) events_.contact_end.push_back({id(pair_a(pair)), id(pair_b(pair))});
    if (!was && is)
      events_.contact_begin.push_back(
          {id(pair_a(pair)), id(pair_b(pair)), pressing(first, j), geometry_[first].normal});
  }
  if (told) detail::sort_ends(events_.contact_end, contact_end_scratch_);
}

/// [kg] As solvers have it: 0 for what no impulse moves.
template <class S> S WorldEngine<S>::mass_of_row(std::uint32_t row) const {
  if (row == 0) return S(0);
  const BodyProperties<S>& body = state_.awake.properties[row - 1];
  return body.type == BodyType::dynamic ? body.mass : S(0);
}

/// What contacts first..end-1 gave over the step along their normals [kg m/s].
template <class S> S WorldEngine<S>::pressing(std::size_t first, std::size_t end) const {
  auto total = SumOf<S, Velocity<S>>{};
  for (std::size_t i = first; i < end; ++i) {
    const S mass_a = mass_of_row(geometry_[i].row_a), mass_b = mass_of_row(geometry_[i].row_b);
    const MassShare<S> share = mass_share(mass_a, mass_b);
    total = total + product(mass_b > S(0) ? share.b * mass_b : mass_a, step_impulses_[i]);
  }
  const auto most = product(highest<S>(), Velocity<S>(1));
  return most < total ? highest<S>() : round_to<S>(total);
}

}  // namespace isostep
