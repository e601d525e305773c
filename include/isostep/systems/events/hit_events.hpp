// HitEvents<S>: contacts that begin fast, of bodies with a HitReport.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/core/instantiate.hpp"
#include "isostep/store/body_map.hpp"
#include "isostep/systems/events/contact_events.hpp"

namespace isostep {

/// Input:   the records; a step's contacts, after the narrow phase and again after the solver.
/// Output:  events, ascending by pair, each with the point of the pair that closed fastest.
/// Keeps:   nothing from step to step but memory.
template <class S> class HitEvents {
 public:
  ISO_INLINE HitEvents(const WorldState<S>& state, const BodyMap<S>& map) : state_(state), map_(map) {}

  /// Measures how fast contacts close. Called before the solver.
  void measure(std::span<const ContactGeometry<S>> geometry);
  /// Collects contacts that began to press. Called after the solver.
  void collect(const SolvedContacts<S>& contacts, Events<S>& events);

 private:
  struct Approach {
    S speed;              // [m/s] 0: of no body with a record, or leaving
    std::uint32_t point;  // of the contact
  };
  void list_thresholds();
  Approach approach_of(const ContactGeometry<S>& g, std::uint32_t count) const;
  bool touched(std::span<const Contact<S>> old, std::uint32_t a, std::uint32_t b) const;
  void tell(const SolvedContacts<S>& contacts, std::size_t first, std::size_t end, Events<S>& events) const;

  const WorldState<S>& state_;
  const BodyMap<S>& map_;
  std::vector<S> thresholds_;         // [m/s] by body slot; below 0: none
  std::vector<Approach> approaches_;  // parallel to the contacts; empty: nobody asks
};

#define ISO_HIT_EVENTS_OF(extern, S) extern template class HitEvents<S>;
ISO_EXTERN_FOR_EACH_SCALAR(ISO_HIT_EVENTS_OF)

}  // namespace isostep
