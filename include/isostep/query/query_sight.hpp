// QuerySight<S>: which bodies and parts the filter of a question takes.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/core/instantiate.hpp"
#include "isostep/store/body_map.hpp"
#include "isostep/store/query_types.hpp"

namespace isostep {

/// Input:   the state and the body map. Output: what a filter sees. Keeps: nothing.
template <class S> class QuerySight {
 public:
  ISO_INLINE QuerySight(const WorldState<S>& state, const BodyMap<S>& map) : state_(state), map_(map) {}

  ISO_INLINE BodyId id_of(std::uint32_t slot) const { return state_.body_slots.template id_of<BodyId>(slot); }
  /// Returns true if the filter takes a part of that body.
  bool sees(const QueryFilter& filter, std::uint32_t slot) const;
  /// Returns true if the filter takes the part. Its body is not ignored by its id.
  bool sees_part(const QueryFilter& filter, const BodyProperties<S>& body, const PartTraits<S>& part) const;

 private:
  static bool sees(const QueryFilter& filter, const Filter& of, std::uint32_t kind, bool senses);

  const WorldState<S>& state_;
  const BodyMap<S>& map_;
};

#define ISO_QUERY_SIGHT_OF(extern, S) extern template class QuerySight<S>;
ISO_EXTERN_FOR_EACH_SCALAR(ISO_QUERY_SIGHT_OF)

}  // namespace isostep
