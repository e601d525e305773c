// Carriers<S>: finds the kinematic bodies that turn, and the contacts on them and on turning belts.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "isostep/core/instantiate.hpp"
#include "isostep/dynamics/belt.hpp"
#include "isostep/dynamics/body.hpp"
#include "isostep/dynamics/carrying.hpp"
#include "isostep/dynamics/contact.hpp"

namespace isostep {

/// Input:   the awake bodies, the geometry of the contacts, the rate of the solver's integration [1/s]; if belts turn,
///          these and the contacts.
/// Output:  the contacts on carriers and on turning belts, ascending.
/// Keeps:   nothing from step to step but memory.
template <class S> class Carriers {
 public:
  void update(std::span<const BodyState<S>> states, std::span<const BodyProperties<S>> properties,
              std::span<const ContactGeometry<S>> geometry, std::int32_t rate,
              std::span<const Contact<S>> contacts = {}, const Belts<S>* belts = nullptr);
  ISO_INLINE const std::vector<Carried<S>>& carried() const { return carried_; }

 private:
  void find_carriers(std::span<const BodyState<S>> states, std::span<const BodyProperties<S>> properties,
                     std::int32_t rate);
  bool add_on_carrier(std::uint32_t contact, const ContactGeometry<S>& g);
  void add_on_belt(std::uint32_t contact, const ContactKey& key, const ContactGeometry<S>& g, std::int32_t rate);
  void spin_on_belts(const ContactKey& key, Carried<S>& carried) const;

  const Belts<S>* belts_ = nullptr;   // for one update; null: none turns
  std::vector<Carrier<S>> carriers_;  // by row
  std::vector<Carried<S>> carried_;
};

#define ISO_CARRIERS_OF(extern, S) extern template class Carriers<S>;
ISO_EXTERN_FOR_EACH_SCALAR(ISO_CARRIERS_OF)

}  // namespace isostep
