// ParticleContacts: which constraints hold in a step, with the impulses of the last one, and what of them is kept.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/core/instantiate.hpp"
#include "isostep/particles/step/pair_search.hpp"
#include "isostep/particles/step/rows.hpp"

namespace isostep {

template <class S> class ParticleContacts {
 public:
  using V = Velocity<S>;
  using U = Unit<S>;
  using Row = ParticleConstraint<S>;

  ParticleContacts(ParticleState<S>& state, ParticleStep<S>& step, PairSearch<S>& search, ParticleRows<S>& rows);

  /// Finds links; contacts that may come about within the step, by ascending key, with their last impulses; touches.
  void find();
  /// Contacts that bore anything stay in the state, with their impulses where a solver `keeps_impulses` from step to
  /// step; events tell those that began, and what touched bodies got. Touches and pushes are used up.
  void store(bool keeps_impulses);

  template <class Visit> void visit_scratch(const Visit& visit);

 private:
  void add_links();
  void find_pairs();
  void add_pair(std::uint32_t a, std::uint32_t b, std::size_t& old);
  void add_scenery(std::uint32_t slot, std::size_t& old);
  void add_contact(std::uint32_t a, std::uint32_t b, S radius, const ParticleMaterial<S>& material, std::size_t& old);
  void add_touches();
  ISO_INLINE bool is_old(const ParticleContact<S>& contact, std::size_t& old) const;
  void store_contacts(bool keeps_impulses);
  void store_touches();
  void tell_contact(const ParticleContact<S>& contact, const Row& row);
  ISO_INLINE const ParticleMaterial<S>& material_of(std::uint32_t slot) const {
    return state_.materials.all()[state_.material[slot]];
  }

  ParticleState<S>& state_;
  ParticleStep<S>& step_;
  PairSearch<S>& search_;
  ParticleRows<S>& rows_;
  std::vector<std::uint64_t> pairs_;              // a << 32 | b, ascending
  std::vector<ParticleContact<S>> old_contacts_;  // of the last step
};

#define ISO_PARTICLE_CONTACTS_OF(extern, S) extern template class ParticleContacts<S>;
ISO_EXTERN_FOR_EACH_SCALAR(ISO_PARTICLE_CONTACTS_OF)

}  // namespace isostep
