// BreakEvents<S>: which breakable bodies a step's contacts broke.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/core/instantiate.hpp"
#include "isostep/store/body_map.hpp"
#include "isostep/systems/events/contact_events.hpp"

namespace isostep {

/// Input:   a step's contacts and the Breakable records.
/// Output:  marks in those records, and events, ascending by the record's slot. Of several blows in a step the hardest
///          counts, the first of equals.
/// Keeps:   nothing from step to step but memory.
template <class S> class BreakEvents {
 public:
  ISO_INLINE BreakEvents(WorldState<S>& state, const BodyMap<S>& map) : state_(state), map_(map) {}

  void collect(const SolvedContacts<S>& contacts, Events<S>& events);

 private:
  struct Hit {
    S impulse;            // [kg m/s] 0: none
    std::size_t contact;  // the first of the pair
    bool on_b;
  };
  void weigh(const SolvedContacts<S>& contacts, std::size_t first, std::size_t end);
  void mark(const SolvedContacts<S>& contacts, std::uint32_t slot, Events<S>& events);

  WorldState<S>& state_;
  const BodyMap<S>& map_;
  std::vector<std::uint32_t> record_of_;  // by body slot: 1 + the record's, or 0
  std::vector<Hit> blows_;                // by record slot
};

#define ISO_BREAK_EVENTS_OF(extern, S) extern template class BreakEvents<S>;
ISO_EXTERN_FOR_EACH_SCALAR(ISO_BREAK_EVENTS_OF)

}  // namespace isostep
