// Bodies of contact_events.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/reduced_mass.hpp"
#include "isostep/store/event_order.hpp"
#include "isostep/store/finite_guard.hpp"
#include "isostep/systems/events/contact_events.hpp"

namespace isostep {
namespace detail {

/// [kg] As solvers have it: 0 for what no impulse moves.
template <class S> ISO_INLINE S mass_of_row(const WorldState<S>& state, std::uint32_t row) {
  if (row == 0) return S(0);
  const BodyProperties<S>& body = state.awake.properties[row - 1];
  return body.type == BodyType::dynamic ? body.mass : S(0);
}
/// [kg m/s] Of contacts first..end-1 together.
template <class S>
ISO_INLINE S normal_impulse(const WorldState<S>& state, const SolvedContacts<S>& contacts, std::size_t first,
                            std::size_t end) {
  auto total = SumOf<S, Velocity<S>>{};
  for (std::size_t i = first; i < end; ++i) {
    const ContactGeometry<S>& g = contacts.geometry[i];
    const S a = mass_of_row(state, g.row_a), b = mass_of_row(state, g.row_b);
    const ContactResponse<S>* const response = response_of(contacts.responses, i);
    const S mass = response == nullptr ? reduced_mass(a, b) : response->reduced(a, b);
    total = total + product(mass, contacts.impulses[i]);
  }
  const auto most = product(highest<S>(), Velocity<S>(1));
  return most < total ? highest<S>() : finite_of(round_to<S>(total));
}

}  // namespace detail

/// Both lists ascend, so the events do, but for ends that commands made.
template <class S> void ContactEvents<S>::collect(const SolvedContacts<S>& contacts, Events<S>& events) {
  const std::span<const Contact<S>> old = contacts.old, now = contacts.now;
  const auto id = [&](std::uint32_t slot) { return state_.body_slots.template id_of<BodyId>(slot); };
  constexpr std::uint64_t kNone = ~std::uint64_t{0};
  const auto pair_at = [&](std::span<const Contact<S>> list, std::size_t at) {
    return at < list.size() ? pair_key(list[at].key.body_a, list[at].key.body_b) : kNone;
  };
  const auto touching = [](const Contact<S>& c) { return (c.flags & contact_flag::kTouching) != 0; };
  const bool told = !events.contact_end.empty();
  std::size_t i = 0, j = 0;
  std::uint64_t old_pair = pair_at(old, 0), new_pair = pair_at(now, 0);
  while (min(old_pair, new_pair) != kNone) {
    const std::uint64_t pair = min(old_pair, new_pair);
    const std::size_t first = j;
    bool was = false, is = false;
    for (; old_pair == pair; old_pair = pair_at(old, ++i)) was = was || touching(old[i]);
    for (; new_pair == pair; new_pair = pair_at(now, ++j)) is = is || touching(now[j]);
    if (was && !is) events.contact_end.push_back({id(pair_a(pair)), id(pair_b(pair))});
    if (!was && is)
      events.contact_begin.push_back({id(pair_a(pair)), id(pair_b(pair)),
                                      detail::normal_impulse(state_, contacts, first, j),
                                      contacts.geometry[first].normal});
  }
  if (told) detail::sort_ends(events.contact_end, end_scratch_);
}

}  // namespace isostep
