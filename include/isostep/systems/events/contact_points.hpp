// ContactPoints<S>: tells of the contacts of bodies that have a ContactReport.
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "isostep/core/bitset.hpp"
#include "isostep/core/instantiate.hpp"
#include "isostep/store/body_map.hpp"
#include "isostep/systems/events/contact_events.hpp"

namespace isostep {

/// Input:   solved contacts of the step, the ContactReport records.
/// Output:  Events::contacts, ascending by contact, then by point.
/// Keeps:   nothing from step to step but memory.
template <class S> class ContactPoints {
 public:
  ISO_INLINE ContactPoints(WorldState<S>& state, const BodyMap<S>& map) : state_(state), map_(map) {}

  void collect(const SolvedContacts<S>& contacts, Events<S>& events);

 private:
  void tell(const SolvedContacts<S>& contacts, std::size_t at, Events<S>& events) const;

  WorldState<S>& state_;
  const BodyMap<S>& map_;
  Bitset asked_;  // by body slot
};

#define ISO_CONTACT_POINTS_OF(extern, S) extern template class ContactPoints<S>;
ISO_EXTERN_FOR_EACH_SCALAR(ISO_CONTACT_POINTS_OF)

}  // namespace isostep
