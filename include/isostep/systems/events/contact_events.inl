// Bodies of contact_events.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/reduced_mass.hpp"
#include "isostep/store/contact_ends.hpp"
#include "isostep/store/contact_pairs.hpp"
#include "isostep/store/event_order.hpp"
#include "isostep/store/finite_guard.hpp"
#include "isostep/systems/events/contact_events.hpp"

namespace isostep {
namespace detail {

/// [kg] The mass as solvers see it: 0 if no impulse moves the body.
template <class S> ISO_INLINE S mass_of_row(const WorldState<S>& state, std::uint32_t row) {
  if (row == 0) return S(0);
  const BodyProperties<S>& body = state.awake.properties[row - 1];
  return body.type == BodyType::dynamic ? body.mass : S(0);
}
/// [kg m/s] Returns the summed normal impulse of contacts first..end-1 that have all bits of `flag`.
template <class S>
ISO_INLINE S normal_impulse(const WorldState<S>& state, const SolvedContacts<S>& contacts, std::size_t first,
                            std::size_t end, std::uint32_t flag = 0) {
  auto total = SumOf<S, Velocity<S>>{};
  for (std::size_t i = first; i < end; ++i) {
    if ((contacts.now[i].flags & flag) != flag) continue;
    const ContactGeometry<S>& g = contacts.geometry[i];
    const S a = mass_of_row(state, g.row_a), b = mass_of_row(state, g.row_b);
    const ContactResponse<S>* const response = response_of(contacts.responses, i);
    const S mass = response == nullptr ? reduced_mass(a, b) : response->reduced(a, b);
    total = total + product(mass, contacts.impulses[i]);
  }
  const auto most = product(highest<S>(), Velocity<S>(1));
  return most < total ? highest<S>() : finite_of(round_to<S>(total));
}
/// Returns the first of contacts first..end-1 that is reported and carried an impulse, or `end`.
template <class S>
ISO_INLINE std::size_t first_touching(std::span<const Contact<S>> contacts, std::size_t first, std::size_t end) {
  constexpr std::uint32_t kBoth = contact_flag::kReported | contact_flag::kTouching;
  while (first < end && (contacts[first].flags & kBoth) != kBoth) ++first;
  return first;
}

}  // namespace detail

/// Collects events in order, since both lists ascend; ends by commands are merged. Skips contacts that nobody reports.
template <class S> void ContactEvents<S>::collect(const SolvedContacts<S>& contacts, Events<S>& events) {
  const std::span<const Contact<S>> old = contacts.old, now = contacts.now;
  constexpr std::uint64_t kNone = ~std::uint64_t{0};
  const auto reported = [](std::span<const Contact<S>> list, std::size_t at) {
    while (at < list.size() && (list[at].flags & contact_flag::kReported) == 0) ++at;
    return at;
  };
  const auto pair_at = [&](std::span<const Contact<S>> list, std::size_t at) {
    return at < list.size() ? pair_key(list[at].key.body_a, list[at].key.body_b) : kNone;
  };
  const bool told = !events.contact_end.empty();
  std::size_t i = reported(old, 0), j = reported(now, 0);
  std::uint64_t old_pair = pair_at(old, i), new_pair = pair_at(now, j);
  while (min(old_pair, new_pair) != kNone) {
    const std::uint64_t pair = min(old_pair, new_pair);
    const std::size_t first_old = i, first_now = j;
    for (; old_pair == pair; old_pair = pair_at(old, i)) i = reported(old, i + 1);
    for (; new_pair == pair; new_pair = pair_at(now, j)) j = reported(now, j + 1);
    const std::size_t was = detail::first_touching<S>(old, first_old, i);
    const std::size_t is = detail::first_touching<S>(now, first_now, j);
    if (was < i && is == j) events.contact_end.push_back(ends_of(state_, map_, old[was].key));
    if (was == i && is < j) events.contact_begin.push_back(begin_of(contacts, is));
  }
  if (told) detail::sort_ends(events.contact_end, end_scratch_);
}

/// Returns the begin event of a pair whose first touching contact is `first`.
template <class S>
ContactBegin<S> ContactEvents<S>::begin_of(const SolvedContacts<S>& contacts, std::size_t first) const {
  const ContactEnd parts = ends_of(state_, map_, contacts.now[first].key);
  const std::size_t end = detail::end_of_pair(contacts.now, first);
  const S impulse = detail::normal_impulse(state_, contacts, first, end, contact_flag::kReported);
  return {parts.a, parts.b, parts.child_a, parts.child_b, impulse, contacts.geometry[first].normal};
}

}  // namespace isostep
