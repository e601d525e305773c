// Bodies of contact_points.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/store/contact_ends.hpp"
#include "isostep/systems/events/contact_events.inl"
#include "isostep/systems/events/contact_points.hpp"

namespace isostep {

template <class S> void ContactPoints<S>::collect(const SolvedContacts<S>& contacts, Events<S>& events) {
  const auto& records = state_.records->contact_reports;
  if (records.all().empty()) return;
  asked_.clear();
  for (std::uint32_t slot = 0; slot < records.all().size(); ++slot) {
    if (records.is_taken(slot)) asked_.set(records.all()[slot].body.slot);
  }
  for (std::size_t i = 0; i < contacts.now.size(); ++i) {
    const ContactKey& key = contacts.now[i].key;
    if (asked_.test(key.body_a) || asked_.test(key.body_b)) tell(contacts, i, events);
  }
}

/// Reports the points of a contact. They share its impulse of the step as they share that of the last sub-step.
template <class S>
void ContactPoints<S>::tell(const SolvedContacts<S>& contacts, std::size_t at, Events<S>& events) const {
  const Contact<S>& contact = contacts.now[at];
  const ContactGeometry<S>& g = contacts.geometry[at];
  const auto id = [&](std::uint32_t slot) { return state_.body_slots.template id_of<BodyId>(slot); };
  const Leaf a = leaf_of(map_, contact.key.body_a, contact.key.child_a);
  const Leaf b = leaf_of(map_, contact.key.body_b, contact.key.child_b);
  const Vec3<S> centre_b = map_.state_at(map_.location(contact.key.body_b)).centre;
  const S total = detail::normal_impulse(state_, contacts, at, at + 1);
  Velocity<S> largest = Velocity<S>(0);
  for (std::uint32_t p = 0; p < contact.count; ++p) largest = max(largest, contact.normal_impulse[p]);
  const bool known = Velocity<S>(0) < largest;
  const auto weight = [&](std::uint32_t p) {  // [1] against the largest
    return known ? convert<S>(contact.normal_impulse[p] / largest) : S(1);
  };
  S weights = S(0);
  for (std::uint32_t p = 0; p < contact.count; ++p) weights += weight(p);
  for (std::uint32_t p = 0; p < contact.count; ++p) {
    const S share = divide_to<S>(weight(p), weights);
    events.contacts.push_back({id(contact.key.body_a), id(contact.key.body_b), a.child, b.child, a.triangle, b.triangle,
                               centre_b + g.points[p].arm_b, g.normal, g.points[p].separation,
                               saturate_to<S>(product(total, share))});
  }
}

}  // namespace isostep
