// Bodies of contact_responses.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/store/contact_ends.hpp"
#include "isostep/systems/contacts/contact_responses.hpp"

namespace isostep {

template <class S> void ContactResponses<S>::update() {
  all_.clear();
  table_.update(state_.records->kind_responses);
  if (table_.empty()) return;
  const auto kind = [&](std::uint32_t slot, std::uint32_t leaf) {
    const BodyProperties<S>& body = map_.properties_at(map_.location(slot));
    if (!map_.shapes.traits_of(body.shape).has(part_flag::kOwnMaterial)) return body.material.kind;
    const std::uint32_t child = leaf_of(map_, slot, leaf).child;
    return map_.shapes.children_of(body.shape)[child].traits.material_or(body.material).kind;
  };
  for (std::uint32_t i = 0; i < state_.contacts.size(); ++i) {
    const ContactKey& key = state_.contacts[i].key;
    const std::uint32_t a = kind(key.body_a, key.child_a);
    const KindResponse<S>* const found = table_.find(a, kind(key.body_b, key.child_b));
    if (found == nullptr) continue;
    const KindResponse<S>& r = *found;
    const ContactResponse<S> as_named = {i,
                                         r.inverse_mass_scale_a,
                                         r.inverse_mass_scale_b,
                                         r.inverse_inertia_scale_a,
                                         r.inverse_inertia_scale_b,
                                         r.max_force};
    const ContactResponse<S> swapped = {i,
                                        r.inverse_mass_scale_b,
                                        r.inverse_mass_scale_a,
                                        r.inverse_inertia_scale_b,
                                        r.inverse_inertia_scale_a,
                                        r.max_force};
    all_.push_back(r.kind_a == a ? as_named : swapped);
  }
}

}  // namespace isostep
