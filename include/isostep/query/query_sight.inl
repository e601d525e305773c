// Bodies of query_sight.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/query/query_sight.hpp"

namespace isostep {

template <class S> bool QuerySight<S>::sees(const QueryFilter& filter, std::uint32_t slot) const {
  const BodyProperties<S>& body = map_.properties_at(map_.location(slot));
  for (const BodyId unseen : filter.ignore_all) {
    if (unseen && id_of(slot) == unseen) return false;
  }
  if (filter.ignore && id_of(slot) == filter.ignore) return false;
  const bool senses = (body.flags & body_flag::kSensor) != 0;
  if (map_.shapes.traits_of(body.shape).flags == 0) return sees(filter, body.filter, body.material.kind, senses);
  for (const Child<S>& child : map_.shapes.children_of(body.shape)) {
    if (sees_part(filter, body, child.traits)) return true;
  }
  return false;
}
template <class S>
bool QuerySight<S>::sees_part(const QueryFilter& filter, const BodyProperties<S>& body,
                              const PartTraits<S>& part) const {
  return sees(filter, part.filter_or(body.filter), part.material_or(body.material).kind,
              (body.flags & body_flag::kSensor) != 0 || part.has(part_flag::kSensor));
}
template <class S>
bool QuerySight<S>::sees(const QueryFilter& filter, const Filter& of, std::uint32_t kind, bool senses) {
  for (const std::uint32_t ignored : filter.ignore_kinds) {
    if (ignored == kind) return false;
  }
  const bool grouped = filter.group != 0 && filter.group == of.group;
  return (of.category & filter.mask) != 0 && !grouped && (filter.sensors || !senses);
}

}  // namespace isostep
