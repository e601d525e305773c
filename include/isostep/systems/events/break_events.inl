// Bodies of break_events.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/store/contact_pairs.hpp"
#include "isostep/store/finite_guard.hpp"
#include "isostep/systems/events/break_events.hpp"
#include "isostep/systems/events/contact_events.inl"

namespace isostep {

template <class S> void BreakEvents<S>::collect(const SolvedContacts<S>& contacts, Events<S>& events) {
  const auto& records = state_.records->breakables;
  if (records.all().empty()) return;
  record_of_.assign(state_.body_slots.entries().size(), 0);
  blows_.assign(records.all().size(), Hit{S(0), 0, false});
  for (std::uint32_t slot = 0; slot < records.all().size(); ++slot) {
    if (records.is_taken(slot) && records.all()[slot].depth > 0) record_of_[records.all()[slot].body.slot] = slot + 1;
  }
  const std::span<const Contact<S>> now = contacts.now;
  detail::for_each_pair(now, [&](std::size_t first, std::size_t end) {
    const ContactKey& key = now[first].key;
    if (record_of_[key.body_a] != 0 || record_of_[key.body_b] != 0) weigh(contacts, first, end);
  });
  for (std::uint32_t slot = 0; slot < blows_.size(); ++slot) {
    if (S(0) < blows_[slot].impulse) mark(contacts, slot, events);
  }
}

/// Weighs the contacts of a pair, for both of its bodies.
template <class S> void BreakEvents<S>::weigh(const SolvedContacts<S>& contacts, std::size_t first, std::size_t end) {
  const S impulse = detail::normal_impulse(state_, contacts, first, end);
  const ContactKey& key = contacts.now[first].key;
  for (const bool on_b : {false, true}) {
    const std::uint32_t record = record_of_[on_b ? key.body_b : key.body_a];
    if (record == 0) continue;
    const S break_impulse = state_.records->breakables.all()[record - 1].break_impulse;
    const S broken_by = state_.parts.breakable_inputs[record - 1].impulse;
    Hit& blow = blows_[record - 1];
    if (break_impulse < impulse && broken_by < impulse && blow.impulse < impulse) blow = {impulse, first, on_b};
  }
}

template <class S> void BreakEvents<S>::mark(const SolvedContacts<S>& contacts, std::uint32_t slot, Events<S>& events) {
  const Hit& blow = blows_[slot];
  const ContactGeometry<S>& geometry = contacts.geometry[blow.contact];
  const std::uint32_t points = contacts.now[blow.contact].count;
  const S share = S(1) / S(static_cast<int>(max(points, 1u)));
  Vec3<S> arm = Vec3<S>::zero();
  for (std::uint32_t i = 0; i < points; ++i)
    arm += (blow.on_b ? geometry.points[i].arm_b : geometry.points[i].arm_a) * share;
  const Vec3<Unit<S>> direction = blow.on_b ? geometry.normal : -geometry.normal;
  const Breakable<S>& breakable = state_.records->breakables.all()[slot];
  Blow<S>& mark = state_.parts.breakable_inputs[slot];
  const Location at = map_.location(breakable.body.slot);
  const BodyState<S>& body = map_.state_at(at);
  const Mat3<Unit<S>> turn = to_matrix(body.orientation);
  mark.impulse = blow.impulse;
  mark.point = transposed_times(turn, arm) + map_.properties_at(at).local_centre;
  mark.direction = transposed_times(turn, direction);
  detail::keep_finite(mark);
  events.broke.push_back({breakable.body, blow.impulse, body.centre + arm, direction});
}

}  // namespace isostep
