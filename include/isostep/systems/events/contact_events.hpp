// ContactEvents<S>: which bodies that report it began and ceased to press on each other.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "isostep/core/instantiate.hpp"
#include "isostep/dynamics/contact_response.hpp"
#include "isostep/store/body_map.hpp"
#include "isostep/store/events.hpp"
#include "isostep/store/state.hpp"

namespace isostep {

/// Holds the contacts of a step after the narrow phase and the solver.
template <class S> struct SolvedContacts {
  std::span<const Contact<S>> old, now;                // of the last step and of this one, ascending
  std::span<const ContactGeometry<S>> geometry;        // parallel to `now`
  std::span<const Velocity<S>> impulses;               // [m/s] likewise, of the whole step
  std::span<const ContactResponse<S>> responses = {};  // of those that answer otherwise, ascending by contact
};

/// Input:   the contacts of two steps.
/// Output:  events of contacts that began, with the impulse, and of contacts that ended, in order.
/// Keeps:   nothing from step to step but memory.
template <class S> class ContactEvents {
 public:
  ISO_INLINE ContactEvents(const WorldState<S>& state, const BodyMap<S>& map) : state_(state), map_(map) {}

  /// Two bodies touch when a reported contact of them carried an impulse. Appends to `events`, which may already hold
  /// ends that commands caused.
  void collect(const SolvedContacts<S>& contacts, Events<S>& events);

 private:
  ContactBegin<S> begin_of(const SolvedContacts<S>& contacts, std::size_t first) const;

  const WorldState<S>& state_;
  const BodyMap<S>& map_;
  std::vector<ContactEnd> end_scratch_;
};

#define ISO_CONTACT_EVENTS_OF(extern, S) extern template class ContactEvents<S>;
ISO_EXTERN_FOR_EACH_SCALAR(ISO_CONTACT_EVENTS_OF)

}  // namespace isostep
