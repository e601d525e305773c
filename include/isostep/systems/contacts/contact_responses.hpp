// ContactResponses<S>: which of a step's contacts answer otherwise, by KindResponse records.
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "isostep/core/instantiate.hpp"
#include "isostep/dynamics/contact_response.hpp"
#include "isostep/dynamics/kind_table.hpp"
#include "isostep/store/body_map.hpp"

namespace isostep {

/// Input:   the step's contacts, the materials of their bodies, the records.
/// Output:  the response of each contact whose kinds have a record, ascending by contact.
/// Keeps:   nothing from step to step but memory.
template <class S> class ContactResponses {
 public:
  ISO_INLINE ContactResponses(const WorldState<S>& state, const BodyMap<S>& map) : state_(state), map_(map) {}

  void update();
  ISO_INLINE std::span<const ContactResponse<S>> all() const { return all_; }
  ISO_INLINE const ResponseTable<S>& table() const { return table_; }
  template <class Visit> void visit_scratch(const Visit& visit) {
    if (!all_.empty()) visit("responses", all_);
  }

 private:
  const WorldState<S>& state_;
  const BodyMap<S>& map_;
  ResponseTable<S> table_;
  std::vector<ContactResponse<S>> all_;
};

#define ISO_CONTACT_RESPONSES_OF(extern, S) extern template class ContactResponses<S>;
ISO_EXTERN_FOR_EACH_SCALAR(ISO_CONTACT_RESPONSES_OF)

}  // namespace isostep
