// Bodies of hit_events.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/store/contact_ends.hpp"
#include "isostep/store/contact_pairs.hpp"
#include "isostep/systems/events/hit_events.hpp"

namespace isostep {

template <class S> void HitEvents<S>::list_thresholds() {
  const auto& records = state_.records->hit_reports;
  thresholds_.assign(state_.body_slots.entries().size(), S(-1));
  for (std::uint32_t slot = 0; slot < records.all().size(); ++slot) {
    if (records.is_taken(slot)) thresholds_[records.all()[slot].body.slot] = records.all()[slot].speed;
  }
}

template <class S> void HitEvents<S>::measure(std::span<const ContactGeometry<S>> geometry) {
  approaches_.clear();
  if (state_.records->hit_reports.all().empty()) return;
  list_thresholds();
  approaches_.resize(state_.contacts.size());
  for (std::size_t i = 0; i < state_.contacts.size(); ++i) {
    const ContactKey& key = state_.contacts[i].key;
    const bool asked = !(thresholds_[key.body_a] < S(0)) || !(thresholds_[key.body_b] < S(0));
    approaches_[i] = asked ? approach_of(geometry[i], state_.contacts[i].count) : Approach{S(0), 0};
  }
}

template <class S>
typename HitEvents<S>::Approach HitEvents<S>::approach_of(const ContactGeometry<S>& g, std::uint32_t count) const {
  const auto state_of = [&](std::uint32_t row) { return row == 0 ? nullptr : &state_.awake.states[row - 1]; };
  Approach fastest = {S(0), 0};
  for (std::uint32_t p = 0; p < count; ++p) {
    const auto& point = g.points[p];
    const Vec3<Velocity<S>> b_from_a =
        detail::velocity_at<S>(state_of(g.row_b), point.arm_b) - detail::velocity_at<S>(state_of(g.row_a), point.arm_a);
    const S speed = convert<S>(saturate_to<Velocity<S>>(dot_sum(-b_from_a, g.normal)));
    if (fastest.speed < speed) fastest = {speed, p};
  }
  return fastest;
}

template <class S> bool HitEvents<S>::touched(std::span<const Contact<S>> old, std::uint32_t a, std::uint32_t b) const {
  for (const Contact<S>& contact : detail::contacts_of(old, a, b)) {
    if ((contact.flags & contact_flag::kTouching) != 0) return true;
  }
  return false;
}

template <class S> void HitEvents<S>::collect(const SolvedContacts<S>& contacts, Events<S>& events) {
  if (approaches_.empty()) return;
  const std::span<const Contact<S>> now = contacts.now;
  detail::for_each_pair(now, [&](std::size_t first, std::size_t end) {
    bool touches = false, asked = false;
    for (std::size_t i = first; i < end; ++i) {
      touches = touches || (now[i].flags & contact_flag::kTouching) != 0;
      asked = asked || S(0) < approaches_[i].speed;
    }
    const ContactKey& key = now[first].key;
    if (touches && asked && !touched(contacts.old, key.body_a, key.body_b)) tell(contacts, first, end, events);
  });
}

/// Reports the fastest of the pair's contacts first..end-1, if it exceeds a threshold.
template <class S>
void HitEvents<S>::tell(const SolvedContacts<S>& contacts, std::size_t first, std::size_t end,
                        Events<S>& events) const {
  std::size_t fastest = first;
  for (std::size_t i = first + 1; i < end; ++i) {
    if (approaches_[fastest].speed < approaches_[i].speed) fastest = i;
  }
  const ContactKey& key = contacts.now[first].key;
  const Approach& approach = approaches_[fastest];
  const auto beyond = [&](S threshold) { return !(threshold < S(0)) && threshold < approach.speed; };
  if (!beyond(thresholds_[key.body_a]) && !beyond(thresholds_[key.body_b])) return;
  const ContactEnd parts = ends_of(state_, map_, contacts.now[fastest].key);
  const ContactGeometry<S>& g = contacts.geometry[fastest];
  const Vec3<S> at = map_.state_at(map_.location(key.body_b)).centre + g.points[approach.point].arm_b;
  events.hits.push_back({parts.a, parts.b, parts.child_a, parts.child_b, at, g.normal, approach.speed});
}

}  // namespace isostep
