// What the key of a contact names: bodies, and the leaves of their parts.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/store/body_map.hpp"

namespace isostep {

/// Returns the leaf that a contact's key names.
template <class S> Leaf leaf_of(const BodyMap<S>& map, std::uint32_t body_slot, std::uint32_t leaf) {
  const BodyProperties<S>& body = map.properties_at(map.location(body_slot));
  if (body.type == BodyType::dynamic) return {leaf, 0};  // it has no surfaces
  return leaf_at<S>(map.shapes.tree_of(body.shape), map.shapes.children_of(body.shape), map.shapes.contents(), leaf);
}

/// Returns the bodies and parts of a contact.
template <class S> ContactEnd ends_of(const WorldState<S>& state, const BodyMap<S>& map, const ContactKey& key) {
  const auto id = [&](std::uint32_t slot) { return state.body_slots.template id_of<BodyId>(slot); };
  return {id(key.body_a), id(key.body_b), leaf_of(map, key.body_a, key.child_a).child,
          leaf_of(map, key.body_b, key.child_b).child};
}

}  // namespace isostep
